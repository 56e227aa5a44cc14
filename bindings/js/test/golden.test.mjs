// The golden digests of tests/golden in Node and in Chromium: the same bits as the native library.
//   MVS_JS_SCENES=close,op   groups of scenes to run [close]; all: every one
//   MVS_GOLDEN=PROGRAM       the native program, whose snapshot hashes are compared as well
import test from "node:test";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

import { build } from "esbuild";

import { executable, openPage, read } from "./chromium.mjs";
import { runGolden } from "./golden.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../../..");
const folder = join(root, "build/wasm/bindings/js");
const table = read(join(root, "tests/golden/digests.csv"));
const scenes = process.env.MVS_JS_SCENES ?? "close";
const asked = scenes === "all" ? [] : scenes.split(",");
const program = process.env.MVS_GOLDEN ?? join(root, "build/release/tests/golden/golden");
const wasm = readFileSync(join(folder, "golden.wasm"));
// a script of a web page: in Node it only has to be evaluated
const create = new Function(`${read(join(folder, "golden.js"))}; return createGolden;`)();

function assertSame({ lines, code }) {
  assert.equal(code, 0, lines.join("\n"));
  const last = lines.at(-1);
  assert.match(last, /^[1-9]\d* scenes, [1-9]\d* digests, 0 differ$/);
  return last;
}

test("golden digests in Node", async (t) => {
  t.diagnostic(assertSame(await runGolden(create, wasm, table, ["/digests.csv", ...asked])));
});

test("snapshot hashes of the native library", { skip: existsSync(program) ? false : `no ${program}` }, async () => {
  const { lines } = await runGolden(create, wasm, table, ["--hash", ...asked]);
  const native = execFileSync(program, ["--hash", ...asked], { encoding: "utf8" }).trim().split("\n");
  assert.ok(native.length > 0);
  assert.deepEqual(lines, native);
});

test("golden digests in Chromium", { skip: existsSync(executable) ? false : `no ${executable}: install chromium` }, async (t) => {
  const bundled = await build({ entryPoints: [join(here, "golden-worker.mjs")], bundle: true, format: "iife", write: false });
  const page = await openPage({
    classic: read(join(folder, "golden.js")),
    work: bundled.outputFiles[0].text,
    packed: gzipSync(wasm, { level: 6 }).toString("base64"),
  });
  try {
    const [answer] = await page.run({ table, args: ["/digests.csv", ...asked] });
    t.diagnostic(`${page.version}: ${assertSame(answer)}`);
  } finally {
    await page.close();
  }
});
