// The verdict in large letters over all panels: sealed or leaking, where and how much; dots stand for what is still to
// come.
import { beyondLimit, percentOfLimit, shareOfLimit } from '../notable';
import { beforeDoubt, doubtNote, marked } from '../store/doubt';
import { allowedLoad, faultyLoad, smallAnnulus } from '../store/limits';
import { ofMiddle } from '../store/names';
import * as state from '../store/state';
import { showChord } from '../store/tour';
import { attachedInVain, isOverloaded, relieved, verdictOf } from '../store/verdict';
import { figure, tipTexts, valveTexts, verdictTexts, where } from '../text/texts';
import type { Figures } from '../protocol';
import { Spread } from './parts';

export function Verdict() {
  const figures = state.figures.value;
  const surface = state.surface.value;
  if (!figures || surface)
    return (
      <div class="verdict waiting" data-testid="verdict">
        <strong>{surface ? verdictTexts.surface : '…'}</strong>
      </div>
    );
  const { level, word, but, unmeasured, folded, severe, doubt } = verdictOf(figures);
  const small = smallAnnulus();
  const tag = tagOf();
  const held = isHeld();
  // of the valve in the hand there is no grade
  const grading = held
    ? 'none'
    : (doubt ?? (level === null ? 'none' : severe ? 4 : but.length && !level ? 'but' : level));
  return (
    <div
      class={`verdict level-${grading}${state.outdated.value ? ' outdated' : ''}`}
      data-testid="verdict"
      aria-busy={state.pending.value}
    >
      <div class="verdict-word">
        <strong>
          {word}
          {but.length > 0 && !level && !folded && verdictTexts.but}
        </strong>
        {tag && <span class="tag">{tag}</span>}
      </div>
      {but.map((reservation) => (
        <strong
          class="verdict-but"
          title={small === null ? verdictTexts.butHelp : verdictTexts.smallAnnulus(small)}
        >
          {reservation}
        </strong>
      ))}
      {doubt !== 'cross' && <Leak figures={figures} graded={level !== null} />}
      {held && <div class="verdict-note">{verdictTexts.notWhileHeld}</div>}
      {doubt && (
        <div class="verdict-where" data-testid="doubt">
          {doubtNote(figures)}
        </div>
      )}
      {unmeasured && <div class="verdict-note">{verdictTexts.openingUnknown}</div>}
      {!doubt && <Beyond figures={figures} />}
      <Relieved figures={figures} />
      <AttachedInVain figures={figures} />
    </div>
  );
}

/** Whether the picture shows tissue that a hand holds or has just let go, and the figures are those of the valve at rest. */
const isHeld = (): boolean => state.handing.value || !!state.motion.value?.picture.hand;

/** Which valve the figures belong to, where it is not the one of the plan as the picture shows it. */
function tagOf(): string {
  if (isHeld()) return verdictTexts.held(state.tool.value === 'push' ? 'push' : 'pull');
  if (state.motion.value && state.openness.value < 1) return verdictTexts.ofClosed;
  if (state.inPast.value)
    return (state.compared.value && !state.preview.value && state.compareWith.value) || verdictTexts.past;
  if (state.outdated.value) return verdictTexts.trying;
  return state.preview.value ? verdictTexts.preview : '';
}

/** Chordae that are named on the card, as many as have room. */
const named = 2;

/** The chordae beyond their limit, by name: a press shows them. They are counted here where the verdict does not. */
function Beyond({ figures }: { figures: Figures }) {
  const beyond = beyondLimit(figures.chords);
  if (!beyond.length) return null;
  const words = verdictTexts;
  const counted = isOverloaded(figures) && figures.known !== 'shape';
  return (
    <div
      class={counted ? 'verdict-warn' : 'verdict-note'}
      title={beyond.some((chord) => chord.artificial) ? words.artificialHelp : words.limitHelp}
    >
      {!counted && <div>{words.chordsOver(beyond.length, faultyLoad(), allowedLoad() !== null)}</div>}
      <div class="beyond-names">
        {beyond.slice(0, named).map((chord) => (
          <button
            type="button"
            class="link"
            title={tipTexts.beyond(chord.name)}
            onClick={() => open(chord.name)}
          >
            {words.chordOver(chord.name, percentOfLimit(shareOfLimit(chord)))}
          </button>
        ))}
        {beyond.length > named && '…'}
      </div>
    </div>
  );
}

/** Chordae that were far beyond their limit in the valve before and are slack. */
function Relieved({ figures }: { figures: Figures }) {
  const slack = relieved(state.before.value, figures);
  if (!slack.length || figures.known === 'shape') return null;
  return (
    <div class="verdict-note" title={verdictTexts.relievedHelp}>
      {verdictTexts.relieved(slack)}
    </div>
  );
}

/** Chordae that the plan attached and that are slack. */
function AttachedInVain({ figures }: { figures: Figures }) {
  const vain = figures.known === 'shape' ? [] : attachedInVain(figures);
  if (!vain.length) return null;
  return (
    <div class="verdict-note" title={verdictTexts.attachedInVainHelp}>
      {verdictTexts.attachedInVain(vain)}
    </div>
  );
}

/** Shows a chord in the picture and, unless a form stands there, its figures. */
function open(name: string): void {
  showChord(name);
  if (!state.draft.value) state.panel.value = 'repair';
}

/** mm: half of the coaptation that surgeons aim at in A2–P2, a judgement. */
const littleHeight = 4;

/** Digits of a leak in mm2. */
const digits = (orifice: number): number => (orifice > 0 && orifice < 10 ? 1 : 0);

/** The size of the leak and its place, or how far the leaflets meet; dots stand for what is still to come. */
function Leak({ figures, graded }: { figures: Figures; graded: boolean }) {
  const words = verdictTexts;
  const { orifice, coaptationMean, coaptationHeight } = figures.measures;
  const shape = figures.known === 'shape';
  const size = (area: number) => figure(area, digits(area));
  const before = state.before.value?.measures.orifice;
  const spread = state.shownSpread.value?.measures;
  const little = orifice === 0 && coaptationHeight < littleHeight;
  const help = little
    ? ofMiddle(words.meetLittle) + valveTexts.coaptationHeightHelp
    : valveTexts.coaptationMeanHelp;
  return (
    <>
      <div class="verdict-figure">
        <span class="big" data-testid="orifice">
          {shape ? '…' : size(orifice)}
        </span>{' '}
        {marked(words.leak + words.atPressure, figures)}
        {before !== undefined && graded && !beforeDoubt.value && size(before) !== size(orifice) && (
          <span class="was">{words.was(size(before))}</span>
        )}
        <Spread range={spread?.orifice} digits={digits(orifice)} />
      </div>
      {graded && (
        <div class={little ? 'verdict-where little' : 'verdict-where'} title={orifice > 0 ? undefined : help}>
          {orifice > 0
            ? words.at(where(figures))
            : ofMiddle(words.meet(figure(coaptationMean), little ? coaptationHeight : null))}
          {orifice === 0 && <Spread range={spread?.coaptationMean} digits={1} />}
        </div>
      )}
    </>
  );
}
