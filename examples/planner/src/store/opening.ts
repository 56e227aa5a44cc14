// How far the valve would open: measured by itself while an operation that narrows it is chosen, after the figures of
// the closed valve.
import { effect } from '@preact/signals';
import type { Cost } from '../protocol';
import { fail, request } from './requests';
import * as state from './state';

/** Operations that narrow the open valve. */
export const narrowing = new Set(['ring', 'band', 'annulus_scale', 'clip', 'resect']);
/** ms without a change of the form before the worker is taken for it; it cannot be interrupted. */
const rest = 400;
/** Vertices above which it takes too long to be done unasked. */
const most = 2500;

/** The opening of a closed valve if it was measured. */
export function openingOf(hash: string | undefined): Cost | null {
  if (!hash) return null;
  if (state.cost.value?.hash === hash) return state.cost.value.value;
  return state.openings.value.get(hash) ?? null;
}

async function measure(which: 'main' | 'preview', hash: string): Promise<void> {
  const { value: flow } = state.flow;
  const found = await request('cost', { which, flow: flow ?? 0 });
  const kept = [...state.openings.value].slice(-20);
  state.openings.value = new Map([...kept, [hash, found]]);
}

/** Measures the preview, then the valve before it. */
async function measureBoth(): Promise<void> {
  const [preview, main] = [state.preview.value?.figures, state.main.value?.figures];
  const idle = () =>
    !!preview && state.preview.value?.figures === preview && !state.pending.value && !state.busy.value;
  try {
    if (preview && idle() && !openingOf(preview.hash)) await measure('preview', preview.hash);
    if (main && idle() && !openingOf(main.hash)) await measure('main', main.hash);
  } catch (error) {
    fail(error);
  }
}

export function watchOpening(): void {
  let timer = 0;
  effect(() => {
    const { draft, pending, busy, preview } = state;
    window.clearTimeout(timer);
    const ready =
      narrowing.has(draft.value?.kind ?? '') &&
      preview.value?.figures.known === 'all' &&
      !pending.value &&
      !busy.value &&
      preview.value.picture.positions.length <= 3 * most;
    if (ready) timer = window.setTimeout(() => void measureBoth(), rest);
  });
}
