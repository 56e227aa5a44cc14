// The range within which the leak of a valve from an image is known: its chordae are guessed, so that the leak of its one closure says
// little. It belongs to the valve as it was built; the leak after operations is compared with it.
import { signal } from '@preact/signals';
import type { Figures, Finding, Range } from '../protocol';
import { verdictTexts } from '../text/texts';
import { mm2 } from '../worker/units';
import * as state from './state';

/** mm2, by the hash of the closed valve as it was built. */
const ranges = signal<Map<string, Range>>(new Map());

/** mm2; a range that is narrower reads as one number. */
const least = 0.05;

/** The library's finding, which has no values without a closure at rest; to a tenth, as its sentence says it. */
export function rangeIn(findings: Finding[]): Range | null {
  const values = findings.find(({ name }) => name === 'leak_interval')?.values ?? [];
  const [low, high] = values.map((area) => +(area * mm2).toFixed(1));
  return high === undefined ? null : [low, high];
}

export function keepLeakRange(hash: string, range: Range | null): void {
  if (range && range[1] - range[0] >= least) ranges.value = new Map([...ranges.value, [hash, range]]);
}

/** The range of the valve with which the plan begins, if that was built from an image. */
export const leakRange = (): Range | null => ranges.value.get(state.first.value?.figures.hash ?? '') ?? null;

/** Remark beside the leak of a valve as it was built; empty for others. */
export const ofLeakRange = ({ hash }: Figures): string[] => {
  const range = ranges.value.get(hash);
  return range ? [verdictTexts.leakKnown(...range)] : [];
};

/** Remark beside a valve after operations; empty where the leak before is known. */
export function leakBefore({ hash }: Figures): string {
  const range = leakRange();
  return range && !ranges.value.has(hash) ? verdictTexts.leakBefore(...range) : '';
}
