// The polite status line: what was done, and the verdict on the valve that it gave.
import { effect, untracked } from '@preact/signals';
import { t, verdictTexts } from '../text/texts';
import type { Figures } from '../protocol';
import * as state from './state';
import { headline, relieved } from './verdict';

/** What the present valve comes from. */
let done = '';

const lineOf = (what: string, before: Figures | null, now: Figures): string => {
  const slack = relieved(before, now);
  return t.statusLine(what, headline(now), now, slack.length ? verdictTexts.relieved(slack) : '');
};

/** Says the result for the valve of the plan; `what` names what was done, which later figures of the valve belong to as well. */
export function sayResult(now: Figures, what = done): void {
  done = what;
  if (now.known !== 'all') return;
  state.status.value = lineOf(done, state.earlier.value?.figures ?? null, now);
}

export function sayPreview(now: Figures): void {
  state.status.value = lineOf(t.previewed, state.main.value?.figures ?? null, now);
}

/** Says the result once more where the opening, which is measured later, changes the verdict. */
export function watchResult(): void {
  let said: Figures | null = null;
  let sentence = '';
  effect(() => {
    const figures = state.main.value?.figures;
    if (!figures || figures.known !== 'all' || state.draft.value || state.coming.value) return;
    const now = headline(figures);
    if (said === figures && now !== sentence) untracked(() => sayResult(figures));
    [said, sentence] = [figures, now];
  });
}
