// Fields that take a list of points: the outline of a resection, drawn in the picture, and the measured curve of a
// ring, read from a file.
import { PenLine } from 'lucide-preact';
import { setField } from '../store/edit';
import * as state from '../store/state';
import { fewestPoints, fieldTips, pointTexts } from '../text/texts';
import type { FieldInfo } from '../protocol';
import { beginOutline, removeOutlinePoint, useOutline } from '../view/outline';
import { Button } from './parts';

/** Rows of three numbers of a text file, whatever stands around them: xyz, csv, the vertices of an OBJ. */
export function readPoints(text: string): number[][] {
  const rows = [];
  for (const line of text.split(/\r?\n/)) {
    const words = line
      .trim()
      .replace(/^v\s+/i, '')
      .split(/[\s,;]+/);
    const numbers = words.map(Number);
    if (words.length >= 3 && numbers.slice(0, 3).every(Number.isFinite)) rows.push(numbers.slice(0, 3));
  }
  return rows;
}

/** A curve in mm: files in metres span less than a millimetre's number of units. */
export function inMillimetres(points: number[][]): number[][] {
  const span = Math.max(...[0, 1, 2].map((c) => range(points.map((p) => p[c]))));
  return span < 1 ? points.map((p) => p.map((v) => 1000 * v)) : points;
}

const range = (values: number[]): number => Math.max(...values) - Math.min(...values);

function Outline() {
  const drawing = state.picking.value === 'outline';
  const given = state.draft.value?.fields.outline as number[][] | undefined;
  if (!drawing)
    return (
      <div class="field" title={fieldTips.resect.outline}>
        <Button icon={<PenLine size={16} />} onClick={beginOutline}>
          {given ? pointTexts.drawAgain : pointTexts.draw}
        </Button>
        {given && <small data-testid="outlined">{pointTexts.outlined(state.outlineOn.value)}</small>}
      </div>
    );
  const count = state.outline.value.length;
  return (
    <div class="field" data-testid="outline">
      <div class="row">
        <Button kind="main" disabled={count < 2} onClick={useOutline}>
          {pointTexts.use}
        </Button>
        <Button disabled={!count} onClick={removeOutlinePoint}>
          {pointTexts.back}
        </Button>
      </div>
      <small>{pointTexts.count(count, state.outlineOn.value)}</small>
      {state.outlineRefusal.value && (
        <small class="warn" role="alert">
          {state.outlineRefusal.value}
        </small>
      )}
      <small>{pointTexts.keys}</small>
    </div>
  );
}

function Curve({ field }: { field: FieldInfo }) {
  const given = state.draft.value?.fields[field.name] as number[][] | undefined;
  const read = async (file: File) => {
    const points = inMillimetres(readPoints(await file.text()));
    if (points.length < fewestPoints)
      state.draftMessage.value = pointTexts.fewPoints(file.name, points.length);
    else setField(field.name, points);
  };
  return (
    <div class="field" title={fieldTips.ring.curve}>
      <label for={`f-${field.name}`}>{pointTexts.curve}</label>
      <input
        id={`f-${field.name}`}
        type="file"
        accept=".txt,.csv,.xyz,.obj"
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file) void read(file);
        }}
      />
      {given ? (
        <div class="row">
          <small>{pointTexts.curveRead(given.length)}</small>
          <Button kind="quiet" onClick={() => setField(field.name, undefined)}>
            {pointTexts.remove}
          </Button>
        </div>
      ) : (
        <small>{pointTexts.curveHint}</small>
      )}
    </div>
  );
}

export function PointsField({ kind, field }: { kind: string; field: FieldInfo }) {
  if (kind === 'resect' && field.name === 'outline') return <Outline />;
  if (kind === 'ring' && field.name === 'curve') return <Curve field={field} />;
  return null;
}
