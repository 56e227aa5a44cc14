// The section plane in the picture: a frame round the valve, and the line along which the leaflets are cut.
import type { Picture, Topology } from '../protocol';
import { tissue } from './colours';
import { Shapes, type Mesh } from './mesh';
import type { CutPlane } from './renderer';

/** Radii of the line and of the frame, mm. */
const lineRadius = 0.28;
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

/** Ends of the cut through each triangle that the plane crosses. */
function cutsOf(topology: Topology, x: Float32Array, plane: CutPlane): [number[], number[]][] {
  const away = new Float32Array(topology.nodes);
  for (let i = 0; i < topology.nodes; ++i)
    for (let c = 0; c < 3; ++c) away[i] += plane.normal[c] * x[3 * i + c];
  const cuts: [number[], number[]][] = [];
  const { triangles } = topology;
  for (let t = 0; t < triangles.length; t += 3) {
    const ends: number[][] = [];
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
      const [da, db] = [away[a] - plane.offset, away[b] - plane.offset];
      if (da < 0 === db < 0) continue;
      const s = da / (da - db);
      ends.push([0, 1, 2].map((c) => x[3 * a + c] + s * (x[3 * b + c] - x[3 * a + c])));
    }
    if (ends.length === 2) cuts.push([ends[0], ends[1]]);
  }
  return cuts;
}

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

let built: { picture: Picture; offset: number; mesh: Mesh } | null = null;

/** Frame and line of the plane; the last one is kept. */
export function cutMesh(
  topology: Topology,
  picture: Picture,
  plane: CutPlane,
  frame: number[],
  radius: number,
): Mesh {
  if (built?.picture === picture && built.offset === plane.offset) return built.mesh;
  const shapes = new Shapes();
  for (const [a, b] of cutsOf(topology, picture.positions, plane))
    shapes.tube(a, b, lineRadius, tissue.cut, 6);
  shapes.path(frameCorners(plane, frame, radius), frameRadius, tissue.chosen, true, 5);
  built = { picture, offset: plane.offset, mesh: shapes.mesh() };
  return built.mesh;
}
