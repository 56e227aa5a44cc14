// Parts under the pointer: a leaflet triangle by Moeller and Trumbore's intersection, a chord or a papillary
// head within a distance on the screen from its drawn outline, if no leaflet hides it.
import type { Picture, Topology } from '../protocol';
import type { Camera } from './camera';
import { drawnRadius } from './chordae';
import { headFlare, headLength, headRadius } from './heart';
import type { CutPlane } from './renderer';

export interface SurfaceHit {
  triangle: number;
  u: [number, number, number];
  /** The vertex of the triangle nearest to the place. */
  node: number;
  at: [number, number, number];
  distance: number;
}

export interface Hit {
  surface: SurfaceHit | null;
  /** The chord and the papillary head within reach that are nearest on the screen, -1 if there is none. */
  chord: number;
  head: number;
  /** What the pointer means where nothing special is asked for. */
  part: 'chord' | 'head' | 'surface' | null;
}

/** What can be picked, as it is drawn. */
export interface Pickable {
  camera: Camera;
  topology: Topology;
  picture: Picture;
  /** Rows are origin, AP, CC and the axis into the atrium (Figures.frame). */
  frame: number[];
  width: number;
  height: number;
  chordsOn: boolean;
  plane: CutPlane | null;
}

export function pickSurface(
  camera: Camera,
  topology: { triangles: Uint32Array },
  x: Float32Array,
  px: number,
  py: number,
  width: number,
  height: number,
  plane: CutPlane | null,
): SurfaceHit | null {
  const { origin, direction: d } = camera.ray(px, py, width, height);
  const { triangles } = topology;
  let best: SurfaceHit | null = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const e1x = x[b] - x[a],
      e1y = x[b + 1] - x[a + 1],
      e1z = x[b + 2] - x[a + 2];
    const e2x = x[c] - x[a],
      e2y = x[c + 1] - x[a + 1],
      e2z = x[c + 2] - x[a + 2];
    const hx = d.y * e2z - d.z * e2y,
      hy = d.z * e2x - d.x * e2z,
      hz = d.x * e2y - d.y * e2x;
    const determinant = e1x * hx + e1y * hy + e1z * hz;
    if (Math.abs(determinant) < 1e-12) continue;
    const f = 1 / determinant;
    const sx = origin.x - x[a],
      sy = origin.y - x[a + 1],
      sz = origin.z - x[a + 2];
    const u = f * (sx * hx + sy * hy + sz * hz);
    if (u < 0 || u > 1) continue;
    const qx = sy * e1z - sz * e1y,
      qy = sz * e1x - sx * e1z,
      qz = sx * e1y - sy * e1x;
    const v = f * (d.x * qx + d.y * qy + d.z * qz);
    if (v < 0 || u + v > 1) continue;
    const distance = f * (e2x * qx + e2y * qy + e2z * qz);
    if (distance <= 0 || (best && distance >= best.distance)) continue;
    const at: [number, number, number] = [
      origin.x + distance * d.x,
      origin.y + distance * d.y,
      origin.z + distance * d.z,
    ];
    if (plane && at[0] * plane.normal[0] + at[1] * plane.normal[1] + at[2] * plane.normal[2] > plane.offset)
      continue;
    const weights: [number, number, number] = [1 - u - v, u, v];
    const corner = weights.indexOf(Math.max(...weights));
    best = { triangle: t / 3, u: weights, node: triangles[t + corner], at, distance };
  }
  return best;
}

/** Distance of a pixel from a segment on the screen, and the place along it. */
function segmentDistance(p: number[], a: number[], b: number[]): [number, number] {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = dx * dx + dy * dy;
  const s = length > 0 ? Math.min(1, Math.max(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length)) : 0;
  return [Math.hypot(p[0] - a[0] - s * dx, p[1] - a[1] - s * dy), s];
}

interface Candidate {
  index: number;
  /** Pixels between the pointer and what is drawn, 0 on it. */
  beside: number;
  /** mm from the eye to what is drawn there. */
  depth: number;
}

const none: Candidate = { index: -1, beside: Infinity, depth: Infinity };

/** Measures parts on the screen. */
class Screen {
  private readonly eye;

  constructor(private readonly from: Pickable) {
    this.eye = from.camera.position();
  }

  place(at: ArrayLike<number>): [number, number] {
    const { camera, width, height } = this.from;
    const [x, y] = camera.project(at[0], at[1], at[2], width, height);
    return [x, y];
  }

  range(at: ArrayLike<number>): number {
    return Math.hypot(at[0] - this.eye.x, at[1] - this.eye.y, at[2] - this.eye.z);
  }

  /** Pixels of a length at a distance from the eye, both in mm. */
  pixels(length: number, range: number): number {
    return (length * this.from.height) / (2 * range * Math.tan(this.from.camera.fov / 2));
  }
}

/** The head whose outline is nearest, the one in front of several under the pointer; what lies behind `far` mm is hidden. */
function pickHead(
  from: Pickable,
  screen: Screen,
  p: [number, number],
  reach: number,
  far: number,
): Candidate {
  const { topology, picture, frame } = from;
  const radius = headRadius(topology);
  let best = none;
  topology.headNodes.forEach((node, index) => {
    const top = picture.positions.subarray(3 * node, 3 * node + 3);
    const end = [0, 1, 2].map((c) => top[c] - headLength * frame[9 + c]);
    const [distance, s] = segmentDistance(p, screen.place(top), screen.place(end));
    const range = (1 - s) * screen.range(top) + s * screen.range(end);
    const wide = radius * (1 + s * (headFlare - 1));
    const beside = Math.max(0, distance - screen.pixels(wide, range));
    // of the round surface under the pointer
    const off = distance / screen.pixels(1, range);
    const depth = range - Math.sqrt(Math.max(0, wide * wide - off * off));
    const nearer = beside < best.beside || (beside === best.beside && depth < best.depth);
    if (beside <= reach && depth < far && nearer) best = { index, beside, depth };
  });
  return best;
}

/** The chord whose outline is nearest, the one in front of several under the pointer. */
function pickChord(
  from: Pickable,
  screen: Screen,
  p: [number, number],
  reach: number,
  far: number,
): Candidate {
  const { topology, picture, plane } = from;
  const x = picture.positions;
  const at = (node: number) => x.subarray(3 * node, 3 * node + 3);
  let best = none;
  for (let index = 0; index < topology.chordKind.length; ++index) {
    const [a, b] = [topology.chordNodes[2 * index], topology.chordNodes[2 * index + 1]];
    const [distance, s] = segmentDistance(p, screen.place(at(a)), screen.place(at(b)));
    if (distance > reach) continue;
    const depth = (1 - s) * screen.range(at(a)) + s * screen.range(at(b));
    const beside = Math.max(0, distance - screen.pixels(drawnRadius(topology, index), depth));
    const nearer = beside < best.beside || (beside === best.beside && depth < best.depth);
    if (!nearer || depth > far || (plane && hidden(x, a, s, b, plane))) continue;
    best = { index, beside, depth };
  }
  return best;
}

/**
 * What the pointer means: the head where it is drawn, unless a chord is drawn in front of it there; beside the heads
 * a chord within reach, which is thin and has to be meant from beside it; then a head within reach; then the leaflet.
 */
function meant(head: Candidate, chord: Candidate, surface: SurfaceHit | null): Hit['part'] {
  const inFront = chord.beside === 0 && chord.depth < head.depth;
  if (head.beside === 0 && !inFront) return 'head';
  if (chord.index >= 0) return 'chord';
  if (head.index >= 0) return 'head';
  return surface && 'surface';
}

/** mm behind a leaflet within which a part still shows: chordae end on the other side of it. */
const through = 1.5;

/** The parts at a pixel; `reach`: pixels beside a part that still pick it. */
export function pick(from: Pickable, px: number, py: number, reach: number): Hit {
  const { camera, topology, picture, width, height, plane } = from;
  const surface = pickSurface(camera, topology, picture.positions, px, py, width, height, plane);
  const far = surface ? surface.distance + through : Infinity;
  const screen = new Screen(from);
  const head = pickHead(from, screen, [px, py], reach, far);
  const chord = from.chordsOn ? pickChord(from, screen, [px, py], reach, far) : none;
  return { surface, chord: chord.index, head: head.index, part: meant(head, chord, surface) };
}

function hidden(x: Float32Array, a: number, s: number, b: number, plane: CutPlane): boolean {
  let value = -plane.offset;
  for (let c = 0; c < 3; ++c) value += plane.normal[c] * ((1 - s) * x[3 * a + c] + s * x[3 * b + c]);
  return value > 0;
}
