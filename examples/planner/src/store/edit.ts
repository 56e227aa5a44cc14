// The operation in the form and its preview. The shape of a preview is shown before its figures are known. A newer
// value does not interrupt the shape of an older one unless that takes long: the picture then follows a slider.
import { batch } from '@preact/signals';
import { titlesOf } from '../notable';
import { say, t } from '../text/texts';
import type { FieldValue, Shown } from '../protocol';
import { rangeFault } from './bounds';
import { cancel, complete as addFigures, fail, isCancelled, request, sentenceOf, show } from './requests';
import { sayPreview } from './result';
import * as state from './state';
import { warnOfStep } from './warnings';

/** ms for which a newer value waits for the shape of an older one. */
const patience = 250;

/** The preview that the worker calculates. */
let under: { id: number; draft: state.Draft; shaped: boolean } | null = null;
let timer = 0;

/** Begins or changes an operation; its preview follows. */
export function edit(kind: string, fields: Record<string, FieldValue>): void {
  batch(() => {
    state.draft.value = { kind, fields };
    state.early.value = false;
    state.panel.value = 'repair';
    state.motion.value = null;
    state.openness.value = 1;
    state.tool.value = 'look';
  });
  refresh();
}

/** Fields that a list of points replaces; the library takes either. */
export const replacements: Record<string, { points: string; instead: string[] }> = {
  resect: { points: 'outline', instead: ['scallop', 'position', 'width', 'base_width', 'depth'] },
  ring: { points: 'curve', instead: ['size', 'ap_ratio', 'saddle'] },
};

/** Length without pull of a chord of the plan, mm: where a change of it begins. Not rounded: that would be a change already. */
export function presentLength(id: string): number {
  return state.main.value!.figures.chords.find((item) => item.id === id)!.rest;
}

/** Sets a field; a chord that answers the form is chosen in the picture as well, and its length is the present one. */
export function setField(name: string, value: FieldValue | undefined): void {
  const now = state.draft.value;
  // a number that was typed is taken by Enter, by leaving its field and after a pause: the form changes once
  if (!now || (typeof value === 'number' && now.fields[name] === value)) return;
  const fields = { ...now.fields };
  const shape = replacements[now.kind];
  if (shape?.points === name) for (const other of shape.instead) delete fields[other];
  else if (shape?.instead.includes(name)) delete fields[shape.points];
  if (value === undefined) delete fields[name];
  else fields[name] = value;
  if (state.picking.value === name) state.picking.value = null;
  if (name === 'chord' && typeof value === 'string') {
    state.choice.value = { kind: 'chord', id: value };
    if (now.kind === 'chord_length' && fields.factor === undefined) fields.length = presentLength(value);
  }
  edit(now.kind, fields);
}

/** Lets the next click in the picture fill a field. The valve before the operation is shown to click on. */
export function pickField(name: string | null): void {
  state.picking.value = name;
  if (name) leavePreview();
  else refresh();
}

/** Whether a draft has all that it needs for a preview. */
export function complete(kind: string, fields: Record<string, FieldValue>): boolean {
  const info = state.operationOf(kind);
  if (!info) return false;
  if (info.fields.some((field) => field.required && fields[field.name] === undefined)) return false;
  if (kind === 'chord_length') return fields.length !== undefined || fields.factor !== undefined;
  if (kind === 'ring') return fields.size !== undefined || fields.curve !== undefined;
  if (kind === 'band') return fields.length !== undefined || fields.factor !== undefined;
  if (kind === 'chord_transfer') return fields.site !== undefined || fields.head !== undefined;
  return true;
}

/** Ends the preview that is shown or calculated; the form stays. */
function leavePreview(): void {
  window.clearTimeout(timer);
  timer = 0;
  if (under) cancel(under.id);
  const busy = !!under;
  under = null;
  batch(() => {
    state.preview.value = null;
    state.previewed.value = null;
    state.draftMessage.value = '';
    state.pending.value = false;
    if (busy) state.busy.value = null;
  });
}

/** Calculates the preview of the form, at once or as soon as the shape before it is shown. */
function refresh(): void {
  const draft = state.draft.value;
  if (!draft || !complete(draft.kind, draft.fields)) return leavePreview();
  const fault = rangeFault(draft);
  if (fault) {
    leavePreview();
    return refuse(draft, fault);
  }
  state.pending.value = true;
  if (!under || under.shaped) return void calculate(draft);
  timer ||= window.setTimeout(next, patience);
}

/** Goes on with the newest form. */
function next(): void {
  window.clearTimeout(timer);
  timer = 0;
  const draft = state.draft.value;
  if (draft && draft !== under?.draft) void calculate(draft);
}

async function calculate(draft: state.Draft): Promise<void> {
  if (under) cancel(under.id);
  const call = request('preview', draft, {
    share: (share) => {
      if (call.id === under?.id) state.busy.value = { text: t.previewing, share };
    },
    stage: (shown) => {
      if (call.id !== under?.id) return;
      under.shaped = true;
      reveal(draft, shown);
      if (timer) next();
    },
  });
  under = { id: call.id, draft, shaped: false };
  state.busy.value = { text: t.previewing, share: 0 };
  try {
    const shown = await call;
    if (call.id === under?.id) reveal(draft, shown);
  } catch (error) {
    if (call.id === under?.id && !isCancelled(error)) refuse(draft, sentenceOf(error));
  } finally {
    if (call.id === under?.id) ended();
  }
}

/** Nothing is calculated any more, unless the form has changed in the meantime. */
function ended(): void {
  under = null;
  if (timer) return next();
  batch(() => {
    state.pending.value = false;
    state.busy.value = null;
  });
}

function reveal(draft: state.Draft, shown: Shown): void {
  const before = state.preview.value;
  // the last figures come with the picture of the orifice again: it need not be drawn twice
  const same = before?.figures.hash === shown.figures.hash && before.figures.known === 'orifice';
  batch(() => {
    state.preview.value = same ? { ...shown, picture: before.picture } : shown;
    state.previewed.value = draft;
    state.draftMessage.value = '';
    if (shown.figures.known === 'shape') state.busy.value = null;
    else if (shown.figures.known === 'all') sayPreview(shown.figures);
  });
}

function refuse(draft: state.Draft, sentence: string): void {
  batch(() => {
    state.preview.value = null;
    state.previewed.value = draft;
    state.draftMessage.value = sentence;
    state.status.value = sentence;
  });
}

/**
 * Applies the operation of the form, whose preview the picture shows: before it does, nothing is applied, and the status line
 * says so. Figures that are still to come follow on the valve of the plan.
 */
export async function apply(): Promise<void> {
  const draft = state.draft.value;
  if (!draft || state.draftMessage.value) return;
  const shown = state.preview.value;
  if (!shown || state.outdated.value) {
    if (!state.pending.value) refresh();
    if (state.pending.value) [state.early.value, state.status.value] = [true, t.notSeen];
    return;
  }
  if (under) cancel(under.id);
  under = null;
  const accepted = request('accept', { has: shown.figures.known }, { stage: addFigures });
  batch(() => {
    state.pending.value = false;
    state.busy.value = null;
    show(shown, false, say(titlesOf(shown.figures).at(-1) ?? ''));
    state.changed.value = true;
    warnOfStep(shown);
  });
  try {
    const last = await accepted;
    if (last) addFigures(last);
  } catch (error) {
    fail(error);
  }
}

/** Leaves the form without a change. */
export function discard(): void {
  leavePreview();
  batch(() => {
    state.draft.value = null;
    state.picking.value = null;
    // it was about the form
    state.status.value = '';
  });
  void request('discard', null).catch(fail);
}
