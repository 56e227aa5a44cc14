// The goals of a valve of the tour: their limits, which are reached, and which faults of a sealed valve they name.
import { computed } from '@preact/signals';
import { edgeHeights } from '../flail';
import { percentOfLimit } from '../notable';
import type { Figures, Shown } from '../protocol';
import { apart, verdictTexts } from '../text/texts';
import { doubtOf } from './doubt';
import { allowedLoad, foldedShare, leastCoaptation, leastOpening, openingOf } from './limits';
import * as state from './state';

export type Goal = 'sealed' | 'chords' | 'open' | 'edge' | 'coaptation';

/** The scallop that is flail in a valve of the tour. */
export const flailOf = (number: number): string | undefined => ({ 4: 'P2' })[number];

/** Height of the free edge of the tour's flail scallop above the annulus, mm; null in a valve without a flail scallop. */
export function flailHeight(shown: Shown | null): number | null {
  const scallop = flailOf(state.tour.value?.number ?? 0);
  const topology = shown && state.topologyOf(shown.picture);
  if (!scallop || !topology) return null;
  return edgeHeights(topology, shown.picture, shown.figures.frame).get(scallop) ?? null;
}

const unknown = { sealed: null, chords: null, open: null, edge: null, coaptation: null };

/** The goals of the tour's valve, judged on one of its states; null where it is not known yet. */
export function reached(shown: Shown | null): Record<Goal, boolean | null> {
  if (!shown || state.coming.value) return unknown;
  // of figures that do not count no goal is reached, and none is judged
  if (doubtOf(shown.figures)) return { ...unknown, sealed: false };
  const height = flailHeight(shown);
  const { hash, known, measures } = shown.figures;
  const cost = openingOf(hash);
  const [least, allowed, length] = [leastOpening(), allowedLoad(), leastCoaptation()];
  const partly = known !== 'all';
  return {
    sealed: known === 'shape' ? null : measures.orifice === 0 && foldedShare(measures.annulusCc) === null,
    chords: partly || allowed === null ? null : percentOfLimit(measures.chordLoad) <= allowed,
    // a valve without a flail scallop has nothing to reach
    edge: height === null || height < 0,
    coaptation: known === 'shape' || length === null ? null : measures.coaptationMean >= length,
    open: cost && least !== null ? cost.openArea >= least : null,
  };
}

/** Whether the valve of the plan reaches all goals of its valve of the tour. */
export const reachesAll = computed(
  () => !!state.tour.value && Object.values(reached(state.main.value)).every(Boolean),
);

/** The picture that figures belong to, among the valves that the page has. */
function shownWith({ hash }: Figures): Shown | null {
  const { preview, main, first, compared, keptPlans } = state;
  const all = [preview.value, main.value, first.value, compared.value, ...keptPlans.value.values()];
  return all.find((shown) => shown?.figures.hash === hash) ?? null;
}

/** The goals of the tour that a valve misses beside leak, opening and chordae, in words; of a sealed valve only: a leak is said first. */
export function missedGoals(figures: Figures): string[] {
  if (!state.tour.value || figures.measures.orifice > 0 || state.coming.value) return [];
  const scallop = flailOf(state.tour.value.number);
  const height = scallop ? flailHeight(shownWith(figures)) : null;
  const { coaptationMean } = figures.measures;
  const least = leastCoaptation();
  return [
    ...(scallop && height !== null && height >= 0 ? [verdictTexts.edgeAbove(scallop, height)] : []),
    ...(least !== null && coaptationMean < least
      ? [verdictTexts.coaptationBelow(apart(coaptationMean, least))]
      : []),
  ];
}
