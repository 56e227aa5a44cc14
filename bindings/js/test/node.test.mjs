// The cases of cases/ under Node, with the package as npm packs it (build/js).
//   MVS_JS_CASES=life,operations,settles,refusals,work   groups to run [life,operations,settles,refusals,work]
//   MVS_JS_ROUNDS=N          rounds of the soak [not run]
import test from "node:test";
import { readFileSync } from "node:fs";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";

import * as libmvs from "../../../build/js/dist/index.mjs";
import { life } from "./cases/life.mjs";
import { operations } from "./cases/operations.mjs";
import { soak } from "./cases/soak.mjs";
import { refusals } from "./cases/refusals.mjs";
import { settles } from "./cases/settles.mjs";
import { work } from "./cases/work.mjs";

setFlagsFromString("--expose-gc");
globalThis.gc = runInNewContext("gc");
const wasm = await WebAssembly.compile(readFileSync(new URL("../../../build/js/dist/mvs.wasm", import.meta.url)));
const load = (options) => libmvs.loadMvs({ wasm, ...options });
const mvs = await load({});
const groups = { life, operations, settles, refusals, work };
const rounds = Number(process.env.MVS_JS_ROUNDS ?? 0);

for (const group of (process.env.MVS_JS_CASES ?? "life,operations,settles,refusals,work").split(",")) {
  for (const [name, run] of Object.entries(groups[group])) test(`${group}: ${name}`, () => run({ libmvs, mvs, load }));
}
if (rounds > 0) {
  for (const [name, run] of Object.entries(soak)) test(`soak: ${name}`, () => run({ libmvs, mvs, load, rounds }));
}
