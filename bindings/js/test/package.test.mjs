// The package that npm packs installs in an empty folder, and works with import, require, a bundler and
// TypeScript.
import test from "node:test";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

import { build } from "esbuild";

const built = fileURLToPath(new URL("../../../build/js", import.meta.url));
const typescript = fileURLToPath(new URL("../node_modules/typescript/bin/tsc", import.meta.url));

const use = `
  const mvs = await loadMvs();
  const sim = mvs.simulator();
  sim.generateValve();
  sim.setLoad();
  const stats = sim.settle();
  const snapshot = sim.snapshot();
  console.log(stats.converged, snapshot.measure().intersections);
  snapshot.dispose();
  sim.dispose();
`;

test("a module that is not there is an MvsError", async () => {
  const folder = mkdtempSync(join(tmpdir(), "mvs-lost-"));
  const { fetch } = globalThis;
  try {
    copyFileSync(join(built, "dist/index.mjs"), join(folder, "index.mjs"));
    const lost = await import(pathToFileURL(join(folder, "index.mjs")).href);
    await assert.rejects(lost.loadMvs(), { name: "MvsError", code: "MVS_E_IO", part: "wasm", message: /could not be read .*ENOENT/ });
    const page = await import(pathToFileURL(join(built, "dist/browser.mjs")).href);
    const answers = [
      [() => new Response("gone", { status: 404, statusText: "Not Found" }), "MVS_E_IO", /mvs\.wasm: 404 Not Found$/],
      [() => Promise.reject(new TypeError("no network")), "MVS_E_IO", /no network/],
      [() => new Response("<!DOCTYPE html><html></html>", { headers: { "content-type": "text/html" } }), "MVS_E_FORMAT", /a page \(HTML\)/],
    ];
    for (const [answer, code, message] of answers) {
      globalThis.fetch = async () => answer();
      await assert.rejects(page.loadMvs(), { name: "MvsError", code, part: "wasm", message });
    }
  } finally {
    globalThis.fetch = fetch;
    rmSync(folder, { recursive: true });
  }
});

test("npm pack makes a package that works in an empty folder", async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "mvs-npm-"));
  const run = (command, ...args) => execFileSync(command, args, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
  const file = (name, text) => writeFileSync(join(folder, name), text);
  try {
    const [{ filename, files }] = JSON.parse(execFileSync("npm", ["pack", "--json", "--pack-destination", folder], { cwd: built, encoding: "utf8" }));
    const names = files.map(({ path }) => path);
    for (const name of ["README.md", "LICENSE", "dist/mvs.wasm", "dist/classic.js", "dist/types/index.d.ts"]) assert.ok(names.includes(name), name);
    file("package.json", '{ "name": "empty", "version": "1.0.0" }');
    run("npm", "install", "--no-audit", "--no-fund", "--offline", `./${filename}`);

    await t.test("import", () => {
      file("esm.mjs", `import { loadMvs } from "libmvs";\n${use}`);
      assert.equal(run(process.execPath, "esm.mjs").trim(), "1 0");
    });
    await t.test("require", () => {
      file("cjs.cjs", `const { loadMvs } = require("libmvs");\n(async () => {${use}})();`);
      assert.equal(run(process.execPath, "cjs.cjs").trim(), "1 0");
    });
    await t.test("a bundler takes the browser's entry, with the module as a file", async () => {
      file("page.mjs", `import { loadMvs } from "libmvs";\n${use}`);
      const { outputFiles } = await build({ absWorkingDir: folder, entryPoints: ["page.mjs"], bundle: true, format: "esm", write: false });
      assert.match(outputFiles[0].text, /new URL\("\.\/mvs\.wasm", import\.meta\.url\)/);
    });
    await t.test("a bundler keeps the script that defines the global", async () => {
      file("classic.mjs", `import "libmvs/classic.js";\n`);
      const { outputFiles } = await build({ absWorkingDir: folder, entryPoints: ["classic.mjs"], bundle: true, format: "esm", write: false });
      assert.ok(outputFiles[0].text.length > 50000, `${outputFiles[0].text.length} characters`);
    });
    await t.test("TypeScript finds the declarations", () => {
      file("types.mts", `import { loadMvs, MvsError, NodeKind, type Snapshot } from "libmvs";
        import { loadMvs as load } from "libmvs/browser";
        import url from "libmvs/mvs.wasm";
        const start: typeof loadMvs = load;
        ${use}
        const area: number = snapshot.measure().coaptation_area;
        const x: Float64Array = snapshot.array("node_position").slice();
        const triangles: Uint32Array = snapshot.copy("triangle_nodes");
        const ids: bigint = snapshot.array("chord_id")[0]!;
        const kinds: number = snapshot.array("node_kind").subarray(1)[0]!;
        const stated: Float64Array = snapshot.array<Float64Array>("node_force");
        for (const value of snapshot.array("chord_tension")) console.log(value + 1);
        Float32Array.from(snapshot.array("node_position"));
        mvs.checkValve({ nodes: snapshot.array("node_rest"), triangles: [[0, 1, 2]] });
        // @ts-expect-error arrays are read-only
        snapshot.array("node_position")[0] = 1;
        // @ts-expect-error arrays are read-only
        snapshot.view("node_position").values.fill(0);
        console.log(triangles, ids, kinds, stated);
        const made: bigint = sim.apply("ring", { size: 0.032 });
        using other = sim.snapshot();
        sim.check("chord_add", { head: "AL1", site: { scallop: "A2", u: [0.5, 0.9] }, type: "strut" });
        sim.apply("head_move", { head: "AL1", by: [0, 0, 1e-3], frame: "valve" });
        const name: string = mvs.operations[0]!.name;
        sim.check(name, { [mvs.operations[0]!.fields[0]!.name]: 1 });
        // @ts-expect-error an operation that does not exist
        sim.apply("clp");
        // @ts-expect-error a field that the operation does not have
        sim.apply("ring", { sise: 1 });
        // @ts-expect-error operations are frozen
        mvs.operations[0].name = "";
        mvs.c.mvs_sensitivity_run(snapshot.handle, [{ kind: "measure", measure: "coaptation_area" }], [{ kind: "chord_rest_length", index: 3 }]);
        console.log(other.name, url, start === load);
        // @ts-expect-error a word that is not an array
        snapshot.array("node_colour");
        // @ts-expect-error a field that does not exist
        sim.settle({ iterations: 3 });
        export const all: [number, Float64Array, bigint, typeof MvsError, number, Snapshot] = [area, x, made, MvsError, NodeKind.annulus, snapshot];`);
      file("types.cts", `import libmvs = require("libmvs");\nexport const load: () => Promise<libmvs.Mvs> = libmvs.loadMvs;`);
      file("page.ts", `/// <reference types="libmvs/classic.js" />
        async function start(wasm: ArrayBuffer): Promise<string> { return (await libmvs.loadMvs({ wasm })).version; }`);
      run(process.execPath, typescript, "--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--lib", "es2022,dom", "types.mts", "types.cts", "page.ts");
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
});
