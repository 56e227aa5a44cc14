// The form of an operation, generated from the library's table: numbers as sliders with a box, parts as lists
// that a click in the picture fills too, fields that few need behind "More".
import { useEffect, useRef } from 'preact/hooks';
import { Check, Crosshair, X } from 'lucide-preact';
import { apply, complete, discard, replacements } from '../store/edit';
import { ofMiddle } from '../store/names';
import * as state from '../store/state';
import { appTexts, formTexts, t, tips, wordsOf } from '../text/texts';
import type { FieldInfo } from '../protocol';
import { useRoomAboveFoot } from './room';
import { ChordFacts } from './chord';
import { Field } from './fields';
import { GoalLine } from './goals';
import { Opening } from './opening';
import { Button, Section } from './parts';

/** Fields that are asked for although the library does not require them. */
const prominent: Record<string, string[]> = {
  ring: ['size'],
  band: ['factor'],
  annulus_scale: ['factor', 'ap', 'cc'],
  neochord: ['site', 'head', 'length'],
  chord_add: ['site', 'head', 'length'],
  chord_length: ['chord', 'length'],
  chord_remove: ['chord'],
  chord_transfer: ['chord', 'end', 'site', 'head'],
  head_move: ['head', 'by'],
  clip: ['position', 'angle', 'width', 'anterior', 'posterior'],
  resect: ['outline', 'scallop', 'position', 'width', 'depth'],
  patch: ['site', 'width', 'height'],
};

export function OperationForm() {
  const draft = state.draft.value!;
  const info = state.operationOf(draft.kind)!;
  const words = wordsOf(draft.kind, info.help);
  const usable = info.fields.filter((field) => field.type !== 'point' && !field.name.startsWith('landmarks'));
  // of an operation that the page does not know: what is required, or all of them where nothing is
  const required = usable.filter((field) => field.required);
  const first = prominent[draft.kind] ?? (required.length ? required : usable).map((field) => field.name);
  const picking = state.picking.value;
  // a list of points that is given or drawn stands instead of other fields
  const points = replacements[draft.kind];
  const hidden = points && (picking === points.points || draft.fields[points.points]) ? points.instead : [];
  const shown = first
    .map((name) => usable.find((field) => field.name === name))
    .filter((f): f is FieldInfo => !!f && !hidden.includes(f.name));
  const more = usable.filter((field) => !first.includes(field.name) && !hidden.includes(field.name));
  // of the valve before the operation, and of its preview
  const [chord, changed] = [state.main, state.preview].map((valve) =>
    valve.value?.figures.chords.find((item) => item.id === draft.fields.chord),
  );
  const ready = complete(draft.kind, draft.fields);
  const foot = useRoomAboveFoot();
  const head = useRef<HTMLHeadingElement>(null);
  // the card that was pressed is gone: a screen reader goes on with the name of the form
  useEffect(() => {
    if (document.activeElement === document.body) head.current?.focus({ preventScroll: true });
  }, []);
  return (
    <form
      class="panel-body form"
      data-testid="form"
      onSubmit={(event) => (event.preventDefault(), void apply())}
    >
      <div class="form-head">
        <h2 ref={head} tabIndex={-1}>
          {words.title}
        </h2>
        <Button kind="quiet" icon={<X size={18} />} label={formTexts.leave} keys="Escape" onClick={discard} />
      </div>
      <p class="hint">{ofMiddle(words.short)}</p>
      {picking && (
        <p class="ask" role="status">
          <Crosshair size={16} aria-hidden="true" />{' '}
          {question(info.fields.find((field) => field.name === picking)!)}
        </p>
      )}
      {chord && (
        <div class="chosen-card" data-testid="chosen">
          <ChordFacts chord={chord} after={changed} brief />
        </div>
      )}
      {shown.map((field) => (
        <Field key={field.name} kind={draft.kind} field={field} label={words.fields?.[field.name]} />
      ))}
      {(draft.kind === 'annulus_scale' || draft.kind === 'band') && <AnnulusSize />}
      {more.length > 0 && (
        <Section title={formTexts.more} name={`more of ${draft.kind}`}>
          {more.map((field) => (
            <Field key={field.name} kind={draft.kind} field={field} label={words.fields?.[field.name]} />
          ))}
        </Section>
      )}
      <div class="form-foot" ref={foot}>
        <Refusal />
        {state.tour.value && <GoalLine number={state.tour.value.number} />}
        <Opening kind={draft.kind} />
        <p class="hint trying">
          {ready && state.outdated.value && (
            <span data-testid="trying">{state.early.value ? t.notSeen : t.previewing}</span>
          )}
        </p>
        <button
          type="submit"
          class="button main"
          disabled={!ready || !!state.draftMessage.value || picking === points?.points}
          title={`${tips[appTexts.apply]} ${formTexts.enter}`}
        >
          <Check size={16} />
          <span>{appTexts.apply}</span>
        </button>
        <Button onClick={discard}>{appTexts.discard}</Button>
      </div>
    </form>
  );
}

/** Why the form is refused, beside the buttons: in sight wherever the fields are scrolled to. */
function Refusal() {
  const line = useRef<HTMLParagraphElement>(null);
  const text = state.draftMessage.value;
  // in small windows the foot scrolls with the form
  useEffect(() => line.current?.scrollIntoView({ block: 'nearest' }), [text]);
  if (!text) return null;
  return (
    <p class="message" role="alert" ref={line}>
      {text}
    </p>
  );
}

/** The annulus before and after, mm. */
function AnnulusSize() {
  const [was, now] = [state.main, state.preview].map((valve) => valve.value?.figures.measures);
  if (!was || !now) return null;
  const size = ({ annulusAp, annulusCc }: typeof was) => ({ ap: annulusAp, cc: annulusCc });
  return <small class="hint">{formTexts.annulus(size(was), size(now))}</small>;
}

const question = (field: FieldInfo): string => formTexts.questions[field.type] ?? '';
