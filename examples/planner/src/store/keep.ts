// Keeping: downloads of valve and session, and the copy for recovery. Storage of a page from disk is shared by every
// page from disk, so the copy is made only where the user allows it.
import { effect, signal, untracked } from '@preact/signals';
import { openSession } from './files';
import { fail, request, run } from './requests';
import * as state from './state';
import { refusals, t } from '../text/texts';

const database = 'mvs-planner-1';
const store = 'session';
const allowedKey = 'mvs-planner-1-autosave';

export const autosave = signal(false);
export const storageWorks = signal(true);
export const recoverable = signal<{ title: string; saved: string } | null>(null);

export function download(bytes: Uint8Array | string, name: string, type: string): void {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  announce(t.saved(name));
  // browsers read the blob after the click
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** Says what was saved, to the eye and to a screen reader; an offered way back stays. */
function announce(text: string): void {
  const offer = state.notice.value?.action && state.notice.value;
  state.notice.value = {
    kind: 'info',
    text: [text, offer?.text].filter(Boolean).join(' '),
    action: offer && offer.action,
  };
  state.status.value = text;
}

function fileName(): string {
  return (
    (state.title.value || 'valve')
      .replace(/[^\p{L}\p{N} _.-]+/gu, ' ')
      .trim()
      .slice(0, 60) || 'valve'
  );
}

export async function saveObj(): Promise<void> {
  const bytes = await run(t.saving, 'save_obj', null);
  if (bytes) download(bytes, `${fileName()}.obj`, 'model/obj');
}

export async function saveSession(): Promise<void> {
  const bytes = await run(t.saving, 'save_session', { title: state.title.value, notes: state.notes.value });
  if (!bytes) return;
  download(bytes, `${fileName()}.mvsplan`, 'application/zip');
  state.changed.value = false;
}

function openDatabase(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const opening = indexedDB.open(database, 1);
    opening.onupgradeneeded = () => opening.result.createObjectStore(store);
    opening.onsuccess = () => resolve(opening.result);
    opening.onerror = () => reject(opening.error ?? new Error(refusals.noStorage));
    opening.onblocked = () => reject(new Error(refusals.storageInUse));
  });
}

async function withStore<T>(
  mode: IDBTransactionMode,
  work: (store: IDBObjectStore) => IDBRequest<T>,
): Promise<T> {
  const base = await openDatabase();
  try {
    return await new Promise<T>((resolve, reject) => {
      const transaction = base.transaction(store, mode);
      const asked = work(transaction.objectStore(store));
      transaction.oncomplete = () => resolve(asked.result);
      transaction.onerror = () => reject(transaction.error);
      transaction.onabort = () => reject(transaction.error);
    });
  } finally {
    base.close();
  }
}

interface Kept {
  title: string;
  saved: string;
  bytes: Uint8Array;
}

/** Reads whether a copy was allowed, and whether one is there; called once at the start. */
export async function findCopy(): Promise<void> {
  try {
    autosave.value = localStorage.getItem(allowedKey) === 'yes';
    const kept = (await withStore('readonly', (s) => s.get('last'))) as Kept | undefined;
    if (kept) recoverable.value = { title: kept.title, saved: kept.saved };
  } catch {
    storageWorks.value = false;
    autosave.value = false;
  }
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

export async function allowAutosave(allowed: boolean): Promise<void> {
  try {
    localStorage.setItem(allowedKey, allowed ? 'yes' : 'no');
    autosave.value = allowed;
    if (allowed) await keepCopy();
    else await forgetCopy();
  } catch (error) {
    storageWorks.value = false;
    autosave.value = false;
    fail(error);
  }
}

/** Writes the copy of the present session, if the user allowed it. */
export async function keepCopy(): Promise<void> {
  if (!autosave.value || !state.main.value) return;
  try {
    const bytes = await request('save_session', { title: state.title.value, notes: state.notes.value });
    const kept: Kept = { title: state.title.value, saved: new Date().toISOString(), bytes };
    await withStore('readwrite', (s) => s.put(kept, 'last'));
  } catch (error) {
    storageWorks.value = false;
    fail(error);
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
  await writeKeptFile();
}

export function leaveKeptFile(): void {
  handle = null;
  keptFile.value = '';
}

/** Writes the session to the chosen file, one write after the other; the file is replaced as a whole. */
export function writeKeptFile(): Promise<void> {
  writing = writing.then(async () => {
    if (!handle || !state.main.value) return;
    try {
      const bytes = await request('save_session', { title: state.title.value, notes: state.notes.value });
      const stream = await handle.createWritable();
      await stream.write(bytes.slice());
      await stream.close();
      state.changed.value = false;
    } catch (error) {
      leaveKeptFile();
      fail(error);
    }
  });
  return writing;
}

/** ms without a further letter before changed notes are written. */
const typed = 800;

/** Lets the copy and the chosen file follow the plan, its checkpoints and its notes. */
export function keepFollowing(): void {
  let kept: unknown[] = [state.main.value, state.checkpoints.value];
  let timer = 0;
  const write = () => {
    window.clearTimeout(timer);
    void keepCopy().then(writeKeptFile);
  };
  effect(() => {
    const now = [state.main.value, state.checkpoints.value];
    if (now[0] && now.some((value, k) => value !== kept[k])) untracked(write);
    kept = now;
  });
  let { value: notes } = state.notes;
  state.notes.subscribe((now) => {
    if (now === notes) return;
    notes = now;
    window.clearTimeout(timer);
    timer = window.setTimeout(write, typed);
  });
}

export async function forgetCopy(): Promise<void> {
  await withStore('readwrite', (s) => s.delete('last'));
  recoverable.value = null;
}

export async function recover(): Promise<void> {
  const kept = (await withStore('readonly', (s) => s.get('last'))) as Kept | undefined;
  recoverable.value = null;
  if (kept) await openSession(kept.bytes);
}
