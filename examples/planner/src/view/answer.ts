// A click in the picture as the answer to a question of the form.
import { edit, setField } from '../store/edit';
import * as state from '../store/state';
import type { Hit } from './pick';

/** A click answers the question of the form: which head, chord, scallop or place. */
export function fillField(hit: Hit, name: string): void {
  const draft = state.draft.value;
  const picture = state.main.value?.picture;
  const topology = picture && state.topologyOf(picture);
  const info = state.operationOf(draft?.kind);
  const field = info?.fields.find((candidate) => candidate.name === name);
  if (!draft || !topology || !field || !picture) return;
  if (field.type === 'head' && hit.head >= 0) setField(name, topology.heads[hit.head].id);
  else if (field.type === 'chord' && hit.chord >= 0) setField(name, topology.chords[hit.chord].id);
  else if (field.type === 'scallop' && hit.surface)
    setField(name, topology.scallops[topology.triangleScallop[hit.surface.triangle]].id);
  else if (field.type === 'site' && hit.surface) fillSite(name, hit);
  else return;
  state.picking.value = null;
}

/** A place on the leaflet; the papillary head is the nearer one unless it was chosen before. */
function fillSite(name: string, hit: Hit): void {
  const draft = state.draft.value!;
  const picture = state.main.value!.picture;
  const topology = state.topologyOf(picture)!;
  const { triangle, u, at } = hit.surface!;
  const fields = { ...draft.fields, [name]: { triangle, u } };
  const info = state.operationOf(draft.kind);
  const head = info?.fields.find((field) => field.type === 'head' && field.required);
  if (head && fields[head.name] === undefined) {
    const range = (node: number) =>
      Math.hypot(...[0, 1, 2].map((c) => picture.positions[3 * node + c] - at[c]));
    const order = [...topology.headNodes.keys()].sort(
      (i, j) => range(topology.headNodes[i]) - range(topology.headNodes[j]),
    );
    if (order.length) fields[head.name] = topology.heads[order[0]].id;
  }
  edit(draft.kind, fields);
}
