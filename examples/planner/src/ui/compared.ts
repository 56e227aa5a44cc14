// The figures of two valves that stand side by side, in the comparison of plans and in the report.
import { titlesOf } from '../notable';
import { gradientOf } from '../store/gradient';
import { areaFigure, figure, figureNames, say } from '../text/texts';
import type { Cost, Figures, Measures } from '../protocol';

/** Name, value, digits, unit. */
type Compared = [string, (m: Measures) => number, number, string];

export const comparedFigures: Compared[] = [
  [figureNames.orifice, (m) => m.orifice, 1, 'mm²'],
  [figureNames.coaptationMean, (m) => m.coaptationMean, 1, 'mm'],
  [figureNames.coaptationHeight, (m) => m.coaptationHeight, 1, 'mm'],
  [figureNames.tentingHeight, (m) => m.tentingHeight, 1, 'mm'],
  [figureNames.billowHeight, (m) => m.billowHeight, 1, 'mm'],
  [figureNames.annulusAp, (m) => m.annulusAp, 1, 'mm'],
  [figureNames.annulusCc, (m) => m.annulusCc, 1, 'mm'],
  [figureNames.chordsOver, (m) => m.chordsOver, 0, ''],
  [figureNames.maxChordTension, (m) => 1000 * m.maxChordTension, 0, 'mN'],
];

/** The value of one of them in a valve, with its unit. */
export const valueIn = ([, get, digits, unit]: Compared, { measures }: Figures): string =>
  `${figure(get(measures), digits)} ${unit}`.trim();

/** Name and both values of each figure, with their units. */
export function comparedRows(one: Figures, other: Figures): [string, string, string][] {
  return comparedFigures.map((row) => [row[0], valueIn(row, one), valueIn(row, other)]);
}

/** The names of the operations of a plan. */
export const stepsOf = (figures: Figures): string[] => titlesOf(figures).map(say);

/** The gradient of the given flow in words; empty where it is not known. */
export function gradientText(cost: Cost | null): string {
  const gradient = gradientOf(cost);
  return gradient === null ? '' : `${figure(gradient)} mmHg`;
}

/** An open area in words. */
export const areaText = (cost: Cost): string => `${areaFigure(cost.openArea)} cm²`;
