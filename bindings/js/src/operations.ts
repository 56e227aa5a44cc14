// Surgical operations by name: their fields are written by the schema that the library itself
// describes (mvs_get_op_field), so that a new operation needs no code here.
import type { ArrayInput } from "./arrays.js";
import { refuse } from "./error.js";
import { SiteKind } from "./generated/enums.js";
import type { Functions } from "./generated/functions.js";
import type { FieldInfo, OperationValues } from "./generated/structs.js";
import type { Arena } from "./heap.js";
import { big, enumNumber, layoutOf, real, whole, writeArray } from "./layout.js";
import type { Operation } from "./calls.js";

/** A part by its name ("A2/7") or id. */
export type PartRef = string | bigint;
/** A place on a leaflet: a node, a place in a triangle, or a place in a scallop. */
export type Site =
  | { node: number }
  | { triangle: number; u: ArrayLike<number> }
  | { scallop: PartRef; u: ArrayLike<number> };
/** "chord_length" and the others. */
export type OperationName = keyof OperationValues;
/** The fields of an operation: those of its name, any where the name is not known before the program runs. */
export type FieldsOf<N extends string> = N extends OperationName ? OperationValues[N] : OperationFields;
/** A name of an operation, or a text that is not known before the program runs. */
export type NameOf<N extends string> = N & (string extends N ? unknown : OperationName);
/** Values of the fields of an operation, by their names; those left out take their defaults. */
export type OperationFields = Record<string, number | string | bigint | PartRef | Site | ArrayInput | null | undefined>;

/** A field of an operation, for forms. */
export interface OperationField extends FieldInfo {
  /** The words of a choice. */
  words: Readonly<Record<string, number>>;
}
/** An operation, for forms. */
export interface OperationInfo {
  readonly name: string;
  readonly help: string;
  readonly number: number;
  readonly size: number;
  readonly fields: readonly Readonly<OperationField>[];
}

type FindPart = (kind: "chord" | "head" | "scallop", name: string) => bigint;

const wordsOf = (choices: string): Record<string, number> =>
  Object.fromEntries(choices.split(" ").filter(Boolean).map((pair) => {
    const [word, number] = pair.split("=");
    return [word!, Number(number)];
  }));

/** Reads all operations with their fields from the library. */
export function readSchema(c: Functions): readonly OperationInfo[] {
  return frozen(Array.from({ length: c.mvs_get_op_count() }, (_, index) => {
    const info = c.mvs_get_op_info(index);
    const fields = Array.from({ length: info.fields }, (_, k) => {
      const field = c.mvs_get_op_field(index, k);
      return { ...field, words: wordsOf(field.choices) };
    });
    const number = enumNumber("mvs_op_kind", info.kind, "kind");
    return { name: info.name, help: info.help, number, size: info.size, fields };
  }));
}

// Freezes a value with all its parts: operations are written by this table, which must not change.
function frozen<T extends object>(value: T): T {
  for (const part of Object.values(value)) if (typeof part === "object" && part !== null) frozen(part as object);
  return Object.freeze(value);
}

// Fields that state what 0 means although it is outside of their range.
const zeroCounts = new Set(["resect.base_width"]);

// In operations 0 stands for a value that is not given, unless 0 is within the range of the field.
function replacesZero(operation: string, field: OperationField): boolean {
  if (zeroCounts.has(`${operation}.${field.name}`)) return false;
  return (field.type === "number" || field.type === "count") && !(field.low <= 0 && field.high >= 0);
}

/** Writes operations with the parts of one valve. */
export class OperationWriter {
  constructor(
    private readonly schema: readonly OperationInfo[],
    private readonly find: FindPart,
  ) {}

  /** An operation for mvs_check_op and mvs_apply_op. */
  make(name: string, given: object): Operation {
    const values = given as OperationFields;
    const info = this.schema.find((one) => one.name === name);
    if (!info) return refuse("operation", `no operation is called ${name}; there are ${this.schema.map((one) => one.name).join(", ")}`);
    if (typeof values !== "object" || values === null) refuse("fields", `fields is ${String(values)}: it has to be an object with the fields of ${name}`);
    for (const key of Object.keys(values)) {
      if (!info.fields.some((field) => field.name === key)) {
        refuse(`${name}.${key}`, `${name} has no field ${key}; its fields are ${info.fields.map((field) => field.name).join(", ")}`);
      }
    }
    return {
      write: (arena) => {
        const at = arena.zeroed(info.size);
        arena.heap.view.setUint32(at, info.size, true);
        arena.heap.view.setUint32(at + 4, info.number, true);
        for (const field of info.fields) {
          const value = values[field.name];
          if (value === 0 && replacesZero(name, field)) {
            refuse(`${name}.${field.name}`, `${name}.${field.name} is 0, which would be taken for its default: leave it out for the default`);
          }
          if (value !== undefined && value !== null) this.field(arena, field, at + field.offset, value, `${name}.${field.name}`);
        }
        return at;
      },
    };
  }

  private field(arena: Arena, field: OperationField, at: number, value: unknown, what: string): void {
    const { view } = arena.heap;
    switch (field.type) {
      case "number":
        view.setFloat64(at, real(value, what), true);
        return;
      case "count":
        view.setUint32(at, whole(value, what), true);
        return;
      case "choice":
        view.setUint32(at, this.choice(field, value, what), true);
        return;
      case "chord":
      case "head":
      case "scallop":
        view.setBigUint64(at, this.part(field.type, value, what), true);
        return;
      case "site":
        this.site(arena, at, value, what);
        return;
      case "point":
        this.numbers(arena, at, value, 3, what);
        arena.heap.view.setUint32(at + 24, 1, true);
        return;
      case "vector":
        this.numbers(arena, at, value, 3, what);
        return;
      case "points":
        writeArray(arena, at, value as ArrayInput, 3, "F64", what);
        return;
      case "text": {
        const address = arena.text(value as string, what);
        arena.heap.view.setUint32(at, address, true);
        return;
      }
      default:
        refuse(what, `${what} is of the type ${String(field.type)}, which this package does not know: use a newer one`);
    }
  }

  private choice(field: OperationField, value: unknown, what: string): number {
    if (typeof value === "number") return whole(value, what);
    const found = typeof value === "string" && Object.hasOwn(field.words, value) ? field.words[value] : undefined;
    return found ?? refuse(what, `${what} is ${JSON.stringify(value)}: it has to be one of ${Object.keys(field.words).join(", ")}`);
  }

  private part(kind: "chord" | "head" | "scallop", value: unknown, what: string): bigint {
    return typeof value === "string" ? this.find(kind, value) : big(value, what);
  }

  private numbers(arena: Arena, at: number, value: unknown, count: number, what: string): void {
    const list = value as ArrayLike<number>;
    if (typeof value !== "object" || value === null || list.length !== count) {
      refuse(what, `${what} has to be an array of ${count} numbers`);
    }
    for (let k = 0; k < count; ++k) arena.heap.view.setFloat64(at + 8 * k, real(list[k], what), true);
  }

  private site(arena: Arena, at: number, value: unknown, what: string): void {
    if (typeof value !== "object" || value === null) refuse(what, `${what} has to be { node }, { triangle, u } or { scallop, u }`);
    const site = value as { node?: unknown; triangle?: unknown; scallop?: unknown; u?: ArrayLike<number> };
    const { view } = arena.heap;
    const given = ["node", "triangle", "scallop"].filter((key) => key in site);
    if (given.length !== 1) refuse(what, `${what} has to be { node }, { triangle, u } or { scallop, u }`);
    const wrong = Object.keys(site).find((key) => key !== given[0] && !(key === "u" && given[0] !== "node"));
    if (wrong !== undefined) refuse(`${what}.${wrong}`, `${what} has no field ${wrong}: it has to be { node }, { triangle, u } or { scallop, u }`);
    const how = given[0] === "node" ? SiteKind.node : given[0] === "triangle" ? SiteKind.triangle : SiteKind.anatomical;
    view.setUint32(at, how, true);
    if (how === SiteKind.anatomical) view.setBigUint64(at + 8, this.part("scallop", site.scallop, `${what}.scallop`), true);
    else view.setUint32(at + 4, whole(how === SiteKind.node ? site.node : site.triangle, what), true);
    if (how !== SiteKind.node) {
      const u = site.u;
      const wanted = how === SiteKind.triangle ? 3 : 2;
      if (typeof u !== "object" || u === null || u.length !== wanted) refuse(`${what}.u`, `${what}.u has to be an array of ${wanted} numbers`);
      this.numbers(arena, at + layoutOf("mvs_site").fields.find((field) => field.name === "u")!.at, u, wanted, `${what}.u`);
    }
  }
}
