// Classic scripts and workers, also of a page opened from disk: the global `libmvs`. Nothing is
// fetched: loadMvs takes the bytes, which the page sends by message.
import { instantiate, type LoadOptions, type Mvs } from "./library.js";

export * from "./api.js";

/** Loads the library from the bytes of mvs.wasm. */
export async function loadMvs(options: LoadOptions = {}): Promise<Mvs> {
  return instantiate(options);
}

declare global {
  /** The library in classic scripts: all exports of this file. */
  var libmvs: typeof import("./classic.js");
}
