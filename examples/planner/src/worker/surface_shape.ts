// The shape of a patient's surface before anything on it is clicked: its annulus, the axis into the atrium and the narrow
// direction across it, guessed; its size. Computed in the worker: for 100,000 triangles it takes longer than a page may be
// without an answer.
import type { SurfaceShape } from '../protocol';
import { cross, dot, minus, scale, unit, type Vector } from '../vector';
import { rims } from './rims';

const pointOf = (x: ArrayLike<number>, i: number): Vector => [x[3 * i], x[3 * i + 1], x[3 * i + 2]];

/** Middle and sides of the box around points. */
function boxOf(
  points: Float32Array,
  nodes: ArrayLike<number> & Iterable<number>,
): { middle: Vector; size: Vector } {
  const [low, high] = [pointOf(points, nodes[0]), pointOf(points, nodes[0])];
  for (const node of nodes)
    for (let c = 0; c < 3; ++c) {
      low[c] = Math.min(low[c], points[3 * node + c]);
      high[c] = Math.max(high[c], points[3 * node + c]);
    }
  return {
    middle: scale([low[0] + high[0], low[1] + high[1], low[2] + high[2]], 0.5),
    size: minus(high, low),
  };
}

/** The area of a loop as a vector. */
function areaOf(points: Float32Array, loop: number[]): Vector {
  const origin = pointOf(points, loop[0]);
  const sum: Vector = [0, 0, 0];
  loop.forEach((node, k) => {
    const next = loop[(k + 1) % loop.length];
    const part = cross(minus(pointOf(points, node), origin), minus(pointOf(points, next), origin));
    for (let c = 0; c < 3; ++c) sum[c] += 0.5 * part[c];
  });
  return sum;
}

/** The annulus: the loop of the boundary with the largest area. */
function annulusOf(points: Float32Array, triangles: Uint32Array): { nodes: number[]; axis: Vector } | null {
  const loops = rims(triangles).map((nodes) => ({ nodes, axis: areaOf(points, nodes) }));
  const size = (loop: { axis: Vector }) => Math.hypot(...loop.axis);
  const largest = loops.sort((a, b) => size(b) - size(a))[0];
  return largest && size(largest) > 0 ? { ...largest, axis: unit(largest.axis) } : null;
}

/** For a surface without a boundary: all of its points, and the shortest axis of the box around them. */
function wholeOf(points: Float32Array, triangles: Uint32Array): { nodes: number[]; axis: Vector } {
  const { size } = boxOf(points, triangles);
  const shortest: Vector = [0, 0, 0];
  shortest[size.indexOf(Math.min(...size))] = 1;
  return { nodes: Array.from(triangles), axis: shortest };
}

/** Whether most normals of triangles, by area, have a part along a direction. */
function faces(points: Float32Array, triangles: Uint32Array, direction: Vector): boolean {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => pointOf(points, triangles[t + k]));
    sum += dot(cross(minus(b, a), minus(c, a)), direction);
  }
  return sum > 0;
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

/** The direction across the axis along which the points spread least: an annulus is wider from side to side than from
 *  front to back. */
function narrowest(points: Float32Array, triangles: Uint32Array, middle: Vector, up: Vector): Vector {
  const p = unit(cross(up, Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
  const q = cross(up, p);
  let [pp, pq, qq] = [0, 0, 0];
  for (const node of triangles) {
    const from = minus(pointOf(points, node), middle);
    const [a, b] = [dot(from, p), dot(from, q)];
    [pp, pq, qq] = [pp + a * a, pq + a * b, qq + b * b];
  }
  // the angle of the widest direction in the plane, and a right angle more
  const angle = 0.5 * Math.atan2(2 * pq, pp - qq) + Math.PI / 2;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * p[0] + s * q[0], c * p[1] + s * q[1], c * p[2] + s * q[2]];
}

/** Extents along the axes of the file: what any other program says of it too. */
export function sizeOf(points: ArrayLike<number>): number[] {
  const [low, high] = [
    [0, 0, 0].fill(points.length ? Infinity : 0),
    [0, 0, 0].fill(points.length ? -Infinity : 0),
  ];
  for (let i = 0; i < points.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  return high.map((v, c) => v - low[c]);
}

export function shapeOf(points: Float32Array, triangles: Uint32Array): SurfaceShape {
  const { nodes, axis } = annulusOf(points, triangles) ?? wholeOf(points, triangles);
  const { middle } = boxOf(points, nodes);
  const up = widensAlong(points, triangles, middle, axis) ? axis : scale(axis, -1);
  let radius = 0;
  for (const node of triangles)
    radius = Math.max(radius, Math.hypot(...minus(pointOf(points, node), middle)));
  return {
    middle,
    up,
    narrow: narrowest(points, triangles, middle, up),
    radius,
    outward: faces(points, triangles, up),
  };
}
