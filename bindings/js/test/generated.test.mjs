// The generated wrappers are those of include/mvs-api.json, and cover every public function.
import test from "node:test";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";

const at = (path) => new URL(path, import.meta.url);
const api = JSON.parse(readFileSync(at("../../../include/mvs-api.json"), "utf8"));
const unwrapped = JSON.parse(readFileSync(at("../tools/unwrapped.json"), "utf8"));
const functions = readFileSync(at("../src/generated/functions.ts"), "utf8");
const structs = readFileSync(at("../src/generated/structs.ts"), "utf8");
const enums = readFileSync(at("../src/generated/enums.ts"), "utf8");

test("generating again gives no difference", () => {
  execFileSync(process.execPath, [at("../tools/generate.mjs").pathname, "--check"]);
});

test("each public function is wrapped, or left out with a reason", () => {
  for (const { name } of api.functions) {
    const wrapped = new RegExp(`^  ${name}\\(`, "m").test(functions);
    assert.equal(wrapped, !(name in unwrapped), name);
    if (!wrapped) assert.ok(unwrapped[name].length > 20, `a reason for ${name}`);
  }
});

test("each function that is wrapped exists in the module", async () => {
  const module = await WebAssembly.compile(readFileSync(at("../../../build/js/dist/mvs.wasm")));
  assert.ok(WebAssembly.Module.exports(module).length > api.functions.length - Object.keys(unwrapped).length);
  const { loadMvs } = await import("../../../build/js/dist/index.mjs");
  const { c } = await loadMvs({ wasm: module });
  for (const { name } of api.functions) {
    if (!(name in unwrapped)) assert.equal(typeof c.module[`_${name}`], "function", name);
  }
});

test("structs, units and enumerations are those of the interface", () => {
  const inside = (entry) => !["mvs/driver.h", "mvs/device.h"].includes(entry.header);
  for (const struct of api.structs.filter(inside)) assert.match(structs, new RegExp(`^  ${struct.name}: \\{`, "m"));
  const measures = api.structs.find((struct) => struct.name === "mvs_measures");
  for (const field of measures.fields.filter((one) => one.unit)) {
    assert.match(structs, new RegExp(`/\\*\\* ${field.unit.replace("/", "\\/")}\\b[^\\n]*\\n  ${field.name}: number;`), field.name);
  }
  for (const entry of api.enums.filter((one) => inside(one) && one.values.length > 0)) {
    for (const value of entry.values) {
      const word = value.name.toLowerCase();
      const found = [...enums.matchAll(/^ {2}(\w+): (-?\d+),$/gm)].some(([, key, number]) => word.endsWith(key) && Number(number) === value.value);
      assert.ok(found, value.name);
    }
  }
});
