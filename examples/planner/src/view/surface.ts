// An imported surface: its mesh, lit as a leaflet with both sides told apart, and a frame for its views, guessed from its
// shape and from the points that were clicked.
import { tissue } from './colours';
import { vertexNormals, type Colour, type Mesh } from './mesh';
import type { Imported } from '../store/state';

type Vector = [number, number, number];

/** The frame of a surface as in `Figures`, the largest distance of a point from its middle, mm, and whether the normals of
 *  its triangles point into the atrium. */
export interface SurfaceFrame {
  frame: number[];
  radius: number;
  outward: boolean;
}

const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a: Vector, s: number): Vector => [a[0] * s, a[1] * s, a[2] * s];
const unit = (a: Vector): Vector => scale(a, 1 / (Math.hypot(...a) || 1));
const pointOf = (x: ArrayLike<number>, i: number): Vector => [x[3 * i], x[3 * i + 1], x[3 * i + 2]];

/** Vector areas below this share of the area say nothing: a closed wall, or triangles without a common orientation. */
const least = 0.15;

/** Middle and sides of the box around the triangles' points. */
function boxOf(points: Float32Array, triangles: Uint32Array): { middle: Vector; size: Vector } {
  const [low, high] = [pointOf(points, triangles[0]), pointOf(points, triangles[0])];
  for (const node of triangles)
    for (let c = 0; c < 3; ++c) {
      low[c] = Math.min(low[c], points[3 * node + c]);
      high[c] = Math.max(high[c], points[3 * node + c]);
    }
  return {
    middle: scale([low[0] + high[0], low[1] + high[1], low[2] + high[2]], 0.5),
    size: minus(high, low),
  };
}

/** The sum of the triangles' areas as vectors: that of the annulus less that of the free edge, both across the axis of the
 *  valve. Where it is too small, the shortest axis of the box. */
function axisOf(points: Float32Array, triangles: Uint32Array, size: Vector): Vector {
  const sum: Vector = [0, 0, 0];
  let area = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => pointOf(points, triangles[t + k]));
    const normal = cross(minus(b, a), minus(c, a));
    for (let k = 0; k < 3; ++k) sum[k] += normal[k];
    area += Math.hypot(...normal);
  }
  if (Math.hypot(...sum) > least * area) return unit(sum);
  const shortest: Vector = [0, 0, 0];
  shortest[size.indexOf(Math.min(...size))] = 1;
  return shortest;
}

/** Leaflets narrow towards the ventricle: whether heights along an axis grow with the distance from it. */
function widensAlong(points: Float32Array, triangles: Uint32Array, middle: Vector, axis: Vector): boolean {
  let [n, h, r, hr] = [0, 0, 0, 0];
  for (const node of triangles) {
    const from = minus(pointOf(points, node), middle);
    const height = dot(from, axis);
    const distance = Math.sqrt(Math.max(0, dot(from, from) - height * height));
    [n, h, r, hr] = [n + 1, h + height, r + distance, hr + height * distance];
  }
  return hr / n >= (h / n) * (r / n);
}

/** The direction from front to back that the clicked points give, else any. */
function forward(up: Vector, middle: Vector, { commissures, anterior }: Imported['points']): Vector {
  const across = (v: Vector) => minus(v, scale(up, dot(v, up)));
  const towards = anterior.length ? across(minus(anterior[0] as Vector, middle)) : null;
  if (commissures.length < 2) return unit(towards ?? across(Math.abs(up[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
  const ap = cross(up, unit(across(minus(commissures[1] as Vector, commissures[0] as Vector))));
  return towards && dot(towards, ap) < 0 ? scale(ap, -1) : ap;
}

export function surfaceFrame(
  points: Float32Array,
  triangles: Uint32Array,
  marks: Imported['points'],
): SurfaceFrame {
  const { middle, size } = boxOf(points, triangles);
  const axis = axisOf(points, triangles, size);
  const outward = widensAlong(points, triangles, middle, axis);
  const up = outward ? axis : scale(axis, -1);
  const ap = forward(up, middle, marks);
  let radius = 0;
  for (const node of triangles)
    radius = Math.max(radius, Math.hypot(...minus(pointOf(points, node), middle)));
  return { frame: [...middle, ...ap, ...cross(ap, up), ...up], radius, outward };
}

export function surfaceMesh(positions: Float32Array, index: Uint32Array, outward: boolean): Mesh {
  const shade = (colour: Colour) => {
    const out = new Float32Array(positions.length);
    for (let i = 0; i < out.length; i += 3) out.set(colour, i);
    return out;
  };
  const [atrial, ventricular] = [shade(tissue.atrialAnterior), shade(tissue.ventricularAnterior)];
  return {
    positions,
    index,
    normals: vertexNormals(positions, index),
    front: outward ? atrial : ventricular,
    back: outward ? ventricular : atrial,
    opacity: 1,
    overlay: false,
    cut: false,
    flat: false,
  };
}
