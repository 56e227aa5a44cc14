// Valves that were left since the page was opened, with their plans, kept plans and notes, as sessions in memory: each can be opened
// again.
import { signal } from '@preact/signals';
import { titlesOf } from '../notable';
import { reachesAll } from './goals';
import { request } from './requests';
import { sessionContents } from './session';
import * as state from './state';
import { headline } from './verdict';

export interface Left {
  title: string;
  /** The session. */
  bytes: Uint8Array;
  tour: typeof state.tour.value;
  /** A valve of the tour whose goals it reaches. */
  finished: boolean;
  /** It has something that is in no file. */
  changed: boolean;
  /** Operations of its plan, and plans that are kept under a name. */
  steps: number;
  kept: number;
  /** Its verdict, with its reservations. */
  verdict: string;
  /** When it was left, ms since 1970. */
  at: number;
  /** Equal for equal contents. */
  content: string;
}

/** The newest first. */
export const leftValves = signal<Left[]>([]);

/** Bytes of all sessions together: some hundred valves as the page brings them. The newest one stays whatever its size. */
const most = 48e6;

/** The present valve if it has something to return to: operations, kept plans, notes, or that it is in no file. */
export async function leave(): Promise<Left | null> {
  const { canUndo, checkpoints, checkpointHashes, notes, onlyHere, main, tour } = state;
  const something = canUndo.value || checkpoints.value.length || notes.value || onlyHere.value;
  if (!main.value || !something) return null;
  const title = state.title.value;
  const { figures } = main.value;
  const done = titlesOf(figures);
  const plans = [checkpoints.value, checkpointHashes.value];
  const left = {
    title,
    tour: tour.value,
    finished: reachesAll.value,
    changed: state.changed.value,
    steps: done.length,
    kept: checkpoints.value.length,
    verdict: headline(figures, true),
    at: Date.now(),
    content: JSON.stringify([title, figures.hash, done, plans, notes.value, tour.value?.number]),
  };
  try {
    return { ...left, bytes: await request('save_session', sessionContents()) };
  } catch {
    return null;
  }
}

/** Puts a valve that was left into the list; returns the titles of those that the memory has no room for any more. */
export function remember(left: Left | null): string[] {
  if (!left) return [];
  const all = [left, ...leftValves.value.filter(({ content }) => content !== left.content)];
  let bytes = 0;
  const fits = all.map((valve, k) => (bytes += valve.bytes.length) <= most || k === 0);
  leftValves.value = all.filter((_, k) => fits[k]);
  return all.filter((_, k) => !fits[k]).map(({ title }) => title);
}

/** Takes a valve that is open again from the list. */
export function forget({ content }: Left): void {
  leftValves.value = leftValves.value.filter((valve) => valve.content !== content);
}

/** The last plan of a valve of the tour that was left. */
export const repairOf = (number: number): Left | undefined =>
  leftValves.value.find(({ tour }) => tour?.number === number);
