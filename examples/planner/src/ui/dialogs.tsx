// Dialogs: the list of keys, the report; a notice at the foot of the page; the offer to recover a session.
import { useEffect, useRef } from 'preact/hooks';
import type { ComponentChildren } from 'preact';
import { fail } from '../store/requests';
import { forgetCopy, recover, recoverable } from '../store/recovery';
import * as state from '../store/state';
import { appTexts, barTexts, dialogTexts, help } from '../text/texts';
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
          <summary>{dialogTexts.licences}</summary>
          <pre class="licences">{document.getElementById('licences')?.textContent}</pre>
        </details>
        <p class="hint">{dialogTexts.about(state.version.value)}</p>
      </Modal>
    );
  }
  if (state.dialog.value === 'report') return <ReportDialog />;
  return null;
}

export function Notice() {
  const notice = state.notice.value;
  useEffect(() => {
    if (notice?.kind !== 'info') return;
    const timer = setTimeout(() => (state.notice.value = null), notice.action ? 30_000 : 8000);
    return () => clearTimeout(timer);
  }, [notice]);
  if (!notice) return null;
  return (
    <div
      class={`notice ${notice.kind}`}
      role={notice.kind === 'error' ? 'alert' : 'status'}
      data-testid="notice"
    >
      <span>{notice.text}</span>
      {notice.action && (
        <Button kind="main" onClick={() => ((state.notice.value = null), notice.action!.run())}>
          {notice.action.text}
        </Button>
      )}
      <Button kind="quiet" onClick={() => (state.notice.value = null)}>
        {appTexts.close}
      </Button>
    </div>
  );
}

export function Recovery() {
  const [kept] = recoverable.value;
  if (!kept || !state.ready.value) return null;
  return (
    <div class="notice info" role="status" data-testid="recovery">
      <span>{dialogTexts.left(kept.title, new Date(kept.saved).toLocaleString(), kept.surface)}</span>
      <Button kind="main" onClick={() => void recover().catch(fail)}>
        {dialogTexts.recover}
      </Button>
      <Button onClick={() => void forgetCopy().catch(fail)}>{dialogTexts.forget}</Button>
    </div>
  );
}
