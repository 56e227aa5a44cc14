// Undo and redo, and the slider that opens and closes the valve.
import { t } from '../text/texts';
import { discard } from './edit';
import { change, fail, request } from './requests';
import * as state from './state';

export async function undo(): Promise<void> {
  if (state.draft.value) return discard();
  if (!state.canUndo.value) return;
  await change(t.undoing, 'undo', null);
  state.changed.value = true;
}

export async function redo(): Promise<void> {
  if (!state.canRedo.value) return;
  await change(t.redoing, 'redo', null);
  state.changed.value = true;
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
      state.receive(motion.picture);
      if (state.openness.value < 1) state.motion.value = motion;
    } catch (error) {
      fail(error);
    }
  }
  opening = false;
}
