// The library's table of operations in the units of the page, and fields of the page in those of the library.
import { MvsError, type Mvs } from 'libmvs';
import type { FieldValue, Operation, OperationInfo } from '../protocol';
import { refusals } from '../text/texts';
import { pageUnit } from './units';

export function operationsOf(mvs: Mvs): OperationInfo[] {
  return mvs.operations.map((operation) => ({
    name: operation.name,
    help: operation.help,
    fields: operation.fields.map((field) => {
      const { factor, unit } = pageUnit(field.unit);
      return {
        name: field.name,
        type: String(field.type),
        required: field.required === 1,
        low: field.low * factor,
        high: field.high * factor,
        unit,
        label: field.label,
        help: field.help,
        choices: Object.entries(field.words).map(([name, value]) => ({ name, value })),
        fallback: field.default_text,
        fallbackValue: field.default_value * factor,
      };
    }),
  }));
}

/** Fields of an operation in SI units, parts by their ids. */
export function libraryFields(mvs: Mvs, operation: Operation): Record<string, never> {
  const info = mvs.operations.find((candidate) => candidate.name === operation.kind);
  if (!info) throw new MvsError('MVS_E_OP', operation.kind, refusals.noOperation(operation.kind));
  const out: Record<string, unknown> = {};
  for (const [name, value] of Object.entries(operation.fields)) {
    const field = info.fields.find((candidate) => candidate.name === name);
    if (!field) throw new MvsError('MVS_E_OP', name, refusals.noField(operation.kind, name));
    out[name] = toLibrary(String(field.type), pageUnit(field.unit).factor, value);
  }
  return out as Record<string, never>;
}

function toLibrary(type: string, factor: number, value: FieldValue): unknown {
  if (type === 'chord' || type === 'head' || type === 'scallop') return BigInt(value as string);
  if (type === 'site') {
    const site = value as
      { triangle: number; u: number[] } | { scallop: string; along: number; height: number };
    return 'triangle' in site ? site : { scallop: BigInt(site.scallop), u: [site.along, site.height] };
  }
  if (typeof value === 'number') return type === 'number' ? value / factor : value;
  if (Array.isArray(value))
    return value.map((v) => (Array.isArray(v) ? v.map((w) => w / factor) : v / factor));
  return value;
}
