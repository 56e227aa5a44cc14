// Recovery: copies of the plan and of a surface with clicked points, and copies left by a crash or a closed tab. Storage of
// a page from disk is shared by every page from disk, so copies are made only where the user allows it.
import { batch, effect, signal, untracked } from '@preact/signals';
import {
  deleteAllCopies,
  deleteCopy,
  hold,
  leftCopies,
  newKey,
  readCopy,
  writeCopy,
  type Copy,
  type LeftCopy,
} from './copies';
import { beginImport, openSession } from './files';
import { leave } from './left';
import { fail, request } from './requests';
import { sessionContents } from './session';
import * as state from './state';

const allowedKey = 'mvs-planner-1-autosave';

export const autosave = signal(false);
export const storageWorks = signal(true);
/** Copies that were left behind, the newest first: it is offered. */
export const recoverable = signal<LeftCopy[]>([]);

function allowed(): boolean {
  try {
    return localStorage.getItem(allowedKey) === 'yes';
  } catch {
    return false;
  }
}

/** Reads whether a copy was allowed, and which ones were left; called once at the start. */
export async function findCopies(): Promise<void> {
  try {
    autosave.value = allowed();
    recoverable.value = await leftCopies();
  } catch {
    storageWorks.value = false;
    autosave.value = false;
  }
}

/** The present session; asked for at once, so that it is not that of a plan which is opened afterwards. */
export const sessionNow = (): Promise<Uint8Array> => request('save_session', sessionContents());

export async function allowAutosave(allowed: boolean): Promise<void> {
  try {
    localStorage.setItem(allowedKey, allowed ? 'yes' : 'no');
    autosave.value = allowed;
    if (allowed) {
      if (state.main.value) await keepCopy(sessionNow());
      return;
    }
    [ownKey, surfaceKey] = [null, null];
    await copying;
    await deleteAllCopies();
    recoverable.value = [];
  } catch (error) {
    storageWorks.value = false;
    autosave.value = false;
    fail(error);
  }
}

/** The keys of the copies of the present plan and of the surface that is being imported, once they were written. */
let ownKey: string | null = null;
let surfaceKey: string | null = null;
let copying: Promise<void> = Promise.resolve();

/** Whether copies are allowed: another tab may have taken the permission back. */
function mayCopy(): boolean {
  if (autosave.value) autosave.value = allowed();
  return autosave.value;
}

/** Writes a copy after those that are being written. */
function write(key: string, copy: () => Promise<Copy>): Promise<void> {
  copying = copying.then(async () => {
    try {
      await hold(key);
      await writeCopy(key, await copy());
    } catch (error) {
      storageWorks.value = false;
      fail(error);
    }
  });
  return copying;
}

/** Writes a session to the copy of the present plan, if the user allowed it. */
export function keepCopy(session: Promise<Uint8Array>): Promise<void> {
  if (!mayCopy()) return copying;
  const { value: title } = state.title;
  ownKey ??= newKey();
  return write(ownKey, async () => ({ title, saved: new Date().toISOString(), bytes: await session }));
}

/** Writes the surface of an import with its clicked points to a copy of its own, if the user allowed it. */
function keepSurface({ name, bytes, surface, kind, points, closed, thickness }: state.Imported): void {
  if (!mayCopy()) return;
  surfaceKey ??= newKey();
  void write(surfaceKey, async () => ({
    title: name,
    saved: new Date().toISOString(),
    bytes,
    surface: { unit: surface.unit, kind, points, closed, thickness },
  }));
}

/** Deletes the copy of a surface that was left, or from which a valve was built. */
function leaveSurfaceCopy(): void {
  const key = surfaceKey;
  surfaceKey = null;
  if (key) copying = copying.then(() => deleteCopy(key)).catch(fail);
}

/** The copy of a plan that gives way to another one stays if it has changes that are saved nowhere else. */
export function leaveCopy(unsaved: boolean): void {
  const key = ownKey;
  ownKey = null;
  if (key && !unsaved) copying = copying.then(() => deleteCopy(key)).catch(fail);
}

/** ms without a further letter or click before changed notes or points are written. */
export const rest = 800;

/** Lets a copy follow the points that are clicked on a surface. */
export function followSurface(): void {
  let timer = 0;
  effect(() => {
    const { value } = state.surface;
    window.clearTimeout(timer);
    if (!value) return untracked(leaveSurfaceCopy);
    if (autosave.value && state.marked.value) timer = window.setTimeout(() => keepSurface(value), rest);
  });
}

/** Deletes the copy that is offered, and offers the next one. */
export async function forgetCopy(): Promise<void> {
  const [first, ...others] = recoverable.value;
  if (first) await deleteCopy(first.key);
  recoverable.value = others;
}

/** Opens the copy that is offered; the opened plan or surface goes on in it. Other copies are offered at the next start. */
export async function recover(): Promise<void> {
  const [first] = recoverable.value;
  recoverable.value = [];
  const kept = first && (await readCopy(first.key));
  if (!kept) return;
  if (kept.surface) {
    if (!(await beginImport(kept.title, kept.bytes, kept.surface.unit, kept.surface))) return;
    leaveSurfaceCopy();
    surfaceKey = first.key;
  } else {
    if (!(await openSession(kept.bytes, await leave()))) return;
    batch(() => {
      state.changed.value = true;
      state.onlyHere.value = true;
    });
    leaveCopy(false);
    ownKey = first.key;
  }
  await hold(first.key);
}
