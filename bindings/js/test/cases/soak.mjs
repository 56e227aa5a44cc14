// Soak: many rounds of all that allocates. The memory of the module must not grow after the first rounds.
import { equal, ok } from "../check.mjs";

function round(mvs, sim, k) {
  sim.apply("chord_length", { chord: "A2/7", factor: 0.9 });
  sim.settle();
  const snapshot = sim.snapshot();
  snapshot.measure();
  snapshot.chords();
  snapshot.regions();
  snapshot.array("node_force");
  const text = snapshot.toObj();
  const plan = snapshot.plan();
  const tool = sim.grasp(100 + (k % 100));
  sim.step(undefined, 5);
  sim.removeTool(tool);
  sim.restore(snapshot);
  sim.undo();
  const other = mvs.simulator({ log: () => {} });
  other.load(text);
  other.dispose();
  snapshot.dispose();
  ok(plan.length > 100, "plan");
}

export const soak = {
  the_memory_is_stable({ mvs, rounds }) {
    const sim = mvs.simulator();
    sim.generateValve();
    sim.setLoad();
    sim.settle();
    const start = sim.snapshot();
    const warm = Math.ceil(rounds / 4);
    let memory = 0;
    let bytes = 0;
    for (let k = 0; k < rounds; ++k) {
      round(mvs, sim, k);
      sim.restore(start);
      if (k === warm) {
        memory = mvs.usage.memoryBytes;
        bytes = mvs.usage.wrapperBytes;
      }
    }
    equal(mvs.usage.memoryBytes, memory, "bytes of the memory");
    equal(mvs.usage.wrapperBytes, bytes, "bytes of the wrappers");
    start.dispose();
    sim.dispose();
  },
};
