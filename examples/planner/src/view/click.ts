// A click in the picture: chooses a part, answers the question of the form, adds a point to an outline, or marks a
// point of an imported surface.
import * as state from '../store/state';
import type { FieldInfo, Topology } from '../protocol';
import { importTexts } from '../text/texts';
import { setField } from '../store/edit';
import { fillField } from './answer';
import type { Place } from './drags';
import { beforePreview } from './before';
import { addOutlinePoint } from './outline';
import { pickSurface, type Hit } from './pick';
import type { Viewport } from './viewport';

/** Whether a field of the form is answered by a click on what the leaflets hide. */
export function hidesFromAtrium(field: string): boolean {
  const kind = state.draft.peek()?.kind;
  const info = state.operations.peek().find((operation) => operation.name === kind);
  return ['chord', 'head'].includes(info?.fields.find(({ name }) => name === field)?.type ?? '');
}

/** The most points of each kind; the oldest gives way. */
const most = { annulus: 200, commissures: 2, anterior: 1, tips: 12 };

/** Marks a point on the surface of an import. Papillary tips stand below it: a click beside the surface sets one at
 *  the depth of the middle of the surface, see `tipAt`. */
function markImport(view: Viewport, imported: state.Imported, p: Place): void {
  const { camera, width, height } = view;
  camera.update();
  const { positions, index } = view.surface!;
  const placeAt = (x: number, y: number) =>
    pickSurface(camera, { triangles: index }, positions, x, y, width, height, null)?.at ?? null;
  const kind = state.importing.value;
  const at = placeAt(p.x, p.y) ?? (kind === 'tips' ? tipAt(view, p) : nearby(p, placeAt));
  if (!at) {
    state.status.value = importTexts.beside;
    state.notice.value = { kind: 'info', text: importTexts.beside };
    return;
  }
  if (state.notice.value?.text === importTexts.beside) state.notice.value = null;
  const points = [...imported.points[kind], at].slice(-most[kind]);
  state.imported.value = { ...imported, points: { ...imported.points, [kind]: points } };
}

/** Pixels beside the surface at which a click still means its rim. */
const besideRim = 10;

/** A place of the surface beside a pixel; null if the surface is out of reach. */
function nearby(p: Place, placeAt: (x: number, y: number) => number[] | null): number[] | null {
  for (let k = 0; k < 8; ++k) {
    const [x, y] = [Math.cos((k * Math.PI) / 4), Math.sin((k * Math.PI) / 4)];
    const at = placeAt(p.x + besideRim * x, p.y + besideRim * y);
    if (at) return at;
  }
  return null;
}

/** The place of the pointer in the plane through the target of the camera, which is the middle of the surface. */
function tipAt(view: Viewport, p: Place): number[] {
  const { camera } = view;
  const { origin, direction } = camera.ray(p.x, p.y, view.width, view.height);
  const forward = camera.target.clone().sub(origin);
  const depth = forward.lengthSq() / forward.dot(direction);
  const at = origin.addScaledVector(direction, depth);
  return [at.x, at.y, at.z];
}

function choiceOf(hit: Hit, topology: Topology): state.Choice | null {
  if (hit.part === 'head') return { kind: 'head', id: topology.heads[hit.head].id };
  if (hit.part === 'chord') return { kind: 'chord', id: topology.chords[hit.chord].id };
  if (!hit.surface) return null;
  return { kind: 'scallop', id: topology.scallops[topology.triangleScallop[hit.surface.triangle]].id };
}

/** Chooses a part; the panel "Repair" lists the operations on it. */
function choose(choice: state.Choice | null): void {
  state.choice.value = choice;
  if (choice && state.panel.value !== 'import') state.panel.value = 'repair';
}

export function click(view: Viewport, p: Place, hit: Hit | null): void {
  const surface = state.surface.value;
  if (surface && view.surface) return markImport(view, surface, p);
  const picture = state.picture.value;
  const topology = picture && state.topologyOf(picture);
  if (!hit || !topology || state.motion.value) return;
  const { picking } = state;
  if (picking.value === 'outline') return addOutlinePoint(hit);
  if (picking.value) return fillField(hit, picking.value);
  if (answer(hit, topology)) return;
  choose(choiceOf(hit, topology));
}

/** The hit part that fits a field of one of these types that the form of the moment requires. */
function answerOf(hit: Hit, topology: Topology, asks: FieldInfo[]): { field: FieldInfo; id: string } | null {
  const take = (type: string, parts: { id: string }[], index: number) => {
    const field = asks.find((candidate) => candidate.type === type);
    return field && index >= 0 ? { field, id: parts[index].id } : null;
  };
  const head = take('head', topology.heads, hit.head);
  // a form without a chord takes a head from beside it, even where a chord is nearer
  return (hit.part === 'head' ? head : null) ?? take('chord', topology.chords, hit.chord) ?? head;
}

/**
 * A chord, a head or a place on a leaflet that is clicked while a form requires one is the one of the form, even if it
 * has another already.
 */
function answer(hit: Hit, topology: Topology): boolean {
  const draft = state.draft.value;
  const before = state.topologyOf(state.main.value!.picture);
  const info = state.operationOf(draft?.kind);
  const asks = info?.fields.filter((candidate) => candidate.required) ?? [];
  if (!draft || !before) return false;
  const part = answerOf(hit, topology, asks);
  if (part) {
    // a chord that the preview has added is no part of the valve
    const known = part.field.type === 'chord' ? before.chords : before.heads;
    if (!known.some(({ id }) => id === part.id)) return false;
    if (draft.fields[part.field.name] !== part.id) setField(part.field.name, part.id);
    return true;
  }
  const site = asks.find((candidate) => candidate.type === 'site');
  const there = hit.surface && hit.part !== 'head' && beforePreview(hit.surface);
  if (!site || !there) return false;
  fillField({ ...hit, surface: there }, site.name);
  return true;
}
