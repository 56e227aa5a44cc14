// The polite status line: the last change, and the verdict on the valve after it.
import { effect, untracked } from '@preact/signals';
import { t, verdictTexts } from '../text/texts';
import type { Figures } from '../protocol';
import * as state from './state';
import { doubtOf } from './doubt';
import { measuresItself, unmeasurable } from './limits';
import { attachedInVain, headline, relieved, verdictOf } from './verdict';

/** The change that led to the present valve. */
let done = '';

/** A result that is said once the opening of its valve is measured, so that it is said once. */
let held: Figures | null = null;

const lineOf = (what: string, before: Figures | null, now: Figures): string => {
  const slack = relieved(before, now);
  const vain = attachedInVain(now);
  const more = [
    ...(slack.length ? [verdictTexts.relieved(slack)] : []),
    ...(vain.length ? [verdictTexts.attachedInVain(vain)] : []),
  ];
  return t.statusLine(what, headline(now), doubtOf(now) ? null : now, more.join('. '));
};

function speak(now: Figures): void {
  held = null;
  state.status.value = lineOf(done, state.earlier.value?.figures ?? null, now);
}

/** Whether the opening of the valve of the plan is still to come, so that its verdict would change. */
const waits = (now: Figures): boolean =>
  verdictOf(now).unmeasured && measuresItself(state.main.value!) && unmeasurable.value !== now.hash;

/** Says the result for the valve of the plan; `what` names the change, which later figures of the valve belong to as well. */
export function sayResult(now: Figures, what = done): void {
  done = what;
  held = null;
  if (now.known !== 'all') return;
  if (waits(now)) held = now;
  else speak(now);
}

/** The preview that was said last, and its verdict then. */
let told: { figures: Figures; verdict: string } | null = null;

export function sayPreview(now: Figures): void {
  told = { figures: now, verdict: headline(now) };
  state.status.value = lineOf(t.previewed, state.main.value?.figures ?? null, now);
}

/** Says a preview again once its opening is measured, which its verdict did not know. */
function watchPreview(): void {
  effect(() => {
    const figures = state.preview.value?.figures;
    if (!figures || told?.figures !== figures || state.outdated.value) return;
    if (headline(figures) !== told.verdict) untracked(() => sayPreview(figures));
  });
}

/** Says a result that was held once its opening is known, and any result again where an opening that was asked for changes its verdict. */
export function watchResult(): void {
  watchPreview();
  let said: Figures | null = null;
  let sentence = '';
  effect(() => {
    const figures = state.main.value?.figures;
    if (!figures || figures.known !== 'all' || state.draft.value || state.coming.value) return;
    const now = headline(figures);
    const due = held === figures ? !waits(figures) : said === figures && now !== sentence;
    if (due) untracked(() => speak(figures));
    [said, sentence] = [figures, now];
  });
}
