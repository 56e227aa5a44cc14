// The memory of the module: allocation, text, numbers. Views are made anew after it has grown.
import { MvsError, refuse } from "./error.js";

/** The part of emscripten's module that is used; functions of the library under "_" and their names. */
export interface EmscriptenModule {
  HEAPU8: Uint8Array;
  FS: {
    writeFile(path: string, data: Uint8Array): void;
    unlink(path: string): void;
    mkdir(path: string): void;
    chdir(path: string): void;
  };
  _malloc(size: number): number;
  _free(address: number): void;
  [name: string]: unknown;
}

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class Heap {
  private data: DataView;
  private bytesNow: Uint8Array;
  /** Bytes in use by calls and handles of the wrappers themselves, for tests of leaks. */
  allocated = 0;
  private readonly sizes = new Map<number, number>();

  constructor(readonly module: EmscriptenModule) {
    this.bytesNow = module.HEAPU8;
    this.data = new DataView(this.bytesNow.buffer);
  }

  /** The present buffer; another one after the memory has grown. */
  get buffer(): ArrayBufferLike {
    return this.bytes.buffer;
  }

  get bytes(): Uint8Array {
    if (this.bytesNow !== this.module.HEAPU8) {
      this.bytesNow = this.module.HEAPU8;
      this.data = new DataView(this.bytesNow.buffer);
    }
    return this.bytesNow;
  }

  get view(): DataView {
    return this.bytes && this.data;
  }

  allocate(size: number): number {
    const address = size < 0x7fffffff ? this.module._malloc(Math.max(size, 1)) >>> 0 : 0;
    if (address === 0) {
      throw new MvsError("MVS_E_MEMORY", "", `out of memory: no ${size} bytes are free; dispose of snapshots, or use a coarser valve`);
    }
    this.sizes.set(address, size);
    this.allocated += size;
    return address;
  }

  free(address: number): void {
    this.allocated -= this.sizes.get(address) ?? 0;
    this.sizes.delete(address);
    this.module._free(address);
  }

  /** The zero-terminated text at an address; "" for a null pointer. */
  text(address: number): string {
    if (address === 0) return "";
    const { bytes } = this;
    let end = address;
    while (bytes[end] !== 0) ++end;
    return decoder.decode(bytes.slice(address, end));
  }
}

/** Allocations of one call, freed together. */
export class Arena {
  private readonly addresses: number[] = [];

  constructor(readonly heap: Heap) {}

  allocate(size: number): number {
    const address = this.heap.allocate(size);
    this.addresses.push(address);
    return address;
  }

  /** Zeroed memory. */
  zeroed(size: number): number {
    const address = this.allocate(size);
    this.heap.bytes.fill(0, address, address + size);
    return address;
  }

  text(text: string, what: string): number {
    if (typeof text !== "string") refuse(what, `${what} is not a text but ${typeof text}`);
    if (text.includes("\0")) refuse(what, `${what} contains a zero character`);
    const bytes = encoder.encode(text);
    const address = this.zeroed(bytes.length + 1);
    this.heap.bytes.set(bytes, address);
    return address;
  }

  bytes(data: Uint8Array): number {
    const address = this.allocate(data.length);
    this.heap.bytes.set(data, address);
    return address;
  }

  free(): void {
    for (const address of this.addresses) this.heap.free(address);
    this.addresses.length = 0;
  }
}

/** The bytes of a text in UTF-8, or the bytes themselves. */
export function toBytes(data: Uint8Array | string, what: string): Uint8Array {
  if (typeof data === "string") return encoder.encode(data);
  if (data instanceof Uint8Array) return data;
  return refuse(what, `${what} is neither a text nor a Uint8Array`);
}
