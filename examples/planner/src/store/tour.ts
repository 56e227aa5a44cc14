// The tour: opening its valves, and measuring how far a sealed valve opens, which is one of the goals.
import { effect } from '@preact/signals';
import { tourTexts } from '../text/texts';
import { openShipped } from './files';
import { knownFounding, learnFounding } from './founding';
import { measureCost } from './measure';
import { reachesAll } from './goals';
import { openingOf } from './limits';
import * as state from './state';

/** Chooses a chord of the valve of the plan and shows it from the ventricle. */
export function showChord(name: string): void {
  const chord = state.main.value?.figures.chords.find((item) => item.name === name);
  if (!chord) return;
  state.chordsOn.value = true;
  state.choice.value = { kind: 'chord', id: chord.id };
  state.wantedView.value = { preset: 'ventricle' };
}

export async function startValve(number: number): Promise<void> {
  const tour = { number, founding: knownFounding() };
  await openShipped(`founding${number}`, tourTexts.valves[number - 1].title, tour);
  state.panel.value = 'tour';
  await learnFounding(number);
}

/** Remembers the valves whose goals are reached. */
function watchGoals(): void {
  effect(() => {
    const number = state.tour.value?.number;
    if (!number || !reachesAll.value) return;
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
