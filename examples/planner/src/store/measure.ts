// Checkpoints, and figures that are calculated on request.
import { batch } from '@preact/signals';
import type { Calls } from '../calls';
import type { CheckpointList } from '../protocol';
import { mayReplace } from './ask';
import { offerReturn } from './files';
import { leave } from './left';
import { change, run, whole } from './requests';
import { keepOpening } from './opening';
import { keptName } from './plans';
import * as state from './state';
import { planTexts, t } from '../text/texts';

/** Runs a request that changes the list of checkpoints; whether it was done. */
async function changeList<
  Name extends 'checkpoint' | 'rename_checkpoint' | 'remove_checkpoint' | 'put_back_checkpoint',
>(name: Name, argument: Calls[Name]['argument']): Promise<boolean> {
  const list = (await run(t.saving, name, argument)) as CheckpointList | null;
  if (!list) return false;
  batch(() => {
    state.receiveCheckpoints(list);
    state.changed.value = true;
  });
  return true;
}

export async function saveCheckpoint(name: string): Promise<void> {
  const replaced = state.checkpoints.value.includes(name);
  const done = await changeList('checkpoint', { name });
  if (done && replaced) state.status.value = planTexts.replaced(name);
  // the one that it replaced is no longer what the plan is compared with
  if (done && state.compareWith.value === name) await compareCheckpoint(name);
}

export async function renameCheckpoint(name: string, to: string): Promise<void> {
  if (!to || to === name) return;
  const done = await changeList('rename_checkpoint', { name, to });
  if (done && state.compareWith.value === name) state.compareWith.value = to;
}

export async function removeCheckpoint(name: string): Promise<void> {
  if (state.compareWith.value === name) await compareCheckpoint(null);
  if (await changeList('remove_checkpoint', { name })) state.status.value = planTexts.removed(name);
}

export async function putBackCheckpoint(): Promise<void> {
  await changeList('put_back_checkpoint', null);
}

/** A name that no checkpoint has, for the next one. */
export function nextName(): string {
  let k = state.checkpoints.value.length + 1;
  while (state.checkpoints.value.includes(planTexts.planOf(k))) ++k;
  return planTexts.planOf(k);
}

export async function restoreCheckpoint(name: string): Promise<void> {
  const kept = () => !!keptName(state.main.value?.figures.hash);
  if (!kept() && state.changed.value && state.canUndo.value && !(await mayReplace(name, 'name'))) return;
  await whole(async () => {
    // a plan that is not kept can be returned to
    const left = kept() ? null : await leave();
    await change(t.undoing, 'restore', { name });
    state.changed.value = true;
    offerReturn(left, null);
  });
}

export async function compareCheckpoint(name: string | null): Promise<void> {
  state.compareWith.value = name;
  state.compared.value = null;
  if (!name) return;
  const shown = await run(t.measuring, 'read_checkpoint', { name });
  if (!shown) return;
  state.compared.value = shown;
}

export async function measureCost(): Promise<void> {
  if (!state.main.value) return;
  const value = await run(t.measuring, 'cost', { which: state.preview.value ? 'preview' : 'main' });
  if (!value) return;
  state.cost.value = value;
  keepOpening(value);
}

export async function measureSpread(): Promise<void> {
  if (!state.main.value) return;
  const value = await run(t.spreading, 'spread', { members: 8 });
  if (value) state.spread.value = value;
}
