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

/** mm: the widths of the annuli of patients, from an infant's to a most dilated one; a valve beyond is probably in another unit. */
const widths: [number, number] = [8, 80];

export const isPlausible = (cc: number): boolean => cc >= widths[0] && cc <= widths[1];

/** mm2: the open valves of healthy adults have 4 to 6 cm2. */
const widest = 600;

/** Whether a valve opens wider than a healthy one does, for want of a wall that stops its leaflets. */
export const isWide = ({ openArea }: Cost): boolean => openArea > widest;

/** mm from commissure to commissure below which an annulus is smaller than an adult's: those measured in adults are 35 to 39 mm wide, and
 *  rings for adults begin at 24. */
const leastAdult = 28;

/** The width of the annulus before the first operation, mm, where it is smaller than an adult's: limits of stenosis hold for adults. */
export function smallAnnulus(): number | null {
  const cc = state.first.value?.figures.measures.annulusCc;
  return cc !== undefined && cc < leastAdult ? cc : null;
}

/** Width and depth of an annulus, mm: from commissure to commissure and from front to back. */
export type Extent = 'annulusCc' | 'annulusAp';

/** mm: the least of healthy adults; measured are 35 to 39 and 24 to 29. */
const leastNormal: Record<Extent, number> = { annulusCc: 35, annulusAp: 24 };

/** A normal annulus for this valve, mm: that before the illness where it is known. Else that before the first operation less the
 *  dilation of the most dilated valve of the study, 15 % (Tenenholtz et al. 2011), but of an adult not less than a normal one. */
function normalExtent(extent: Extent): number | null {
  const healthy = state.tour.value?.founding?.healthy.measures[extent];
  const first = state.first.value?.figures.measures[extent];
  if (healthy !== undefined || first === undefined) return healthy ?? null;
  const undilated = first / 1.15;
  return smallAnnulus() === null ? Math.max(undilated, Math.min(first, leastNormal[extent])) : undilated;
}

/** Per cent of a normal annulus below which the plan has made it much too small. Of the width: restrictive rings are by custom two sizes
 *  below the measured one, 4 mm of about 35, and leave 88 %. Of the depth: a ring at that limit, 28 mm wide and by custom three quarters
 *  as deep, leaves 75 % of the 28 mm of the study; no custom of rings accounts for less than 70 %. */
const leastShare: Record<Extent, number> = { annulusCc: 80, annulusAp: 70 };

/** The extent of the annulus before the plan, mm, where the plan has made it much too small; else null. */
export function undersizedFrom(extent: Extent, now: number): number | null {
  const first = state.first.value?.figures.measures[extent];
  const normal = normalExtent(extent);
  if (first === undefined || normal === null || now >= first) return null;
  return Math.round((100 * now) / normal) < leastShare[extent] ? first : null;
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

/** mm: coaptation at A2–P2 below which a sealed valve has no reserve. The trials of edge-to-edge repair (EVEREST) took
 *  2 mm as the least with which leaflets can be said to meet; repairs aim at 8 mm. */
const leastCentral = 2;

/** The least height over which A2 and P2 have to meet, mm: of a valve that met over less than 3 mm before its illness, as those of the
 *  study over 1.5, two thirds of that. */
export function leastCentralCoaptation(): number {
  const healthy = state.tour.value?.founding?.healthy.measures.coaptationHeight;
  return healthy === undefined ? leastCentral : Math.min(leastCentral, (2 / 3) * healthy);
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
