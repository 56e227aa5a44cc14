// The valve that the page shows, be it that of the plan, a preview, the valve before, or one in motion: its frame and
// size, and its meshes with their labels and leak.
import { chordValue, leakPlaces, shareOfLimit } from '../notable';
import type { Fields, Picture, Topology } from '../protocol';
import * as state from '../store/state';
import { clipNames, clipParts } from './clips';
import { isChordMap } from './colours';
import { cutMeshes } from './cut';
import { ringRadius } from './heart';
import { atrialSide, ventricularSide } from './leaflets';
import { point, type Mesh } from './mesh';
import type { CutPlane } from './renderer';
import { sceneMeshes } from './scene';

/** Rows: origin in mm, AP, CC, into the atrium. */
export function shownFrame(): number[] {
  return (
    (state.preview.value ?? state.resting.value)?.figures.frame ?? state.motion.value?.frame ?? guessedFrame()
  );
}

/** Frame of a picture that has no figures yet: centre and normal of the annulus. */
function guessedFrame(): number[] {
  const picture = state.picture.value;
  const topology = picture && state.topologyOf(picture);
  if (!picture || !topology) return [0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1];
  const centre = [0, 0, 0];
  for (const node of topology.annulus)
    for (let c = 0; c < 3; ++c) centre[c] += picture.positions[3 * node + c] / topology.annulus.length;
  return [...centre, 0, 1, 0, -1, 0, 0, 0, 0, 1];
}

/** The outline of the annulus as it is drawn, with a ring on it, mm. */
export function rimOf(picture: Picture): number[][] {
  const places = annulusOf(picture);
  const middle = [0, 1, 2].map((c) => places.reduce((sum, at) => sum + at[c] / places.length, 0));
  return places.map((at) => {
    const away = at.map((v, c) => v - middle[c]);
    const share = ringRadius / Math.hypot(...away);
    return at.map((v, c) => v + share * away[c]);
  });
}

/** The places of the annulus, mm. */
export function annulusOf(picture: Picture): number[][] {
  const topology = state.topologyOf(picture);
  return Array.from(topology?.annulus ?? [], (node) => point(picture.positions, node));
}

/** Radius of the annulus about the origin of a frame, mm: of the larger one of the valve and its preview. */
export function shownRadius(frame: number[]): number {
  const picture = state.resting.value?.picture ?? state.picture.value;
  const places = [picture, state.preview.value?.picture].flatMap((one) => (one ? annulusOf(one) : []));
  if (!places.length) return 20;
  return Math.max(5, ...places.map((at) => Math.hypot(...at.map((v, c) => v - frame[c]))));
}

/** Values per node of the valve that is shown at rest. */
export function shownFields(): Fields | null {
  return state.motion.value ? null : (state.figures.value?.fields ?? null);
}

/** Fields of the resting valve of which a moving picture is: without the sides of its leaflets a sealed valve would show daylight
 *  between them while tissue is pushed. */
function fieldsBefore(picture: Picture): Fields | null {
  const resting = state.resting.value;
  return resting?.picture.topology === picture.topology ? resting.figures.fields : null;
}

/** The shown valve where a plane cuts it. */
export function sectionMeshes(
  topology: Topology,
  picture: Picture,
  plane: CutPlane,
  frame: number[],
  radius: number,
): Mesh[] {
  const upper = atrialSide(topology, picture, shownFields() ?? fieldsBefore(picture)).positions;
  const lower = ventricularSide(topology, picture);
  const closed = state.motion.value ? (state.resting.value?.picture ?? null) : null;
  const sides = { middle: picture.positions, upper, lower };
  const clips = () => clipParts(topology, picture, frame, clipTurns(topology));
  return cutMeshes(topology, picture, sides, plane, frame, radius, closed, clips);
}

/** The meshes of the valve; an empty list before the first valve. */
export function valveMeshes(frame: number[]): Mesh[] {
  const picture = state.picture.value;
  const topology = picture && state.topologyOf(picture);
  if (!picture || !topology) return [];
  const shown = state.motion.value ? null : state.shown.value;
  const figures = shown?.figures ?? null;
  const choice = state.choice.value;
  const chord = state.added.value?.id ?? (choice?.kind === 'chord' ? choice.id : '');
  const map = shown ? state.map.value : 'tissue';
  return sceneMeshes(topology, picture, {
    map,
    fields: shownFields(),
    sides: shownFields() ?? fieldsBefore(picture),
    distance: map === 'distance' ? distances() : null,
    frame,
    load: figures ? Float32Array.from(figures.chords, shareOfLimit) : null,
    chordValues:
      figures && isChordMap(map)
        ? Float32Array.from(figures.chords, (chord) => chordValue(map, chord))
        : null,
    chosenChord: topology.chords.findIndex((part) => part.id === chord),
    chosenHead: choice?.kind === 'head' ? topology.heads.findIndex((part) => part.id === choice.id) : -1,
    chordsOn: state.chordsOn.value,
    jets: leakPlaces(figures?.orificeParts ?? []),
    clipTurns: clipTurns(topology),
    atRest: !state.motion.value,
    closed: state.motion.value ? (state.resting.value?.picture ?? null) : null,
    removed: state.chordsOn.value && shown && shown === state.preview.value ? removedChords(topology) : [],
  });
}

/** Turns of the clips of the shown valve, as its plan says; a clip from before the plan is drawn across the edge. */
function clipTurns(topology: Topology): Map<string, number> {
  const figures = (state.shown.value ?? state.resting.value)?.figures;
  const turns = new Map(figures?.clips.map(({ name, angle }) => [name, angle]));
  return new Map([...clipNames(topology)].map((name) => [name, turns.get(name) ?? 0]));
}

/** Ends of the chordae that the preview takes away, in the valve before. */
function removedChords(topology: Topology): [number[], number[]][] {
  const before = state.main.value?.picture;
  const old = before && state.topologyOf(before);
  if (!old || old === topology) return [];
  const kept = new Set(topology.chords.map((part) => part.id));
  const at = (node: number) => [...before.positions.subarray(3 * node, 3 * node + 3)];
  return old.chords.flatMap((part, k): [number[], number[]][] =>
    kept.has(part.id) ? [] : [[at(old.chordNodes[2 * k]), at(old.chordNodes[2 * k + 1])]],
  );
}

/** Distance of each node from its place in the valve before, matched by origin. */
function distances(): Float32Array | null {
  const now = state.shown.value?.picture;
  const then = (state.compared.value ?? (state.preview.value ? state.main.value : state.first.value))
    ?.picture;
  const [a, b] = [now && state.topologyOf(now), then && state.topologyOf(then)];
  if (!now || !then || !a || !b) return null;
  const rows = new Map<number, number>();
  b.origin.forEach((origin, row) => rows.set(origin, row));
  return Float32Array.from(a.origin, (origin, i) => {
    const j = origin === 0xffffffff ? undefined : rows.get(origin);
    if (j === undefined) return NaN;
    let sum = 0;
    for (let c = 0; c < 3; ++c) sum += (now.positions[3 * i + c] - then.positions[3 * j + c]) ** 2;
    return Math.sqrt(sum);
  });
}
