// Clips as devices: a bar along the edge and two arms across it, turned as the clip is, each to the ventricular side of its leaflet;
// seen, and faintly through the leaflets that close over it.
import type { Picture, Topology } from '../protocol';
import { clipOf, suture } from '../notable';
import { tissue } from './colours';
import { point, Shapes } from './mesh';

/** mm: a bar as thick as the leaflets that it holds. */
const radius = 1;
/** mm from the middle of a clip to the ends of its arms as seen from the atrium. The length of arms is no part of the model: those of
 *  common clips are 9 mm long, and stand steeply in a closed clip. */
export const armReach = 4.5;
/** mm from the middle of a leaflet to an arm on its ventricular side. */
const beside = 1;
/** The steepest arm, height over reach: 9 mm long. */
const steepest = 1.7;
/** Radii of the arms in the middle and at their ends, mm. */
const armRadii = [0.9, 0.65];

/** Names of the clips of a valve. */
export const clipNames = ({ chords, chordKind }: Topology): Set<string> =>
  new Set(chords.flatMap(({ name }, k) => (chordKind[k] === suture && clipOf(name) ? [clipOf(name)] : [])));

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

/** Where a clip is: its middle, and half of the distance of its outermost stitches as seen from the atrium, mm. */
export interface ClipBody {
  middle: number[];
  half: number;
}

/** The bodies of all clips, by their names. */
export function clipBodies(topology: Topology, picture: Picture, frame: number[]): Map<string, ClipBody> {
  return new Map(
    [...stitchesOf(topology, picture)].map(([name, stitches]) => {
      const [a, b] = ends(stitches, frame.slice(9, 12));
      return [name, { middle: a.map((v, c) => 0.5 * (v + b[c])), half: 0.5 * apart(a, b) }];
    }),
  );
}

/** mm of the leaflets above a place as seen from the atrium, along `up`, by the nearest node. */
function liftAt(topology: Topology, picture: Picture, place: number[], up: number[]): number {
  let [nearest, lift] = [Infinity, 0];
  for (const node of topology.triangles) {
    const away = point(picture.positions, node).map((v, c) => v - place[c]);
    const height = away.reduce((sum, v, c) => sum + v * up[c], 0);
    const level = Math.hypot(...away.map((v, c) => v - height * up[c]));
    if (level < nearest) [nearest, lift] = [level, height];
  }
  return lift;
}

/** Devices of all clips as convex parts, the bar and both arms of each; `turns`: of each in degrees against the clock, by its name. */
export function clipParts(
  topology: Topology,
  picture: Picture,
  frame: number[],
  turns: Map<string, number>,
): Shapes[] {
  const parts: Shapes[] = [];
  const [ap, cc, up] = [frame.slice(3, 6), frame.slice(6, 9), frame.slice(9, 12)];
  for (const [name, { middle, half }] of clipBodies(topology, picture, frame)) {
    const angle = ((turns.get(name) ?? 0) * Math.PI) / 180;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const arm = ap.map((v, c) => cos * v + sin * cc[c]);
    const bar = cc.map((v, c) => cos * v - sin * ap[c]);
    const at = (along: number[], by: number) => middle.map((v, c) => v + by * along[c]);
    const body = new Shapes();
    body.tube(at(bar, -half), at(bar, half), radius, tissue.suture, 12);
    parts.push(body);
    for (const side of [-1, 1]) {
      body.tube(at(bar, side * half), at(bar, side * (half + 0.4)), radius, tissue.suture, 12, 0.02);
      const level = at(arm, side * armReach);
      const most = steepest * armReach;
      const lift = Math.min(most, Math.max(-most, liftAt(topology, picture, level, up) - beside));
      const tip = level.map((v, c) => v + lift * up[c]);
      const one = new Shapes();
      one.tube(middle, tip, armRadii[0], tissue.suture, 12, armRadii[1]);
      one.sphere(tip, armRadii[1], tissue.suture, 8, 12);
      parts.push(one);
    }
  }
  return parts;
}
