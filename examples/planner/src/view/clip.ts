// The place of the clip of the form in the picture: on the free edge of its two scallops, at its position between
// their ends. Positions grow along the CC axis, as in the library.
import * as state from '../store/state';
import type { Topology } from '../protocol';

export interface ClipPlace {
  at: number[];
  position: number;
  /** Half the width of the scallops along the CC axis, mm. */
  half: number;
}

/** The free edge of a scallop: nodes and their coordinates along the CC axis. */
function edgeOf(topology: Topology, scallop: number): number[] {
  const own = new Set<number>();
  for (let i = 0; i < topology.triangles.length; ++i)
    if (topology.triangleScallop[Math.floor(i / 3)] === scallop) own.add(topology.triangles[i]);
  return Array.from(topology.freeEdge).filter((node) => own.has(node));
}

function scallopOf(topology: Topology, id: unknown, fallback: string): number {
  const k = topology.scallops.findIndex((part) => part.id === id);
  return k >= 0 ? k : topology.scallops.findIndex((part) => part.name === fallback);
}

/** Where the clip is while its form is open; null without such a form. */
export function clipPlace(): ClipPlace | null {
  const draft = state.draft.value;
  const picture = state.picture.value;
  const topology = picture && state.topologyOf(picture);
  const frame = state.figures.value?.frame;
  if (draft?.kind !== 'clip' || !picture || !topology || !frame) return null;
  const x = picture.positions;
  const cc = (node: number) =>
    [0, 1, 2].reduce((sum, c) => sum + (x[3 * node + c] - frame[c]) * frame[6 + c], 0);
  const sides = [
    edgeOf(topology, scallopOf(topology, draft.fields.anterior, 'A2')),
    edgeOf(topology, scallopOf(topology, draft.fields.posterior, 'P2')),
  ];
  if (sides.some((nodes) => !nodes.length)) return null;
  const position = typeof draft.fields.position === 'number' ? draft.fields.position : 0;
  const at = [0, 0, 0];
  let half = 0;
  for (const nodes of sides) {
    const places = nodes.map(cc);
    const [low, high] = [Math.min(...places), Math.max(...places)];
    const wanted = 0.5 * (low + high) + 0.5 * position * (high - low);
    const nearest = nodes.reduce((a, b) => (Math.abs(cc(a) - wanted) <= Math.abs(cc(b) - wanted) ? a : b));
    for (let c = 0; c < 3; ++c) at[c] += 0.5 * x[3 * nearest + c];
    half += 0.25 * (high - low);
  }
  return { at, position, half: Math.max(half, 1) };
}
