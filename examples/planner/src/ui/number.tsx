// A number of an operation, with a slider where it has a usual range.
import { useSignal, type Signal } from '@preact/signals';
import { titlesOf } from '../notable';
import { isOutside, shownUnit } from '../store/bounds';
import { setField } from '../store/edit';
import * as state from '../store/state';
import { ringCurves } from '../view/heart';
import { clipPlaceIn, fieldTip, figure, formTexts } from '../text/texts';
import type { FieldInfo } from '../protocol';
import { DecimalBox } from './decimal';
import { SliderEnds } from './parts';

/** Ranges and steps of sliders: usual values, where the library accepts more. */
const sliders: Record<string, Record<string, [number, number, number]>> = {
  ring: { size: [24, 40, 2] },
  band: { factor: [0.6, 1, 0.01] },
  annulus_scale: { factor: [0.7, 1.2, 0.01], ap: [0.7, 1.2, 0.01], cc: [0.7, 1.2, 0.01] },
  neochord: { length: [5, 40, 0.5] },
  chord_add: { length: [5, 40, 0.5] },
  chord_length: { length: [3, 45, 0.1] },
  clip: { position: [-1, 1, 0.05], angle: [-45, 45, 5], width: [4, 12, 0.5] },
  resect: { position: [-1, 1, 0.05], width: [2, 20, 0.5], depth: [2, 15, 0.5] },
  patch: { width: [4, 25, 0.5], height: [3, 18, 0.5] },
};

/** Positions along a scallop grow to the left of the surgeon's view: so do their sliders. */
const isPosition = (kind: string, name: string): boolean =>
  name === 'position' && (kind === 'clip' || kind === 'resect');

export interface FieldProps {
  kind: string;
  field: FieldInfo;
  label?: string;
}

export function labelOf({ field, label }: FieldProps): string {
  return label ?? (field.label || field.name);
}

/** The tooltip of a field, with the value that an empty one stands for where that has a unit. */
export function tipOf({ kind, field }: FieldProps): string {
  const { unit, scale } = shownUnit(field);
  const value = fallbackOf(field);
  const plain = value === undefined || !unit || (!Number.isFinite(field.fallbackValue) && scale === 1);
  const usual = plain ? '' : `${+(value * scale).toPrecision(3)} ${unit}`;
  return fieldTip(kind, field.name, field.help, usual);
}

/** Present length of the chord in the form, for "18.2 mm, was 20.4". */
function restOfChord(): number | null {
  const id = state.draft.value?.fields.chord;
  return state.main.value?.figures.chords.find((chord) => chord.id === id)?.rest ?? null;
}

/** The value of an empty field; "0, the middle" is 0. Only plain numbers, and zero, are free of units. */
function fallbackOf(field: FieldInfo): number | undefined {
  if (!field.fallback) return undefined;
  const value = Number.isFinite(field.fallbackValue)
    ? field.fallbackValue
    : field.unit && !/^0\b(?!\.)/.test(field.fallback)
      ? NaN
      : parseFloat(field.fallback);
  return Number.isFinite(value) ? value : undefined;
}

/** A number as it stands in its box; the present length of a chord as its card says it. */
function textOf(value: number | undefined, scale: number, present: number | null): string {
  if (value === undefined) return '';
  return value === present ? figure(value) : String(+(value * scale).toPrecision(6));
}

/** How far the previewed clip is from the middle, in words of the plan; null until its preview is shown. */
function previewedPlace(): string | null {
  if (state.outdated.value) return null;
  const title = state.preview.value && titlesOf(state.preview.value.figures).at(-1);
  return title ? clipPlaceIn(title) : null;
}

/** Whether the chord that the preview adds carries nothing. */
const isSlack = (): boolean => !state.outdated.value && (state.added.value?.strain ?? 1) <= 0;

/** The length of the previewed band, mm; null until its preview is shown. */
function previewedBand(): number | null {
  const curve = state.preview.value && ringCurves(state.preview.value.picture).at(-1);
  if (!curve || state.outdated.value) return null;
  return curve.slice(1).reduce((sum, point, k) => {
    const [a, b] = [curve[k], point];
    return sum + Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }, 0);
}

/** The side of the middle on which a position lies. */
function Side({ sense, value }: { sense: Signal<number>; value: number }) {
  return (
    <span class="number towards">
      <select
        aria-label={formTexts.side}
        title={formTexts.towardsTip}
        value={String(sense.value)}
        onChange={({ currentTarget }) => {
          sense.value = +currentTarget.value;
          if (value) setField('position', sense.value * Math.abs(value));
        }}
      >
        {[1, -1].map((side, k) => (
          <option value={String(side)}>{formTexts.towards[k]}</option>
        ))}
      </select>
    </span>
  );
}

/** A sentence on a ring that is wider than the annulus by more than its width is known. */
function Oversized({ size }: { size: number }) {
  const annulus = state.main.value?.figures.measures.annulusCc ?? NaN;
  if (!(size > oversized * annulus)) return null;
  return (
    <small class="warn" data-testid="oversized">
      {formTexts.oversized(size - annulus)}
    </small>
  );
}

/** What the size of a ring is compared with: the annulus, and by how much the ring is narrower than that. */
function sizeWords(size: number, largest: number): string {
  const annulus = state.main.value?.figures.measures.annulusCc ?? NaN;
  const words = formTexts.sizeFrom(annulus);
  return annulus > size ? `${words} ${formTexts.narrower(size, annulus, size === largest)}` : words;
}

/** Sizes of rings go by 2 mm, about 5 %: the nearest size above the annulus is none too large. */
const oversized = 1.05;

export function NumberField(props: FieldProps) {
  const { kind, field } = props;
  const value = state.draft.value?.fields[field.name] as number | undefined;
  const { unit, scale } = shownUnit(field);
  const range = sliders[kind]?.[field.name];
  const rest = kind === 'chord_length' && field.name === 'length' ? restOfChord() : null;
  const given = fallbackOf(field);
  const fallback = field.name === 'length' ? (state.added.value?.rest ?? given) : given;
  const set = (number: number | undefined) =>
    setField(field.name, number === undefined ? undefined : number / scale);
  const noNumber = useSignal('');
  const shown = value ?? (range ? fallback : undefined);
  const position = isPosition(kind, field.name);
  const text = textOf(position && value ? Math.abs(value) : value, scale, rest);
  const low = rest ? +(0.4 * rest).toFixed(1) : range?.[0];
  const high = rest ? +(1.6 * rest).toFixed(1) : range?.[1];
  const slider = (of: number) => (position ? -of : of) * scale;
  // of a position the box has the distance from the middle, and words beside it have the side
  const sense = useSignal(1);
  if (position && value) sense.value = Math.sign(value);
  /** Takes the number of the box. */
  const take = (number: number | undefined) =>
    set(position && sense.value < 0 && number !== undefined ? -number : number);
  // a number that is refused says so beside Apply
  const refused = isOutside(field, value);
  const beyond = value !== undefined && !!range && !refused && (value < low! || value > high!);
  return (
    <div class="field" title={tipOf(props)}>
      <label for={`f-${field.name}`}>{labelOf(props)}</label>
      <div class="number">
        {range && (
          <span class="slide">
            <input
              type="range"
              class={beyond ? 'beyond' : undefined}
              aria-label={labelOf(props)}
              aria-valuetext={position ? formTexts.position(shown ?? 0) : undefined}
              min={slider(position ? high! : low!)}
              max={slider(position ? low! : high!)}
              step={range[2] * scale}
              value={slider(shown ?? (low! + high!) / 2)}
              onInput={({ currentTarget: { value: text } }) => set(position ? 0 - +text : +text)}
            />
            <SliderEnds
              ends={position ? formTexts.sides : [low!, high!].map((end) => +(end * scale).toPrecision(4))}
            />
          </span>
        )}
        <DecimalBox
          id={`f-${field.name}`}
          text={text}
          placeholder={
            fallback !== undefined
              ? String(+(fallback * scale).toPrecision(3))
              : field.fallback
                ? formTexts.auto
                : ''
          }
          step={Math.min(1, (range?.[2] ?? 1) * scale)}
          eager
          onTake={take}
          onRefuse={(sentence) => (noNumber.value = sentence)}
        />
        <span class="unit">{unit}</span>
      </div>
      {noNumber.value && (
        <small class="warn" role="alert">
          {noNumber.value}
        </small>
      )}
      {position && <Side sense={sense} value={value ?? 0} />}
      {kind === 'ring' && field.name === 'size' && <small>{sizeWords(shown ?? high!, high!)}</small>}
      {beyond && (
        <small class="warn" role="status" data-testid="beyond">
          {kind === 'ring' && formTexts.ringSizes(low!, high!)}
          {formTexts.beyond(value * scale, low! * scale, high! * scale, unit)}
        </small>
      )}
      {kind === 'ring' && field.name === 'size' && <Oversized size={value ?? NaN} />}
      {kind === 'band' && field.name === 'factor' && <small>{formTexts.bandLength(previewedBand())}</small>}
      {position && <small>{formTexts.position(value ?? 0)}</small>}
      {position && kind === 'clip' && <small>{formTexts.placed(previewedPlace())}</small>}
      {rest !== null && value !== undefined && !refused && <small>{formTexts.change(rest, value)}</small>}
      {(kind === 'chord_add' || kind === 'neochord') && field.name === 'length' && isSlack() && (
        <small class="warn">{formTexts.slack}</small>
      )}
      {value === undefined &&
        field.fallback &&
        !rest &&
        !position &&
        !Number.isFinite(field.fallbackValue) && <small>{formTexts.leftEmpty(field.fallback)}</small>}
    </div>
  );
}
