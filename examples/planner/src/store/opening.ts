// How far the valve would open: measured by itself while an operation that narrows it is chosen, after the figures of
// the closed valve.
import { effect, untracked } from '@preact/signals';
import type { CostRequest } from '../calls';
import type { Cost, Shown } from '../protocol';
import { measuresItself, narrowing, openingOf, unmeasurable } from './limits';
import { fail, request } from './requests';
import * as state from './state';
import { isNarrowed } from './verdict';

/** ms without a change of the form before the worker is taken for it; it cannot be interrupted. */
const rest = 400;

/** Remembers the opening of the closed valve that was measured, among the last ones. */
export function keepOpening(found: Cost): void {
  state.openings.value = new Map([...[...state.openings.value].slice(-20), [found.hash, found]]);
}

async function measure(which: CostRequest['which']): Promise<void> {
  keepOpening(await request('cost', { which }));
}

/** True while two plans that are compared are measured. */
let comparing = false;

/** Measures the openings of the present plan and of the one that it is compared with, unless they take too long. */
async function measureCompared(name: string, other: Shown, main: Shown): Promise<void> {
  if (comparing || !measuresItself(main)) return;
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

/** The valve whose opening was asked for last: a failure is not repeated. */
let asked = '';

/** Measures the valve of the plan where an operation may have narrowed it, for which its verdict waits, or where the gradient of a flow
 *  is asked for. */
function watchNarrowed(): void {
  let timer = 0;
  effect(() => {
    window.clearTimeout(timer);
    const { main, draft, busy, motion, handing, surface } = state;
    const figures = main.value?.figures;
    const idle = !draft.value && !busy.value && !motion.value && !handing.value && !surface.value;
    if (!idle || figures?.known !== 'all' || !figures.measures.atRest) return;
    if (!(isNarrowed(figures) || state.flow.value) || openingOf(figures.hash) || asked === figures.hash)
      return;
    if (!measuresItself(main.value!)) return;
    timer = window.setTimeout(() => {
      asked = figures.hash;
      const { hash } = figures;
      measure('main').catch((error) => ((unmeasurable.value = hash), fail(error)));
    }, rest);
  });
}

/** Measures the valve with this hash and the first one of the plan, for the report; larger ones too. */
export async function measurePlan(hash: string, which: CostRequest['which']): Promise<void> {
  const { first } = state;
  if (!openingOf(hash)) await measure(which);
  if (!openingOf(first.value?.figures.hash)) await measure('first');
}

export function watchOpening(): void {
  watchCompared();
  watchNarrowed();
  let timer = 0;
  effect(() => {
    const { draft, pending, busy, preview } = state;
    window.clearTimeout(timer);
    const ready =
      narrowing.has(draft.value?.kind ?? '') &&
      preview.value?.figures.known === 'all' &&
      !pending.value &&
      !busy.value &&
      measuresItself(preview.value);
    if (ready) timer = window.setTimeout(() => void measureBoth(), rest);
  });
}
