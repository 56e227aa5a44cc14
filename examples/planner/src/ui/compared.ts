// The figures of two valves that stand side by side, in the comparison of plans and in the report.
import { titlesOf } from '../notable';
import { doubtNotes, marked } from '../store/doubt';
import { gradientOf } from '../store/gradient';
import { isWide, openingOf } from '../store/limits';
import { ofMiddle } from '../store/names';
import { areaFigure, figure, figureNames, say, valveTexts } from '../text/texts';
import type { Figures, Measures } from '../protocol';

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

/** The value of one of them in a valve, with its unit, and marked where it does not count. */
export const valueIn = ([, get, digits, unit]: Compared, valve: Figures): string =>
  marked(`${figure(get(valve.measures), digits)} ${unit}`.trim(), valve);

/** Name and both values of each figure, with their units. */
export function comparedRows(one: Figures, other: Figures): [string, string, string][] {
  return comparedFigures.map((row) => [ofMiddle(row[0]), valueIn(row, one), valueIn(row, other)]);
}

/** The names of the operations of a plan. */
export const stepsOf = (figures: Figures): string[] => titlesOf(figures).map(say);

/** The gradient of the given flow in words; empty where it is not known. */
export function gradientText(valve: Figures): string {
  const gradient = gradientOf(openingOf(valve.hash));
  return gradient === null ? '' : marked(`${figure(gradient)} mmHg`, valve);
}

/** The open area of a valve in words; empty where it is not measured. */
export function areaText(valve: Figures): string {
  const cost = openingOf(valve.hash);
  if (!cost) return '';
  return marked(`${areaFigure(cost.openArea)} cm²${isWide(cost) ? ` ${valveTexts.wideMark}` : ''}`, valve);
}

/** What the marks beside the figures of these valves mean. */
export function markNotes(valves: Figures[]): string[] {
  const wide = valves.some(({ hash }) => {
    const cost = openingOf(hash);
    return !!cost && isWide(cost);
  });
  return [...doubtNotes(valves), ...(wide ? [valveTexts.openAreaWide] : [])];
}
