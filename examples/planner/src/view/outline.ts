// The outline of a resection that is drawn by clicks on a leaflet. It has to begin and end on the free edge, which
// closed leaflets hide: its ends are led to the nearest node of the free edge of that leaflet.
import { batch } from '@preact/signals';
import * as state from '../store/state';
import { edit, pickField } from '../store/edit';
import type { Topology } from '../protocol';
import { pointTexts } from '../text/texts';
import type { Hit } from './pick';

/** The leaflet of the outline: that of its first point. */
let leaflet = -1;

export function beginOutline(): void {
  leaflet = -1;
  state.outline.value = [];
  state.outlineOn.value = { leaflet: '', scallops: [] };
  state.outlineRefusal.value = '';
  edit('resect', {});
  pickField('outline');
  // the keys of the cross belong to the picture
  document.querySelector<HTMLElement>('.canvas canvas')?.focus({ preventScroll: true });
}

export function removeOutlinePoint(): void {
  const { leaflet: name, scallops } = state.outlineOn.value;
  state.outline.value = state.outline.value.slice(0, -1);
  const left = scallops.slice(0, -1);
  state.outlineOn.value = { leaflet: left.length ? name : '', scallops: left };
  state.outlineRefusal.value = '';
}

/** The next point. A cut is in one leaflet: a click on another one sets none, and the form says so. */
export function addOutlinePoint(hit: Hit): void {
  const picture = state.main.value?.picture;
  const topology = picture && state.topologyOf(picture);
  if (!hit.surface || !topology) return;
  const { triangle, at } = hit.surface;
  const of = topology.triangleLeaflet[triangle];
  const scallop = topology.scallops[topology.triangleScallop[triangle]].name;
  const { value: on } = state.outlineOn;
  if (!state.outline.value.length) leaflet = of;
  else if (of !== leaflet) {
    state.outlineRefusal.value = pointTexts.otherLeaflet(scallop, on.leaflet);
    state.status.value = state.outlineRefusal.value;
    return;
  }
  batch(() => {
    state.outlineRefusal.value = '';
    state.outline.value = [...state.outline.value, [...at]];
    state.outlineOn.value = { leaflet: topology.leaflets[of].name, scallops: [...on.scallops, scallop] };
  });
}

/** Weight of the whole distance beside that along the edge. */
const beside = 0.2;

/**
 * Nodes of the free edge of the leaflet to which the ends of the cut lead: those below the ends, that is nearest along
 * the CC axis, and two different ones. The nearest in space would be the deepest of the edge for both ends.
 */
function edgeBelow(topology: Topology, x: Float32Array, frame: number[], ends: number[][]): number[][] {
  const own = new Uint8Array(topology.nodes);
  for (let i = 0; i < topology.triangles.length; ++i)
    if (topology.triangleLeaflet[Math.floor(i / 3)] === leaflet) own[topology.triangles[i]] = 1;
  const place = (node: number) => [x[3 * node], x[3 * node + 1], x[3 * node + 2]];
  const cc = (at: number[]) => at.reduce((sum, v, c) => sum + v * frame[6 + c], 0);
  const edge = Array.from(topology.freeEdge)
    .filter((node) => own[node])
    .map(place)
    .sort((a, b) => cc(a) - cc(b));
  if (edge.length < 3) return ends;
  const away = (a: number[], b: number[]) =>
    Math.abs(cc(a) - cc(b)) + beside * Math.hypot(...a.map((v, c) => v - b[c]));
  const rows = ends.map((end) =>
    edge.reduce((best, at, k) => (away(at, end) < away(edge[best], end) ? k : best), 0),
  );
  if (rows[0] === rows[1]) {
    const rising = cc(ends[0]) <= cc(ends[1]);
    rows[0] = Math.max(0, Math.min(edge.length - 1, rows[0] + (rising ? -1 : 1)));
    rows[1] = Math.max(0, Math.min(edge.length - 1, rows[1] + (rising ? 1 : -1)));
  }
  return rows.map((k) => edge[k]);
}

/** The clicked points with their ways to the free edge. */
export function wholeOutline(): number[][] {
  const points = state.outline.value;
  const shown = state.main.value;
  const topology = shown && state.topologyOf(shown.picture);
  if (!points.length || !topology) return points;
  const ends = [points[0], points[points.length - 1]];
  const [first, last] = edgeBelow(topology, shown.picture.positions, shown.figures.frame, ends);
  return [first, ...points, last];
}

/** Takes the outline into the form; its preview follows. */
export function useOutline(): void {
  const outline = wholeOutline();
  state.picking.value = null;
  state.outlineRefusal.value = '';
  edit('resect', { outline });
}
