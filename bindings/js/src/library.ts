// Loads the module: from bytes, on every platform alike. Nothing is fetched here.
import { type FaultCallback } from "./arrays.js";
import createMvs from "mvs-module";
import { knownOptions, MvsError } from "./error.js";
import { Struct } from "./generated/enums.js";
import { Functions } from "./generated/functions.js";
import type { FieldInfo, Law, SurfaceFileOptions, ValveDesc } from "./generated/structs.js";
import type { EmscriptenModule } from "./heap.js";
import { readSchema, type OperationInfo } from "./operations.js";
import { Simulator, type SimulatorOptions } from "./simulator.js";
import { readSurface, type Surface } from "./surface.js";

export interface LoadOptions {
  /** The bytes of mvs.wasm, or the module compiled of them. */
  wasm?: BufferSource | WebAssembly.Module | undefined;
  /** Bytes, largest size of the memory, 32 MiB to 2 GiB [2 GiB]. Beyond it calls give MVS_E_MEMORY. */
  maxMemory?: number | undefined;
}

/** The names of the options, which each way of loading checks before it reads mvs.wasm. */
export const loadOptions: readonly (keyof LoadOptions)[] = ["wasm", "maxMemory"];

const page = 65536;
const initialMemory = 33554432;
const largestMemory = 2147483648;

/** A fault of a valve. */
export interface Fault {
  part: string;
  sentence: string;
}

export class Mvs {
  /** The functions of the C interface, for what the classes do not offer. */
  readonly c: Functions;
  private schema: readonly OperationInfo[] | undefined;

  constructor(module: EmscriptenModule) {
    this.c = new Functions(module);
    module.FS.mkdir("/files");
    module.FS.chdir("/files");
  }

  simulator(options?: SimulatorOptions): Simulator {
    return new Simulator(this, options);
  }

  /** "0.1.0" */
  get version(): string {
    const number = this.c.mvs_version();
    return `${Math.floor(number / 10000)}.${Math.floor(number / 100) % 100}.${number % 100}`;
  }

  get features(): string[] {
    return this.c.mvs_features().split(" ").filter(Boolean);
  }

  /** All operations with their fields, for forms. */
  get operations(): readonly OperationInfo[] {
    return (this.schema ??= readSchema(this.c));
  }

  /** Fields of a struct of results with label, unit and help, for tables. */
  fields(which: Struct): FieldInfo[] {
    return Array.from({ length: this.c.mvs_get_field_count(which) }, (_, k) => this.c.mvs_get_field(which, k));
  }

  /** The laws of leaflets and of chordae. */
  laws(): { leaflet: Law[]; chord: Law[] } {
    return {
      leaflet: Array.from({ length: this.c.mvs_get_leaflet_law_count() }, (_, k) => this.c.mvs_get_leaflet_law(k)),
      chord: Array.from({ length: this.c.mvs_get_chord_law_count() }, (_, k) => this.c.mvs_get_chord_law(k)),
    };
  }

  /** All faults of a valve; those of a valid valve are warnings. */
  checkValve(valve: ValveDesc): { code: string; faults: Fault[] } {
    const faults: Fault[] = [];
    const collect: FaultCallback = (part, sentence) => void faults.push({ part, sentence });
    const code = this.c.mvs_check_valve(valve, collect);
    return { code: this.c.mvs_result_name(code), faults };
  }

  /** Reads a surface or landmarks from the bytes of a file; the ending of its name is the format. */
  readSurface(data: Uint8Array | string, name: string, options?: SurfaceFileOptions): Surface {
    return readSurface(this, data, name, options);
  }

  /** Objects that were not released yet, and bytes of the memory, for tests of leaks. */
  get usage(): { handles: Record<string, number>; wrapperBytes: number; memoryBytes: number } {
    const { held, heap } = this.c;
    const handles = Object.fromEntries([...held].filter(([, count]) => count !== 0));
    return { handles, wrapperBytes: heap.allocated, memoryBytes: heap.bytes.length };
  }
}

// Bytes that are those of a module, and not of the page that a server answers for a file that it does not have.
function mustBeWasm(wasm: unknown): void {
  const isBytes = ArrayBuffer.isView(wasm) || Object.prototype.toString.call(wasm) === "[object ArrayBuffer]";
  if (!isBytes) {
    throw new MvsError("MVS_E_ARGUMENT", "wasm", "wasm is neither bytes nor a WebAssembly.Module: give the ArrayBuffer of mvs.wasm, of a Response its arrayBuffer()");
  }
  const bytes = ArrayBuffer.isView(wasm) ? new Uint8Array(wasm.buffer, wasm.byteOffset, wasm.byteLength) : new Uint8Array(wasm as ArrayBuffer);
  if (String(bytes.subarray(0, 4)) === "0,97,115,109") return;
  const text = new TextDecoder().decode(bytes.slice(0, 256)).trimStart();
  const what = bytes.length === 0 ? "nothing" : text.startsWith("<") ? "a page (HTML)" : "other bytes";
  throw new MvsError("MVS_E_FORMAT", "wasm", `this is ${what} and not mvs.wasm: the server may not have the file at the address that was asked (of Vite's development server see the README of libmvs)`);
}

/** Makes the library from its bytes or its compiled module. */
export async function instantiate(options: LoadOptions): Promise<Mvs> {
  knownOptions(options, loadOptions, "options");
  const { wasm, maxMemory = largestMemory } = options;
  if (!wasm) throw new MvsError("MVS_E_ARGUMENT", "wasm", "wasm is missing: give the bytes of mvs.wasm, or the module compiled of them");
  if (!(wasm instanceof WebAssembly.Module)) mustBeWasm(wasm);
  if (!(maxMemory >= initialMemory && maxMemory <= largestMemory)) {
    throw new MvsError("MVS_E_ARGUMENT", "maxMemory", `maxMemory is ${maxMemory}: it has to be ${initialMemory} to ${largestMemory} bytes`);
  }
  const wasmMemory = new WebAssembly.Memory({ initial: initialMemory / page, maximum: Math.floor(maxMemory / page) });
  return new Promise((resolve, reject) => {
    const failed = (error: unknown): void =>
      reject(new MvsError("MVS_E_UNSUPPORTED", "wasm", `mvs.wasm could not be started (${String(error)}): it needs an engine with SIMD and exceptions of WebAssembly (Node 18, Chromium 95, Firefox 100, Safari 16.4)`));
    const instantiateWasm = (imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance) => void): object => {
      const started = wasm instanceof WebAssembly.Module
        ? WebAssembly.instantiate(wasm, imports)
        : WebAssembly.instantiate(wasm, imports).then(({ instance }) => instance);
      started.then(receive).catch(failed);
      return {};
    };
    createMvs({ wasmMemory, instantiateWasm, print: () => {}, printErr: () => {} })
      .then((module) => resolve(new Mvs(module)))
      .catch(failed);
  });
}
