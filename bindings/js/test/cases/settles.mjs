// Loads, settles in slices, progress.
import { hashOf } from "./life.mjs";
import { equal, fails, ok } from "../check.mjs";

export const settles = {
  a_load_that_is_given_in_part_has_the_defaults_of_systole: async ({ mvs }) => {
    const sim = mvs.simulator();
    sim.generateValve();
    const loads = [[undefined, 15998.64, 1], [{}, 15998.64, 1], [{ pressure: 8000 }, 8000, 1], [{ boundary_fraction: 0.5 }, 15998.64, 0.5],
      [{ pressure: 0, boundary_fraction: 0 }, 0, 0]];
    for (const [load, pressure, fraction] of loads) {
      sim.setLoad(load);
      equal(sim.loadCase.pressure, pressure, "pressure");
      equal(sim.loadCase.boundary_fraction, fraction, "boundary_fraction");
    }
    await fails(() => sim.setLoad({ presure: 8000 }), "MVS_E_ARGUMENT", /no field presure/, "load.presure");
    await fails(() => sim.setLoad({ pressure: null }), "MVS_E_ARGUMENT", /null/, "load.pressure");
    await fails(() => sim.setLoad(null), "MVS_E_ARGUMENT", /load/);
    sim.setLoad();
    sim.settle();
    const ensembles = sim.read((s) => [undefined, {}, { pressure: 15998.64 }].map((load) => s.ensemble(load, { members: 1 })));
    for (const ensemble of ensembles) {
      const member = ensemble.snapshot(0);
      equal(member.load.boundary_fraction, 1, "boundary_fraction of a member");
      member.dispose();
      ensemble.dispose();
    }
    sim.dispose();
  },

  a_settle_in_slices_has_the_same_bits: async ({ mvs }) => {
    const sim = mvs.simulator();
    sim.generateValve();
    sim.setLoad();
    const open = sim.snapshot();
    const shares = [];
    let served = 0;
    const timer = setInterval(() => ++served, 0);
    const stats = await sim.settleInSlices({ slice: 0.001, onProgress: (share) => shares.push(share) });
    clearInterval(timer);
    equal(stats.converged, 1, "converged");
    ok(shares.length > 3 && shares.at(-1) === 1, `shares ${shares}`);
    ok(served > 0, "timers run in between");
    const sliced = hashOf(sim);
    sim.restore(open);
    sim.settle();
    equal(sliced, hashOf(sim), "hash");
    sim.restore(open);
    const controller = new AbortController();
    await fails(
      () => sim.settleInSlices({ slice: 0.001, signal: controller.signal, onProgress: () => controller.abort() }),
      "MVS_E_CANCELLED", /cancelled/);
    equal(hashOf(sim), open.hash, "hash after the cancellation");
    await fails(() => sim.advanceSettle(0), "MVS_E_STATE", /settle/);
    open.dispose();
    sim.dispose();
  },

  a_settle_in_slices_ends_for_one_caller: async ({ mvs }) => {
    const sim = mvs.simulator();
    sim.generateValve();
    sim.setLoad();
    const open = sim.snapshot();
    const begin = (options) => {
      const promise = sim.settleInSlices({ slice: 0.001, ...options });
      promise.catch(() => {});
      return promise;
    };
    // aborted, changed, begun anew: the new one comes to rest
    const controller = new AbortController();
    const first = begin({ signal: controller.signal });
    controller.abort();
    sim.apply("chord_length", { chord: "A2/7", factor: 0.9 });
    const second = begin();
    await fails(() => first, "MVS_E_CANCELLED", /cancelled/, "settle");
    equal((await second).converged, 1, "converged");
    // two at the same time: only the second has a result
    sim.restore(open);
    const loose = begin({ residual: 1e-1 });
    const fine = begin({ residual: 1e-6 });
    await fails(() => loose, "MVS_E_CANCELLED", /replaced by a new settle/, "settle");
    equal((await fine).converged, 1, "converged");
    equal(sim.read((s) => s.rest.tolerance), 1e-6, "tolerance");
    // a failed begin ends nothing
    sim.restore(open);
    const kept = begin();
    await fails(() => sim.settleInSlices({ solver: "fast" }), "MVS_E_ARGUMENT", /one of newton/);
    equal((await kept).converged, 1, "converged");
    sim.restore(open);
    const ended = [
      [() => sim.apply("chord_length", { chord: "A2/7", factor: 0.9 }), /another call has changed the valve/],
      [() => sim.restore(open), /another call has changed the valve/],
      [() => sim.cancelSettle(), /cancelSettle/],
      [() => sim.beginSettle(), /replaced by a new settle/],
    ];
    for (const [change, sentence] of ended) {
      const promise = begin();
      change();
      await fails(() => promise, "MVS_E_CANCELLED", sentence, "settle");
    }
    sim.advanceSettle(0); // the settle that beginSettle() began goes on
    sim.cancelSettle();
    // a failure of the caller's function ends its own settle
    await fails(() => sim.settleInSlices({ slice: 0.001, onProgress: () => sim.undo() }), "MVS_E_STATE", /undo/);
    await fails(() => sim.advanceSettle(0), "MVS_E_STATE", /settle/);
    sim.restore(open);
    const lost = begin();
    sim.dispose();
    await fails(() => lost, "MVS_E_STATE", /disposed/, "simulator");
    open.dispose();
  },

  progress_and_log_reach_javascript: async ({ mvs }) => {
    const lines = [];
    let calls = 0;
    const sim = mvs.simulator({ log: (level, text) => lines.push(`${level} ${text}`), progress: () => void ++calls });
    sim.generateValve();
    sim.setLoad({ pressure: 120, boundary_fraction: 1 });
    ok(lines.some((line) => line.startsWith("warning") && /mmHg/.test(line)), `log: ${lines}`);
    sim.setLoad();
    sim.settle();
    ok(calls > 0, "progress was called");
    sim.dispose();
    const strict = mvs.simulator({ progress: (share) => share >= 0 });
    strict.generateValve();
    strict.setLoad();
    await fails(() => strict.settle(), "MVS_E_CANCELLED", /cancel/);
    strict.dispose();
    const thrower = mvs.simulator({
      progress: () => {
        throw new RangeError("of the caller");
      },
    });
    thrower.generateValve();
    thrower.setLoad();
    let thrown;
    try {
      thrower.settle();
    } catch (error) {
      thrown = error;
    }
    ok(thrown instanceof RangeError, "the exception of a callback reaches the caller");
    thrower.dispose();
    const eager = mvs.simulator({ progress: () => eager.dispose() });
    eager.generateValve();
    eager.setLoad();
    await fails(() => eager.settle(), "MVS_E_STATE", /callback cannot dispose/);
    ok(!eager.isDisposed, "still held");
    eager.dispose();
  },
};
