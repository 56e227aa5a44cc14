// The plans that are kept under a name, as the report lists them.
import type { Shown } from '../protocol';
import { planTexts } from '../text/texts';
import { request } from './requests';
import * as state from './state';

/** The name under which the valve with this hash is kept; empty where it is not. */
export function keptName(hash: string | undefined): string {
  const k = state.checkpointHashes.value.indexOf(hash ?? '');
  return k < 0 ? '' : state.checkpoints.value[k];
}

/** The same; of a valve that is not kept, words for the present plan. */
export const planName = (hash: string | undefined): string => keptName(hash) || planTexts.present;

/** Reads the kept plans other than the present one. Their valves are kept closed: nothing is closed again. */
export async function readPlans(): Promise<void> {
  const present = state.main.value?.figures.hash;
  const names = state.checkpoints.value.filter((_, k) => state.checkpointHashes.value[k] !== present);
  const read = new Map<string, Shown>();
  for (const name of names) read.set(name, await request('read_checkpoint', { name }));
  state.keptPlans.value = read;
}
