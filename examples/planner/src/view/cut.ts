// The section plane in the picture: a frame round the valve, the leaflets as they are cut, with their thickness, and the cuts of
// the annulus, of rings and of clips.
import type { Picture, Topology } from '../protocol';
import { between, cross, dot, unit, type Vector } from '../vector';
import { tissue } from './colours';
import { tubesOf, type Tube } from './heart';
import { overlap } from './leaflets';
import { point, Shapes, type Colour, type Mesh } from './mesh';
import type { CutPlane } from './renderer';

/** Radii of the lines along the atrial sides and of the frame, mm. */
const lineRadius = 0.07;
const frameRadius = 0.12;

/** The plane across the CC axis of a frame at an offset from its origin, mm. */
export function planeOf(f: number[], offset: number): CutPlane {
  const normal: [number, number, number] = [f[6], f[7], f[8]];
  return { normal, offset: f[0] * f[6] + f[1] * f[7] + f[2] * f[8] + offset };
}

/** The name of the scallop of each leaflet that a plane cuts, the one with the most cut triangles. */
export function cutScallops(topology: Topology, x: Float32Array, plane: CutPlane): string[] {
  const { triangles, triangleLeaflet, triangleScallop } = topology;
  const counts = topology.leaflets.map(() => topology.scallops.map(() => 0));
  const above = (node: number) =>
    [0, 1, 2].reduce((sum, c) => sum + plane.normal[c] * x[3 * node + c], 0) > plane.offset;
  triangleScallop.forEach((scallop, t) => {
    const sides = [0, 1, 2].map((k) => above(triangles[3 * t + k]));
    if (sides.includes(true) && sides.includes(false)) counts[triangleLeaflet[t]][scallop] += 1;
  });
  return counts.flatMap((count) => {
    const most = Math.max(...count);
    return most > 0 ? [topology.scallops[count.indexOf(most)].name] : [];
  });
}

/** The leaflets at one end of the cut through a triangle: their atrial and their ventricular side in the plane. */
type End = [Vector, Vector];

/** Where the sides of the leaflets are: their middle, and both sides as they are drawn. */
export interface Sides {
  middle: Float32Array;
  upper: Float32Array;
  lower: Float32Array;
}

/** Sides that touch overlap in the picture by this share of it each; in the cut they meet. */
const ofOverlap = 0.5 * overlap;

/** An end of the cut through a triangle: a share of the way from node a to node b. */
interface CutEnd {
  a: number;
  b: number;
  share: number;
}

/** Where an end of a cut is. */
export const placeOf = (x: Float32Array, { a, b, share }: CutEnd): Vector =>
  between(point(x, a), point(x, b), share);

/** Both ends of the cut through each triangle that the plane crosses. */
export function cutsOf(topology: Topology, x: Float32Array, plane: CutPlane): [CutEnd, CutEnd][] {
  const away = new Float64Array(topology.nodes).fill(-plane.offset);
  for (let i = 0; i < topology.nodes; ++i)
    for (let c = 0; c < 3; ++c) away[i] += plane.normal[c] * x[3 * i + c];
  const cuts: [CutEnd, CutEnd][] = [];
  const { triangles } = topology;
  for (let t = 0; t < triangles.length; t += 3) {
    const ends: CutEnd[] = [];
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
      if (away[a] < 0 !== away[b] < 0) ends.push({ a, b, share: away[a] / (away[a] - away[b]) });
    }
    if (ends.length === 2) cuts.push([ends[0], ends[1]]);
  }
  return cuts;
}

/** The sides of the leaflets at an end of a cut. */
function sidesAt({ middle, upper, lower }: Sides, plane: CutPlane, end: CutEnd): End {
  const [m, above, below] = [middle, upper, lower].map((x) => placeOf(x, end));
  const beside = (side: Vector, less: number): Vector => {
    const away = side.map((v, c) => v - m[c]) as Vector;
    const length = Math.hypot(...away) || 1;
    const out = dot(away, plane.normal);
    const share = Math.max(0, length - less) / length;
    return m.map((v, c) => v + share * (away[c] - out * plane.normal[c])) as Vector;
  };
  return [beside(above, ofOverlap), beside(below, 0)];
}

/** Largest factor by which the cut of a tube along the plane is longer than one across. */
const longestCut = 3;

/** Where a curve crosses the plane, and its direction there. */
export function crossings(
  points: number[][],
  closed: boolean,
  plane: CutPlane,
): { middle: number[]; along: Vector }[] {
  const away = points.map((p) => dot(p as Vector, plane.normal) - plane.offset);
  const found = [];
  for (let k = 0; k + (closed ? 0 : 1) < points.length; ++k) {
    const next = (k + 1) % points.length;
    if (away[k] < 0 === away[next] < 0) continue;
    const [a, b] = [points[k], points[next]];
    const s = away[k] / (away[k] - away[next]);
    found.push({ middle: between(a, b, s), along: unit(b.map((v, c) => v - a[c]) as Vector) });
  }
  return found;
}

/** mm by which the cut of a tube lies before that of the one inside it. */
const before = 0.05;
/** A cut is darker than the surface: a white ring would vanish before the background. */
const cutShade = 0.75;

/** Where a tube is cut: ellipses in the plane, `layer` times before it. */
function tubeCuts(
  shapes: Shapes,
  { points, closed, radius, colour }: Tube,
  plane: CutPlane,
  layer: number,
): void {
  for (const { middle, along } of crossings(points, closed, plane)) {
    const across = unit(cross(along, plane.normal));
    const lean = Math.min(longestCut, 1 / Math.max(1e-6, Math.abs(dot(along, plane.normal))));
    const up = cross(plane.normal, Math.hypot(...across) > 0.5 ? across : anyAcross(plane.normal));
    const side = cross(up, plane.normal);
    const corner = (angle: number) =>
      middle.map(
        (v, c) =>
          v +
          before * layer * plane.normal[c] +
          radius * (Math.cos(angle) * side[c] + lean * Math.sin(angle) * up[c]),
      );
    shapes.polygon(
      Array.from({ length: 20 }, (_, j) => corner((2 * Math.PI * j) / 20)),
      [cutShade * colour[0], cutShade * colour[1], cutShade * colour[2]],
    );
  }
}

/** Where a convex solid is cut: the hull of the places where its edges cross the plane. */
function solidCut(shapes: Shapes, solid: Shapes, plane: CutPlane, layer: number): void {
  const { positions, index, front } = solid.mesh();
  const corners: Vector[] = [];
  for (let k = 0; k < index.length; ++k) {
    const [a, b] = [index[k], index[k % 3 === 2 ? k - 2 : k + 1]].map((node) => point(positions, node));
    const [da, db] = [a, b].map((at) => dot(at, plane.normal) - plane.offset);
    if (da < 0 === db < 0) continue;
    const s = da / (da - db);
    corners.push(between(a, b, s).map((v, c) => v + before * layer * plane.normal[c]) as Vector);
  }
  if (corners.length < 3) return;
  const right = anyAcross(plane.normal);
  const up = cross(plane.normal, right);
  const hull = hullOf(corners, right, up);
  if (hull.length > 2) shapes.polygon(hull, [0, 1, 2].map((c) => cutShade * front[c]) as unknown as Colour);
}

/** The convex hull of points in a plane with two axes, anticlockwise: Andrew's two chains. */
function hullOf(points: Vector[], right: Vector, up: Vector): Vector[] {
  const flat = points
    .map((at) => ({ at, x: dot(at, right), y: dot(at, up) }))
    .sort((a, b) => a.x - b.x || a.y - b.y);
  const chain = (row: typeof flat) => {
    const found: typeof flat = [];
    for (const next of row) {
      for (;;) {
        const [a, b] = found.slice(-2);
        if (!b || (b.x - a.x) * (next.y - a.y) - (b.y - a.y) * (next.x - a.x) > 1e-9) break;
        found.pop();
      }
      found.push(next);
    }
    return found.slice(0, -1);
  };
  return [...chain(flat), ...chain([...flat].reverse())].map(({ at }) => at);
}

const anyAcross = (n: Vector): Vector => unit(cross(n, Math.abs(n[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0]));

/** A rectangle in the plane, from the front to the back of the annulus. */
function frameCorners(plane: CutPlane, f: number[], radius: number): number[][] {
  const offset = plane.offset - [0, 1, 2].reduce((sum, c) => sum + f[c] * plane.normal[c], 0);
  return [
    [-1.15, 0.35],
    [1.15, 0.35],
    [1.15, -1.05],
    [-1.15, -1.05],
  ].map(([ap, up]) =>
    [0, 1, 2].map((c) => f[c] + offset * plane.normal[c] + radius * (ap * f[3 + c] + up * f[9 + c])),
  );
}

let built: { picture: Picture; upper: Float32Array; offset: number; meshes: Mesh[] } | null = null;

/** The light line along the atrial side of a cut leaflet, which parts leaflets that touch. */
const lining: Colour = tissue.atrialAnterior;

/** The cut leaflets, annulus, rings and clips, and the frame of the plane; the last ones are kept. */
export function cutMeshes(
  topology: Topology,
  picture: Picture,
  sides: Sides,
  plane: CutPlane,
  frame: number[],
  radius: number,
  closed: Picture | null,
  clips: () => Shapes[],
): Mesh[] {
  const same = built?.picture === picture && built.upper === sides.upper && built.offset === plane.offset;
  if (same) return built!.meshes;
  const [faces, lines] = [new Shapes(), new Shapes()];
  for (const ends of cutsOf(topology, sides.middle, plane)) {
    const [a, b] = ends.map((end) => sidesAt(sides, plane, end));
    faces.polygon([a[0], a[1], b[1], b[0]], tissue.cut);
    lines.tube(a[0], b[0], lineRadius, lining, 5);
  }
  tubesOf(topology, picture, closed).forEach((tube, layer) => tubeCuts(faces, tube, plane, layer));
  for (const part of clips()) solidCut(faces, part, plane, 1);
  lines.path(frameCorners(plane, frame, radius), frameRadius, tissue.chosen, true, 5);
  const meshes = [faces.mesh({ flat: true }), lines.mesh()];
  built = { picture, upper: sides.upper, offset: plane.offset, meshes };
  return meshes;
}
