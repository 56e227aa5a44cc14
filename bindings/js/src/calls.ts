// Calls of C functions by their signatures: arguments into the memory of the module, results and
// failures out of it.
import type { FaultCallback, LogCallback, ProgressCallback } from "./arrays.js";
import { MvsError, refuse } from "./error.js";
import type { LogLevel } from "./generated/enums.js";
import { HeldHandles } from "./held.js";
import { Arena, Heap, toBytes, type EmscriptenModule } from "./heap.js";
import { big, enumNumber, enumWord, layoutOf, readScalar, readStruct, readView, StructWriter, whole, writeScalar, real } from "./layout.js";

export interface Step {
  name: string;
  how: string;
  nullable: boolean;
  of?: string;
  element?: string;
  length?: number;
  components?: number;
  freedBy?: string;
}
export interface Signature {
  name: string;
  returns: string;
  steps: Step[];
}

/** An operation in the memory of the module, made by operations.ts. */
export interface Operation {
  write(arena: Arena): number;
}

interface Callbacks {
  log?: LogCallback;
  progress?: ProgressCallback;
  fault?: FaultCallback;
}

type Output = { name: string; read: () => unknown };

/** Arguments, outputs and callbacks of one call. */
interface Call {
  signature: Signature;
  arena: Arena;
  writer: StructWriter;
  values: (number | bigint)[];
  outputs: Output[];
  callbacks: Callbacks;
  user: number;
  /** Index in `values` of (data, capacity, &count), and bytes of an element. */
  fill?: { index: number; element: number; count: number; asNumbers: boolean };
}

/** Bytes that a call with (data, capacity, &size) offers at first. */
const firstCapacity = 1 << 16;

export class Calls {
  readonly heap: Heap;
  private readonly callbacks = new Map<number, Callbacks>();
  private readonly callbacksOf = new Map<number, number>();
  private nextUser = 1;
  private thrown: { error: unknown } | undefined;
  private broken = "";
  private depth = 0;
  private readonly handles = new HeldHandles();

  constructor(readonly module: EmscriptenModule) {
    this.heap = new Heap(module);
    module["onLog"] = (user: number, level: number, text: number) => {
      this.guarded(() => this.callbacks.get(user)?.log?.(enumWord("mvs_log_level", level) as LogLevel, this.heap.text(text)), undefined);
    };
    module["onProgress"] = (user: number, share: number, residual: number) =>
      this.guarded(() => (this.callbacks.get(user)?.progress?.(share, residual) === true ? 1 : 0), 1);
    module["onFault"] = (user: number, part: number, sentence: number) => {
      this.guarded(() => this.callbacks.get(user)?.fault?.(this.heap.text(part), this.heap.text(sentence)), undefined);
    };
  }

  /** Calls of JavaScript from C: the first exception is thrown once the call has returned. */
  private guarded<T>(work: () => T, otherwise: T): T {
    try {
      return work();
    } catch (error) {
      this.thrown ??= { error };
      return otherwise;
    }
  }

  /** Calls a function of the module by its name in C, with numbers. */
  raw(name: string, ...values: (number | bigint)[]): number {
    if (this.broken) throw new MvsError("MVS_E_INTERNAL", "module", this.broken);
    if (name === "mvs_destroy" && this.depth > 0) {
      throw new MvsError("MVS_E_STATE", "simulator", "a callback cannot dispose of a simulator: cancel the call, and do it afterwards");
    }
    const fn = this.module[`_${name}`] as ((...values: (number | bigint)[]) => number) | undefined;
    if (!fn) throw new MvsError("MVS_E_UNSUPPORTED", name, `this build has no function ${name}`);
    ++this.depth;
    try {
      return fn(...values);
    } catch (error) {
      // a trap: the state of the module is unknown
      this.broken = `the module stopped in ${name} (${String(error)}): load it anew`;
      throw new MvsError("MVS_E_INTERNAL", "module", this.broken);
    } finally {
      --this.depth;
    }
  }

  invoke(signature: Signature, args: unknown[]): unknown {
    const arena = new Arena(this.heap);
    const call: Call = {
      signature, arena, values: [], outputs: [], callbacks: {}, user: 0,
      writer: new StructWriter(arena, (kind, callback) => this.keep(call, kind, callback)),
    };
    let keepCallbacks = false;
    try {
      let next = 0;
      for (const step of signature.steps) {
        if (this.isInput(step)) this.input(call, step, args[next++]);
        else this.output(call, step);
      }
      let result = this.perform(call);
      if (call.fill && this.refill(call)) result = this.perform(call);
      keepCallbacks = this.keepWithHandle(call);
      return this.answer(call, result);
    } finally {
      if (call.user && !keepCallbacks) this.callbacks.delete(call.user);
      arena.free();
    }
  }

  private isInput(step: Step): boolean {
    return !step.how.startsWith("out") && step.how !== "fill";
  }

  private keep(call: Call, kind: string, callback: unknown): { address: number; user: number } {
    if (typeof callback !== "function") refuse(kind, `${kind} is not a function`);
    if (!call.user) this.callbacks.set((call.user = this.nextUser++), call.callbacks);
    (call.callbacks as Record<string, unknown>)[kind] = callback;
    return { address: this.raw(`mvs_js_${kind}`), user: call.user };
  }

  private input(call: Call, step: Step, value: unknown): void {
    const { values, arena } = call;
    if (value === null || value === undefined) {
      if (!step.nullable && step.how !== "callback") refuse(step.name, `${step.name} is missing`);
      values.push(...(step.how === "inStructs" ? [0, 0, 0] : step.how === "callback" || step.how === "bytes" ? [0, 0] : [0]));
      return;
    }
    switch (step.how) {
      case "handle":
        values.push(this.handles.check(step.of!, value, step.name));
        return;
      case "inStruct":
        values.push(call.writer.make(step.of!, value, step.name));
        return;
      case "inStructs":
        values.push(...call.writer.list(step.of!, value, step.name));
        return;
      case "operation":
        values.push((value as Operation).write(arena));
        return;
      case "text":
        values.push(arena.text(value as string, step.name));
        return;
      case "bytes": {
        const bytes = toBytes(value as Uint8Array | string, step.name);
        values.push(arena.bytes(bytes), BigInt(bytes.length));
        return;
      }
      case "callback": {
        const kept = this.keep(call, step.of!, value);
        values.push(kept.address, kept.user);
        return;
      }
      case "inArray": {
        const list = value as ArrayLike<number>;
        if (list.length !== step.length) refuse(step.name, `${step.name} has ${list.length} numbers: it has to have ${step.length}`);
        const at = arena.zeroed(8 * step.length!);
        for (let k = 0; k < list.length; ++k) writeScalar(this.heap, step.element!, at, k, list[k], step.name);
        values.push(at);
        return;
      }
      case "enum":
        values.push(step.element === "i32" && typeof value === "number" ? value : enumNumber(step.of!, value, step.name));
        return;
      default:
        values.push(step.element === "u64" ? big(value, step.name) : step.element === "f64" ? real(value, step.name) : whole(value, step.name));
    }
  }

  private output(call: Call, step: Step): void {
    const { heap } = this;
    if (step.how === "fill") {
      const element = step.element === "U8" ? 1 : 8 * step.components!;
      const capacity = Math.ceil(firstCapacity / element);
      const count = call.arena.zeroed(8);
      call.fill = { index: call.values.length, element, count, asNumbers: step.element !== "U8" };
      call.values.push(call.arena.allocate(capacity * element), BigInt(capacity), count);
      call.outputs.push({ name: step.name, read: () => this.filled(call) });
      return;
    }
    const size = step.how === "outStruct" || step.how === "outView" ? layoutOf(step.of!).size : 8 * (step.length ?? 1);
    const at = call.arena.zeroed(size);
    call.values.push(at);
    const reads: Record<string, () => unknown> = {
      outStruct: () => readStruct(heap, step.of!, at),
      outView: () => readView(heap, at),
      outHandle: () => this.handles.add(step.of!, step.freedBy ?? "", heap.view.getUint32(at, true)),
      outText: () => heap.text(heap.view.getUint32(at, true)),
      outScalar: () => readScalar(heap, step.element!, at),
      outArray: () => Array.from({ length: step.length! }, (_, k) => readScalar(heap, step.element!, at, k)),
    };
    if (step.how === "outStruct" && layoutOf(step.of!).sized) heap.view.setUint32(at, size, true);
    call.outputs.push({ name: step.name, read: reads[step.how]! });
  }

  private perform(call: Call): number {
    const result = this.raw(call.signature.name, ...call.values);
    const { thrown } = this;
    this.thrown = undefined;
    if (call.signature.returns === "mvs_result" && result !== 0) throw thrown ? thrown.error : this.failure();
    if (thrown) throw thrown.error;
    return result;
  }

  /** The last failure of the library as an exception. */
  failure(): MvsError {
    const error = readStruct(this.heap, "mvs_error", this.raw("mvs_last_error"));
    const code = this.heap.text(this.raw("mvs_result_name", error["code"] as number));
    return new MvsError(code, error["part"] as string, error["message"] as string, error["line"] as number);
  }

  // Offers more room if the answer did not fit.
  private refill(call: Call): boolean {
    const fill = call.fill!;
    const count = Number(this.heap.view.getBigUint64(fill.count, true));
    if (BigInt(count) <= (call.values[fill.index + 1] as bigint)) return false;
    call.values[fill.index] = call.arena.allocate(count * fill.element);
    call.values[fill.index + 1] = BigInt(count);
    return true;
  }

  private filled(call: Call): Uint8Array | Float64Array {
    const fill = call.fill!;
    const from = call.values[fill.index] as number;
    const size = Number(this.heap.view.getBigUint64(fill.count, true)) * fill.element;
    const bytes = this.heap.bytes.slice(from, from + size);
    return fill.asNumbers ? new Float64Array(bytes.buffer) : bytes;
  }

  /** Handles that are not released yet, by the function that releases them. */
  get held(): ReadonlyMap<string, number> {
    return this.handles.counts;
  }

  // Callbacks of a simulator live as long as it does.
  private keepWithHandle(call: Call): boolean {
    const first = call.values[0] as number;
    const name = call.signature.name;
    if (name === "mvs_snapshot_retain") {
      this.handles.add("mvs_snapshot", "mvs_snapshot_release", first);
    }
    if (first !== 0 && /(_release|_destroy)$/.test(name)) {
      this.handles.remove(name, first);
      if (name === "mvs_destroy") {
        this.callbacks.delete(this.callbacksOf.get(first) ?? 0);
        this.callbacksOf.delete(first);
      }
    }
    if (name !== "mvs_create" || !call.user) return false;
    this.callbacksOf.set(this.heap.view.getUint32(call.values[1] as number, true), call.user);
    return true;
  }

  private answer(call: Call, result: number): unknown {
    const { outputs } = call;
    if (outputs.length === 1) return outputs[0]!.read();
    if (outputs.length > 1) return Object.fromEntries(outputs.map((output) => [output.name, output.read()]));
    switch (call.signature.returns) {
      case "const char *":
        return this.heap.text(result);
      case "const mvs_error *":
        return readStruct(this.heap, "mvs_error", result);
      case "uint32_t":
        return result >>> 0;
      case "code":
        return result;
      default:
        return undefined;
    }
  }
}
