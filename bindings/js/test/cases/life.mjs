// Life of objects: load, close, arrays and their validity, release, leaks, memory that is exhausted.
import { equal, fails, ok } from "../check.mjs";

export const closed = (mvs, vertices = 425) => {
  const sim = mvs.simulator();
  sim.generateValve({ vertices });
  sim.setLoad();
  sim.settle();
  return sim;
};

export const hashOf = (sim) => sim.read((snapshot) => snapshot.hash);

// Takes all memory but about `kept` bytes, in one piece; below 0: all memory.
function fill(heap, kept) {
  const blocks = kept > 0 ? [heap.allocate(kept)] : [];
  try {
    for (let size = 1 << 20; size >= 1024; ) {
      try {
        blocks.push(heap.allocate(size));
      } catch (error) {
        if (kept < 0 && size === 1024) throw error;
        size /= 2;
      }
    }
  } finally {
    if (kept < 0) blocks.splice(0).forEach((block) => heap.free(block));
  }
  if (kept > 0) heap.free(blocks.shift());
  return blocks;
}

export const life = {
  a_valve_closes_and_can_be_measured({ mvs }) {
    const sim = closed(mvs);
    equal(sim.stats().converged, 1, "converged");
    const snapshot = sim.snapshot();
    const measures = snapshot.measure();
    equal(measures.at_rest, 1, "at_rest");
    equal(measures.intersections, 0, "intersections");
    ok(measures.coaptation_area > 1e-5, "leaflets coapt");
    ok(/^[0-9a-f]{32}$/.test(snapshot.hash), "hash");
    equal(snapshot.load.pressure, 15998.64, "pressure");
    snapshot.dispose();
    sim.dispose();
  },

  arrays_are_views_of_the_memory({ mvs }) {
    const sim = closed(mvs);
    const snapshot = sim.snapshot();
    const x = snapshot.array("node_position");
    equal(x.buffer, mvs.c.heap.buffer, "buffer");
    equal(snapshot.array("node_position"), x, "asked again");
    const view = snapshot.view("triangle_nodes");
    equal(view.components, 3, "components");
    equal(view.values.length, 3 * view.count, "numbers");
    ok(view.values instanceof Uint32Array, "triangles are Uint32Array");
    ok(snapshot.array("chord_id") instanceof BigUint64Array, "ids are BigUint64Array");
    ok(snapshot.array("node_kind") instanceof Uint8Array, "kinds are Uint8Array");
    equal(snapshot.array("ring_id").length, 0, "no rings");
    ok(snapshot.copy("node_position").buffer !== x.buffer, "a copy has its own buffer");
    snapshot.dispose();
    sim.dispose();
  },

  views_are_made_anew_after_the_memory_has_grown({ mvs }) {
    const sim = closed(mvs);
    const snapshot = sim.snapshot();
    const before = snapshot.array("node_position");
    const numbers = before.slice();
    const { heap } = mvs.c;
    const blocks = [];
    while (before.length > 0) blocks.push(heap.allocate(8 << 20));
    const after = snapshot.array("node_position");
    equal(after.buffer, heap.buffer, "buffer");
    ok(after.length === numbers.length && after.every((value, k) => Object.is(value, numbers[k])), "the same numbers");
    for (const block of blocks) heap.free(block);
    snapshot.dispose();
    sim.dispose();
  },

  async what_was_disposed_of_is_refused({ mvs }) {
    const sim = closed(mvs);
    const snapshot = sim.snapshot();
    const view = snapshot.view("node_position");
    snapshot.dispose();
    snapshot.dispose();
    await fails(() => snapshot.measure(), "MVS_E_STATE", /disposed/, "snapshot");
    await fails(() => snapshot.array("node_position"), "MVS_E_STATE", /disposed/);
    await fails(() => view.values, "MVS_E_STATE", /disposed/);
    sim.dispose();
    await fails(() => sim.settle(), "MVS_E_STATE", /disposed/, "simulator");
    ok(sim.isDisposed, "isDisposed");
  },

  async only_snapshots_of_the_same_module_are_taken({ mvs, load }) {
    const sim = closed(mvs);
    const snapshot = sim.snapshot();
    const other = closed(await load({}));
    const foreign = other.snapshot();
    const before = snapshot.hash;
    for (const wrong of [sim, null, undefined, 5, "x", {}, [], { handle: snapshot.handle }, { handle: 16 }]) {
      await fails(() => sim.restore(wrong), "MVS_E_ARGUMENT", /has to be a Snapshot/, "snapshot");
      await fails(() => sim.transferState(wrong), "MVS_E_ARGUMENT", /has to be a Snapshot/, "from");
      await fails(() => snapshot.compare(wrong), "MVS_E_ARGUMENT", /has to be a Snapshot/, "other");
    }
    await fails(() => sim.restore(sim), "MVS_E_ARGUMENT", /snapshot is a simulator/, "snapshot");
    await fails(() => sim.restore(foreign), "MVS_E_ARGUMENT", /another module/, "snapshot");
    await fails(() => sim.transferState(foreign), "MVS_E_ARGUMENT", /another module/, "from");
    await fails(() => snapshot.compare(foreign), "MVS_E_ARGUMENT", /another module/, "other");
    equal(hashOf(sim), before, "hash");
    equal(foreign.measure().at_rest, 1, "the other module works");
    for (const owned of [foreign, other, snapshot, sim]) owned.dispose();
  },

  async only_handles_that_are_held_are_taken({ mvs }) {
    const { c } = mvs;
    const sim = c.mvs_create();
    c.mvs_generate_valve(sim);
    const snapshot = c.mvs_get_snapshot(sim);
    const again = c.mvs_snapshot_retain(snapshot) ?? snapshot;
    for (const wrong of [sim, 16, snapshot + 8, "x", { handle: snapshot }, true]) {
      await fails(() => c.mvs_restore(sim, wrong), "MVS_E_ARGUMENT", /handle of a snapshot/, "snapshot");
    }
    await fails(() => c.mvs_undo(snapshot), "MVS_E_ARGUMENT", /handle of a sim/, "sim");
    c.mvs_snapshot_release(snapshot);
    c.mvs_restore(sim, again);
    c.mvs_snapshot_release(again);
    await fails(() => c.mvs_restore(sim, snapshot), "MVS_E_ARGUMENT", /still holds/, "snapshot");
    await fails(() => c.mvs_snapshot_release(snapshot), "MVS_E_ARGUMENT", /still holds/, "snapshot");
    c.mvs_destroy(sim);
    await fails(() => c.mvs_undo(sim), "MVS_E_ARGUMENT", /still holds/, "sim");
  },

  a_snapshot_outlives_its_simulator({ mvs }) {
    const sim = closed(mvs);
    const snapshot = sim.snapshot();
    sim.dispose();
    ok(snapshot.measure().coaptation_area > 0, "measured");
    snapshot[Symbol.dispose]();
  },

  nothing_is_held_after_disposing({ mvs }) {
    const before = JSON.stringify(mvs.usage.handles);
    const bytes = mvs.usage.wrapperBytes;
    const sim = closed(mvs);
    const snapshot = sim.snapshot();
    const { opened } = snapshot.cost();
    const ensemble = snapshot.ensemble({ pressure: 15998.64, boundary_fraction: 1 }, { members: 2, start: "snapshot" });
    const member = ensemble.snapshot(1);
    ok(JSON.stringify(mvs.usage.handles) !== before, "handles are counted");
    for (const owned of [member, ensemble, opened, snapshot, sim]) owned.dispose();
    equal(JSON.stringify(mvs.usage.handles), before, "handles");
    equal(mvs.usage.wrapperBytes, bytes, "bytes of the wrappers");
  },

  async failures_leak_nothing({ mvs }) {
    const sim = mvs.simulator();
    sim.generateValve();
    const bytes = mvs.usage.wrapperBytes;
    const handles = JSON.stringify(mvs.usage.handles);
    for (let k = 0; k < 50; ++k) {
      await fails(() => sim.load("v 1 2\n", "obj"), "MVS_E_FORMAT", /./);
      await fails(() => sim.apply("chord_length", { chord: "A2/7", factor: -1 }), "MVS_E_ARGUMENT", /factor/);
      await fails(() => sim.settle({ solver: "fast" }), "MVS_E_ARGUMENT", /one of newton, implicit, explicit/);
      await fails(() => sim.setValve({ nodes: [[0, 0, 0]], triangles: ["a"] }), "MVS_E_ARGUMENT", /triangles/);
    }
    equal(mvs.usage.wrapperBytes, bytes, "bytes of the wrappers");
    equal(JSON.stringify(mvs.usage.handles), handles, "handles");
    sim.dispose();
  },

  async what_is_forgotten_is_released_by_the_garbage_collector({ mvs }) {
    if (typeof globalThis.gc !== "function") throw new Error("start the engine with --expose-gc");
    const sim = closed(mvs);
    const count = () => mvs.usage.handles.mvs_snapshot_release ?? 0;
    const before = count();
    (() => {
      for (let k = 0; k < 20; ++k) sim.snapshot();
    })();
    ok(count() > before, "snapshots are held");
    for (let k = 0; k < 100 && count() > before; ++k) {
      globalThis.gc();
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    equal(count(), before, "held after a collection");
    sim.dispose();
  },

  async an_array_keeps_its_snapshot({ mvs }) {
    const sim = closed(mvs);
    const count = () => mvs.usage.handles.mvs_snapshot_release ?? 0;
    const before = count();
    let arrays = (() => [sim.snapshot().array("node_position"), sim.snapshot().view("node_position")])();
    const numbers = arrays[0].slice();
    sim.generateValve({ vertices: 300 });
    const collect = async () => {
      for (let k = 0; k < 10; ++k) {
        globalThis.gc();
        await new Promise((resolve) => setTimeout(resolve, 10));
      }
    };
    await collect();
    equal(count(), before + 2, "snapshots held by the array and the view");
    const other = closed(mvs);
    ok(arrays[0].every((value, k) => Object.is(value, numbers[k])), "the same numbers");
    ok(arrays[1].values.every((value, k) => Object.is(value, numbers[k])), "the same numbers of the view");
    arrays = undefined;
    for (let k = 0; k < 10 && count() > before; ++k) await collect();
    equal(count(), before, "snapshots held without them");
    for (const owned of [other, sim]) owned.dispose();
  },

  async bodies_of_tools_end_with_their_snapshot({ mvs }) {
    const sim = closed(mvs);
    sim.addTool({ kind: "convex", position: [0, 0, 0.05], bodies: [{ kind: "hull", vertices: [0, 0, 0, 0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01], radius: 0.001 }] });
    const [body] = sim.read((s) => s.toolBodies(0));
    await fails(() => body.vertices.values, "MVS_E_STATE", /disposed/, "array");
    sim.dispose();
  },

  each_array_has_the_type_of_its_name({ libmvs, mvs }) {
    const sim = closed(mvs);
    sim.read((s) => {
      const types = Object.keys(libmvs.ArrayKind).map((name) => `${name} ${s.array(name).constructor.name}`);
      ok(types.includes("chord_id BigUint64Array") && types.includes("triangle_nodes Uint32Array") && types.includes("node_kind Uint8Array"), `${types}`);
    });
    sim.dispose();
  },

  async memory_that_is_exhausted_is_a_failure({ load }) {
    const mvs = await load({ maxMemory: 32 << 20 });
    const sim = mvs.simulator();
    sim.generateValve();
    sim.setLoad();
    const open = sim.snapshot();
    const { heap } = mvs.c;
    let refused = 0;
    for (let kept = 16; kept <= 16384; kept *= 2) {
      const blocks = fill(heap, 1024 * kept);
      for (const work of [() => sim.settle(), () => sim.generateValve({ vertices: 3000 }), () => sim.read((s) => s.measure())]) {
        try {
          work();
        } catch (error) {
          equal(error.code, "MVS_E_MEMORY", String(error));
          ++refused;
          equal(sim.read((s) => s.hash), open.hash, "hash after the failure");
        }
        sim.restore(open);
      }
      for (const block of blocks) heap.free(block);
    }
    ok(refused >= 3, `${refused} calls were refused`);
    await fails(() => fill(heap, -1), "MVS_E_MEMORY", /bytes are free/);
    equal(sim.settle().converged, 1, "closes afterwards");
    open.dispose();
    sim.dispose();
  },

  async two_modules_are_independent({ mvs, load }) {
    const other = await load({});
    const [a, b] = [closed(mvs), closed(other)];
    equal(a.read((s) => s.hash), b.read((s) => s.hash), "hash");
    ok(a.mvs.c.heap.buffer !== b.mvs.c.heap.buffer, "memory");
    a.dispose();
    b.dispose();
  },

  async a_module_that_cannot_start_says_why({ libmvs }) {
    await fails(() => libmvs.instantiate({}), "MVS_E_ARGUMENT", /wasm is missing/, "wasm");
    const page = new TextEncoder().encode("\n<!doctype html><title>app</title>");
    await fails(() => libmvs.instantiate({ wasm: page }), "MVS_E_FORMAT", /a page \(HTML\) and not mvs\.wasm/, "wasm");
    await fails(() => libmvs.instantiate({ wasm: page.buffer }), "MVS_E_FORMAT", /HTML/, "wasm");
    await fails(() => libmvs.instantiate({ wasm: new Uint8Array([1, 2, 3]) }), "MVS_E_FORMAT", /other bytes/, "wasm");
    await fails(() => libmvs.instantiate({ wasm: new Uint8Array(0) }), "MVS_E_FORMAT", /nothing/, "wasm");
    const head = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0);
    await fails(() => libmvs.instantiate({ wasm: head.subarray(0, 6) }), "MVS_E_UNSUPPORTED", /could not be started/, "wasm");
    await fails(() => libmvs.instantiate({ wasm: head, maxMemory: 5 }), "MVS_E_ARGUMENT", /maxMemory/, "maxMemory");
    for (const wasm of ["mvs.wasm", 5, {}, Promise.resolve(head)]) {
      await fails(() => libmvs.loadMvs({ wasm }), "MVS_E_ARGUMENT", /neither bytes nor/, "wasm");
    }
    await fails(() => libmvs.loadMvs(null), "MVS_E_ARGUMENT", /options is null/, "options");
    await fails(() => libmvs.loadMvs(5), "MVS_E_ARGUMENT", /options is 5/, "options");
    await fails(() => libmvs.loadMvs({ wasm: head, memory: 5 }), "MVS_E_ARGUMENT", /no field memory; its fields are wasm/, "options.memory");
  },

  async bytes_pack_into_text_and_back({ libmvs }) {
    const bytes = Uint8Array.from({ length: 100000 }, (_, k) => (k * k) >> 5);
    const back = await libmvs.unpackBytes(await libmvs.packBytes(bytes));
    ok(back.length === bytes.length && back.every((byte, k) => byte === bytes[k]), "the same bytes");
  },
};
