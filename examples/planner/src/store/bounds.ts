// The ranges of the numbers of a form, from the library's table in the units of the page: a number out of its range is refused here, in
// these units, and does not go to the library, which takes an optional 0 for an empty field.
import type { FieldInfo } from '../protocol';
import { formTexts, wordsOf } from '../text/texts';
import * as state from './state';

/** Names that hold shares, shown in per cent. */
const shares = new Set(['factor', 'ap', 'cc', 'ap_ratio', 'area_factor']);

/** The unit in which a field is shown, and its factor on the value: shares are shown in percent. */
export function shownUnit(field: FieldInfo): { unit: string; scale: number } {
  const isShare = (shares.has(field.name) || field.name === 'position') && field.unit === '';
  return isShare ? { unit: '%', scale: 100 } : { unit: field.unit, scale: 1 };
}

/** Relative: limits were turned into the units of the page. */
const rounding = 1e-9;

/** Whether a number is out of the range of its field. */
export function isOutside({ type, low, high }: FieldInfo, value: unknown): boolean {
  if (type !== 'number' || typeof value !== 'number') return false;
  const slack = rounding * Math.max(Math.abs(low), Math.abs(high));
  return value < low - slack || value > high + slack;
}

/** The refusal of the first number of a form that is out of its range; empty where there is none. */
export function rangeFault({ kind, fields }: state.Draft): string {
  const info = state.operationOf(kind);
  const field = info?.fields.find((candidate) => isOutside(candidate, fields[candidate.name]));
  if (!info || !field) return '';
  const label = wordsOf(kind, info.help).fields?.[field.name] ?? (field.label || field.name);
  const { unit, scale } = shownUnit(field);
  const [value, low, high] = [fields[field.name] as number, field.low, field.high].map((v) => scale * v);
  return formTexts.outside(label, value, low, high, unit);
}
