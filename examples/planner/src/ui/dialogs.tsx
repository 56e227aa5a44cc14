// Dialogs: the list of keys, the report.
import { useEffect, useRef } from 'preact/hooks';
import type { ComponentChildren } from 'preact';
import * as state from '../store/state';
import { appTexts, barTexts, dialogTexts, help, tips } from '../text/texts';
import { Button } from './parts';
import { ReportDialog } from './report';

export function Modal(props: { title: string; wide?: boolean; children: ComponentChildren }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  const close = () => (state.dialog.value = null);
  return (
    <dialog
      ref={dialog}
      class={props.wide ? 'wide' : ''}
      aria-label={props.title}
      onClose={close}
      onCancel={close}
    >
      <div class="form-head">
        <h2>{props.title}</h2>
        <Button kind="quiet" onClick={close}>
          {appTexts.close}
        </Button>
      </div>
      {props.children}
    </dialog>
  );
}

export function Dialogs() {
  if (state.dialog.value === 'keys') {
    return (
      <Modal title={barTexts.help}>
        <table class="table">
          <tbody>
            {help.keys.map(([key, text]) => (
              <tr>
                <th scope="row">
                  <kbd>{key}</kbd>
                </th>
                <td>{text}</td>
              </tr>
            ))}
          </tbody>
        </table>
        <p>{dialogTexts.pointer}</p>
        <details class="section">
          <summary title={tips[dialogTexts.licences]}>{dialogTexts.licences}</summary>
          <pre class="licences">{document.getElementById('licences')?.textContent}</pre>
        </details>
        <p class="hint">{dialogTexts.about(state.version.value)}</p>
      </Modal>
    );
  }
  if (state.dialog.value === 'report') return <ReportDialog />;
  return null;
}
