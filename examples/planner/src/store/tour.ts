// The tour: opening its valves, and measuring how far a sealed valve opens, which is one of the goals.
import { effect } from '@preact/signals';
import { shippedVertices } from '../shipped';
import { tourTexts } from '../text/texts';
import type { FoundingResult } from '../protocol';
import { openShipped } from './files';
import { measureCost } from './measure';
import { reachesAll } from './goals';
import { openingOf } from './limits';
import { fail, request } from './requests';
import * as state from './state';

/** The healthy valve of the tour, the same for all its valves: known from the first moment of the second one. */
let healthyValve: FoundingResult['healthy'] | null = null;

/** Chooses a chord of the valve of the plan and shows it from the ventricle. */
export function showChord(name: string): void {
  const chord = state.main.value?.figures.chords.find((item) => item.name === name);
  if (!chord) return;
  state.chordsOn.value = true;
  state.choice.value = { kind: 'chord', id: chord.id };
  state.wantedView.value = { preset: 'ventricle' };
}

export async function startValve(number: number): Promise<void> {
  const founding = healthyValve ? { healthy: healthyValve } : null;
  await openShipped(`founding${number}`, tourTexts.valves[number - 1].title, { number, founding });
  state.panel.value = 'tour';
  // two requests, between which a preview has its turn
  try {
    const healthy = await request('founding_healthy', { vertices: shippedVertices });
    healthyValve = healthy;
    learn(number, { healthy });
    learn(number, {
      healthy,
      repaired: await request('founding_repair', { number, vertices: shippedVertices }),
    });
  } catch (error) {
    fail(error);
  }
}

function learn(number: number, founding: FoundingResult): void {
  if (state.tour.value?.number === number) state.tour.value = { ...state.tour.value, founding };
}

/** Remembers the valves whose goals are reached. */
function watchGoals(): void {
  effect(() => {
    const number = state.tour.value?.number;
    if (!number || !reachesAll()) return;
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
    if (!idle || figures.known !== 'all' || figures.measures.orifice > 0 || !figures.measures.atRest) return;
    if (!openingOf(figures.hash) && measured !== figures.hash) {
      measured = figures.hash;
      void measureCost();
    }
  });
}

/** The valve whose opening was asked for last: a failure is not repeated. */
let measured = '';
