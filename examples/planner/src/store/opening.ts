// How far the valve would open: measured by itself while an operation that narrows it is chosen, after the figures of
// the closed valve.
import { effect, signal, untracked } from '@preact/signals';
import type { CostRequest } from '../calls';
import type { Cost, Shown } from '../protocol';
import { measuresItself, narrowing, openingOf, unmeasurable } from './limits';
import { fail, request } from './requests';
import * as state from './state';
import { isNarrowed } from './verdict';

/** ms without a change of the form before the worker is taken for it; it cannot be interrupted. */
const rest = 400;

/** Openings that are remembered: more than the plans of a report. */
const most = 100;

/** Remembers the opening of the closed valve that was measured, among the last ones. */
export function keepOpening(found: Cost): void {
  state.openings.value = new Map([...[...state.openings.value].slice(-most), [found.hash, found]]);
}

type Asked = CostRequest['which'];

async function measure(which: Asked): Promise<void> {
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

/** Open areas that a report still waits for. */
export const toMeasure = signal(0);

/**
 * Measures the open areas of a report one after the other, larger valves too: of the seen plan with this hash, of the first valve, of
 * the present and of the kept plans. `shown`: after each; it says whether the report is still looked at.
 */
export async function measureReport(hash: string, which: Asked, shown: () => boolean): Promise<void> {
  const { checkpoints, checkpointHashes, first, main } = state;
  const plans: [string | undefined, Asked][] = [
    ...checkpoints.value.map((name, k): [string, Asked] => [checkpointHashes.value[k], `checkpoint ${name}`]),
    [main.value?.figures.hash, 'main'],
    [first.value?.figures.hash, 'first'],
    [hash, which],
  ];
  // one question for each valve; those of the report's own figures first
  const left = new Map(plans.filter(([valve]) => valve && !openingOf(valve)).reverse());
  for (const [valve, asked] of [...left]) {
    toMeasure.value = left.size;
    // one that cannot be opened does not hold the others up
    await measure(asked).catch(fail);
    left.delete(valve);
    toMeasure.value = left.size;
    if (!shown()) break;
  }
  toMeasure.value = 0;
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
