// How far the valve would open: measured by itself while an operation that narrows it is chosen, after the figures of
// the closed valve.
import { effect, untracked } from '@preact/signals';
import type { CostRequest } from '../calls';
import type { Cost, Shown } from '../protocol';
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
  if (state.cost.value?.hash === hash) return state.cost.value;
  return state.openings.value.get(hash) ?? null;
}

/** Remembers the opening of the closed valve that was measured, among the last ones. */
export function keepOpening(found: Cost): void {
  state.openings.value = new Map([...[...state.openings.value].slice(-20), [found.hash, found]]);
}

async function measure(which: CostRequest['which']): Promise<void> {
  const { value: flow } = state.flow;
  keepOpening(await request('cost', { which, flow: flow ?? 0 }));
}

/** True while two plans that are compared are measured. */
let comparing = false;

/** Measures the openings of the present plan and of the one that it is compared with, unless they take too long. */
async function measureCompared(name: string, other: Shown, main: Shown): Promise<void> {
  if (comparing || main.picture.positions.length > 3 * most) return;
  comparing = true;
  try {
    if (!openingOf(other.figures.hash)) await measure(`checkpoint ${name}`);
    if (!openingOf(main.figures.hash) && state.main.value === main) await measure('main');
  } catch (error) {
    fail(error);
  } finally {
    comparing = false;
  }
}

/** Measures the preview, then the valve before it. */
async function measureBoth(): Promise<void> {
  const [preview, main] = [state.preview.value?.figures, state.main.value?.figures];
  const idle = () =>
    !!preview && state.preview.value?.figures === preview && !state.pending.value && !state.busy.value;
  try {
    if (preview && idle() && !openingOf(preview.hash)) await measure('preview');
    if (main && idle() && !openingOf(main.hash)) await measure('main');
  } catch (error) {
    fail(error);
  }
}

/** Measures two plans that are compared as soon as all figures are known and nothing else is under way. */
function watchCompared(): void {
  effect(() => {
    const [name, other, main] = [state.compareWith.value, state.compared.value, state.main.value];
    const idle = !state.busy.value && !state.draft.value && main?.figures.known === 'all';
    if (name && other && main && idle) untracked(() => void measureCompared(name, other, main));
  });
}

export function watchOpening(): void {
  watchCompared();
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
