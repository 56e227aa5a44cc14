// The tour: opening its valves, and measuring how far a sealed valve opens, which is one of the goals.
import { effect } from '@preact/signals';
import { tourTexts } from '../text/texts';
import { openShipped, shippedVertices } from './files';
import { measureCost } from './measure';
import { fail, request } from './requests';
import * as state from './state';

export async function startValve(number: number): Promise<void> {
  await openShipped(`founding${number}`, tourTexts.valves[number - 1].title, { number, founding: null });
  state.panel.value = 'tour';
  // two requests, between which a preview has its turn
  try {
    const healthy = await request('founding_healthy', { vertices: shippedVertices });
    const repaired = await request('founding_repair', { number, vertices: shippedVertices });
    if (state.tour.value?.number === number)
      state.tour.value = { ...state.tour.value, founding: { healthy, repaired } };
  } catch (error) {
    fail(error);
  }
}

/** The goals of the tour's valve, judged on the applied valve and not on a preview; null where it is not known yet. */
export function reached(): Record<'sealed' | 'chords' | 'open', boolean | null> {
  const founding = state.tour.value?.founding;
  const { hash, measures } = state.main.value!.figures;
  const cost = state.cost.value?.hash === hash ? state.cost.value.value : null;
  return {
    sealed: measures.atRest && measures.orifice === 0,
    chords: founding ? measures.chordsOver <= founding.healthy.measures.chordsOver : null,
    open: cost && founding ? cost.openArea >= 0.9 * founding.healthy.openArea : null,
  };
}

/** Remembers the valves whose goals are reached. */
function watchGoals(): void {
  effect(() => {
    const number = state.tour.value?.number;
    if (!number || !state.main.value || !Object.values(reached()).every(Boolean)) return;
    const { finished } = state;
    if (!finished.value.includes(number)) finished.value = [...finished.value, number];
  });
}

/** Measures the opening of each sealed valve of the tour as soon as nothing else is under way. */
export function watchTour(): void {
  watchGoals();
  effect(() => {
    const figures = state.main.value?.figures;
    const idle = state.tour.value?.founding && figures && !state.draft.value && !state.busy.value;
    if (!idle || figures.measures.orifice > 0 || !figures.measures.atRest) return;
    if (state.cost.value?.hash !== figures.hash && measured !== figures.hash) {
      measured = figures.hash;
      void measureCost();
    }
  });
}

/** The valve whose opening was asked for last: a failure is not repeated. */
let measured = '';
