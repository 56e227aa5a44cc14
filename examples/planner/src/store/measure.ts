// Checkpoints, and figures that are calculated on request.
import { batch } from '@preact/signals';
import { change, run } from './requests';
import { keepOpening } from './opening';
import * as state from './state';
import { planTexts, t } from '../text/texts';

export async function saveCheckpoint(name: string): Promise<void> {
  const names = await run(t.saving, 'checkpoint', { name });
  if (!names) return;
  state.checkpoints.value = names;
  state.changed.value = true;
}

export async function renameCheckpoint(name: string, to: string): Promise<void> {
  if (!to || to === name) return;
  const names = await run(t.saving, 'rename_checkpoint', { name, to });
  if (!names) return;
  batch(() => {
    state.checkpoints.value = names;
    if (state.compareWith.value === name) state.compareWith.value = to;
    state.changed.value = true;
  });
}

/** A name that no checkpoint has, for the next one. */
export function nextName(): string {
  let k = state.checkpoints.value.length + 1;
  while (state.checkpoints.value.includes(planTexts.planOf(k))) ++k;
  return planTexts.planOf(k);
}

export async function restoreCheckpoint(name: string): Promise<void> {
  await change(t.undoing, 'restore', { name });
}

export async function compareCheckpoint(name: string | null): Promise<void> {
  state.compareWith.value = name;
  state.compared.value = null;
  if (!name) return;
  const shown = await run(t.measuring, 'read_checkpoint', { name });
  if (!shown) return;
  state.receive(shown.picture);
  state.compared.value = shown;
}

export async function measureCost(): Promise<void> {
  const figures = (state.preview.value ?? state.main.value)?.figures;
  if (!figures) return;
  const value = await run(t.measuring, 'cost', {
    which: state.preview.value ? 'preview' : 'main',
    flow: state.flow.value ?? 0,
  });
  if (!value) return;
  state.cost.value = { hash: figures.hash, value };
  keepOpening(figures.hash, value);
}

export async function measureSpread(): Promise<void> {
  const figures = state.main.value?.figures;
  if (!figures) return;
  const value = await run(t.spreading, 'spread', { members: 8 });
  if (value) state.spread.value = { hash: figures.hash, value };
}
