// The plans that are kept beside the one of a report, with their figures in a table, as HTML.
import { toMeasure } from '../store/opening';
import { planName } from '../store/plans';
import * as state from '../store/state';
import { headline } from '../store/verdict';
import { doubtTexts, figureNames, reportTexts, valveTexts } from '../text/texts';
import type { Figures } from '../protocol';
import { areaText, comparedFigures, markNotes, valueIn } from './compared';

export function escape(text: string): string {
  return text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}

/** The figures by which plans are chosen. */
const chosen = new Set([
  figureNames.orifice,
  figureNames.coaptationMean,
  figureNames.annulusAp,
  figureNames.annulusCc,
  figureNames.chordsOver,
]);
const columns = comparedFigures.filter(([name]) => chosen.has(name));

/** Characters of a cell that stays on one line: a figure with its unit and marks; a sentence would push the plot beside it away. */
const oneLine = 14;

/** A cell of a table; a figure that does not count is drawn less strongly. */
export function cellOf(text: string): string {
  const classes = [text.length > oneLine ? 'wrap' : '', text.endsWith(doubtTexts.mark) ? 'doubtful' : ''];
  return `<td class="${classes.join(' ').trim()}">${escape(text)}</td>`;
}

/** The marks in a table of these valves, in words. */
export const notesBelow = (valves: Figures[]): string =>
  markNotes(valves)
    .map((note) => `<p class="marks">${escape(note)}</p>`)
    .join('');

function row(name: string, figures: Figures): string {
  const cells = [
    ...columns.map((column) => valueIn(column, figures)),
    areaText(figures) || (toMeasure.value ? reportTexts.coming : reportTexts.notMeasured),
  ];
  const all = cells.map(cellOf).join('');
  return `<tr><th>${escape(name)}</th><td class="wrap">${escape(headline(figures))}</td>${all}</tr>`;
}

/** The table of all plans, that of the report first; empty where no other plan is kept. */
export function otherPlans(now: Figures): string {
  const others = [...state.keptPlans.value].filter(([, { figures }]) => figures.hash !== now.hash);
  const present = state.main.value!;
  // the report may be that of a kept plan
  if (present.figures.hash !== now.hash) others.unshift([planName(present.figures.hash), present]);
  if (!others.length) return '';
  const names = [
    figureNames.plan,
    figureNames.verdict,
    ...columns.map(([name]) => name),
    valveTexts.openArea,
  ];
  const heads = names.map((name) => `<th class="wrap">${escape(name)}</th>`).join('');
  const own = planName(now.hash);
  const rows = [row(own, now), ...others.map(([name, { figures }]) => row(name, figures))].join('');
  return `<h2>${reportTexts.otherPlans}</h2><table class="plans" data-testid="report-plans"><tr>${heads}</tr>${rows}</table>${notesBelow([now, ...others.map(([, { figures }]) => figures)])}`;
}
