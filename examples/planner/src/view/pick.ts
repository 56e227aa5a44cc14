// Parts under the pointer: a leaflet triangle by Moeller and Trumbore's intersection, a chord or a papillary
// head within a distance on the screen, if no leaflet hides it.
import type { Picture, Topology } from '../protocol';
import type { Camera } from './camera';
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
  chord: number;
  head: number;
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

/** About half the width of a chord in the picture, pixels. */
const drawn = 4;

/** Distance of a pixel from a segment on the screen, and the place along it. */
function segmentDistance(p: number[], a: number[], b: number[]): [number, number] {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = dx * dx + dy * dy;
  const s = length > 0 ? Math.min(1, Math.max(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length)) : 0;
  return [Math.hypot(p[0] - a[0] - s * dx, p[1] - a[1] - s * dy), s];
}

export function pick(
  camera: Camera,
  topology: Topology,
  picture: Picture,
  px: number,
  py: number,
  width: number,
  height: number,
  reach: number,
  chordsOn: boolean,
  plane: CutPlane | null,
): Hit {
  const x = picture.positions;
  const surface = pickSurface(camera, topology, x, px, py, width, height, plane);
  const eye = camera.position();
  const far = surface ? surface.distance + 1.5 : Infinity;
  const screen = (node: number) =>
    camera.project(x[3 * node], x[3 * node + 1], x[3 * node + 2], width, height);
  const range = (node: number) =>
    Math.hypot(x[3 * node] - eye.x, x[3 * node + 1] - eye.y, x[3 * node + 2] - eye.z);
  let head = -1;
  let nearest = 2 * reach;
  topology.headNodes.forEach((node, h) => {
    const [sx, sy] = screen(node);
    const distance = Math.hypot(sx - px, sy - py);
    if (distance < nearest && range(node) < far) [head, nearest] = [h, distance];
  });
  let chord = -1;
  nearest = Infinity;
  for (let k = 0; chordsOn && k < topology.chordKind.length; ++k) {
    const [a, b] = [topology.chordNodes[2 * k], topology.chordNodes[2 * k + 1]];
    const [distance, s] = segmentDistance([px, py], screen(a), screen(b));
    const depth = (1 - s) * range(a) + s * range(b);
    // of chordae under the pointer the one in front, else the nearest on the screen
    const score = Math.max(0, distance - drawn) + depth / 1e3;
    if (distance > reach || score >= nearest || depth > far) continue;
    if (plane && hidden(x, a, s, b, plane)) continue;
    [chord, nearest] = [k, score];
  }
  return { surface, chord, head };
}

function hidden(x: Float32Array, a: number, s: number, b: number, plane: CutPlane): boolean {
  let value = -plane.offset;
  for (let c = 0; c < 3; ++c) value += plane.normal[c] * ((1 - s) * x[3 * a + c] + s * x[3 * b + c]);
  return value > 0;
}
