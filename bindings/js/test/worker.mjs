// The cases in a browser's worker: answers a job { groups, rounds } with one message for each case.
import { life } from "./cases/life.mjs";
import { operations } from "./cases/operations.mjs";
import { soak } from "./cases/soak.mjs";
import { refusals } from "./cases/refusals.mjs";
import { settles } from "./cases/settles.mjs";
import { work } from "./cases/work.mjs";

const groups = { life, operations, settles, refusals, work, soak };

onmessage = async ({ data: { packed, job } }) => {
  const { libmvs } = globalThis;
  try {
    const wasm = await WebAssembly.compile(await libmvs.unpackBytes(packed));
    const load = (options) => libmvs.loadMvs({ wasm, ...options });
    const mvs = await load({});
    for (const group of job.groups) {
      for (const [name, run] of Object.entries(groups[group])) {
        try {
          await run({ libmvs, mvs, load, rounds: job.rounds });
          postMessage({ name: `${group}: ${name}` });
        } catch (error) {
          postMessage({ name: `${group}: ${name}`, failure: String(error?.stack ?? error) });
        }
      }
    }
    postMessage({ done: true });
  } catch (error) {
    postMessage({ done: true, failure: String(error?.stack ?? error) });
  }
};
