// The outline of a resection that is drawn by clicks on a leaflet. It has to begin and end on the free edge, which
// closed leaflets hide: its ends are led to the nearest node of the free edge of that leaflet.
import * as state from '../store/state';
import { edit, pickField } from '../store/edit';
import type { Topology } from '../protocol';
import type { Hit } from './pick';

/** The leaflet of the outline: that of its first point. */
let leaflet = -1;

export function beginOutline(): void {
  leaflet = -1;
  state.outline.value = [];
  edit('resect', {});
  pickField('outline');
}

/** The next point; clicks on the other leaflet are ignored. */
export function addOutlinePoint(hit: Hit): void {
  const picture = state.main.value?.picture;
  const topology = picture && state.topologyOf(picture);
  if (!hit.surface || !topology) return;
  const of = topology.triangleLeaflet[hit.surface.triangle];
  if (!state.outline.value.length) leaflet = of;
  if (of === leaflet) state.outline.value = [...state.outline.value, [...hit.surface.at]];
}

/** The node of the free edge of the leaflet that is nearest to a point. */
function onFreeEdge(topology: Topology, x: Float32Array, at: number[]): number[] {
  const own = new Uint8Array(topology.nodes);
  for (let i = 0; i < topology.triangles.length; ++i)
    if (topology.triangleLeaflet[Math.floor(i / 3)] === leaflet) own[topology.triangles[i]] = 1;
  const place = (node: number) => [x[3 * node], x[3 * node + 1], x[3 * node + 2]];
  const away = (node: number) => Math.hypot(...place(node).map((v, c) => v - at[c]));
  const edge = Array.from(topology.freeEdge).filter((node) => own[node]);
  return edge.length ? place(edge.reduce((a, b) => (away(a) <= away(b) ? a : b))) : at;
}

/** The clicked points with their ways to the free edge. */
export function wholeOutline(): number[][] {
  const points = state.outline.value;
  const picture = state.main.value?.picture;
  const topology = picture && state.topologyOf(picture);
  if (!points.length || !topology) return points;
  const edge = (at: number[]) => onFreeEdge(topology, picture.positions, at);
  return [edge(points[0]), ...points, edge(points[points.length - 1])];
}

/** Takes the outline into the form; its preview follows. */
export function useOutline(): void {
  const outline = wholeOutline();
  state.picking.value = null;
  edit('resect', { outline });
}
