// The module that emscripten makes (CMakeLists.txt): build/wasm/bindings/js/mvs.js.
declare module "mvs-module" {
  import type { EmscriptenModule } from "./heap.js";
  export default function createMvs(options: object): Promise<EmscriptenModule>;
}
