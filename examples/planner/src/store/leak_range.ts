// The range within which the leak of a valve from an image is known: its chordae are guessed, so that the leak of its one closure says
// little. It belongs to the valve as it was built; operations make the chordae no better known, so that its reservation stays.
import { signal } from '@preact/signals';
import type { Figures, Finding, Range } from '../protocol';
import { verdictTexts } from '../text/texts';
import { mm2 } from '../worker/units';
import * as state from './state';

export interface Known {
  range: Range;
  /** The range is that of this valve; else of the valve as it was built, from which operations led to this one. */
  own: boolean;
}

/** By the hash of the closed valve with which a plan begins. */
const ranges = signal<Map<string, Known>>(new Map());

/** mm2; a range that is narrower reads as one number. */
const least = 0.05;

/** The library's finding, which has no values without a closure at rest; to a tenth, as its sentence says it. */
export function rangeIn(findings: Finding[]): Range | null {
  const values = findings.find(({ name }) => name === 'leak_interval')?.values ?? [];
  const [low, high] = values.map((area) => +(area * mm2).toFixed(1));
  return high === undefined ? null : [low, high];
}

/** `own`: the valve is the one that was built. */
export function keepLeakRange(hash: string, range: Range | null, own = true): void {
  if (range && range[1] - range[0] >= least)
    ranges.value = new Map([...ranges.value, [hash, { range, own }]]);
}

const ofPlan = (): Known | undefined => ranges.value.get(state.first.value?.figures.hash ?? '');

/** mm2, of the valve from an image with which the plan begins, or from which that was made. */
export const leakRange = (): Range | null => ofPlan()?.range ?? null;

/** What is known of a valve of the plan, to keep beside its file; null where its chordae are not guessed. */
export function leakNote({ hash }: Figures): Known | null {
  const known = ranges.value.get(hash) ?? ofPlan();
  return known ? { range: known.range, own: known.own && ranges.value.has(hash) } : null;
}

/** Reservation on a valve whose chordae are guessed: the range of its leak, or, after operations, that of the leak before. */
export function ofLeakRange(figures: Figures): string[] {
  const known = leakNote(figures);
  if (!known) return [];
  return [(known.own ? verdictTexts.leakKnown : verdictTexts.leakBefore)(...known.range)];
}
