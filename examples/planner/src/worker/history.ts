// The operations of a valve, and how its clips were set: from the plan of the library, as data.
import type { Mvs, Snapshot } from 'libmvs';
import { clipOf } from '../notable';
import type { ClipSet, HistoryEntry } from '../protocol';
import { mm } from './units';

export function historyOf(snapshot: Snapshot): HistoryEntry[] {
  const { done, undone } = snapshot.history();
  const entry = (undoneNow: boolean) => (item: (typeof done)[number]) => ({
    title: item.title,
    kind: String(item.kind),
    group: item.in_group,
    made: String(item.made),
    undone: undoneNow,
  });
  return [...done.map(entry(false)), ...undone.map(entry(true))];
}

/** The history without the first `before` operations, which made the valve ill; `forgotten`: without those that were undone. */
export function ofRepair(history: HistoryEntry[], before: number, forgotten: boolean): HistoryEntry[] {
  const done = history.filter(({ undone }) => !undone).slice(before);
  return forgotten ? done : [...done, ...history.filter(({ undone }) => undone)];
}

/** A step of a plan that sets a clip (formats/FORMAT.md); fields with their default are left out. */
interface ClipStep {
  do?: string;
  width_m?: number;
  angle_rad?: number;
}

/** Clips that the plan of a valve set, of which a stitch is left. */
export function clipsOf(mvs: Mvs, snapshot: Snapshot): ClipSet[] {
  const made = snapshot.history().done.filter(({ kind }) => String(kind) === 'clip');
  // a plan is written for those that have a clip only
  if (!made.length) return [];
  const { steps } = JSON.parse(snapshot.plan()) as { steps: ClipStep[] };
  const set = steps.filter((step) => step.do === 'clip');
  const names = new Map(snapshot.parts('chord').map(({ id, name }) => [id, name]));
  const usual = mvs.operations
    .find(({ name }) => name === 'clip')!
    .fields.find(({ name }) => name === 'width')!.default_value;
  return made.flatMap(({ made: stitch, title }, k) => {
    const name = clipOf(names.get(stitch) ?? '');
    const { width_m: width = usual, angle_rad: angle = 0 } = set[k] ?? {};
    return name ? [{ name, title, width: width * mm, angle: (angle * 180) / Math.PI }] : [];
  });
}
