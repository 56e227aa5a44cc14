// The leaflets as sheets with a thickness: an atrial and a ventricular side, told apart or in the colours of a map, each of which
// is seen from its own side only.
import type { Fields, Picture, Topology } from '../protocol';
import { colourOf, isChordMap, maps, tissue } from './colours';
import { heightOf, vertexNormals, type Mesh } from './mesh';
import type { SceneOptions } from './scene';

/** mm between the middle of a leaflet and its sides: half the distance at which leaflets of the library touch. */
export const halfThickness = 0.5;

/** mm from the middle of a leaflet to its ventricular side as it is drawn. Pressed on each other, the middles of the leaflets of the
 *  library are 0.5 to 0.6 mm apart: ventricular sides of a fold that touch do not cross. */
const ventricularDepth = 0.25;

/** Value of the colour map at each node; null for maps that do not colour the leaflets. */
function mapValues(picture: Picture, options: SceneOptions): Float32Array | null {
  const { map, fields, frame } = options;
  if (map === 'height') {
    const x = picture.positions;
    return new Float32Array(x.length / 3).map((_, node) => heightOf(x, node, frame));
  }
  if (map === 'distance') return options.distance;
  if (!fields) return null;
  if (map === 'coaptation') return fields.coaptation;
  if (map === 'stretch') return fields.stretch.map((v) => 100 * v);
  return null;
}

/** Both sides of the leaflets. One alone, seen from behind, would show the side of the facing leaflet through it: sides that touch
 *  overlap. */
export function leafletMeshes(
  topology: Topology,
  picture: Picture,
  middle: Picture,
  options: SceneOptions,
): Mesh[] {
  const upper = leafletMesh(topology, picture, options);
  const positions = ventricularSide(topology, middle);
  return [
    { ...upper, only: 'front' },
    { ...upper, only: 'back', positions, normals: middleNormals(topology, middle) },
  ];
}

function leafletMesh(topology: Topology, picture: Picture, options: SceneOptions): Mesh {
  const nodes = picture.positions.length / 3;
  const front = new Float32Array(3 * nodes);
  const back = new Float32Array(3 * nodes);
  const { map } = options;
  const values = mapValues(picture, options);
  if (values && map !== 'tissue' && !isChordMap(map)) {
    for (let i = 0; i < nodes; ++i) {
      const colour = colourOf(maps[map], values[i]);
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

/** mm by which the sides of leaflets in contact overlap. The facets of two folds do not fit each other: where the sides only
 *  touched at the nodes, a sealed valve would show slits of light between them, with the chordae behind. */
export const overlap = 0.2;
let found: { of: Picture; normals: Float32Array } | null = null;

/** Normals of the middle of the leaflets. The last ones are kept. */
function middleNormals(topology: Topology, picture: Picture): Float32Array {
  if (found?.of !== picture)
    found = { of: picture, normals: vertexNormals(picture.positions, topology.triangles) };
  return found.normals;
}

/** The same without those of the annulus, where both sides meet. */
function awayFromAnnulus(topology: Topology, picture: Picture): Float32Array {
  const normals = middleNormals(topology, picture).slice();
  for (const node of topology.annulus) normals.fill(0, 3 * node, 3 * node + 3);
  return normals;
}

let lifted: { of: Picture; fields: Fields; picture: Picture } | null = null;

/** The picture with the atrial side of the leaflets in place of their middle. Where leaflets touch, their middles are apart by
 *  the thickness of a leaflet: seen from the atrium a sealed valve would seem to leak. The sides of leaflets that are further
 *  apart than that do not meet, so that a leak stays open. The last one is kept. */
export function atrialSide(topology: Topology, picture: Picture, fields: Fields | null): Picture {
  if (!fields) return picture;
  if (lifted?.of === picture && lifted.fields === fields) return lifted.picture;
  const positions = picture.positions.slice();
  const normals = awayFromAnnulus(topology, picture);
  for (let i = 0; i < positions.length; ++i) {
    const apart = fields.coaptation[Math.floor(i / 3)];
    positions[i] +=
      (apart < Infinity ? Math.min(halfThickness, 0.5 * (apart + overlap)) : halfThickness) * normals[i];
  }
  lifted = { of: picture, fields, picture: { ...picture, positions } };
  return lifted.picture;
}

let lowered: { of: Picture; positions: Float32Array } | null = null;

/** The ventricular side of the leaflets. The last one is kept. */
export function ventricularSide(topology: Topology, picture: Picture): Float32Array {
  if (lowered?.of === picture) return lowered.positions;
  const positions = picture.positions.slice();
  const normals = awayFromAnnulus(topology, picture);
  for (let i = 0; i < positions.length; ++i) positions[i] -= ventricularDepth * normals[i];
  lowered = { of: picture, positions };
  return positions;
}
