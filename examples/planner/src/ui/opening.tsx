// In the form of an operation that narrows the valve: how far it would open, beside the valve before and the goal; at a press why.
import { marked } from '../store/doubt';
import { gradientOf, isTooMuch } from '../store/gradient';
import { leastOpening, narrowing, openingOf, smallAnnulus } from '../store/limits';
import * as state from '../store/state';
import { openingTexts, stenosis, verdictTexts } from '../text/texts';

/** Operations that make the annulus smaller. */
const ofAnnulus = new Set(['ring', 'band']);

/** Share of the opening before below which the form says why so little is left, also where that is no stenosis. */
const muchLess = 0.8;

/** Share by which two openings differ no more than they are known: of a rigid funnel the figure is right to 1 %
 *  (libmvs/measure/DEFINITIONS.md), and leaflets come to rest in slightly different folds. */
const accuracy = 0.02;

export function Opening({ kind }: { kind: string }) {
  const preview = state.preview.value?.figures;
  if (!narrowing.has(kind) || !preview) return null;
  const now = openingOf(preview.hash);
  const before = openingOf(state.main.value?.figures.hash);
  const least = leastOpening();
  const word = now ? stenosis(now.openArea) : '';
  const small = smallAnnulus();
  const [gradient, flow] = [gradientOf(now), state.flow.value];
  const warn = !!word || isTooMuch(gradient) || (now && least !== null && now.openArea < least);
  const share = now && before ? now.openArea / before.openArea : NaN;
  const same = Math.abs(share - 1) <= accuracy;
  const narrower = preview.measures.annulusCc < (state.main.value?.figures.measures.annulusCc ?? 0);
  // the annulus became smaller and the opening did not
  const elsewhere = ofAnnulus.has(kind) && narrower && share >= 1 - accuracy;
  const less = share < muchLess;
  const why = [
    (word || less) && kind === 'clip' && openingTexts.clip,
    elsewhere && openingTexts.elsewhere,
    word && (small === null ? openingTexts.narrow(word) : verdictTexts.smallAnnulus(small)),
    less && openingTexts.measured,
  ].filter((text) => !!text);
  return (
    <div
      class={`opens${warn ? ' warn' : ''}${state.outdated.value ? ' outdated' : ''}`}
      aria-busy={state.outdated.value}
      data-testid="opening"
      title={openingTexts.help}
    >
      {marked(openingTexts.opens(now?.openArea), preview)}
      <span class="was"> {openingTexts.beside(before?.openArea, least, same)}</span>
      {flow && gradient !== null && (
        <small>{openingTexts.gradient(gradient, flow, gradientOf(before))}</small>
      )}
      {why.length > 0 && (
        <Why kind={kind} question={openingTexts.why(word, less)} answers={why as string[]} />
      )}
    </div>
  );
}

/** Closed it takes one line of the foot: the fields above it stay in sight. */
function Why({ kind, question, answers }: { kind: string; question: string; answers: string[] }) {
  // read for one operation, it does not stand in the way of the next one
  const section = `why it opens so far, ${kind}`;
  const open = state.sections.value.get(section) ?? false;
  return (
    <details
      class="why"
      open={open}
      onToggle={({ currentTarget }) => {
        if (currentTarget.open !== open)
          state.sections.value = new Map(state.sections.value).set(section, currentTarget.open);
      }}
    >
      <summary title={openingTexts.whyTip}>{question}</summary>
      {answers.map((text) => (
        <p>{text}</p>
      ))}
    </details>
  );
}
