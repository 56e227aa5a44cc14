// Valves whose figures do not count: leaflets that cross make all measures wrong, and a valve that did not come to rest has none that are
// final. Such a valve has no grade, and every place that shows its figures marks them.
import { computed } from '@preact/signals';
import { doubtTexts } from '../text/texts';
import type { Figures } from '../protocol';
import * as state from './state';

export type Doubt = 'cross' | 'notAtRest';

/** Why the figures of a valve do not count; null where they do, or while the crossings are still to be counted. */
export function doubtOf({ measures }: Figures): Doubt | null {
  if (measures.crossings > 0) return 'cross';
  return measures.atRest && measures.underLoad ? null : 'notAtRest';
}

/** A figure of a valve in words, with the mark of one that does not count. */
export const marked = (text: string, figures: Figures): string =>
  text && doubtOf(figures) ? `${text} ${doubtTexts.mark}` : text;

/** What is wrong with a valve, how much, and what helps; empty where its figures count. */
export function doubtNote(figures: Figures): string {
  const doubt = doubtOf(figures);
  if (!doubt) return '';
  return doubt === 'cross'
    ? doubtTexts.crossNote(figures.measures.crossings)
    : doubtTexts.restNote(figures.measures.residual);
}

/** The notes below a table with the figures of these valves, each once. */
export const doubtNotes = (valves: Figures[]): string[] => [
  ...new Set(
    valves
      .map(doubtOf)
      .filter((doubt) => doubt !== null)
      .map((doubt) => doubtTexts.marks[doubt]),
  ),
];

/** Of the valve whose figures the panels show, and of the one that they are compared with. */
export const shownDoubt = computed(() => state.figures.value && doubtOf(state.figures.value));
export const beforeDoubt = computed(() => state.before.value && doubtOf(state.before.value));
