// The cases of cases/ in Chromium: a classic worker of a page opened from disk, whose security policy
// forbids every request.
//   MVS_JS_ROUNDS=N          rounds of the soak [not run]
import test from "node:test";
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { build } from "esbuild";

import { executable, openPage, read } from "./chromium.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const dist = join(here, "../../../build/js/dist");
const rounds = Number(process.env.MVS_JS_ROUNDS ?? 0);

test("cases in Chromium", { skip: existsSync(executable) ? false : `no ${executable}: install chromium` }, async (t) => {
  const bundled = await build({ entryPoints: [join(here, "worker.mjs")], bundle: true, format: "iife", write: false, charset: "utf8" });
  const page = await openPage({
    classic: read(join(dist, "classic.js")),
    work: bundled.outputFiles[0].text,
    packed: gzipSync(readFileSync(join(dist, "mvs.wasm")), { level: 9 }).toString("base64"),
  });
  try {
    const groups = ["life", "operations", "settles", "refusals", "work", ...(rounds > 0 ? ["soak"] : [])];
    const messages = await page.run({ groups, rounds });
    const last = messages.pop();
    assert.equal(last.failure, undefined);
    assert.ok(messages.length > 25, `${messages.length} cases ran`);
    for (const { name, failure } of messages) await t.test(name, () => assert.equal(failure, undefined));
    assert.deepEqual(page.requests, [], "requests to the network");
  } finally {
    await page.close();
  }
});
