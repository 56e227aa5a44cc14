// Arrays of numbers into and out of the module.
import { refuse, MvsError } from "./error.js";
import type { Heap } from "./heap.js";

export type TypedArray = Float64Array | Float32Array | Uint32Array | BigUint64Array | Uint8Array;
/**
 * A typed array that must not be written to: it is memory that the snapshot shares with its simulator. `slice()` makes an
 * array of one's own.
 */
export type ReadonlyArrayOf<T extends TypedArray> = T extends TypedArray
  ? Omit<T, number | "copyWithin" | "fill" | "reverse" | "set" | "sort" | "subarray"> & {
      readonly [index: number]: T[number];
      subarray(begin?: number, end?: number): ReadonlyArrayOf<T>;
    }
  : never;
/** Numbers in rows one after the other, or rows of numbers. */
export type ArrayInput = ArrayLike<number> | ArrayLike<ArrayLike<number>>;

/** Receives one line of the log. */
export type LogCallback = (level: "error" | "warning" | "info" | "debug", text: string) => void;
/** Receives the completed share and the largest out-of-balance force, N; returning true cancels. */
export type ProgressCallback = (share: number, residual: number) => boolean | void;
/** Receives one fault of a valve. */
export type FaultCallback = (part: string, sentence: string) => void;

/** Element types by their numbers, mvs_type. */
const kinds = [
  undefined,
  { make: Float64Array, type: 1 },
  { make: Float32Array, type: 2 },
  { make: Uint32Array, type: 3 },
  { make: BigUint64Array, type: 4 },
  { make: Uint8Array, type: 5 },
] as const;

// The owner of each array that was handed out, so that the garbage collector does not release it before the array.
const owners = new WeakMap<object, object>();

/**
 * A read-only array of the library, without a copy: `values` looks into the memory of the module, and
 * is made anew after that has grown. Do not keep `values` across calls; keep this object. Never write to `values`:
 * the simulator has the same memory.
 */
export class ArrayView {
  private made: TypedArray | undefined;
  private owner: { readonly isDisposed: boolean } | undefined;

  /** The object whose memory this is: it is kept while this view or its values are. */
  ownedBy(owner: { readonly isDisposed: boolean }): this {
    this.owner = owner;
    return this;
  }

  /** Whether the owner of the array is still held. */
  isValid(): boolean {
    return !this.owner?.isDisposed;
  }

  constructor(
    private readonly heap: Heap,
    private readonly address: number,
    /** Rows. */
    readonly count: number,
    /** Numbers in a row. */
    readonly components: number,
    private readonly type: number,
    private readonly stride: number,
  ) {}

  get values(): ReadonlyArrayOf<TypedArray> {
    if (!this.isValid()) {
      throw new MvsError("MVS_E_STATE", "array", "the owner of this array was disposed of: copy what is needed longer");
    }
    if (!this.made || (this.made.buffer !== this.heap.buffer && this.made.length > 0) || this.made.byteLength === 0) {
      this.made = this.make();
      if (this.owner) owners.set(this.made, this.owner);
    }
    return this.made;
  }

  /** A copy with a buffer of its own, which may be transferred to another thread. */
  copy(): TypedArray {
    return this.values.slice() as TypedArray;
  }

  private make(): TypedArray {
    const kind = kinds[this.type];
    if (!kind) throw new MvsError("MVS_E_INTERNAL", "array", `an array is of the unknown type ${this.type}`);
    const { make } = kind;
    const length = this.count * this.components;
    if (length === 0) return new make(0);
    const row = this.components * make.BYTES_PER_ELEMENT;
    if (this.stride === row) return new make(this.heap.buffer as ArrayBuffer, this.address, length);
    const packed = new Uint8Array(this.count * row);
    for (let r = 0; r < this.count; ++r) {
      const from = this.address + r * this.stride;
      packed.set(this.heap.bytes.subarray(from, from + row), r * row);
    }
    return new make(packed.buffer);
  }
}

// Numbers of rows of `components` numbers each, or the numbers themselves.
function flattened(input: ArrayInput, components: number, what: string): unknown[] {
  const rows = Array.from(input as ArrayLike<number | ArrayLike<number>>);
  if (!rows.some((row) => typeof row === "object" && row !== null)) return rows;
  return rows.flatMap((row, k) => {
    const length = typeof row === "object" && row !== null ? row.length : "no";
    if (length !== components) refuse(what, `${what} has a row ${k} of ${length} numbers: each row has ${components}`);
    return Array.from(row as ArrayLike<number>);
  });
}

/** A typed array that the C interface can read, with the number of its type. */
export function typed(input: ArrayInput, components: number, element: string, what: string): { data: TypedArray; type: number } {
  if (input instanceof Float64Array) return { data: input, type: 1 };
  if (input instanceof Float32Array) return { data: input, type: 2 };
  if (input instanceof Uint32Array) return { data: input, type: 3 };
  if (typeof input !== "object" || input === null || typeof input.length !== "number") {
    return refuse(what, `${what} is not an array of numbers`);
  }
  const flat = flattened(input, components, what);
  for (const [k, value] of flat.entries()) {
    if (typeof value !== "number") refuse(what, `${what} has an element ${k} that is not a number`);
    if (element === "U32" && !(Number.isInteger(value) && (value as number) >= 0 && (value as number) <= 0xffffffff)) {
      refuse(what, `${what} has an element ${k} of ${value}: it has to be a whole number from 0`);
    }
  }
  return element === "U32" ? { data: Uint32Array.from(flat as number[]), type: 3 } : { data: Float64Array.from(flat as number[]), type: 1 };
}
