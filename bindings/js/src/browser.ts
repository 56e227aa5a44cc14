// Browsers through a bundler or a server: mvs.wasm is fetched from beside this file.
import { knownOptions, MvsError } from "./error.js";
import { instantiate, loadOptions, type LoadOptions, type Mvs } from "./library.js";

export * from "./api.js";

/** Loads the library: its own mvs.wasm, or the bytes given. */
export async function loadMvs(options: LoadOptions = {}): Promise<Mvs> {
  knownOptions(options, loadOptions, "options");
  return instantiate({ ...options, wasm: options.wasm ?? (await fetched(new URL("./mvs.wasm", import.meta.url))) });
}

async function fetched(address: URL): Promise<ArrayBuffer> {
  const failed = (why: string): never => {
    throw new MvsError("MVS_E_IO", "wasm", `mvs.wasm could not be fetched from ${address.href}: ${why}`);
  };
  try {
    const response = await fetch(address);
    return response.ok ? await response.arrayBuffer() : failed(`${response.status} ${response.statusText}`.trim());
  } catch (error) {
    return error instanceof MvsError ? Promise.reject(error) : failed(String(error));
  }
}
