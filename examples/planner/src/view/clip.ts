// The clip of the form in the picture: its place, which is that of its body where the preview shows one, else on the free edge of
// its two scallops, at its position between their ends; and its turn. Positions grow along the CC axis and angles are
// anticlockwise as seen from the atrium, as in the library.
import * as state from '../store/state';
import { edit } from '../store/edit';
import type { Topology } from '../protocol';
import { clipBodies, clipNames } from './clips';

export interface ClipPlace {
  at: number[];
  position: number;
  /** Half the width of the scallops along the CC axis, mm. */
  half: number;
  /** Degrees. */
  angle: number;
  /** Unit vector along its arms, to the anterior side. */
  arm: number[];
  /** Where its turn is held, mm. */
  handle: number[];
  /** The picture shows its body. */
  drawn: boolean;
}

/** mm from the middle of the clip to the handle of its turn, and to the ends of its arms. */
const handleAway = 10;
export const armLength = 5;
/** Steps of drags and keys. */
const positionStep = 0.05;
const angleStep = 5;

/** The free edge of a scallop: nodes and their coordinates along the CC axis. */
function edgeOf(topology: Topology, scallop: number): number[] {
  const own = new Set<number>();
  for (let i = 0; i < topology.triangles.length; ++i)
    if (topology.triangleScallop[Math.floor(i / 3)] === scallop) own.add(topology.triangles[i]);
  return Array.from(topology.freeEdge).filter((node) => own.has(node));
}

function scallopOf(topology: Topology, id: unknown, fallback: string): number {
  const k = topology.scallops.findIndex((part) => part.id === id);
  return k >= 0 ? k : topology.scallops.findIndex((part) => part.name === fallback);
}

const numberIn = (draft: state.Draft, name: string): number =>
  typeof draft.fields[name] === 'number' ? draft.fields[name] : 0;

/** The middle of the clip that the preview adds, mm; null before the first preview. */
function previewedMiddle(): number[] | null {
  const [now, then] = [state.preview.value, state.main.value];
  const [topology, old] = [now, then].map((shown) => shown && state.topologyOf(shown.picture));
  if (!now || !topology || !old || state.previewed.value?.kind !== 'clip') return null;
  const before = clipNames(old);
  const name = [...clipNames(topology)].find((one) => !before.has(one));
  if (name === undefined) return null;
  return clipBodies(topology, now.picture, now.figures.frame).get(name)?.middle ?? null;
}

/** Where the clip is while its form is open; null without such a form, and in the valve before. */
export function clipPlace(): ClipPlace | null {
  const draft = state.draft.value;
  const picture = state.picture.value;
  const topology = picture && state.topologyOf(picture);
  const frame = state.figures.value?.frame;
  if (draft?.kind !== 'clip' || !picture || !topology || !frame || state.inPast.value) return null;
  const x = picture.positions;
  const cc = (node: number) =>
    [0, 1, 2].reduce((sum, c) => sum + (x[3 * node + c] - frame[c]) * frame[6 + c], 0);
  const sides = [
    edgeOf(topology, scallopOf(topology, draft.fields.anterior, 'A2')),
    edgeOf(topology, scallopOf(topology, draft.fields.posterior, 'P2')),
  ];
  if (sides.some((nodes) => !nodes.length)) return null;
  const position = numberIn(draft, 'position');
  const edge = [0, 0, 0];
  let half = 0;
  for (const nodes of sides) {
    const places = nodes.map(cc);
    const [low, high] = [Math.min(...places), Math.max(...places)];
    const wanted = 0.5 * (low + high) + 0.5 * position * (high - low);
    const nearest = nodes.reduce((a, b) => (Math.abs(cc(a) - wanted) <= Math.abs(cc(b) - wanted) ? a : b));
    for (let c = 0; c < 3; ++c) edge[c] += 0.5 * x[3 * nearest + c];
    half += 0.25 * (high - low);
  }
  const middle = previewedMiddle();
  // ahead of the body while the preview of a newer position is still to come
  const ahead = middle ? half * (position - numberIn(state.previewed.value!, 'position')) : 0;
  const at = middle ? middle.map((v, c) => v + ahead * frame[6 + c]) : edge;
  const angle = numberIn(draft, 'angle');
  const [c, s] = [Math.cos((angle * Math.PI) / 180), Math.sin((angle * Math.PI) / 180)];
  const arm = [0, 1, 2].map((k) => c * frame[3 + k] + s * frame[6 + k]);
  const handle = at.map((v, k) => v + handleAway * arm[k]);
  return { at, position, half: Math.max(half, 1), angle, arm, handle, drawn: !!middle };
}

/** The largest turn of the form's field, degrees. */
function largestAngle(): number {
  const clip = state.operationOf('clip');
  return Math.floor(clip?.fields.find((field) => field.name === 'angle')?.high ?? 0);
}

function toStep(value: number, step: number, limit: number): number {
  const whole = step * Math.round(value / step);
  return +Math.min(limit, Math.max(-limit, whole)).toFixed(6);
}

/** Sets position or turn of the clip of the form, to the steps of their sliders. */
export function setClip(name: 'position' | 'angle', value: number): void {
  const draft = state.draft.value;
  if (draft?.kind !== 'clip') return;
  const next =
    name === 'position' ? toStep(value, positionStep, 1) : toStep(value, angleStep, largestAngle());
  if (next !== (draft.fields[name] ?? 0)) edit('clip', { ...draft.fields, [name]: next });
}

/** Keys that move the clip of the form to the left, right and round in the surgeon's view; false for all others. */
export function clipKey(key: string): boolean {
  const steps: Record<string, ['position' | 'angle', number]> = {
    a: ['position', positionStep],
    d: ['position', -positionStep],
    q: ['angle', angleStep],
    e: ['angle', -angleStep],
  };
  const draft = state.draft.value;
  if (draft?.kind !== 'clip' || !steps[key]) return false;
  const [name, by] = steps[key];
  setClip(name, ((draft.fields[name] as number | undefined) ?? 0) + by);
  return true;
}
