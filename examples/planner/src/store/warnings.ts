// Notices on what is doubtful about a valve file, and the warnings of the library on opening it and on running a plan.
import { warningTexts } from '../text/texts';
import type { Shown } from '../protocol';
import { isMitral, leafletNames } from './names';
import { isPlausible } from './limits';
import * as state from './state';

/** The warnings that were said since the present plan began. */
let told = new Set<string>();
let plan = 0;

/** Warnings of the library that are new in this plan, in the words of the page. */
function fresh({ warnings = [] }: Shown): string[] {
  if (plan !== state.plan.value) [told, plan] = [new Set(), state.plan.value];
  const all = warnings.filter((text) => !told.has(text));
  for (const text of all) told.add(text);
  return all.map(warningTexts.library);
}

/** A notice with these sentences, which stays until it is closed; null without any. */
function noticeOf(sentences: string[]): typeof state.notice.value {
  return sentences.length ? { kind: 'warning', text: sentences.join(' ') } : null;
}

/** On a valve file that was opened and is shown. */
export function warnOfFile(shown: Shown): typeof state.notice.value {
  const { annulusCc } = shown.figures.measures;
  const names = leafletNames(shown.picture);
  return noticeOf([
    ...(isPlausible(annulusCc) ? [] : [warningTexts.size(annulusCc)]),
    ...(isMitral(names) ? [] : [warningTexts.notMitral(names)]),
    ...(shown.ownLoad === undefined ? [] : [warningTexts.otherLoad(shown.ownLoad)]),
    ...fresh(shown),
  ]);
}

/** On a valve that an operation of the plan led to: the notice is shown after what another one said. */
export function warnOfStep(shown: Shown): void {
  const notice = noticeOf(fresh(shown));
  if (notice) state.notice.value = notice;
}

/** The warnings on the way to a valve whose plan was repeated, after the notice on that. */
export function warnOfPlan(shown: Shown): void {
  const notice = noticeOf(fresh(shown));
  const said = state.notice.value;
  if (notice)
    state.notice.value = {
      ...said,
      kind: said?.kind === 'error' ? 'error' : 'warning',
      text: [said?.text, notice.text].filter(Boolean).join(' '),
    };
}
