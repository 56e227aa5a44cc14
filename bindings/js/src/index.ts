// Node: mvs.wasm is read from beside this file.
import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

import { knownOptions, MvsError } from "./error.js";
import { instantiate, loadOptions, type LoadOptions, type Mvs } from "./library.js";

export * from "./api.js";

// the address of this file: import.meta.url, or __filename of a CommonJS module (tools/build.mjs)
declare const MVS_HERE: string;

/** Loads the library: its own mvs.wasm, or the bytes given. */
export async function loadMvs(options: LoadOptions = {}): Promise<Mvs> {
  knownOptions(options, loadOptions, "options");
  const here = MVS_HERE.startsWith("file:") ? MVS_HERE : pathToFileURL(MVS_HERE);
  return instantiate({ ...options, wasm: options.wasm ?? (await read(new URL("./mvs.wasm", here))) });
}

async function read(file: URL): Promise<Uint8Array> {
  try {
    return await readFile(file);
  } catch (error) {
    throw new MvsError("MVS_E_IO", "wasm", `mvs.wasm could not be read (${String(error)}): it lies beside this file in the package`);
  }
}
