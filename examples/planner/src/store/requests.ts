// Requests to the worker, with a line of progress and a notice where they fail; the valve that a result brings.
import { batch } from '@preact/signals';
import { say, t } from '../text/texts';
import type { CallName, Calls } from '../calls';
import type { Shown } from '../protocol';
import { CallError, Client, type CallOptions } from './client';
import { sayResult } from './result';
import * as state from './state';

let client: Client;

export function connect(): Client {
  client = new Client((sentence) => (state.broken.value = sentence), state.receive);
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
export const cancel = (id: number): void => client.cancel(id);

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

/** An action of several requests, which is under way until it is done. */
export async function whole<T>(work: () => Promise<T>): Promise<T> {
  ++state.underway.value;
  try {
    return await work();
  } finally {
    --state.underway.value;
  }
}

export const sentenceOf = (error: unknown): string =>
  say(error instanceof Error ? error.message : String(error));

export const isCancelled = (error: unknown): boolean => error instanceof CallError && error.cancelled;

export function fail(error: unknown): void {
  if (isCancelled(error)) return;
  const code = error instanceof CallError ? error.failure.code : undefined;
  state.notice.value = { kind: 'error', text: sentenceOf(error), code };
}

/**
 * More figures of the valve of the plan, or its last ones. The picture changes only where the orifice becomes known:
 * the last figures come with it again.
 */
export function complete(shown: Shown): void {
  const { value } = state.main;
  if (value?.figures.hash !== shown.figures.hash) return;
  const same = value.figures.known !== 'shape';
  batch(() => {
    state.main.value = same ? { ...shown, picture: value.picture } : shown;
    if (shown.figures.known === 'all' && !state.preview.value) sayResult(shown.figures);
  });
}

/** Name of a change in the status line. */
const doneBy = { undo: t.undone, redo: t.repeated, restore: t.returned };

/** Runs a request that changes the valve of the plan, and shows it in stages. */
export async function change<Name extends 'undo' | 'redo' | 'restore'>(
  text: string,
  name: Name,
  argument: Calls[Name]['argument'],
): Promise<void> {
  let begun = false;
  const stage = (shown: Shown) => {
    if (begun) return complete(shown);
    begun = true;
    show(shown, false, doneBy[name]);
  };
  const shown = await run(text, name, argument, { stage });
  if (shown) stage(shown as Shown);
}

/** Shows a valve as that of the plan; `fresh` where it begins another plan; `done` names what gave it. */
export function show(shown: Shown, fresh: boolean, done = ''): void {
  batch(() => {
    state.main.value = shown;
    state.preview.value = null;
    state.previewed.value = null;
    state.motion.value = null;
    state.openness.value = 1;
    state.draft.value = null;
    state.draftMessage.value = '';
    state.picking.value = null;
    if (fresh) {
      ++state.plan.value;
      // a notice belongs to its valve
      state.notice.value = null;
      state.first.value = shown;
      state.choice.value = null;
      state.receiveCheckpoints({ names: [], hashes: [], removed: null });
      state.compared.value = null;
      state.compareWith.value = null;
      state.cost.value = null;
      state.spread.value = null;
    }
    sayResult(shown.figures, done);
  });
}
