// Fields of operations: a part of the valve, a place on a leaflet, a choice, a direction, a text; numbers are in number.tsx.
import { Crosshair } from 'lucide-preact';
import { pickField, setField } from '../store/edit';
import * as state from '../store/state';
import { choiceWords, formTexts, tips, tipTexts } from '../text/texts';
import type { FieldValue, Site } from '../protocol';
import { Button, SliderEnds } from './parts';
import { labelOf, NumberField, tipOf, type FieldProps } from './number';
import { PointsField } from './points';

export function Field(props: FieldProps) {
  const { field } = props;
  if (field.type === 'number' || field.type === 'count') return <NumberField {...props} />;
  if (field.type === 'chord' || field.type === 'head' || field.type === 'scallop')
    return <PartField {...props} />;
  if (field.type === 'site') return <SiteField {...props} />;
  if (field.type === 'choice') return <ChoiceField {...props} />;
  if (field.type === 'vector') return <VectorField {...props} />;
  if (field.type === 'points') return <PointsField {...props} />;
  return <TextField {...props} />;
}

function PickButton(props: FieldProps) {
  const { field } = props;
  const on = state.picking.value === field.name;
  return (
    <Button
      kind="quiet"
      pressed={on}
      icon={<Crosshair size={16} />}
      label={formTexts.pick(labelOf(props))}
      title={tipTexts.pick}
      onClick={() => pickField(on ? null : field.name)}
    />
  );
}

function PartField(props: FieldProps) {
  const { field } = props;
  const topology = state.main.value && state.topologyOf(state.main.value.picture);
  const parts =
    field.type === 'chord' ? topology?.chords : field.type === 'head' ? topology?.heads : topology?.scallops;
  const value = state.draft.value?.fields[field.name] as string | undefined;
  return (
    <div class="field" title={tipOf(props)}>
      <label for={`f-${field.name}`}>{labelOf(props)}</label>
      <div class="number">
        <select
          id={`f-${field.name}`}
          value={value ?? ''}
          onChange={(event) => setField(field.name, event.currentTarget.value || undefined)}
        >
          <option value="">{field.required ? formTexts.choose : field.fallback || formTexts.none}</option>
          {parts?.map((part) => (
            <option value={part.id}>{part.name}</option>
          ))}
        </select>
        <PickButton {...props} />
      </div>
    </div>
  );
}

/** Where a place on a scallop begins, as a share of the way from annulus to free edge: near the edge, where chordae are tied. A patch,
 *  whose middle it is, begins in the middle: its 8 mm reach over the edge from elsewhere. */
const firstHeight = (kind: string): number => (kind === 'patch' ? 0.5 : 0.9);

/** A place on a leaflet: by a click, or by scallop and two shares for the keyboard. */
function SiteField(props: FieldProps) {
  const { field, kind } = props;
  const topology = state.main.value && state.topologyOf(state.main.value.picture);
  const value = state.draft.value?.fields[field.name] as Site | undefined;
  const scallopOf = () => {
    if (!value || !topology) return '';
    return 'triangle' in value
      ? topology.scallops[topology.triangleScallop[value.triangle]].id
      : value.scallop;
  };
  const first = { scallop: scallopOf(), along: 0.5, height: firstHeight(kind) };
  const place = value && !('triangle' in value) ? value : first;
  const set = (change: Partial<{ scallop: string; along: number; height: number }>) => {
    const next = { ...place, ...change };
    setField(field.name, next.scallop ? next : undefined);
  };
  const name = topology?.scallops.find((part) => part.id === scallopOf())?.name;
  return (
    <div class="field" title={tipOf(props)}>
      <label for={`f-${field.name}`}>{labelOf(props)}</label>
      <div class="number">
        <select
          id={`f-${field.name}`}
          value={scallopOf()}
          onChange={(event) => set({ scallop: event.currentTarget.value })}
        >
          <option value="">{formTexts.choose}</option>
          {topology?.scallops.map((part) => (
            <option value={part.id}>{part.name}</option>
          ))}
        </select>
        <PickButton {...props} />
      </div>
      {value && 'triangle' in value && <small>{formTexts.picked(name ?? '')}</small>}
      {value && !('triangle' in value) && (
        <>
          <label class="slider">
            <span>{formTexts.along(Math.round(100 * value.along))}</span>
            <input
              type="range"
              title={tips[formTexts.alongTip]}
              min="-1"
              max="0"
              step="0.05"
              value={-value.along}
              aria-valuetext={formTexts.along(Math.round(100 * value.along))}
              onInput={(event) => set({ along: Math.abs(+event.currentTarget.value) })}
            />
            <SliderEnds ends={formTexts.sides} />
          </label>
          <label class="slider">
            <span>{formTexts.height(Math.round(100 * value.height))}</span>
            <input
              type="range"
              title={tips[formTexts.heightTip]}
              min="0.1"
              max="1"
              step="0.05"
              value={value.height}
              onInput={(event) => set({ height: +event.currentTarget.value })}
            />
          </label>
        </>
      )}
    </div>
  );
}

function ChoiceField(props: FieldProps) {
  const { field } = props;
  const value = state.draft.value?.fields[field.name] as number | undefined;
  return (
    <div class="field" title={tipOf(props)}>
      <label for={`f-${field.name}`}>{labelOf(props)}</label>
      <select
        id={`f-${field.name}`}
        value={value === undefined ? '' : String(value)}
        onChange={(event) =>
          setField(field.name, event.currentTarget.value === '' ? undefined : +event.currentTarget.value)
        }
      >
        <option value="">{field.fallback || formTexts.default}</option>
        {field.choices.map((choice) => (
          <option value={choice.value}>{choiceWords[choice.name] ?? choice.name.replace(/_/g, ' ')}</option>
        ))}
      </select>
    </div>
  );
}

/** The choice of a frame that stands for the axes of the file, as in the library's table. */
const sceneFrame = 0;
/** The axis from side to side grows to the left of the surgeon's view: so does its slider. */
const crossAxis = 1;

function VectorField(props: FieldProps) {
  const { field } = props;
  const value = (state.draft.value?.fields[field.name] as [number, number, number] | undefined) ?? [0, 0, 0];
  const anatomical = state.draft.value?.fields.frame !== sceneFrame;
  return (
    <fieldset class="field" title={tipOf(props)}>
      <legend>{labelOf(props)}</legend>
      {value.map((along, c) => {
        const sense = anatomical && c === crossAxis ? -1 : 1;
        const words = anatomical ? formTexts.shift(c, along) : formTexts.fileAxis(c, along);
        return (
          <label class="slider">
            <span>{words}</span>
            <input
              type="range"
              min="-10"
              max="10"
              step="0.5"
              value={sense * along || 0}
              aria-valuetext={words}
              onInput={(event) => {
                const next = [...value] as [number, number, number];
                next[c] = sense * +event.currentTarget.value || 0;
                setField(field.name, next as FieldValue);
              }}
            />
            {anatomical && <SliderEnds ends={formTexts.axisEnds[c]} />}
          </label>
        );
      })}
    </fieldset>
  );
}

function TextField(props: FieldProps) {
  const { field } = props;
  return (
    <div class="field" title={tipOf(props)}>
      <label for={`f-${field.name}`}>{labelOf(props)}</label>
      <input
        id={`f-${field.name}`}
        type="text"
        maxLength={60}
        placeholder={field.fallback}
        onChange={(event) => setField(field.name, event.currentTarget.value || undefined)}
      />
    </div>
  );
}
