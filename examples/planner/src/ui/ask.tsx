// The question before a plan that is kept nowhere gives way to another one: keep it first, go on without it, or stay.
import { answer, question } from '../store/ask';
import { saveSession } from '../store/keep';
import { nextName, saveCheckpoint } from '../store/measure';
import * as state from '../store/state';
import { askTexts, t, tips } from '../text/texts';
import { Modal } from './modal';
import { Button } from './parts';

export function Ask() {
  const { value } = question;
  if (!value) return null;
  const name = nextName();
  const keep = async () => {
    if (value.keep === 'file') await saveSession();
    else await saveCheckpoint(name);
    answer(true);
  };
  return (
    <Modal
      title={askTexts.title}
      onClose={() => answer(false)}
      close={t.cancel}
      closeTip={tips[askTexts.stay]}
    >
      <p data-testid="ask">{askTexts.lost(state.title.value, value.to, value.keep)}</p>
      <div class="row">
        <Button kind="main" title={tips[askTexts.save]} onClick={() => void keep()}>
          {value.keep === 'file' ? askTexts.save : askTexts.keep(name)}
        </Button>
        <Button onClick={() => answer(true)}>{askTexts.replace}</Button>
      </div>
    </Modal>
  );
}
