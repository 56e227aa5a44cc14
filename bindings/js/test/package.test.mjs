// The package that npm packs installs in an empty folder, and works with import, require, a bundler and
// TypeScript.
import test from "node:test";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

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
    await t.test("TypeScript finds the declarations", () => {
      file("types.mts", `import { loadMvs, MvsError, NodeKind, type Snapshot } from "libmvs";\n${use}
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
        // @ts-expect-error a word that is not an array
        snapshot.array("node_colour");
        // @ts-expect-error a field that does not exist
        sim.settle({ iterations: 3 });
        export const all: [number, Float64Array, bigint, typeof MvsError, number, Snapshot] = [area, x, made, MvsError, NodeKind.annulus, snapshot];`);
      file("types.cts", `import libmvs = require("libmvs");\nexport const load: () => Promise<libmvs.Mvs> = libmvs.loadMvs;`);
      run(process.execPath, typescript, "--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--lib", "es2022,dom,esnext.disposable", "types.mts", "types.cts");
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
});
