// Dialogs: the list of keys, the report, what the figures mean, a question.
import * as state from '../store/state';
import { barTexts, dialogTexts, help, tips } from '../text/texts';
import { Ask } from './ask';
import { FigureHelp } from './glossary';
import { Modal } from './modal';
import { FigureHelpButton } from './parts';
import { ReportDialog } from './report';

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
        <FigureHelpButton />
        <details class="section">
          <summary title={tips[dialogTexts.licences]}>{dialogTexts.licences}</summary>
          <pre class="licences">{document.getElementById('licences')?.textContent}</pre>
        </details>
        <p class="hint">{dialogTexts.about(state.version.value)}</p>
      </Modal>
    );
  }
  if (state.dialog.value === 'figures') return <FigureHelp />;
  if (state.dialog.value === 'report') return <ReportDialog />;
  if (state.dialog.value === 'ask') return <Ask />;
  return null;
}
