// Keeping: downloads of valve and session, and the file that follows the plan.
import { effect, signal, untracked } from '@preact/signals';
import { autosave, followSurface, keepCopy, leaveCopy, rest, sessionNow } from './recovery';
import { leakNote } from './leak_range';
import { fail, run } from './requests';
import { sessionContents } from './session';
import * as state from './state';
import { t } from '../text/texts';
import { withNote } from './valve_note';

export function download(bytes: Uint8Array | Blob | string, name: string, type: string): void {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  announce(t.saved(name));
  // browsers read the blob after the click
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** Names the saved file, to the eye and to a screen reader; an offered way back stays. */
function announce(text: string): void {
  const offer = state.notice.value?.action && state.notice.value;
  state.notice.value = {
    kind: 'info',
    text: [text, offer?.text].filter(Boolean).join(' '),
    action: offer && offer.action,
  };
  state.status.value = text;
}

/** The title as the name of a file: systems refuse some signs, as a colon. */
export function fileName(): string {
  return (
    (state.title.value || 'valve')
      .replace(/[^\p{L}\p{N} _.-]+/gu, ' ')
      .replace(/\s+/g, ' ')
      .trim()
      .slice(0, 60) || 'valve'
  );
}

export async function saveObj(): Promise<void> {
  const bytes = await run(t.saving, 'save_obj', null);
  // the name of a surface that the valve was built from stays free
  if (bytes)
    download(withNote(bytes, leakNote(state.main.value!.figures)), `${fileName()} valve.obj`, 'model/obj');
}

export async function saveSession(): Promise<void> {
  const bytes = await run(t.saving, 'save_session', sessionContents());
  if (!bytes) return;
  download(bytes, `${fileName()}.mvsplan`, 'application/zip');
  state.changed.value = false;
}

const visitedKey = 'mvs-planner-1-visited';

/** Whether the page was used in this browser before; nothing about a valve is stored for it. */
export function visited(): boolean {
  try {
    const before = localStorage.getItem(visitedKey) === 'yes';
    localStorage.setItem(visitedKey, 'yes');
    return before;
  } catch {
    return false;
  }
}

/** Whether the browser can write to a file that the user chose; only Chromium can. */
export const canKeepFile = 'showSaveFilePicker' in window;
/** The name of the file that follows the plan, or nothing. */
export const keptFile = signal('');
let handle: FileSystemFileHandle | null = null;
let writing: Promise<void> = Promise.resolve();

interface SavePicker {
  showSaveFilePicker(options: {
    suggestedName: string;
    types: { description: string; accept: Record<string, string[]> }[];
  }): Promise<FileSystemFileHandle>;
}

/** Asks for a file; from then on every change of the plan is written to it. */
export async function chooseKeptFile(): Promise<void> {
  try {
    handle = await (window as unknown as SavePicker).showSaveFilePicker({
      suggestedName: `${fileName()}.mvsplan`,
      types: [{ description: t.sessionFile, accept: { 'application/zip': ['.mvsplan'] } }],
    });
  } catch (error) {
    // the user closed the dialog
    if (!(error instanceof DOMException && error.name === 'AbortError')) fail(error);
    return;
  }
  keptFile.value = handle.name;
  await writeKeptFile(sessionNow());
}

export function leaveKeptFile(): void {
  handle = null;
  keptFile.value = '';
}

/** Writes a session to the chosen file, one write after the other; the file is replaced as a whole. */
function writeKeptFile(session: Promise<Uint8Array>): Promise<void> {
  const target = handle;
  if (!target) return writing;
  writing = writing.then(async () => {
    try {
      const bytes = await session;
      const stream = await target.createWritable();
      await stream.write(bytes.slice());
      await stream.close();
      if (target === handle) state.changed.value = false;
    } catch (error) {
      if (target === handle) leaveKeptFile();
      fail(error);
    }
  });
  return writing;
}

/** The chosen file belongs to the plan it was chosen for: another plan would replace it. */
function keepFileOfPlan(): void {
  if (!handle) return;
  const { name } = handle;
  leaveKeptFile();
  // beside the notice about the plan that was opened
  queueMicrotask(() => {
    const said = state.notice.value;
    state.notice.value = {
      kind: said?.kind ?? 'info',
      text: [said?.text, t.fileLeft(name)].filter(Boolean).join(' '),
      action: said?.action,
    };
  });
}

/** Lets the copies and the chosen file follow the plan, its checkpoints and its notes, and a surface. */
export function keepFollowing(): void {
  followSurface();
  let kept: unknown[] = [state.main.value, state.checkpoints.value];
  let plan = state.plan.value;
  let unsaved = false;
  let timer = 0;
  const writeAll = () => {
    window.clearTimeout(timer);
    if (!state.main.value || !(autosave.value || handle)) return;
    const session = sessionNow();
    void keepCopy(session);
    void writeKeptFile(session);
  };
  effect(() => {
    const now = [state.main.value, state.checkpoints.value];
    const another = state.plan.value !== plan;
    plan = state.plan.value;
    if (another)
      untracked(() => {
        keepFileOfPlan();
        leaveCopy(unsaved);
      });
    if (now[0] && now.some((value, k) => value !== kept[k])) untracked(writeAll);
    kept = now;
    unsaved = state.changed.value;
  });
  let { value: notes } = state.notes;
  state.notes.subscribe((now) => {
    if (now === notes) return;
    notes = now;
    window.clearTimeout(timer);
    timer = window.setTimeout(writeAll, rest);
  });
}
