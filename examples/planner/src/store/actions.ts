// Actions of buttons, keys and the pointer.
import { batch } from '@preact/signals';
import { say, t } from '../text/texts';
import type { CallName, Calls, FieldValue, Shown } from '../protocol';
import { CallError, Client, type CallOptions } from './client';
import * as state from './state';

let client: Client;

export function connect(): Client {
  client = new Client((sentence) => (state.broken.value = sentence));
  return client;
}

export function request<Name extends CallName>(
  name: Name,
  argument: Calls[Name]['argument'],
  options: CallOptions = {},
): Promise<Calls[Name]['result']> & { id: number } {
  return client.call(name, argument, options);
}

export const tell = (name: CallName, argument: unknown): void => client.tell(name, argument);

/** Runs a request with a line of progress; failures become a notice. */
export async function run<Name extends CallName>(
  text: string,
  name: Name,
  argument: Calls[Name]['argument'],
  options: CallOptions = {},
): Promise<Calls[Name]['result'] | null> {
  const call = request(name, argument, {
    ...options,
    share: (share) => {
      if (state.busy.value) state.busy.value = { ...state.busy.value, share };
    },
  });
  state.busy.value = { text, share: 0, cancel: () => client.cancel(call.id) };
  try {
    return await call;
  } catch (error) {
    fail(error);
    return null;
  } finally {
    state.busy.value = null;
  }
}

export function fail(error: unknown): void {
  if (error instanceof CallError && error.cancelled) return;
  state.notice.value = { kind: 'error', text: say(error instanceof Error ? error.message : String(error)) };
}

/** Shows a valve as that of the plan. */
export function show(shown: Shown, fresh: boolean): void {
  state.receive(shown.picture);
  batch(() => {
    state.main.value = shown;
    state.preview.value = null;
    state.motion.value = null;
    state.openness.value = 1;
    state.draft.value = null;
    state.draftMessage.value = '';
    state.picking.value = null;
    if (fresh) {
      state.first.value = shown;
      state.choice.value = null;
      state.checkpoints.value = [];
      state.compared.value = null;
      state.compareWith.value = null;
      state.cost.value = null;
      state.spread.value = null;
    }
    state.status.value = t.statusLine(shown.figures);
  });
}

function begun(shown: Shown | null, title: string): void {
  if (!shown) return;
  state.imported.value = null;
  show(shown, true);
  state.title.value = title;
  state.notes.value = '';
  state.changed.value = false;
}

export async function openShipped(name: string, title: string, vertices = 425): Promise<void> {
  const shown = await run(
    t.closing,
    'open_shipped',
    { name, vertices },
    {
      motion: (motion) => {
        state.receive(motion.picture);
        state.motion.value = motion;
      },
    },
  );
  begun(shown, title);
}

export async function openFile(file: File): Promise<void> {
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (/\.mvsplan$|\.zip$/i.test(file.name)) return openSession(bytes);
  const head = new TextDecoder().decode(bytes.subarray(0, 4000));
  if (/\.obj$/i.test(file.name) && /^#mvs|^# ?mvs|mvs:/m.test(head)) {
    begun(await run(t.closing, 'open_file', { name: file.name, bytes }), file.name.replace(/\.obj$/i, ''));
    return;
  }
  if (/\.(stl|ply|obj|off|vtp|vtk)$/i.test(file.name)) return beginImport(file.name, bytes);
  state.notice.value = { kind: 'error', text: t.unknownFile(file.name) };
}

/** Shows a surface to build a valve from. The unit is asked for because most files do not state it. */
export async function beginImport(name: string, bytes: Uint8Array, unit = 'mm'): Promise<void> {
  const surface = await run(t.reading, 'read_surface', { name, bytes: bytes.slice(), unit });
  if (!surface) return;
  discard();
  batch(() => {
    state.imported.value = {
      name,
      bytes,
      unit,
      surface,
      points: { annulus: [], commissures: [], anterior: [] },
      findings: [],
    };
    state.panel.value = 'import';
    state.status.value = t.importBegun(surface.triangles.length / 3);
  });
}

/** Builds a valve from the surface and closes it. */
export async function buildValve(): Promise<void> {
  const from = state.imported.value;
  if (!from) return;
  const title = from.name.replace(/\.\w+$/, '');
  const built = await run(t.building, 'build', { ...from.points, tips: [], name: title });
  if (!built) return;
  begun(built.shown, title);
  state.imported.value = { ...from, findings: built.findings };
  state.panel.value = 'import';
}

export async function openSession(bytes: Uint8Array): Promise<void> {
  const opened = await run(t.replaying, 'open_session', { bytes });
  if (!opened) return;
  show(opened.shown, true);
  state.first.value = null;
  state.checkpoints.value = opened.checkpoints;
  state.title.value = opened.title;
  state.notes.value = opened.notes;
  state.changed.value = false;
  state.notice.value = opened.sameResult
    ? { kind: 'info', text: t.sessionOpened }
    : { kind: 'error', text: t.sessionDiffers };
}

let draftCall = 0;
let timer = 0;

/** Begins or changes an operation; its preview follows. */
export function edit(kind: string, fields: Record<string, FieldValue>): void {
  batch(() => {
    state.draft.value = { kind, fields };
    state.pending.value = true;
    state.panel.value = 'repair';
    state.motion.value = null;
    state.openness.value = 1;
    state.tool.value = 'look';
  });
  window.clearTimeout(timer);
  timer = window.setTimeout(() => void refresh(), 120);
}

export function setField(name: string, value: FieldValue | undefined): void {
  const now = state.draft.value;
  if (!now) return;
  const fields = { ...now.fields };
  if (value === undefined) delete fields[name];
  else fields[name] = value;
  if (state.picking.value === name) state.picking.value = null;
  edit(now.kind, fields);
}

/** Whether a draft has all that it needs for a preview. */
export function complete(kind: string, fields: Record<string, FieldValue>): boolean {
  const info = state.operations.value.find((operation) => operation.name === kind);
  if (!info) return false;
  if (info.fields.some((field) => field.required && fields[field.name] === undefined)) return false;
  if (kind === 'chord_length') return fields.length !== undefined || fields.factor !== undefined;
  if (kind === 'ring') return fields.size !== undefined;
  if (kind === 'band') return fields.length !== undefined || fields.factor !== undefined;
  if (kind === 'chord_transfer') return fields.site !== undefined || fields.head !== undefined;
  return true;
}

async function refresh(): Promise<void> {
  const draft = state.draft.value;
  if (draftCall) client.cancel(draftCall);
  draftCall = 0;
  if (!draft || !complete(draft.kind, draft.fields)) {
    batch(() => {
      state.preview.value = null;
      state.draftMessage.value = '';
      state.pending.value = false;
      state.busy.value = null;
    });
    return;
  }
  const call = request('preview', draft, {
    share: (share) => {
      if (call.id === draftCall) state.busy.value = { text: t.previewing, share };
    },
  });
  draftCall = call.id;
  state.busy.value = { text: t.previewing, share: 0 };
  try {
    const shown = await call;
    if (call.id !== draftCall) return;
    state.receive(shown.picture);
    batch(() => {
      state.preview.value = shown;
      state.draftMessage.value = '';
      state.status.value = t.previewLine(shown.figures);
    });
  } catch (error) {
    if (call.id !== draftCall || (error instanceof CallError && error.cancelled)) return;
    batch(() => {
      state.preview.value = null;
      state.draftMessage.value = say(error instanceof Error ? error.message : String(error));
      state.status.value = state.draftMessage.value;
    });
  } finally {
    if (call.id === draftCall) {
      draftCall = 0;
      state.pending.value = false;
      state.busy.value = null;
    }
  }
}

/** Applies the operation of the form. */
export async function apply(): Promise<void> {
  if (!state.preview.value) return;
  const shown = await run(t.applying, 'accept', null);
  if (!shown) return;
  show(shown, false);
  state.changed.value = true;
}

/** Leaves the form without a change. */
export function discard(): void {
  window.clearTimeout(timer);
  if (draftCall) client.cancel(draftCall);
  draftCall = 0;
  batch(() => {
    state.draft.value = null;
    state.preview.value = null;
    state.draftMessage.value = '';
    state.picking.value = null;
    state.pending.value = false;
    state.busy.value = null;
  });
  void request('discard', null).catch(fail);
}

export async function undo(): Promise<void> {
  if (state.draft.value) return discard();
  if (!state.canUndo.value) return;
  const shown = await run(t.undoing, 'undo', null);
  if (shown) show(shown, false);
  state.changed.value = true;
}

export async function redo(): Promise<void> {
  if (!state.canRedo.value) return;
  const shown = await run(t.redoing, 'redo', null);
  if (shown) show(shown, false);
  state.changed.value = true;
}

let openingCall = 0;
let wanted: number | null = null;

/** The slider between open and closed; only the latest position is calculated. */
export async function openTo(share: number): Promise<void> {
  state.openness.value = share;
  wanted = share;
  if (openingCall) return;
  while (wanted !== null) {
    const next = wanted;
    wanted = null;
    if (next >= 1) {
      state.motion.value = null;
      continue;
    }
    const call = request('open_to', { share: next });
    openingCall = call.id;
    try {
      const motion = await call;
      state.receive(motion.picture);
      if (state.openness.value < 1) state.motion.value = motion;
    } catch (error) {
      fail(error);
    }
    openingCall = 0;
  }
}
