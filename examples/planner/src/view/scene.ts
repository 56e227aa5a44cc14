// Everything that is drawn of a valve, as meshes: leaflets and seams, what holds them, chordae, the leak, marks of chosen parts.
import type { Fields, OrificePart, Picture, Topology } from '../protocol';
import { beyondAll, chordae, throughAll } from './chordae';
import { clipParts } from './clips';
import { tissue, type MapName } from './colours';
import { annulusAndRings, heads } from './heart';
import { atrialSide, leafletMeshes, ventricularSide } from './leaflets';
import { jets, orifice, throughTissue } from './leak';
import { Shapes, type Mesh } from './mesh';
import { bordersIn, seams } from './seams';

export interface SceneOptions {
  map: MapName;
  fields: Fields | null;
  /** Fields that say how near the leaflets are to each other; of a moving valve those before its motion. */
  sides: Fields | null;
  /** Values of the map `distance`, mm per node, if a reference is given. */
  distance: Float32Array | null;
  frame: number[];
  /** Share of the limit per chord; above 1 it is beyond it. */
  load: Float32Array | null;
  /** Value of the chordae's colour map per chord. */
  chordValues: Float32Array | null;
  chosenChord: number;
  chosenHead: number;
  chordsOn: boolean;
  jets: OrificePart[];
  /** Turns of the clips in degrees, by their names. */
  clipTurns: Map<string, number>;
  /** The picture is that of a valve at rest. */
  atRest: boolean;
  /** The closed valve of a moving picture. */
  closed: Picture | null;
  /** Ends of chordae that the preview takes away, mm. */
  removed: [number[], number[]][];
}

/** Opacity of a clip that leaflets hide: its turn is read through them. */
const behindDevice = 0.45;

/** Everything that is drawn of a valve. */
export function sceneMeshes(topology: Topology, middle: Picture, options: SceneOptions): Mesh[] {
  const picture = atrialSide(topology, middle, options.sides);
  const lower = ventricularSide(topology, middle);
  const leaflets = leafletMeshes(topology, picture, middle, options);
  const [, under] = leaflets;
  const meshes = [
    ...leaflets,
    seams(topology, picture, lower, leaflets[0], bordersIn(topology, middle.positions, options.atRest)),
    annulusAndRings(topology, picture, options),
    heads(topology, picture, options),
  ];
  if (options.chordsOn) {
    meshes.push(chordae(topology, picture, options, under));
    const beyond = beyondAll(topology, picture, options, under);
    if (beyond) meshes.push(beyond);
  }
  const devices = new Shapes();
  for (const part of clipParts(topology, middle, options.frame, options.clipTurns)) devices.add(part);
  if (!devices.isEmpty()) meshes.push(...throughTissue(devices.mesh({ cut: true }), behindDevice));
  if (picture.orificeTriangles.length) meshes.push(...throughTissue(orifice(picture)));
  if (options.jets.length) meshes.push(...throughTissue(jets(options.jets)));
  if (options.chosenChord >= 0) meshes.push(throughAll(topology, picture, options.chosenChord, under));
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
