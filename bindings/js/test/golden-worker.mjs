// tests/golden in a browser's worker; the factory createGolden comes with the classic script.
import { runGolden } from "./golden.mjs";

onmessage = async ({ data: { packed, job } }) => {
  const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  try {
    const wasm = await new Response(stream).arrayBuffer();
    postMessage({ done: true, ...(await runGolden(globalThis.createGolden, wasm, job.table, job.args)) });
  } catch (error) {
    postMessage({ done: true, lines: [String(error?.stack ?? error)], code: 1 });
  }
};
