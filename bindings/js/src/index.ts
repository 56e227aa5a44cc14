// Node: mvs.wasm is read from beside this file.
import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

import { instantiate, type LoadOptions, type Mvs } from "./library.js";

export * from "./api.js";

// the address of this file: import.meta.url, or __filename of a CommonJS module (tools/build.mjs)
declare const MVS_HERE: string;

/** Loads the library: its own mvs.wasm, or the bytes given. */
export async function loadMvs(options: LoadOptions = {}): Promise<Mvs> {
  const here = MVS_HERE.startsWith("file:") ? MVS_HERE : pathToFileURL(MVS_HERE);
  return instantiate({ ...options, wasm: options.wasm ?? (await readFile(new URL("./mvs.wasm", here))) });
}
