// The plans that are kept beside the one of a report, with their figures in a table, as HTML.
import { openingOf } from '../store/limits';
import { keptName } from '../store/plans';
import * as state from '../store/state';
import { headline } from '../store/verdict';
import { figure, figureNames, reportTexts, valveTexts } from '../text/texts';
import type { Figures, Measures } from '../protocol';
import { areaText } from './compared';

export function escape(text: string): string {
  return text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}

/** Name, value in mm or mm2, digits, unit: the figures by which plans are chosen. */
const columns: [string, (m: Measures) => number, number, string][] = [
  [figureNames.orifice, (m) => m.orifice, 1, 'mm²'],
  [figureNames.coaptationMean, (m) => m.coaptationMean, 1, 'mm'],
  [figureNames.annulusAp, (m) => m.annulusAp, 1, 'mm'],
  [figureNames.annulusCc, (m) => m.annulusCc, 1, 'mm'],
  [figureNames.chordsOver, (m) => m.chordsOver, 0, ''],
];

function row(name: string, figures: Figures): string {
  const cost = openingOf(figures.hash);
  const cells = [
    ...columns.map(([, get, digits, unit]) => `${figure(get(figures.measures), digits)} ${unit}`.trim()),
    cost ? areaText(cost) : reportTexts.notMeasured,
  ];
  const all = cells.map((cell) => `<td>${escape(cell)}</td>`).join('');
  return `<tr><th>${escape(name)}</th><td class="wrap">${escape(headline(figures))}</td>${all}</tr>`;
}

/** The table of all plans, that of the report first; empty where no other plan is kept. */
export function otherPlans(now: Figures): string {
  const others = [...state.keptPlans.value].filter(([, { figures }]) => figures.hash !== now.hash);
  const present = state.main.value!;
  // the report may be that of a kept plan
  if (present.figures.hash !== now.hash)
    others.unshift([keptName(present.figures.hash) || reportTexts.present, present]);
  if (!others.length) return '';
  const names = [
    figureNames.plan,
    figureNames.verdict,
    ...columns.map(([name]) => name),
    valveTexts.openArea,
  ];
  const heads = names.map((name) => `<th class="wrap">${escape(name)}</th>`).join('');
  const own = keptName(now.hash) || reportTexts.present;
  const rows = [row(own, now), ...others.map(([name, { figures }]) => row(name, figures))].join('');
  return `<h2>${reportTexts.otherPlans}</h2><table class="plans" data-testid="report-plans"><tr>${heads}</tr>${rows}</table>`;
}
