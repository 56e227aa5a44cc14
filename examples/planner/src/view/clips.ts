// Clips as devices: a bar along the stitches of each, seen, and faintly through the leaflets that close over it.
import type { Picture, Topology } from '../protocol';
import { clipOf, suture } from '../notable';
import { tissue } from './colours';
import { point, Shapes, type Mesh } from './mesh';

/** mm: a bar as thick as the two arms of a clip with the leaflets between them. */
const radius = 1;

/** Middles of the stitches of each clip, by its name. */
function stitchesOf(topology: Topology, picture: Picture): Map<string, number[][]> {
  const clips = new Map<string, number[][]>();
  topology.chords.forEach(({ name }, k) => {
    const clip = clipOf(name);
    if (!clip || topology.chordKind[k] !== suture) return;
    const [a, b] = [0, 1].map((end) => point(picture.positions, topology.chordNodes[2 * k + end]));
    clips.set(clip, [...(clips.get(clip) ?? []), a.map((v, c) => 0.5 * (v + b[c]))]);
  });
  return clips;
}

const apart = (a: number[], b: number[]): number => Math.hypot(...a.map((v, c) => v - b[c]));

/** The ends of a clip: its width is the largest distance of its stitches as seen from the atrium, `up`, at their mean depth. */
function ends(stitches: number[][], up: number[]): [number[], number[]] {
  const depth = (at: number[]) => at.reduce((sum, v, c) => sum + v * up[c], 0);
  const mean = stitches.reduce((sum, at) => sum + depth(at), 0) / stitches.length;
  const level = stitches.map((at) => at.map((v, c) => v + (mean - depth(at)) * up[c]));
  let best: [number[], number[]] = [level[0], level[0]];
  for (const a of level) for (const b of level) if (apart(a, b) > apart(...best)) best = [a, b];
  return best;
}

/** The bars of all clips, with pointed ends; null without a clip. */
export function clips(topology: Topology, picture: Picture, frame: number[]): Mesh | null {
  const found = stitchesOf(topology, picture);
  if (!found.size) return null;
  const shapes = new Shapes();
  for (const stitches of found.values()) {
    const [a, b] = ends(stitches, frame.slice(9, 12));
    const length = Math.max(1e-6, apart(a, b));
    const beyond = (from: number[], to: number[]) =>
      to.map((v, c) => v + (0.4 * radius * (v - from[c])) / length);
    shapes.tube(a, b, radius, tissue.suture, 12);
    shapes.tube(b, beyond(a, b), radius, tissue.suture, 12, 0.02);
    shapes.tube(a, beyond(b, a), radius, tissue.suture, 12, 0.02);
  }
  return shapes.mesh();
}

/** mm between the outermost stitches of each clip as seen from the atrium, by its name. */
export function clipWidths(topology: Topology, picture: Picture, frame: number[]): Map<string, number> {
  const up = frame.slice(9, 12);
  return new Map(
    [...stitchesOf(topology, picture)].map(([name, stitches]) => [name, apart(...ends(stitches, up))]),
  );
}
