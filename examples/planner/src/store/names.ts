// Whether a valve has the leaflets of a mitral valve and the scallops that are named after Carpentier: figures, limits and views are those of
// the mitral valve, and some of their names have A2 and P2 in them.
import { computed } from '@preact/signals';
import { middleWords } from '../text/texts';
import type { Picture } from '../protocol';
import * as state from './state';

export const leafletNames = (picture: Picture): string[] =>
  state.topologyOf(picture)?.leaflets.map(({ name }) => name) ?? [];

const begins = (name: string, letter: string): boolean => name.toLowerCase().startsWith(letter);

/** Two leaflets, by their names the anterior and the posterior one. */
export const isMitral = (names: string[]): boolean =>
  names.length === 2 && ['a', 'p'].every((letter) => names.some((name) => begins(name, letter)));

/** The leaflets of the valve of the plan where they are not those of a mitral valve; else null. */
export const otherLeaflets = computed<string[] | null>(() => {
  const names = state.main.value ? leafletNames(state.main.value.picture) : [];
  return !names.length || isMitral(names) ? null : names;
});

const scallops = computed(() => state.main.value && state.topologyOf(state.main.value.picture)?.scallops);

/** Whether it has no A2 or no P2. */
const noMiddle = computed(() => {
  const all = scallops.value;
  return !!all && ['A2', 'P2'].some((wanted) => !all.some(({ name }) => name === wanted));
});

/** The first scallops of both leaflets of a valve that has no A2 and P2, for operations that begin with these; else null. */
export function insteadOfMiddle(): { anterior: string; posterior: string } | null {
  const all = scallops.value;
  if (!noMiddle.value || !all) return null;
  const [anterior, posterior] = ['a', 'p'].map((letter) => all.find(({ name }) => begins(name, letter)));
  return anterior && posterior ? { anterior: anterior.id, posterior: posterior.id } : null;
}

/** A text with the names of the middle scallops, which stand aside for "the middle" in a valve that has none. */
export const ofMiddle = (text: string): string => (noMiddle.value ? middleWords(text) : text);
