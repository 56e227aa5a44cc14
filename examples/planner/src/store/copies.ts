// Copies of sessions, and of surfaces with clicked points, in the browser, for recovery after a crash. Every plan has a
// copy under a key of its own, so that neither a second tab nor the next plan writes over it. A tab holds a lock on the
// keys it writes to: copies without a held lock were left behind. A browser without locks offers all of them.
import type { FileUnit } from '../protocol';
import type { Given, Imported } from './state';

const database = 'mvs-planner-1';
const store = 'session';
const prefix = 'mvs-planner-1 copy ';
/** Copies that stay; older ones are deleted. */
const most = 8;

export interface Copy {
  title: string;
  /** When it was written, ISO 8601. */
  saved: string;
  bytes: Uint8Array;
  /** A surface that is being imported: `title` is the name of its file, `bytes` are those of the file. */
  surface?: { unit: FileUnit } & Pick<Imported, Given>;
}

export interface LeftCopy {
  key: string;
  title: string;
  saved: string;
  /** Not a session but a surface. */
  surface: boolean;
}

function openDatabase(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const opening = indexedDB.open(database, 1);
    opening.onupgradeneeded = () => opening.result.createObjectStore(store);
    opening.onsuccess = () => resolve(opening.result);
    opening.onerror = () => reject(opening.error);
    opening.onblocked = () => reject(new Error('blocked'));
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

/** A key that no other plan has. */
export const newKey = (): string => `${Date.now()}-${Math.random().toString(36).slice(2)}`;

/** Holds a key for as long as the tab lives. */
export function hold(key: string): Promise<void> {
  return new Promise((resolve) => {
    if (!navigator.locks) return resolve();
    navigator.locks
      .request(prefix + key, { ifAvailable: true }, (lock) => {
        resolve();
        // a promise without an end keeps the lock
        return lock ? new Promise<void>(() => {}) : undefined;
      })
      .catch(() => resolve());
  });
}

async function heldKeys(): Promise<Set<string>> {
  try {
    const { held = [] } = (await navigator.locks?.query()) ?? {};
    return new Set(held.map(({ name = '' }) => name.slice(prefix.length)));
  } catch {
    return new Set();
  }
}

export async function writeCopy(key: string, copy: Copy): Promise<void> {
  await withStore('readwrite', (s) => s.put(copy, key));
}

export const readCopy = (key: string): Promise<Copy | undefined> =>
  withStore('readonly', (s) => s.get(key)) as Promise<Copy | undefined>;

export async function deleteCopy(key: string): Promise<void> {
  await withStore('readwrite', (s) => s.delete(key));
}

export async function deleteAllCopies(): Promise<void> {
  await withStore('readwrite', (s) => s.clear());
}

/** Copies that no living tab writes to, the newest first; all but the newest `most` of them are deleted. */
export async function leftCopies(): Promise<LeftCopy[]> {
  const held = await heldKeys();
  const left: LeftCopy[] = [];
  for (const key of (await withStore('readonly', (s) => s.getAllKeys())) as string[]) {
    const copy = held.has(key) ? undefined : await readCopy(key);
    if (copy) left.push({ key, title: copy.title, saved: copy.saved, surface: !!copy.surface });
  }
  left.sort((a, b) => b.saved.localeCompare(a.saved));
  for (const { key } of left.splice(most)) await deleteCopy(key);
  return left;
}
