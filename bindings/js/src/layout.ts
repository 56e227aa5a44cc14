// Reads and writes structs of the C interface by their layouts on wasm32.
import { ArrayView, typed, type ArrayInput } from "./arrays.js";
import { MvsError, refuse } from "./error.js";
import { enums, Solver, ValveFlags } from "./generated/enums.js";
import { layouts } from "./generated/structs.js";
import type { Arena, Heap } from "./heap.js";

export interface Field {
  name: string;
  kind: string;
  at: number;
  of?: string;
  length?: number;
  count?: number;
  stride?: number;
  components?: number;
  element?: string;
  user?: number;
  /** C takes a 0 for the default: always, or with the explicit solver. */
  zero?: string;
  /** 0 or 1: false and true do as well. */
  flag?: boolean;
}
export interface Layout {
  size: number;
  sized: boolean;
  fields: Field[];
}

/** Kinds of fields that null leaves out. */
const nullable = new Set(["text", "callback"]);

/** Stores a callback of a struct and returns the address of its C function and the user pointer. */
export type KeepCallback = (kind: string, callback: unknown) => { address: number; user: number };

export function layoutOf(name: string): Layout {
  const layout = layouts[name];
  if (!layout) throw new MvsError("MVS_E_INTERNAL", name, `no layout of ${name} is known`);
  return layout;
}

/** The number of a word of an enumeration, or the number itself. */
export function enumNumber(of: string, value: unknown, what: string): number {
  if (typeof value === "number") return whole(value, what);
  const words = enums[of] ?? {};
  const found = typeof value === "string" && Object.hasOwn(words, value) ? words[value] : undefined;
  if (found !== undefined) return found;
  return refuse(what, `${what} is ${JSON.stringify(value)}: it has to be one of ${Object.keys(words).join(", ")}`);
}

/** The word of a number of an enumeration; the number itself where it has none. */
export function enumWord(of: string, number: number): string | number {
  for (const [word, value] of Object.entries(enums[of] ?? {})) if (value === number) return word;
  return number;
}

export function real(value: unknown, what: string): number {
  if (typeof value !== "number") return refuse(what, `${what} is not a number but ${typeof value}`);
  return value;
}

export function whole(value: unknown, what: string, low = 0, high = 0xffffffff): number {
  const number = real(value, what);
  if (!Number.isInteger(number) || number < low || number > high) {
    refuse(what, `${what} is ${number}: it has to be a whole number from ${low} to ${high}`);
  }
  return number;
}

export function big(value: unknown, what: string): bigint {
  const number = typeof value === "number" && Number.isSafeInteger(value) ? BigInt(value) : value;
  if (typeof number !== "bigint" || number < 0n || number > 0xffffffffffffffffn) {
    return refuse(what, `${what} is ${String(value)}: it has to be a bigint or a whole number from 0`);
  }
  return number;
}

function writeNumbers(heap: Heap, field: Field, at: number, value: unknown, what: string): void {
  const list = value as ArrayLike<number>;
  if (typeof value !== "object" || value === null || typeof list.length !== "number") {
    refuse(what, `${what} is not an array of numbers`);
  }
  if (list.length > field.length!) refuse(what, `${what} has ${list.length} numbers: at most ${field.length} fit`);
  for (let k = 0; k < list.length; ++k) writeScalar(heap, field.kind, at, k, list[k], what);
}

const widths: Record<string, number> = { u8: 1, u32: 4, i32: 4, u64: 8, f64: 8 };

export function writeScalar(heap: Heap, kind: string, at: number, index: number, value: unknown, what: string): void {
  const address = at + index * widths[kind]!;
  if (kind === "f64") heap.view.setFloat64(address, real(value, what), true);
  else if (kind === "u64") heap.view.setBigUint64(address, big(value, what), true);
  else if (kind === "u8") heap.view.setUint8(address, whole(value, what, 0, 255));
  else if (kind === "i32") heap.view.setInt32(address, whole(value, what, -0x80000000, 0x7fffffff), true);
  else heap.view.setUint32(address, whole(value, what), true);
}

export function readScalar(heap: Heap, kind: string, at: number, index = 0): number | bigint {
  const address = at + index * widths[kind]!;
  if (kind === "f64") return heap.view.getFloat64(address, true);
  if (kind === "u64") return heap.view.getBigUint64(address, true);
  if (kind === "u8") return heap.view.getUint8(address);
  if (kind === "i32") return heap.view.getInt32(address, true);
  return heap.view.getUint32(address, true);
}

/** Writes an mvs_array that points to a copy of `input` in the arena. */
export function writeArray(arena: Arena, at: number, input: ArrayInput, components: number, element: string, what: string): void {
  const { data, type } = typed(input, components, element, what);
  if (data.length % components !== 0) {
    refuse(what, `${what} has ${data.length} numbers: they have to form rows of ${components}`);
  }
  const address = arena.bytes(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
  const { view } = arena.heap;
  view.setUint32(at, address, true);
  view.setBigUint64(at + 8, BigInt(data.length / components), true);
  view.setUint32(at + 16, components, true);
  view.setUint32(at + 20, type, true);
  view.setBigUint64(at + 24, 0n, true);
}

/** Reads an mvs_view. */
export function readView(heap: Heap, at: number): ArrayView {
  const { view } = heap;
  return new ArrayView(heap, view.getUint32(at, true), Number(view.getBigUint64(at + 8, true)),
    view.getUint32(at + 16, true), view.getUint32(at + 20, true), Number(view.getBigUint64(at + 24, true)));
}

/** Writes structs and the arrays and texts that they point to, in an arena. */
export class StructWriter {
  constructor(
    private readonly arena: Arena,
    private readonly keep: KeepCallback,
  ) {}

  /** Writes a new struct and returns its address. */
  make(name: string, value: unknown, what: string): number {
    const { size } = layoutOf(name);
    const at = this.arena.zeroed(size);
    this.write(name, at, value, what);
    return at;
  }

  write(name: string, at: number, value: unknown, what: string): void {
    const layout = layoutOf(name);
    if (typeof value !== "object" || value === null) refuse(what, `${what} is not an object but ${String(value)}`);
    const known = new Set(layout.fields.map((field) => field.name));
    for (const key of Object.keys(value as object)) {
      if (!known.has(key)) refuse(`${what}.${key}`, `${what} has no field ${key}; its fields are ${[...known].join(", ")}`);
    }
    if (layout.sized) this.arena.heap.view.setUint32(at, layout.size, true);
    for (const field of layout.fields) {
      const given = (value as Record<string, unknown>)[field.name];
      if (given === undefined) continue;
      const name = `${what}.${field.name}`;
      if (given === null) {
        if (!nullable.has(field.kind)) refuse(name, `${name} is null: leave it out for its default`);
        continue;
      }
      if (given === 0 && field.zero) this.zero(field, value as Record<string, unknown>, name);
      this.field(field, at, given, name);
    }
  }

  // A 0 that C would silently replace by the default.
  private zero(field: Field, value: Record<string, unknown>, name: string): void {
    const { solver, flags } = value;
    const isBending = field.name === "bending_scale";
    if (isBending && typeof flags === "number" && flags & ValveFlags.flag_no_bending) return;
    if (field.zero === "explicit" && solver !== "explicit" && solver !== Solver.explicit) return;
    const remedy = isBending ? ", or give flags: ValveFlags.flag_no_bending for leaflets that do not bend" : "";
    refuse(name, `${name} is 0, which would be taken for its default: leave it out for the default${remedy}`);
  }

  private field(field: Field, base: number, value: unknown, what: string): void {
    const { heap } = this.arena;
    const at = base + field.at;
    switch (field.kind) {
      case "enum":
        heap.view.setUint32(at, enumNumber(field.of!, value, what), true);
        return;
      case "text": {
        const address = this.arena.text(value as string, what);
        heap.view.setUint32(at, address, true);
        return;
      }
      case "array":
        writeArray(this.arena, at, value as ArrayInput, field.components!, field.element!, what);
        return;
      case "struct":
        this.write(field.of!, at, value, what);
        return;
      case "structs":
        this.list(field.of!, value, what).forEach((number, k) => heap.view.setUint32(base + [field.at, field.count!, field.stride!][k]!, number, true));
        return;
      case "texts": {
        const texts = this.must(value, what).map((text, k) => this.arena.text(text as string, `${what}[${k}]`));
        const address = this.arena.zeroed(4 * texts.length);
        texts.forEach((text, k) => heap.view.setUint32(address + 4 * k, text, true));
        heap.view.setUint32(at, address, true);
        heap.view.setUint32(base + field.count!, texts.length, true);
        return;
      }
      case "ids": {
        const ids = this.must(value, what).map((id, k) => big(id, `${what}[${k}]`));
        const address = this.arena.zeroed(8 * ids.length);
        ids.forEach((id, k) => heap.view.setBigUint64(address + 8 * k, id, true));
        heap.view.setUint32(at, address, true);
        return;
      }
      case "callback": {
        const kept = this.keep(field.of!, value);
        heap.view.setUint32(at, kept.address, true);
        heap.view.setUint32(base + field.user!, kept.user, true);
        return;
      }
      default:
        if (field.flag && typeof value === "boolean") writeScalar(heap, field.kind, at, 0, Number(value), what);
        else if (field.length) writeNumbers(heap, field, at, value, what);
        else writeScalar(heap, field.kind, at, 0, value, what);
    }
  }

  private must(value: unknown, what: string): unknown[] {
    return Array.isArray(value) ? (value as unknown[]) : refuse(what, `${what} is not an array`);
  }

  /** Writes an array of structs: its address, count and stride. */
  list(name: string, value: unknown, what: string): [number, number, number] {
    const rows = this.must(value, what);
    const { size } = layoutOf(name);
    const address = this.arena.zeroed(size * rows.length);
    rows.forEach((row, k) => this.write(name, address + k * size, row, `${what}[${k}]`));
    return [address, rows.length, size];
  }
}

/** Reads a struct. Texts are copied; arrays are views. */
export function readStruct(heap: Heap, name: string, at: number): Record<string, unknown> {
  const read: Record<string, unknown> = {};
  for (const field of layoutOf(name).fields) read[field.name] = readField(heap, field, at + field.at);
  return read;
}

function readField(heap: Heap, field: Field, at: number): unknown {
  switch (field.kind) {
    case "enum":
      return enumWord(field.of!, heap.view.getUint32(at, true));
    case "text":
      return heap.text(heap.view.getUint32(at, true));
    case "chars":
      return heap.text(at);
    case "view":
      return readView(heap, at);
    case "struct": {
      if (!field.length) return readStruct(heap, field.of!, at);
      const { size } = layoutOf(field.of!);
      return Array.from({ length: field.length }, (_, k) => readStruct(heap, field.of!, at + k * size));
    }
    case "address":
      return heap.view.getUint32(at, true);
    default:
      if (!field.length) return readScalar(heap, field.kind, at);
      return Array.from({ length: field.length }, (_, k) => readScalar(heap, field.kind, at, k));
  }
}
