// Lines on the leaflets: borders of scallops, the free edge, and seams.
import type { Picture, Topology } from '../protocol';
import { suture } from '../notable';
import { bordersOf, type BorderLine, type OnSide } from './borders';
import { tissue } from './colours';
import { halfThickness } from './leaflets';
import { point, Shapes, type Colour, type Mesh } from './mesh';

/** Pairs of nodes, which depend on the connectivity alone. */
interface Lines {
  /** Edges of the free edge. */
  free: [number, number][];
  /** Edges of a cut that are sewn together. */
  sewn: [number, number][];
}

const kept = new WeakMap<Topology, Lines>();

/** The lines of a valve; those of each connectivity are found once. */
export function linesOf(topology: Topology): Lines {
  let lines = kept.get(topology);
  if (!lines) kept.set(topology, (lines = edgesOf(topology)));
  return lines;
}

/** The free edge, of which a cut is part: an edge is sewn where stitches begin or end at one of its nodes. */
function edgesOf({ chordKind, chordNodes, freeEdge }: Topology): Lines {
  const stitched = new Set<number>();
  chordKind.forEach((kind, k) => {
    if (kind === suture) stitched.add(chordNodes[2 * k]).add(chordNodes[2 * k + 1]);
  });
  const lines: Lines = { free: [], sewn: [] };
  freeEdge.forEach((node, k) => {
    const next = freeEdge[(k + 1) % freeEdge.length];
    lines[stitched.has(node) || stitched.has(next) ? 'sewn' : 'free'].push([node, next]);
  });
  return lines;
}

const keptBorders = new WeakMap<Topology, { atRest: boolean; lines: BorderLine[] }>();

/** Borders of scallops in the first pose at rest of a connectivity: tissue keeps its angles nearly in all others. Until there is one
 *  they are those of the first moving picture, which depends on the speed of the machine. */
export function bordersIn(topology: Topology, x: Float32Array, atRest: boolean): BorderLine[] {
  const known = keptBorders.get(topology);
  if (known && (known.atRest || !atRest)) return known.lines;
  const lines = bordersOf(topology, x);
  keptBorders.set(topology, { atRest, lines });
  return lines;
}

/** mm: nodes of the free edge that are further apart are not neighbours but ends of two leaflets. */
const longest = 8;

/** Thin lines on both sides of the sheet, of which `lower` is the ventricular one, and the rim between them along the free edge;
 *  sewn edges are as thick as the leaflet, in its colour: its thickness is what lies between their lines. */
export function seams(
  topology: Topology,
  picture: Picture,
  lower: Float32Array,
  leaflet: Mesh,
  borders: BorderLine[],
): Mesh {
  const shapes = new Shapes();
  const x = picture.positions;
  const { free, sewn } = linesOf(topology);
  const at = (side: Float32Array, { a, b, share }: OnSide) =>
    [0, 1, 2].map((c) => side[3 * a + c] + share * (side[3 * b + c] - side[3 * a + c]));
  for (const side of [x, lower])
    for (const { from, to } of borders) shapes.tube(at(side, from), at(side, to), 0.1, tissue.seam, 4);
  const near = ([a, b]: [number, number]) =>
    Math.hypot(...[0, 1, 2].map((c) => x[3 * a + c] - x[3 * b + c])) < longest;
  for (const [a, b] of free.filter(near)) {
    for (const side of [x, lower]) shapes.tube(point(side, a), point(side, b), 0.2, tissue.edge, 5);
    shapes.polygon([point(x, a), point(lower, a), point(lower, b)], tissue.edge);
    shapes.polygon([point(x, a), point(lower, b), point(x, b)], tissue.edge);
  }
  for (const [a, b] of sewn.filter(near))
    shapes.tube(point(x, a), point(x, b), halfThickness, colourAt(leaflet, a), 8);
  return shapes.mesh({ cut: true });
}

const colourAt = ({ front }: Mesh, node: number): Colour => [
  front[3 * node],
  front[3 * node + 1],
  front[3 * node + 2],
];
