// Annulus, papillary heads, rings and bands.
import type { Picture, Topology } from '../protocol';
import { tissue } from './colours';
import { point, Shapes, type Colour, type Mesh } from './mesh';
import type { SceneOptions } from './scene';

/** The curves of rings and bands in a moving valve: each point goes with the node of the annulus to which it is sewn. */
function carriedRings(topology: Topology, picture: Picture, closed: Picture | null): Float32Array {
  if (closed?.topology !== picture.topology) return picture.ringPoints;
  const points = closed.ringPoints.slice();
  const [now, then] = [picture.positions, closed.positions];
  for (let k = 0; k < points.length; k += 3) {
    const range = (node: number) =>
      Math.hypot(...[0, 1, 2].map((c) => then[3 * node + c] - closed.ringPoints[k + c]));
    const node = topology.annulus.reduce((best, other) => (range(other) < range(best) ? other : best));
    for (let c = 0; c < 3; ++c) points[k + c] += now[3 * node + c] - then[3 * node + c];
  }
  return points;
}

/** Whether a curve is a ring: its ends are as near as its points; those of a band are apart. */
export function isClosed(points: number[][]): boolean {
  const range = (a: number[], b: number[]) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  const steps = points.slice(1).map((point, k) => range(points[k], point));
  return range(points[0], points[points.length - 1]) < 3 * Math.max(...steps);
}

/** mm from the place that holds the chordae to the middle of the papillary muscle's drawn end, away from the atrium. */
export const headLength = 4.5;
/** The drawn radius of a papillary head grows by this factor along it. */
export const headFlare = 1.25;

/** Radius of a papillary head in the picture, mm: many heads are thin. */
export function headRadius(topology: Topology): number {
  const count = topology.headNodes.length;
  return count > 8 ? 0.9 : count > 2 ? 1.5 : 2;
}

/** The points of each ring or band. */
export function ringCurves({ ringStart, ringPoints }: Picture, places = ringPoints): number[][][] {
  const curves: number[][][] = [];
  for (let r = 0; r + 1 < ringStart.length; ++r) {
    curves.push([]);
    for (let k = ringStart[r]; k < ringStart[r + 1]; ++k) curves[r].push(point(places, k));
  }
  return curves;
}

/** Radii of the annulus and of rings in the picture, mm. */
const annulusRadius = 0.55;
export const ringRadius = 1.15;

/** A curve that is drawn as a tube. */
export interface Tube {
  points: number[][];
  closed: boolean;
  radius: number;
  /** Number of sides of its polygon. */
  sides: number;
  colour: Colour;
}

/** The annulus, rings and bands; `closed`: the valve at rest of a moving picture. */
export function tubesOf(topology: Topology, picture: Picture, closed: Picture | null): Tube[] {
  const points = Array.from(topology.annulus, (node) => point(picture.positions, node));
  const tubes: Tube[] = [{ points, closed: true, radius: annulusRadius, sides: 8, colour: tissue.annulus }];
  for (const curve of ringCurves(picture, carriedRings(topology, picture, closed)))
    tubes.push({
      points: curve,
      closed: isClosed(curve),
      radius: ringRadius,
      sides: 10,
      colour: tissue.ring,
    });
  return tubes;
}

/** In a section they end at its plane, so that they hide nothing of it; cut.ts draws where they are cut. */
export function annulusAndRings(topology: Topology, picture: Picture, options: SceneOptions): Mesh {
  const shapes = new Shapes();
  for (const { points, closed, radius, sides, colour } of tubesOf(topology, picture, options.closed))
    shapes.path(points, radius, colour, closed, sides);
  return shapes.mesh({ cut: true });
}

export function heads(topology: Topology, picture: Picture, options: SceneOptions): Mesh {
  const shapes = new Shapes();
  const radius = headRadius(topology);
  topology.headNodes.forEach((node, h) => {
    const at = point(picture.positions, node);
    const colour = h === options.chosenHead ? tissue.chosen : tissue.head;
    shapes.sphere(at, radius, colour, 10, 16);
    const below = at.map((v, c) => v - headLength * options.frame[9 + c]);
    shapes.tube(at, below, radius, colour, 16, radius * headFlare);
    shapes.sphere(below, radius * headFlare, colour, 10, 16);
  });
  // those before the plane of a section hide nothing of it
  return shapes.mesh({ cut: true });
}
