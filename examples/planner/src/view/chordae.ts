// Chordae as tubes from the papillary heads to the ventricular side of the leaflets, in the colour of their load or kind;
// artificial ones in bands of that colour and a dark one.
import type { Picture, Topology } from '../protocol';
import { suture } from '../notable';
import { colourOf, isChordMap, maps, tissue } from './colours';
import { point, Shapes, type Colour, type Mesh } from './mesh';
import type { SceneOptions } from './scene';

const strut = 3;

function chordColour(topology: Topology, picture: Picture, options: SceneOptions, k: number): Colour {
  if (k === options.chosenChord) return tissue.chosen;
  if (topology.chordKind[k] === suture) return tissue.suture;
  if (options.load && options.load[k] > 1) return tissue.over;
  if (picture.chordTaut[k] < 0) return tissue.slack;
  if (isChordMap(options.map) && options.chordValues)
    return colourOf(maps[options.map], options.chordValues[k]);
  if (topology.chordArtificial[k]) return tissue.ring;
  return topology.chordKind[k] === strut ? tissue.strut : tissue.chord;
}

/** mm of the bands by which artificial chordae differ from native ones in all colours. */
const band = 1.4;

/** Whether a chord is drawn in bands: artificial ones, except the chosen one and stitches, which have a colour of their own. */
const isBanded = (
  { chordArtificial, chordKind }: Topology,
  { chosenChord }: SceneOptions,
  k: number,
): boolean => chordArtificial[k] === 1 && chordKind[k] !== suture && k !== chosenChord;

/** The ventricular side of the leaflets, at which chordae end: places of its nodes and their normals into the atrium, which vanish
 *  beside the leaflets. */
export interface Under {
  positions: Float32Array;
  normals: Float32Array;
}

/** Both ends of a chord; it lies on the ventricular side of its leaflet, and shows on no other. */
function chordEnds(topology: Topology, picture: Picture, k: number, radius: number, under: Under) {
  const end = topology.chordNodes[2 * k + 1];
  const a = point(picture.positions, topology.chordNodes[2 * k]);
  if (topology.chordKind[k] === suture) return [a, point(picture.positions, end)];
  const b = point(under.positions, end).map((v, c) => v - radius * under.normals[3 * end + c]);
  return [a, b];
}

/** So many chordae are drawn as thin tubes of few sides. */
const isMany = (topology: Topology): boolean => topology.chordKind.length > 1500;

/** Radius of a chord in the picture, mm; within limits, so that thin ones are seen and thick ones hide little. */
export function drawnRadius(topology: Topology, k: number): number {
  return isMany(topology) ? 0.15 : Math.min(0.75, Math.max(0.22, 0.62 * topology.chordRadius[k]));
}

export function chordae(topology: Topology, picture: Picture, options: SceneOptions, under: Under): Mesh {
  const shapes = new Shapes();
  const many = isMany(topology);
  const onLeaflet = new Uint8Array(topology.nodes);
  for (const node of topology.triangles) onLeaflet[node] = 1;
  for (let k = 0; k < topology.chordKind.length; ++k) {
    const chosen = k === options.chosenChord;
    const radius = drawnRadius(topology, k) * (chosen ? 1.8 : 1);
    const [a, b] = chordEnds(topology, picture, k, radius, under);
    const colour = chordColour(topology, picture, options, k);
    const sides = many ? 4 : 7;
    if (isBanded(topology, options, k)) shapes.banded(a, b, radius, [tissue.artificial, colour], band, sides);
    else shapes.tube(a, b, radius, colour, sides);
    // a joint where chordae branch; on the leaflet it would show on the other side
    if (!many && onLeaflet[topology.chordNodes[2 * k + 1]] === 0)
      shapes.sphere(b, radius * 1.15, colour, 4, 6);
  }
  return shapes.mesh({ cut: true });
}

/** Opacity of a chord beyond its limit where other parts hide it. */
const behind = 0.7;

/** Chordae beyond their limit once more, through the chordae and heads that hide them from below; null if all are within their limits. */
export function beyondAll(
  topology: Topology,
  picture: Picture,
  { load, chosenChord }: SceneOptions,
  under: Under,
): Mesh | null {
  const shapes = new Shapes();
  load?.forEach((share, k) => {
    if (share <= 1 || k === chosenChord || topology.chordKind[k] === suture) return;
    const radius = drawnRadius(topology, k);
    const [a, b] = chordEnds(topology, picture, k, radius, under);
    shapes.tube(a, b, radius, tissue.over, isMany(topology) ? 4 : 7);
  });
  if (shapes.isEmpty()) return null;
  return { ...shapes.mesh({ cut: true, overlay: true, opacity: behind }), fromBelow: true };
}

/** The chosen chord once more, through whatever hides it. */
export function throughAll(topology: Topology, picture: Picture, k: number, under: Under): Mesh {
  const shapes = new Shapes();
  const [a, b] = chordEnds(topology, picture, k, 0.35, under);
  shapes.tube(a, b, 0.35, tissue.chosen);
  return shapes.mesh({ overlay: true, opacity: 0.55 });
}
