// Soak: many rounds of work that allocates, in a memory that cannot grow.
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
  const free = snapshot.array("node_kind").findIndex((kind, node) => kind === 0 && node > 100 + (k % 100));
  const tool = sim.grasp(free);
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

// Bytes that can be allocated in a memory that cannot grow, in pieces of 1 kB and more.
function freeBytes(heap) {
  const blocks = [];
  let sum = 0;
  for (let size = 1 << 20; size >= 1024; ) {
    try {
      blocks.push(heap.allocate(size));
      sum += size;
    } catch {
      size /= 2;
    }
  }
  for (const block of blocks) heap.free(block);
  return sum;
}

export const soak = {
  async the_memory_is_stable({ load, rounds }) {
    const mvs = await load({ maxMemory: 32 << 20 });
    const sim = mvs.simulator();
    sim.generateValve();
    sim.setLoad();
    sim.settle();
    const start = sim.snapshot();
    const warm = Math.ceil(rounds / 4);
    let free = 0;
    for (let k = 0; k < rounds; ++k) {
      round(mvs, sim, k);
      sim.restore(start);
      if (k === warm) free = freeBytes(mvs.c.heap);
    }
    // fragments moved it by 10 kB either way in 8 rounds; one snapshot that is kept takes 100 kB
    const lost = free - freeBytes(mvs.c.heap);
    ok(lost < 65536, `${lost} bytes were lost in ${rounds - warm} rounds`);
    equal(mvs.usage.wrapperBytes, 0, "bytes of the wrappers");
    equal(mvs.usage.handles.mvs_snapshot_release, 1, "snapshots held");
    equal(mvs.usage.handles.mvs_destroy, 1, "simulators held");
  },
};
