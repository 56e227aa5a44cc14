// Figures of the WebAssembly module: size, loading, closures and live steps beside the native library,
// which have to give the same hashes.
//
//   node bench/bench.mjs [ROUNDS]   [3]; needs build/js (scripts/js) and build/release/lib/libmvs.so
//
// CPU seconds of the process, medians over rounds in which native and WebAssembly take turns, since the
// machine may be shared. Those of WebAssembly include the engine's compiler while it still works.
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";

import { loadMvs } from "../../../build/js/dist/index.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../../..");
const rounds = Number(process.argv[2] ?? 3);
const runs = 3; // of one round
const cases = [
  { name: "healthy membrane, 425", shape: 1, vertices: 425 },
  { name: "founding springs, 425", shape: 2, vertices: 425 },
  { name: "founding springs, 1700", shape: 2, vertices: 1700 },
];

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const cpu = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) * 1e-6;
};
const kilobytes = (bytes) => `${(bytes.length / 1000).toFixed(0)} kB`;

function size() {
  const wasm = readFileSync(join(root, "build/js/dist/mvs.wasm"));
  const script = readFileSync(join(root, "build/js/dist/classic.js"));
  for (const [name, bytes] of [["mvs.wasm", wasm], ["classic.js", script]]) {
    const packed = gzipSync(bytes, { level: 9 });
    console.log(`${name}: ${kilobytes(bytes)}, gzip ${kilobytes(packed)}, gzip in base64 ${kilobytes(packed.toString("base64"))}, brotli ${kilobytes(brotliCompressSync(bytes))}`);
  }
  return wasm;
}

async function loading(wasm) {
  const times = [];
  for (let k = 0; k < 5; ++k) {
    const before = cpu();
    const mvs = await loadMvs({ wasm });
    const loaded = cpu();
    const sim = mvs.simulator();
    sim.generateValve();
    sim.setLoad();
    sim.settle();
    times.push([loaded - before, cpu() - loaded]);
    sim.dispose();
  }
  const [load, first] = [0, 1].map((k) => median(times.map((row) => row[k])));
  console.log(`loading: ${load.toFixed(3)} s CPU; first closure of 425 vertices afterwards: ${first.toFixed(3)} s CPU`);
}

function nativeProgram() {
  const library = ["build/release/lib", "build/release/libmvs", "build/release"].map((path) => join(root, path))
    .find((folder) => {
      try {
        return readdirSync(folder).includes("libmvs.so");
      } catch {
        return false;
      }
    });
  if (!library) throw new Error("no libmvs.so in build/release: cmake --build --preset release --target mvs");
  const program = join(root, "build/js/closure");
  execFileSync("cc", ["-O2", "-I", join(root, "include"), join(here, "closure.c"), "-o", program, "-L", library, "-lmvs", `-Wl,-rpath,${library}`]);
  return program;
}

function native(program, { shape, vertices }) {
  const text = execFileSync(program, [shape, vertices, runs].map(String), { encoding: "utf8" });
  return text.trim().split("\n").map((line) => line.split(" ")).map(([settle, steps, hash]) => ({ settle: Number(settle), steps: Number(steps), hash }));
}

function webAssembly(mvs, { shape, vertices }) {
  const sim = mvs.simulator();
  sim.generateValve({ shape, vertices });
  sim.setLoad();
  const open = sim.snapshot();
  const rows = Array.from({ length: runs }, () => {
    sim.restore(open);
    let before = cpu();
    sim.settle();
    const settle = cpu() - before;
    const hash = sim.read((snapshot) => snapshot.hash);
    sim.restore(open);
    sim.step();
    before = cpu();
    sim.step(undefined, 200);
    return { settle, steps: cpu() - before, hash };
  });
  open.dispose();
  sim.dispose();
  return rows;
}

const wasm = size();
await loading(wasm);
const program = nativeProgram();
const mvs = await loadMvs({ wasm });
console.log("case                      closure, CPU s: native  wasm  ratio   live step, ms: native  wasm  ratio   hashes");
let differ = 0;
for (const one of cases) {
  webAssembly(mvs, one); // the engine has optimised by then
  const rows = { native: [], wasm: [] };
  for (let k = 0; k < rounds; ++k) {
    rows.native.push(...native(program, one));
    rows.wasm.push(...webAssembly(mvs, one));
  }
  const figure = (kind, which) => median(rows[kind].map((row) => row[which]));
  const same = new Set([...rows.native, ...rows.wasm].map((row) => row.hash)).size === 1;
  if (!same) ++differ;
  const [a, b, c, d] = [figure("native", "settle"), figure("wasm", "settle"), figure("native", "steps") * 5, figure("wasm", "steps") * 5];
  console.log(`${one.name.padEnd(26)}${a.toFixed(3).padStart(21)}${b.toFixed(3).padStart(7)}${(b / a).toFixed(2).padStart(6)}${c.toFixed(2).padStart(23)}${d.toFixed(2).padStart(7)}${(d / c).toFixed(2).padStart(6)}   ${same ? "equal" : "DIFFER"}`);
}
process.exitCode = differ === 0 ? 0 : 1;
