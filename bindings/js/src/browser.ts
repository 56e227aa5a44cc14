// Browsers through a bundler or a server: mvs.wasm is fetched from beside this file.
import { instantiate, type LoadOptions, type Mvs } from "./library.js";

export * from "./api.js";

/** Loads the library: its own mvs.wasm, or the bytes given. */
export async function loadMvs(options: LoadOptions = {}): Promise<Mvs> {
  let { wasm } = options;
  if (!wasm) {
    const response = await fetch(new URL("./mvs.wasm", import.meta.url));
    if (!response.ok) throw new Error(`mvs.wasm: ${response.status} ${response.statusText}`);
    wasm = await response.arrayBuffer();
  }
  return instantiate({ ...options, wasm });
}
