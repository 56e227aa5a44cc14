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
  /** The side of the leaflet that is seen. */
  atrial: boolean;
}

export interface Hit {
  surface: SurfaceHit | null;
  /** The chord and the papillary head within reach that are nearest on the screen, -1 if both are out of reach. */
  chord: number;
  head: number;
  /** The part that the pointer means where the form does not ask for a type. */
  part: 'chord' | 'head' | 'surface' | null;
}

/** Parts that can be picked, as they are drawn. */
export interface Pickable {
  camera: Camera;
  topology: Topology;
  picture: Picture;
  /** The surface that is drawn of the leaflets, mm: where they touch it has no gap. */
  drawn: Float32Array;
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
    // corners run anticlockwise as seen from the atrium
    best = {
      triangle: t / 3,
      u: weights,
      node: triangles[t + corner],
      at,
      distance,
      atrial: determinant > 0,
    };
  }
  return best;
}

/** Distance of a pixel from a segment on the screen, the place along it, and its pixel. */
function nearestOf(p: Pixel, a: Pixel, b: Pixel): [number, number, Pixel] {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = dx * dx + dy * dy;
  const s = length > 0 ? Math.min(1, Math.max(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length)) : 0;
  const q: Pixel = [a[0] + s * dx, a[1] + s * dy];
  return [Math.hypot(p[0] - q[0], p[1] - q[1]), s, q];
}

type Pixel = [number, number];

/** A part within reach of the pointer. */
interface Candidate {
  index: number;
  /** Pixels between the pointer and the outline of the part, 0 within it. */
  beside: number;
  /** mm from the eye to the part there. */
  depth: number;
  /** The pixel of the part that is nearest to the pointer. */
  place: Pixel;
}

const none: Candidate = { index: -1, beside: Infinity, depth: Infinity, place: [0, 0] };

/** Measures parts on the screen. */
class Screen {
  private readonly eye;

  constructor(private readonly from: Pickable) {
    this.eye = from.camera.position();
  }

  place(at: ArrayLike<number>): Pixel {
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

/** A tube on the screen as a candidate: `a` and `b` are its ends, `wide` its radius at the share s of its length, mm. */
function candidateOf(
  screen: Screen,
  p: Pixel,
  index: number,
  [a, b]: ArrayLike<number>[],
  wide: (s: number) => number,
): Candidate & { s: number } {
  const [distance, s, q] = nearestOf(p, screen.place(a), screen.place(b));
  const range = (1 - s) * screen.range(a) + s * screen.range(b);
  const radius = wide(s);
  const outline = screen.pixels(radius, range);
  if (distance <= outline) {
    // the round surface under the pointer
    const off = distance / screen.pixels(1, range);
    return {
      index,
      s,
      beside: 0,
      depth: range - Math.sqrt(Math.max(0, radius * radius - off * off)),
      place: p,
    };
  }
  const place: Pixel = [0, 1].map((c) => q[c] + ((p[c] - q[c]) * outline) / distance) as Pixel;
  return { index, s, beside: distance - outline, depth: range, place };
}

function heads(from: Pickable, screen: Screen, p: Pixel): Candidate[] {
  const { topology, picture, frame } = from;
  const radius = headRadius(topology);
  return Array.from(topology.headNodes, (node, index) => {
    const top = picture.positions.subarray(3 * node, 3 * node + 3);
    const end = [0, 1, 2].map((c) => top[c] - headLength * frame[9 + c]);
    return candidateOf(screen, p, index, [top, end], (s) => radius * (1 + s * (headFlare - 1)));
  });
}

function chordae(from: Pickable, screen: Screen, p: Pixel): Candidate[] {
  const { topology, picture, plane } = from;
  const x = picture.positions;
  const all = Array.from(topology.chordKind, (_, index) => {
    const [a, b] = [topology.chordNodes[2 * index], topology.chordNodes[2 * index + 1]];
    const ends = [a, b].map((node) => x.subarray(3 * node, 3 * node + 3));
    const candidate = candidateOf(screen, p, index, ends, () => drawnRadius(topology, index));
    return { ...candidate, cut: !!plane && isCut(x, a, candidate.s, b, plane) };
  });
  return all.filter((candidate) => !candidate.cut);
}

/**
 * mm behind the leaflet at which a part still shows. Chordae end in the middle of the tissue and are drawn to its
 * ventricular side, which is slanted under a thick chord; behind the atrial side nothing shows.
 */
const through = { atrial: -0.3, ventricular: 1.5 };

/** The candidate within reach whose outline is nearest and no leaflet hides; of several under the pointer that in front. */
function nearest(all: Candidate[], reach: number, surfaceAt: (p: Pixel) => SurfaceHit | null): Candidate {
  const shows = ({ depth, place }: Candidate): boolean => {
    const leaflet = surfaceAt(place);
    return !leaflet || depth < leaflet.distance + (leaflet.atrial ? through.atrial : through.ventricular);
  };
  const order = all
    .filter(({ beside }) => beside <= reach)
    .sort((a, b) => a.beside - b.beside || a.depth - b.depth);
  return order.find(shows) ?? none;
}

/**
 * The part that the pointer means: the head where it is drawn, unless a chord is drawn in front of it there; beside the heads
 * a chord within reach, which is thin and has to be meant from beside it; then a head within reach; then the leaflet.
 */
function meant(head: Candidate, chord: Candidate, surface: SurfaceHit | null): Hit['part'] {
  const inFront = chord.beside === 0 && chord.depth < head.depth;
  if (head.beside === 0 && !inFront) return 'head';
  if (chord.index >= 0) return 'chord';
  if (head.index >= 0) return 'head';
  return surface && 'surface';
}

/** The place of barycentric weights in a triangle, in the middle of the tissue. */
export function placeIn(
  topology: Topology,
  x: Float32Array,
  { triangle, u }: { triangle: number; u: number[] },
): SurfaceHit['at'] {
  const nodes = topology.triangles.subarray(3 * triangle, 3 * triangle + 3);
  const sum = (c: number) =>
    u[0] * x[3 * nodes[0] + c] + u[1] * x[3 * nodes[1] + c] + u[2] * x[3 * nodes[2] + c];
  return [sum(0), sum(1), sum(2)];
}

/** The parts at a pixel; `reach`: pixels beside a part that still pick it. */
export function pick(from: Pickable, px: number, py: number, reach: number): Hit {
  const { camera, topology, picture, drawn, width, height, plane } = from;
  const surfaceAt = ([x, y]: Pixel) => pickSurface(camera, topology, drawn, x, y, width, height, plane);
  const p: Pixel = [px, py];
  const surface = surfaceAt(p);
  const screen = new Screen(from);
  const head = nearest(heads(from, screen, p), reach, surfaceAt);
  const chord = from.chordsOn ? nearest(chordae(from, screen, p), reach, surfaceAt) : none;
  return {
    surface: surface && { ...surface, at: placeIn(topology, picture.positions, surface) },
    chord: chord.index,
    head: head.index,
    part: meant(head, chord, surface),
  };
}

function isCut(x: Float32Array, a: number, s: number, b: number, plane: CutPlane): boolean {
  let value = -plane.offset;
  for (let c = 0; c < 3; ++c) value += plane.normal[c] * ((1 - s) * x[3 * a + c] + s * x[3 * b + c]);
  return value > 0;
}
