// Meshes of a valve: leaflets with both sides told apart, chordae as tubes, papillary heads, annulus, ring,
// seams of the scallops, the orifice over everything, and the marks of the chosen part.
import type { Fields, OrificePart, Picture, Topology } from '../protocol';
import { suture } from '../notable';
import { colourOf, maps, tissue, type MapName } from './colours';
import { Shapes, vertexNormals, type Colour, type Mesh } from './mesh';

export interface SceneOptions {
  map: MapName;
  fields: Fields | null;
  /** Values of the map `distance`, mm per node, if a reference is given. */
  distance: Float32Array | null;
  frame: number[];
  /** Share of the limit per chord; above 1 it is beyond it. */
  load: Float32Array | null;
  chosenChord: number;
  chosenHead: number;
  chordsOn: boolean;
  jets: OrificePart[];
  /** The closed valve of a moving picture. */
  closed: Picture | null;
  /** Ends of chordae that the preview takes away, mm. */
  removed: [number[], number[]][];
}

const strut = 3;
/** mm between the middle of a leaflet and its sides: half the distance at which leaflets of the library touch. */
const halfThickness = 0.5;

function point(x: Float32Array, node: number): number[] {
  return [x[3 * node], x[3 * node + 1], x[3 * node + 2]];
}

/** Value of the colour map at each node. */
function mapValues(picture: Picture, options: SceneOptions): Float32Array | null {
  const { map, fields, frame } = options;
  if (map === 'height') {
    const x = picture.positions;
    const values = new Float32Array(x.length / 3);
    for (let i = 0; i < values.length; ++i) {
      values[i] =
        (x[3 * i] - frame[0]) * frame[9] +
        (x[3 * i + 1] - frame[1]) * frame[10] +
        (x[3 * i + 2] - frame[2]) * frame[11];
    }
    return values;
  }
  if (map === 'distance') return options.distance;
  if (!fields) return null;
  if (map === 'coaptation') return fields.coaptation;
  if (map === 'stretch') return fields.stretch.map((v) => 100 * v);
  return null;
}

function leafletMesh(topology: Topology, picture: Picture, options: SceneOptions): Mesh {
  const nodes = picture.positions.length / 3;
  const front = new Float32Array(3 * nodes);
  const back = new Float32Array(3 * nodes);
  const values = options.map === 'tissue' || options.map === 'load' ? null : mapValues(picture, options);
  if (values && options.map !== 'tissue' && options.map !== 'load') {
    for (let i = 0; i < nodes; ++i) {
      const colour = colourOf(maps[options.map], values[i]);
      front.set(colour, 3 * i);
      back.set(colour, 3 * i);
    }
  } else {
    const anterior = Math.max(
      0,
      topology.leaflets.findIndex((leaflet) => leaflet.name === 'A'),
    );
    const { triangles, triangleLeaflet } = topology;
    for (let t = 0; t < triangleLeaflet.length; ++t) {
      const isAnterior = triangleLeaflet[t] === anterior;
      for (let k = 0; k < 3; ++k) {
        front.set(isAnterior ? tissue.atrialAnterior : tissue.atrialPosterior, 3 * triangles[3 * t + k]);
        back.set(
          isAnterior ? tissue.ventricularAnterior : tissue.ventricularPosterior,
          3 * triangles[3 * t + k],
        );
      }
    }
  }
  return {
    positions: picture.positions,
    normals: vertexNormals(picture.positions, topology.triangles),
    index: topology.triangles,
    front,
    back,
    opacity: 1,
    overlay: false,
    cut: true,
    flat: false,
  };
}

/** Edges between two scallops, and the free edge, as thin lines on the sheet. Sewn edges are as thick as the leaflet, in its colour:
 *  its thickness is what lies between their lines. */
function seams(topology: Topology, picture: Picture, leaflet: Mesh): Mesh {
  const shapes = new Shapes();
  const x = picture.positions;
  const owner = new Map<number, number>();
  const { triangles, triangleScallop } = topology;
  for (let t = 0; t < triangleScallop.length; ++t) {
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [triangles[3 * t + k], triangles[3 * t + ((k + 1) % 3)]];
      const key = Math.min(a, b) * topology.nodes + Math.max(a, b);
      const other = owner.get(key);
      if (other === undefined) owner.set(key, triangleScallop[t]);
      else if (other !== triangleScallop[t]) shapes.tube(point(x, a), point(x, b), 0.1, tissue.seam, 4);
    }
  }
  const sewn = new Set<number>();
  topology.chordKind.forEach((kind, k) => {
    if (kind === suture) sewn.add(topology.chordNodes[2 * k]).add(topology.chordNodes[2 * k + 1]);
  });
  topology.freeEdge.forEach((node, k) => {
    const next = topology.freeEdge[(k + 1) % topology.freeEdge.length];
    const [a, b] = [point(x, node), point(x, next)];
    if (Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) >= 8) return;
    if (sewn.has(node) || sewn.has(next)) shapes.tube(a, b, halfThickness, colourAt(leaflet, node), 8);
    else shapes.tube(a, b, 0.2, tissue.edge, 5);
  });
  return shapes.mesh({ cut: true });
}

const colourAt = ({ front }: Mesh, node: number): Colour => [
  front[3 * node],
  front[3 * node + 1],
  front[3 * node + 2],
];

function chordColour(topology: Topology, picture: Picture, options: SceneOptions, k: number): Colour {
  if (k === options.chosenChord) return tissue.chosen;
  if (topology.chordKind[k] === suture) return tissue.suture;
  const load = options.load ? options.load[k] : 0;
  if (options.map === 'load') return colourOf(maps.load, 100 * load);
  if (load > 1) return tissue.over;
  if (picture.chordTaut[k] < 0) return tissue.slack;
  return topology.chordKind[k] === strut ? tissue.strut : tissue.chord;
}

/** mm between the surface of a chord and the leaflet that it ends at. */
const below = 0.15;

/** Both ends of a chord. With the `normals` of the nodes, which point into the atrium and vanish beside the leaflets, it ends
 *  on the side of the ventricle, and shows on no other. */
function chordEnds(topology: Topology, picture: Picture, k: number, radius: number, normals: Float32Array) {
  const end = topology.chordNodes[2 * k + 1];
  const [a, b] = [point(picture.positions, topology.chordNodes[2 * k]), point(picture.positions, end)];
  if (topology.chordKind[k] !== suture)
    for (let c = 0; c < 3; ++c) b[c] -= (radius + below) * normals[3 * end + c];
  return [a, b];
}

function chordae(topology: Topology, picture: Picture, options: SceneOptions, normals: Float32Array): Mesh {
  const shapes = new Shapes();
  const many = topology.chordKind.length > 1500;
  const onLeaflet = new Uint8Array(topology.nodes);
  for (const node of topology.triangles) onLeaflet[node] = 1;
  for (let k = 0; k < topology.chordKind.length; ++k) {
    const chosen = k === options.chosenChord;
    const thin = Math.min(0.75, Math.max(0.22, 0.62 * topology.chordRadius[k]));
    const radius = (many ? 0.15 : thin) * (chosen ? 1.8 : 1);
    const [a, b] = chordEnds(topology, picture, k, radius, normals);
    shapes.tube(a, b, radius, chordColour(topology, picture, options, k), many ? 4 : 7);
    // a joint where chordae branch; on the leaflet it would show on the other side
    if (!many && onLeaflet[topology.chordNodes[2 * k + 1]] === 0)
      shapes.sphere(b, radius * 1.15, chordColour(topology, picture, options, k), 4, 6);
  }
  return shapes.mesh({ cut: true });
}

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

function boundary(topology: Topology, picture: Picture, options: SceneOptions): Mesh {
  const shapes = new Shapes();
  const x = picture.positions;
  shapes.path(
    Array.from(topology.annulus, (node) => point(x, node)),
    0.55,
    tissue.annulus,
    true,
  );
  const radius = topology.headNodes.length > 8 ? 0.9 : topology.headNodes.length > 2 ? 1.5 : 2;
  topology.headNodes.forEach((node, h) => {
    const at = point(x, node);
    const colour = h === options.chosenHead ? tissue.chosen : tissue.head;
    shapes.sphere(at, radius, colour, 10, 16);
    const below = [
      at[0] - 4.5 * options.frame[9],
      at[1] - 4.5 * options.frame[10],
      at[2] - 4.5 * options.frame[11],
    ];
    shapes.tube(at, below, radius, colour, 16, radius * 1.25);
    shapes.sphere(below, radius * 1.25, colour, 10, 16);
  });
  const rings = carriedRings(topology, picture, options.closed);
  for (let r = 0; r + 1 < picture.ringStart.length; ++r) {
    const points = [];
    for (let k = picture.ringStart[r]; k < picture.ringStart[r + 1]; ++k) points.push(point(rings, k));
    shapes.path(points, 1.15, tissue.ring, isClosed(points), 10);
  }
  return shapes.mesh();
}

/** Opacity of a leak that leaflets hide: it is still found, and reads as behind them. */
const behind = 0.22;

/** A mesh where it is seen, and faintly where something hides it. */
function throughTissue(mesh: Mesh): Mesh[] {
  return [
    { ...mesh, overlay: true, opacity: behind },
    { ...mesh, overlay: false },
  ];
}

function orifice(picture: Picture): Mesh {
  const count = picture.orificeVertices.length;
  const colours = new Float32Array(count);
  for (let i = 0; i < count; i += 3) colours.set(tissue.orifice, i);
  return {
    positions: picture.orificeVertices,
    normals: vertexNormals(picture.orificeVertices, picture.orificeTriangles),
    index: picture.orificeTriangles,
    front: colours,
    back: colours,
    opacity: 0.85,
    overlay: false,
    cut: false,
    flat: true,
  };
}

/** An arrow along the jet of each part of the orifice, longer for larger parts. */
function jets(parts: OrificePart[]): Mesh {
  const shapes = new Shapes();
  for (const part of parts) {
    const length = 4 + Math.min(8, Math.sqrt(part.area));
    const along = (s: number) => part.centroid.map((v, c) => v + s * part.direction[c]);
    shapes.tube(along(0.5), along(length), 0.45, tissue.orifice, 10);
    shapes.tube(along(length), along(length + 2.5), 1.2, tissue.orifice, 12, 0.02);
  }
  return shapes.mesh();
}

/** The chosen chord once more, through whatever hides it. */
function throughAll(topology: Topology, picture: Picture, k: number, normals: Float32Array): Mesh {
  const shapes = new Shapes();
  const [a, b] = chordEnds(topology, picture, k, 0.35, normals);
  shapes.tube(a, b, 0.35, tissue.chosen);
  return shapes.mesh({ overlay: true, opacity: 0.55 });
}

/** mm that stay between two leaflets, so that they do not cross between their nodes. */
const clearance = 0.2;
let lifted: { of: Picture; fields: Fields; picture: Picture } | null = null;

/** The picture with the atrial side of the leaflets in place of their middle. Where leaflets touch, their middles are apart by
 *  the thickness of a leaflet: seen from the atrium a sealed valve would seem to leak. The last one is kept. */
export function atrialSide(topology: Topology, picture: Picture, fields: Fields | null): Picture {
  if (!fields) return picture;
  if (lifted?.of === picture && lifted.fields === fields) return lifted.picture;
  const positions = picture.positions.slice();
  const normals = vertexNormals(positions, topology.triangles);
  for (const node of topology.annulus) normals.fill(0, 3 * node, 3 * node + 3);
  for (let i = 0; i < positions.length; ++i) {
    const apart = fields.coaptation[Math.floor(i / 3)];
    positions[i] +=
      (apart < Infinity ? Math.min(halfThickness, Math.max(0, 0.5 * (apart - clearance))) : halfThickness) *
      normals[i];
  }
  lifted = { of: picture, fields, picture: { ...picture, positions } };
  return lifted.picture;
}

/** Everything that is drawn of a valve. */
export function sceneMeshes(topology: Topology, middle: Picture, options: SceneOptions): Mesh[] {
  const picture = atrialSide(topology, middle, options.fields);
  const leaflets = leafletMesh(topology, picture, options);
  const meshes = [leaflets, seams(topology, picture, leaflets), boundary(topology, picture, options)];
  if (options.chordsOn) meshes.push(chordae(topology, picture, options, meshes[0].normals));
  if (picture.orificeTriangles.length) meshes.push(...throughTissue(orifice(picture)));
  if (options.jets.length) meshes.push(...throughTissue(jets(options.jets)));
  if (options.chosenChord >= 0)
    meshes.push(throughAll(topology, picture, options.chosenChord, meshes[0].normals));
  if (options.removed.length) {
    const shapes = new Shapes();
    for (const [a, b] of options.removed) shapes.tube(a, b, 0.35, tissue.chosen);
    meshes.push(shapes.mesh({ opacity: 0.4 }));
  }
  if (picture.hand) {
    const hand = new Shapes();
    hand.sphere(picture.hand.subarray(0, 3), 1.1, tissue.hand);
    hand.tube(picture.hand.subarray(0, 3), picture.hand.subarray(3, 6), 0.35, tissue.hand);
    meshes.push(hand.mesh({ overlay: true }));
  }
  return meshes;
}
