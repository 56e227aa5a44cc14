// The verdict in large letters over all panels: sealed or leaking, where and how much; dots stand for what is still to
// come.
import * as state from '../store/state';
import { figure, grade, verdictTexts, where } from '../text/texts';
import type { Figures } from '../protocol';

export function Verdict() {
  const figures = state.figures.value;
  const surface = state.surface.value;
  if (!figures || surface)
    return (
      <div class="verdict waiting" data-testid="verdict">
        <strong>{surface ? verdictTexts.surface : '…'}</strong>
      </div>
    );
  const words = verdictTexts;
  const m = figures.measures;
  const shape = figures.known === 'shape';
  const graded = m.atRest && m.underLoad && !shape;
  const { level, word } = grade(m.orifice);
  const tag = state.inPast.value
    ? words.past
    : state.outdated.value
      ? words.trying
      : state.preview.value
        ? words.preview
        : '';
  return (
    <div
      class={`verdict level-${graded ? level : 'none'}${state.outdated.value ? ' outdated' : ''}`}
      data-testid="verdict"
      aria-busy={state.pending.value}
    >
      <div class="verdict-word">
        <strong>{shape ? words.measuring : graded ? word : words.notAtRest}</strong>
        {tag && <span class="tag">{tag}</span>}
      </div>
      <Leak figures={figures} graded={graded} />
      {!graded && !shape && <div class="verdict-where">{words.notFinal}</div>}
      {m.chordsOver > 0 && (
        <div class={m.chordsOver > usual() ? 'verdict-warn' : 'verdict-note'} title={words.limitHelp}>
          {words.chordsOver(m.chordsOver, comparison())}
        </div>
      )}
    </div>
  );
}

/** Chordae beyond their limit in the healthy valve of the tour, as soon as it is known: no more of them is no warning. */
function usual(): number {
  const tour = state.tour.value;
  return tour ? (tour.founding?.healthy.measures.chordsOver ?? Infinity) : 0;
}

/** That number in words; '…' while it is measured, nothing outside of the tour. */
function comparison(): string {
  const { value } = state.tour;
  return value ? String(value.founding?.healthy.measures.chordsOver ?? '…') : '';
}

/** Digits of a leak in mm2. */
const digits = (orifice: number): number => (orifice > 0 && orifice < 10 ? 1 : 0);

/** The size of the leak and its place, or how far the leaflets meet; dots stand for what is still to come. */
function Leak({ figures, graded }: { figures: Figures; graded: boolean }) {
  const words = verdictTexts;
  const { orifice, coaptationMean } = figures.measures;
  const shape = figures.known === 'shape';
  const size = (area: number) => figure(area, digits(area));
  const before = state.before.value?.measures.orifice;
  return (
    <>
      <div class="verdict-figure">
        <span class="big" data-testid="orifice">
          {shape ? '…' : size(orifice)}
        </span>{' '}
        {words.leak}
        {orifice === 0 && graded && words.atPressure}
        {before !== undefined && !shape && size(before) !== size(orifice) && (
          <span class="was">{words.was(size(before))}</span>
        )}
      </div>
      {graded && (
        <div class="verdict-where">
          {orifice > 0 ? words.at(where(figures)) : words.meet(figure(coaptationMean))}
        </div>
      )}
    </>
  );
}
