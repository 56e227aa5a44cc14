// Limits that a valve is judged by: its opening, the place where that was measured, and the allowed load of chordae.
import { signal } from '@preact/signals';
import { percentOfLimit } from '../notable';
import type { Cost, Shown } from '../protocol';
import * as state from './state';

/** Operations that narrow the open valve. */
export const narrowing = new Set(['ring', 'band', 'annulus_scale', 'clip', 'resect']);

/** Vertices above which it takes too long to measure an opening unasked. */
const most = 2500;

/** Whether the opening of a valve is measured by itself where that is needed. */
export const measuresItself = ({ picture }: Shown): boolean => picture.positions.length <= 3 * most;

/** The valve whose opening could not be measured, by its hash. */
export const unmeasurable = signal('');

/** The opening of a closed valve if it was measured. */
export function openingOf(hash: string | undefined): Cost | null {
  if (!hash) return null;
  if (state.cost.value?.hash === hash) return state.cost.value;
  return state.openings.value.get(hash) ?? null;
}

/** mm from commissure to commissure below which an annulus is smaller than an adult's: those measured in adults are 35 to 39 mm wide, and
 *  rings for adults begin at 24. */
const leastAdult = 28;

/** The width of the annulus before the first operation, mm, where it is smaller than an adult's: limits of stenosis hold for adults. */
export function smallAnnulus(): number | null {
  const cc = state.first.value?.figures.measures.annulusCc;
  return cc !== undefined && cc < leastAdult ? cc : null;
}

/** The width of a normal annulus for this valve, mm: that before the illness where it is known. Else that before the first operation,
 *  less the dilation of the most dilated valve of the study, 15 % (Tenenholtz et al. 2011). */
function normalWidth(): number | null {
  const healthy = state.tour.value?.founding?.healthy.measures.annulusCc;
  const first = state.first.value?.figures.measures.annulusCc;
  return healthy ?? (first === undefined ? null : first / 1.15);
}

/** Per cent of the normal width below which the plan has made the annulus much too small. Restrictive rings are by custom two sizes
 *  below the measured one, 4 mm of about 35: they leave 88 %. */
const leastWidth = 80;

/** The width of the annulus before the plan, mm, where the plan has made it much too small; else null. */
export function undersizedFrom(cc: number): number | null {
  const first = state.first.value?.figures.measures.annulusCc;
  const normal = normalWidth();
  if (first === undefined || normal === null || cc >= first) return null;
  return Math.round((100 * cc) / normal) < leastWidth ? first : null;
}

/** Per cent of the width before the plan below which a smaller annulus is no repair: its leaflets lie in folds, inside and outside of it. */
const leastRepair = 60;

/** The width of the annulus in per cent of that before the plan, where the plan has made it so small; else null. */
export function foldedShare(cc: number): number | null {
  const first = state.first.value?.figures.measures.annulusCc;
  if (first === undefined) return null;
  const percent = Math.round((100 * cc) / first);
  return percent < leastRepair ? percent : null;
}

/** The least open area that the tour asks for, mm2; null where it is not known. */
export function leastOpening(): number | null {
  const healthy = state.tour.value?.founding?.healthy;
  return healthy ? 0.9 * healthy.openArea : null;
}

/** The least mean coaptation length that the tour asks for, mm; null where it is not known. The 8 mm at A2-P2 that surgeons aim at are no
 *  goal: the valve of the study has a posterior leaflet of 12 mm, and its leaflets meet over less when it is healthy. */
export function leastCoaptation(): number | null {
  const healthy = state.tour.value?.founding?.healthy;
  return healthy ? 0.9 * healthy.measures.coaptationMean : null;
}

/** A tenth above the limit: limits are known as little as that. */
const tolerated = 1.1;

/** The largest load of a chord that the tour allows, in per cent of its working limit: a tenth above the limit or above the highest
 *  load before the illness; null where it is not known. */
export function allowedLoad(): number | null {
  const healthy = state.tour.value?.founding?.healthy;
  return healthy ? percentOfLimit(tolerated * Math.max(1, healthy.measures.chordLoad)) : null;
}

/** The load in per cent above which chordae are named as a fault of the valve: that of the tour, where a valve of the tour is open. */
export const faultyLoad = (): number => allowedLoad() ?? percentOfLimit(tolerated);
