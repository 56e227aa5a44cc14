// Colours of tissue and devices, and colour maps that remain ordered for colour-blind people: viridis (van der Walt and
// Smith 2015) for amounts, whose colours stay apart in the light of the scene, unlike the greys of cividis; blue to
// orange through grey for heights above and below a plane. tests/colours.test.mjs holds how far colours that meet stay
// apart for colour-blind people.
import type { Colour } from './mesh';

export const tissue = {
  atrialAnterior: [0.93, 0.74, 0.66] as Colour,
  atrialPosterior: [0.89, 0.66, 0.6] as Colour,
  ventricularAnterior: [0.62, 0.66, 0.8] as Colour,
  ventricularPosterior: [0.54, 0.6, 0.76] as Colour,
  chord: [0.95, 0.91, 0.8] as Colour,
  slack: [0.42, 0.42, 0.42] as Colour,
  strut: [0.98, 0.95, 0.86] as Colour,
  over: [0.9, 0.38, 0.0] as Colour,
  artificial: [0.06, 0.04, 0.32] as Colour,
  suture: [0.16, 0.45, 0.75] as Colour,
  chosen: [0.0, 0.62, 1.0] as Colour,
  head: [0.4, 0.19, 0.16] as Colour,
  annulus: [0.66, 0.56, 0.38] as Colour,
  edge: [0.52, 0.3, 0.28] as Colour,
  seam: [0.72, 0.5, 0.45] as Colour,
  ring: [0.93, 0.95, 0.97] as Colour,
  orifice: [0.78, 0.06, 0.12] as Colour,
  cut: [0.35, 0.08, 0.1] as Colour,
  hand: [0.1, 0.45, 0.85] as Colour,
};

const viridis: Colour[] = [
  [0.267, 0.005, 0.329],
  [0.278, 0.173, 0.478],
  [0.231, 0.318, 0.545],
  [0.173, 0.443, 0.557],
  [0.129, 0.565, 0.553],
  [0.153, 0.678, 0.506],
  [0.361, 0.784, 0.388],
  [0.667, 0.863, 0.196],
  [0.992, 0.906, 0.145],
];
const diverging: Colour[] = [
  [0.03, 0.25, 0.55],
  [0.2, 0.47, 0.75],
  [0.53, 0.71, 0.88],
  [0.91, 0.91, 0.9],
  [0.95, 0.69, 0.42],
  [0.85, 0.42, 0.1],
  [0.55, 0.22, 0.0],
];

/** Maps of the leaflets, and those of the chordae, in which the leaflets have the colours of tissue. */
export type LeafletMap = 'coaptation' | 'height' | 'stretch' | 'distance';
export type ChordMap = 'load' | 'pull' | 'strain';
export type MapName = 'tissue' | LeafletMap | ChordMap;

export interface ColourMap {
  colours: Colour[];
  low: number;
  high: number;
  unit: string;
  /** Values that are written below the scale. */
  ticks: number[];
  /** Colours follow the square root of the value, for values of which most are small. */
  root?: boolean;
}

/** Ranges in the unit that is written at the scale. */
export const maps: Record<LeafletMap | ChordMap, ColourMap> = {
  coaptation: {
    colours: [...viridis].reverse(),
    low: 0.5,
    high: 2.5,
    unit: 'mm',
    ticks: [0.5, 1, 1.5, 2, 2.5],
  },
  height: { colours: diverging, low: -9, high: 9, unit: 'mm', ticks: [-9, -6, -3, 0, 3, 6, 9] },
  stretch: { colours: viridis, low: 0, high: 40, unit: '%', ticks: [0, 10, 20, 30, 40] },
  distance: { colours: viridis, low: 0, high: 4, unit: 'mm', ticks: [0, 1, 2, 3, 4] },
  load: { colours: viridis, low: 0, high: 100, unit: '%', ticks: [0, 25, 50, 75, 100] },
  // up to the limit of a strut chord
  pull: { colours: viridis, low: 0, high: 2000, unit: 'mN', ticks: [0, 100, 400, 800, 2000], root: true },
  strain: { colours: viridis, low: 0, high: 12, unit: '%', ticks: [0, 4, 8, 12] },
};

export const isChordMap = (name: MapName): name is ChordMap =>
  name === 'load' || name === 'pull' || name === 'strain';

/** The share of the scale at which a value stands, 0 to 1. */
export function placeOf(map: ColourMap, value: number): number {
  const share = Math.min(1, Math.max(0, (value - map.low) / (map.high - map.low)));
  return map.root ? Math.sqrt(share) : share;
}

/** The colour of values without a number. */
export const unknown: Colour = [0.7, 0.7, 0.7];

/** Colour of a value; values out of the range take the end's colour, values without a number are grey. */
export function colourOf(map: ColourMap, value: number): Colour {
  if (!Number.isFinite(value)) return unknown;
  const t = placeOf(map, value) * (map.colours.length - 1);
  const k = Math.min(map.colours.length - 2, Math.floor(t));
  const s = t - k;
  const [a, b] = [map.colours[k], map.colours[k + 1]];
  return [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])];
}

/** A CSS gradient of a map, from low to high. */
export function gradient(map: ColourMap): string {
  return `linear-gradient(to right, ${map.colours.map((c) => `rgb(${c.map((v) => Math.round(255 * v)).join(' ')})`).join(', ')})`;
}
