// Undo and redo, and the slider that opens and closes the valve.
import { t } from '../text/texts';
import { discard } from './edit';
import { change, fail, request } from './requests';
import * as state from './state';

let steps: Promise<void> = Promise.resolve();

/** Steps that are asked for quickly are made one after the other, each from the valve that the one before left. */
function step(possible: () => boolean, text: string, name: 'undo' | 'redo'): Promise<void> {
  steps = steps.then(async () => {
    if (!possible()) return;
    await change(text, name, null);
    state.changed.value = true;
  });
  return steps;
}

export async function undo(): Promise<void> {
  if (state.draft.value) return discard();
  await step(() => state.canUndo.value, t.undoing, 'undo');
}

export async function redo(): Promise<void> {
  await step(() => state.canRedo.value, t.redoing, 'redo');
}

let opening = false;
let wanted: number | null = null;

/** The slider between open and closed; only the latest position is calculated. */
export async function openTo(share: number): Promise<void> {
  state.openness.value = share;
  wanted = share;
  if (opening) return;
  opening = true;
  while (wanted !== null) {
    const next = wanted;
    wanted = null;
    if (next >= 1) {
      state.motion.value = null;
      continue;
    }
    try {
      const motion = await request('open_to', { share: next });
      if (state.openness.value < 1) state.motion.value = motion;
    } catch (error) {
      fail(error);
    }
  }
  opening = false;
}
