// Drags in the picture that change the plan: a chord to its length, a clip along the free edge or round, the handle of the
// section plane, tissue in the living valve. Directions on the screen are those of the projected parts.
import * as state from '../store/state';
import { edit } from '../store/edit';
import { fail, request, tell } from '../store/requests';
import { armLength, clipPlace, setClip, type ClipPlace } from './clip';
import { point } from './mesh';
import type { Hit } from './pick';
import type { Viewport } from './viewport';

export interface Place {
  x: number;
  y: number;
}

export type Drag =
  | { kind: 'turn' }
  | { kind: 'pan' }
  | { kind: 'handle' }
  | { kind: 'clip'; position: number }
  | { kind: 'turn-clip' }
  | { kind: 'chord'; id: string; rest: number }
  | { kind: 'hand'; depth: number };

/** mm between the ball and the tissue where it begins. */
const ballGap = 4.5;

function project(view: Viewport, at: ArrayLike<number>): [number, number, number] {
  return view.camera.project(at[0], at[1], at[2], view.width, view.height);
}

function isNear(view: Viewport, at: ArrayLike<number>, p: Place, reach: number): boolean {
  const [x, y] = project(view, at);
  return Math.hypot(x - p.x, y - p.y) < 16 + reach / 2;
}

/** Pixels from a place to the line between two points of the valve. */
function fromLine(view: Viewport, from: ArrayLike<number>, to: ArrayLike<number>, p: Place): number {
  const [[ax, ay], [bx, by]] = [project(view, from), project(view, to)];
  const [dx, dy] = [bx - ax, by - ay];
  const s = Math.min(1, Math.max(0, ((p.x - ax) * dx + (p.y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(p.x - ax - s * dx, p.y - ay - s * dy);
}

/** Whether a place is at the handle or on the arms of the clip, which turn it as well. */
function isOnArms(view: Viewport, clip: ClipPlace, p: Place, reach: number): boolean {
  const end = clip.at.map((v, c) => v - armLength * clip.arm[c]);
  return fromLine(view, end, clip.handle, p) < reach || isNear(view, clip.handle, p, reach);
}

/** The chosen chord if a press is on it: it is drawn through all that is before it, and goes before that. */
function chosenAt(view: Viewport, p: Place, reach: number): Drag | null {
  const { choice, picture, main, motion } = state;
  const topology = picture.value && state.topologyOf(picture.value);
  if (choice.value?.kind !== 'chord' || !topology || motion.value) return null;
  const { id } = choice.value;
  const k = topology.chords.findIndex((part) => part.id === id);
  const chord = main.value?.figures.chords.find((item) => item.id === id);
  if (k < 0 || !chord) return null;
  const [from, to] = [0, 1].map((end) => point(picture.value!.positions, topology.chordNodes[2 * k + end]));
  return fromLine(view, from, to, p) < reach
    ? { kind: 'chord', id, rest: presentLength(id, chord.rest) }
    : null;
}

/** The object that a press at a place drags: a part under the pointer, or the camera. */
export function dragAt(view: Viewport, p: Place, reach: number, hit: Hit | null): Drag {
  if (state.sectionOn.value && isNear(view, view.handle(), p, reach)) return { kind: 'handle' };
  const clip = clipPlace();
  if (clip && isNear(view, clip.at, p, reach)) return { kind: 'clip', position: clip.position };
  if (clip && isOnArms(view, clip, p, reach)) return { kind: 'turn-clip' };
  const chord = state.tool.value === 'look' ? chosenAt(view, p, reach) : null;
  if (chord) return chord;
  if (!hit) return { kind: 'turn' };
  if (state.tool.value !== 'look' && hit.surface) return grasp(view, hit);
  return { kind: 'turn' };
}

/** The length in the form, if that is about this chord, or that of the valve. */
function presentLength(id: string, rest: number): number {
  const draft = state.draft.value;
  if (draft?.kind !== 'chord_length' || draft.fields.chord !== id) return rest;
  if (typeof draft.fields.length === 'number') return draft.fields.length;
  return typeof draft.fields.factor === 'number' ? rest * draft.fields.factor : rest;
}

function grasp(view: Viewport, hit: Hit): Drag {
  const surface = hit.surface!;
  const ball = state.tool.value === 'push';
  const position = [...surface.at];
  if (ball) {
    // outside of the tissue, on the side of the viewer
    const eye = view.camera.position();
    const towards = [eye.x - surface.at[0], eye.y - surface.at[1], eye.z - surface.at[2]];
    const length = Math.hypot(...towards);
    for (let c = 0; c < 3; ++c) position[c] += (ballGap * towards[c]) / length;
  }
  request(
    'hand_begin',
    // from there the ball goes into the tissue at once: a press without a drag pushes it
    { tool: ball ? 'ball' : 'grasp', node: surface.node, position, to: [...surface.at] },
    {
      motion: (motion) => {
        if (state.handing.value) state.motion.value = motion;
      },
    },
  ).catch(fail);
  state.handing.value = true;
  // the hand moves the closed valve
  state.openness.value = 1;
  return { kind: 'hand', depth: surface.distance };
}

/** Moves the tool of the hand in the plane in which it began. */
export function dragHand(view: Viewport, depth: number, p: Place): void {
  const { origin, direction } = view.camera.ray(p.x, p.y, view.width, view.height);
  const at = origin.addScaledVector(direction, depth);
  tell('hand_move', { position: [at.x, at.y, at.z] });
}

/** Ends the hand; the valve of the plan returns. */
export function dropHand(): void {
  state.handing.value = false;
  request('hand_end', null).then(() => (state.motion.value = null), fail);
}

/** Below this share of its length on the screen an axis counts as one that points at the viewer. */
const endOn = 0.25;

/** Motion of the pointer along the CC axis of the valve, mm; where that points at the viewer it grows to the left, as in the
 *  surgeon's view and under the sliders. */
function along(view: Viewport, from: number[], axis: number[], dx: number, dy: number): number {
  const [a, b] = [
    project(view, from),
    project(
      view,
      [0, 1, 2].map((c) => from[c] + axis[c]),
    ),
  ];
  const [ux, uy] = [b[0] - a[0], b[1] - a[1]];
  const length = ux * ux + uy * uy;
  const scale = view.camera.scale(view.height);
  return Math.sqrt(length) * scale > endOn ? (dx * ux + dy * uy) / length : -dx * scale;
}

export function dragHandle(view: Viewport, dx: number, dy: number): void {
  const f = view.frameOf();
  const step = along(view, view.handle(), [f[6], f[7], f[8]], dx, dy);
  const limit = 0.9 * view.radius();
  state.sectionAt.value = Math.min(limit, Math.max(-limit, state.sectionAt.value + step));
}

/** Slides the clip of the form along the free edge. */
export function dragClip(
  view: Viewport,
  drag: Extract<Drag, { kind: 'clip' }>,
  dx: number,
  dy: number,
): void {
  const clip = clipPlace();
  if (!clip) return;
  const f = view.frameOf();
  const step = along(view, clip.at, [f[6], f[7], f[8]], dx, dy) / clip.half;
  drag.position = Math.min(1, Math.max(-1, drag.position + step));
  setClip('position', drag.position);
}

/** Turns the clip of the form so that its arm points to the pointer, in the plane of the annulus. */
export function turnClip(view: Viewport, p: Place): void {
  const clip = clipPlace();
  if (!clip) return;
  const f = view.frameOf();
  const [ap, cc, up] = [f.slice(3, 6), f.slice(6, 9), f.slice(9, 12)];
  const dot = (a: number[], b: number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const { origin, direction } = view.camera.ray(p.x, p.y, view.width, view.height);
  const [eye, ray] = [origin.toArray(), direction.toArray()];
  const from = clip.at.map((v, c) => v - eye[c]);
  const fall = dot(ray, up);
  // seen from the side the plane is a line: the place of the pointer beside the middle counts
  const reach = Math.abs(fall) > 0.2 ? dot(from, up) / fall : Math.hypot(...from);
  const away = ray.map((v, c) => reach * v - from[c]);
  // towards either end of the clip
  const sense = dot(away, ap) < 0 ? -1 : 1;
  setClip('angle', (Math.atan2(sense * dot(away, cc), sense * dot(away, ap)) * 180) / Math.PI);
}

/** Pulling towards the papillary head shortens, in mm of the picture. */
export function dragChord(
  view: Viewport,
  drag: Extract<Drag, { kind: 'chord' }>,
  start: Place,
  p: Place,
): void {
  const picture = state.main.value!.picture;
  const topology = state.topologyOf(picture)!;
  const k = topology.chords.findIndex((part) => part.id === drag.id);
  const end = (node: number) => project(view, picture.positions.subarray(3 * node, 3 * node + 3));
  const [head, leaf] = [end(topology.chordNodes[2 * k]), end(topology.chordNodes[2 * k + 1])];
  const [ux, uy] = [head[0] - leaf[0], head[1] - leaf[1]];
  const length = Math.hypot(ux, uy);
  const pulled = length > 20 ? ((p.x - start.x) * ux + (p.y - start.y) * uy) / length : p.y - start.y;
  const millimetres = pulled * view.camera.scale(view.height);
  const wanted = Math.min(2 * drag.rest, Math.max(0.3 * drag.rest, drag.rest - millimetres));
  edit('chord_length', { chord: drag.id, length: Math.round(10 * wanted) / 10 });
}
