// Makes the package of the module that CMake has built: build/js/, from which npm packs.
//
//   node tools/build.mjs [FOLDER OF mvs.js AND mvs.wasm]
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { build } from "esbuild";

const here = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const root = resolve(here, "../..");
const module = resolve(process.argv[2] ?? join(root, "build/wasm/bindings/js"));
const target = join(root, "build/js");
// replaced as a whole at the end, so that programs that use the package never see half of it
const dist = join(target, "dist.new");
const node = "node18";
const browsers = ["chrome95", "firefox100", "safari16.4"];

rmSync(dist, { recursive: true, force: true });
mkdirSync(dist, { recursive: true });

const bundle = (entry, outfile, options) =>
  build({
    entryPoints: [join(here, "src", entry)],
    outfile: join(dist, outfile),
    bundle: true,
    charset: "utf8",
    legalComments: "none",
    alias: { "mvs-module": join(module, "mvs.js") },
    // emscripten's module asks for these although it is handed the bytes
    define: { __filename: "undefined", ...options.define },
    ...options,
  });

await bundle("index.ts", "index.mjs", { format: "esm", platform: "node", target: node, define: { MVS_HERE: "import.meta.url" } });
await bundle("index.ts", "index.cjs", { format: "cjs", platform: "node", target: node, define: { MVS_HERE: "__filename" } });
await bundle("browser.ts", "browser.mjs", { format: "esm", platform: "browser", target: browsers });
await bundle("classic.ts", "classic.js", { format: "iife", globalName: "libmvs", platform: "browser", target: browsers, minify: true });
copyFileSync(join(module, "mvs.wasm"), join(dist, "mvs.wasm"));

execFileSync(process.execPath, [join(here, "node_modules/typescript/bin/tsc"), "-p", here, "--emitDeclarationOnly", "--outDir", join(dist, "types")], { stdio: "inherit" });

writeFileSync(join(dist, "types/wasm.d.ts"), "/** The address of mvs.wasm, from a bundler that hands out files. */\ndeclare const url: string;\nexport default url;\n");

rmSync(join(target, "dist"), { recursive: true, force: true });
renameSync(dist, join(target, "dist"));

const manifest = JSON.parse(readFileSync(join(here, "package.json"), "utf8"));
delete manifest.scripts;
delete manifest.type; // so that the declarations serve import and require alike
delete manifest.devDependencies;
writeFileSync(join(target, "package.json"), JSON.stringify(manifest, null, 2) + "\n");
copyFileSync(join(here, "README.md"), join(target, "README.md"));
copyFileSync(join(root, "LICENSE"), join(target, "LICENSE"));
console.log(`the package is in ${target}`);
