// Work on a valve: settling, plans, files, instruments, slices, picking.
import { closed, hashOf } from "./life.mjs";
import { equal, fails, near, ok } from "../check.mjs";

// The middle of a chord and a ray that meets it from 0.1 m away, at a right angle to it.
function rayAt(snapshot, chord) {
  const x = snapshot.array("node_position");
  const nodes = snapshot.array("chord_nodes");
  const [a, b] = [nodes[2 * chord], nodes[2 * chord + 1]].map((n) => [x[3 * n], x[3 * n + 1], x[3 * n + 2]]);
  const middle = a.map((v, k) => (v + b[k]) / 2);
  const along = b.map((v, k) => v - a[k]);
  const across = Math.abs(along[2]) > Math.abs(along[0]) ? [along[2], 0, -along[0]] : [along[1], -along[0], 0];
  const length = Math.hypot(...across);
  return { middle, origin: middle.map((v, k) => v - (0.1 * across[k]) / length), direction: across };
}

export const work = {
  async bad_values_are_refused({ mvs }) {
    const sim = mvs.simulator();
    await fails(() => sim.settle(), "MVS_E_STATE", /valve/);
    await fails(() => sim.generateValve({ vertices: -5 }), "MVS_E_ARGUMENT", /vertices is -5/, "desc.vertices");
    await fails(() => sim.generateValve({ vertices: 1.5 }), "MVS_E_ARGUMENT", /whole number/);
    await fails(() => sim.generateValve({ annulus_ap: 10 }), "MVS_E_ARGUMENT", /annulus_ap/);
    await fails(() => sim.generateValve({ colour: 3 }), "MVS_E_ARGUMENT", /no field colour; its fields are vertices/);
    await fails(() => sim.setLoad({ pressure: "high" }), "MVS_E_ARGUMENT", /pressure is not a number/);
    await fails(() => sim.setLoad(7), "MVS_E_ARGUMENT", /not an object/);
    await fails(() => sim.load("", "h5"), "MVS_E_UNSUPPORTED", /./);
    await fails(() => sim.setValve({}), "MVS_E_OP", /nodes/);
    await fails(() => mvs.c.mvs_device_open?.() ?? mvs.c.raw("mvs_no_such"), "MVS_E_UNSUPPORTED", /no function/);
    await fails(() => mvs.readSurface("", "folder/.."), "MVS_E_ARGUMENT", /no name of a file/);
    await fails(() => mvs.readSurface("solid x", "part.stl", { unit: "mm" }), "MVS_E_FORMAT", /part\.stl/);
    sim.generateValve();
    await fails(() => sim.read((s) => s.part("chord", "a\0b")), "MVS_E_ARGUMENT", /zero character/);
    await fails(() => sim.read((s) => s.array("node_colour")), "MVS_E_ARGUMENT", /one of node_position/);
    await fails(() => sim.moveTool(5n, [0, 0]), "MVS_E_ARGUMENT", /has to have 3/);
    await fails(() => sim.moveTool(5n, [0, 0, 0]), "MVS_E_ID", /5/);
    await fails(() => sim.moveTool("x", [0, 0, 0]), "MVS_E_ARGUMENT", /bigint/);
    sim.dispose();
  },

  a_zero_that_would_be_the_default_is_refused: async ({ mvs }) => {
    const sim = closed(mvs);
    const refused = (work, part) => fails(work, "MVS_E_ARGUMENT", /is 0, which would be taken for its default/, part);
    for (const field of ["saddle_height", "indentation_depth", "coaptation_depth", "annulus_contraction", "annulus_scale", "chord_slack", "vertices"]) {
      await refused(() => sim.generateValve({ [field]: 0 }), `desc.${field}`);
      await refused(() => sim.generateValve({ [field]: -0 }), `desc.${field}`);
    }
    await refused(() => sim.setLeaflet("A", { law: "bilinear", thickness: 0 }), "tissue.thickness");
    await refused(() => sim.setValve({ chords: [{ young: 0 }] }), "valve.chords[0].young");
    await refused(() => sim.setValve({ density: 0 }), "valve.density");
    await fails(() => sim.setValve({ bending_scale: 0 }), "MVS_E_ARGUMENT", /flag_no_bending/, "valve.bending_scale");
    await fails(() => sim.setValve({ bending_scale: 0, flags: 2 }), "MVS_E_OP", /nodes/);
    await refused(() => sim.settle({ residual: 0 }), "options.residual");
    await refused(() => sim.settle({ solver: "explicit", damping: 0 }), "options.damping");
    await refused(() => sim.step({ solver: "explicit", damping: 0 }), "options.damping");
    sim.step({ solver: "implicit", damping: 0 });
    sim.step({ damping: 0 });
    await refused(() => sim.step({ budget: 0 }), "options.budget");
    await refused(() => sim.read((s) => s.cost({ pressure: 0 })), "options.pressure");
    await refused(() => sim.read((s) => s.ensemble({}, { members: 0 })), "options.members");
    await refused(() => sim.grasp(200, { max_force: 0 }), "desc.max_force");
    await refused(() => sim.check("annulus_scale", { factor: 0.9, ap: 0 }), "annulus_scale.ap");
    await refused(() => sim.check("neochord", { head: "PM1", site: { scallop: "P2", u: [0.3, 0.9] }, length: 0 }), "neochord.length");
    await refused(() => sim.check("neochord", { head: "PM1", site: { scallop: "P2", u: [0.3, 0.9] }, strands: 0 }), "neochord.strands");
    sim.check("resect", { base_width: 0 }); // a triangle
    sim.check("clip", { position: 0, angle: 0 }); // within their ranges
    sim.dispose();
  },

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

  plans_and_files_come_back({ mvs }) {
    const sim = closed(mvs);
    sim.apply("chord_length", { chord: "A2/7", factor: 0.75 });
    sim.settle();
    const snapshot = sim.snapshot();
    const plan = snapshot.plan({ author: "test", notes: "äöü" });
    const again = mvs.simulator();
    again.generateValve({ vertices: 425 });
    equal(again.checkPlan(plan).operations, 1, "operations");
    const replay = again.replayPlan(plan);
    equal(replay.same_result, 1, "same_result");
    equal(hashOf(again), snapshot.hash, "hash of the replay");
    const text = snapshot.toObj();
    again.load(text);
    equal(again.read((s) => s.toObj()), text, "OBJ of the loaded OBJ");
    ok(new TextDecoder().decode(snapshot.save("vtp")).includes("PolyData"), "VTP");
    for (const owned of [snapshot, sim, again]) owned.dispose();
  },

  a_valve_of_arrays_is_that_of_the_snapshot({ mvs }) {
    const sim = closed(mvs);
    const made = mvs.simulator();
    sim.read((s) => {
      const chords = s.array("chord_nodes");
      const lengths = s.array("chord_rest_length");
      const heads = s.array("head_nodes");
      const valve = {
        nodes: s.array("node_rest"),
        nodes_loaded: s.array("node_loaded"),
        triangles: s.array("triangle_nodes"),
        triangle_leaflet: Array.from(s.array("triangle_leaflet")),
        annulus: s.array("annulus_nodes"),
        leaflets: s.parts("leaflet").map(({ name }) => ({ name, law: "spring" })),
        chords: Array.from(lengths, (rest_length, k) => ({ node_a: chords[2 * k], node_b: chords[2 * k + 1], rest_length })),
        heads: Array.from(heads, (node, k) => ({ node, name: `H${k}` })),
      };
      const { code, faults } = mvs.checkValve(valve);
      equal(code, "MVS_OK", JSON.stringify(faults));
      made.setValve(valve);
      equal(mvs.checkValve({ ...valve, annulus: [0, 1] }).code !== "MVS_OK", true, "a bad annulus");
      ok(mvs.checkValve({ ...valve, annulus: [0, 1] }).faults[0].sentence.length > 10, "a sentence");
    });
    equal(made.read((s) => s.parts("head")[0].name), "H0", "name");
    made.setLoad();
    equal(made.settle().converged, 1, "converged");
    for (const owned of [made, sim]) owned.dispose();
  },

  instruments_grasp_and_push({ mvs }) {
    const sim = closed(mvs);
    const node = 200;
    const tool = sim.grasp(node, { max_force: 2 });
    const start = Array.from(sim.tool(tool).position);
    for (let k = 1; k <= 20; ++k) {
      sim.moveTool(tool, [start[0], start[1], start[2] + 100e-6 * k]);
      sim.step();
    }
    const state = sim.tool(tool);
    equal(state.kind, "grasp", "kind");
    equal(state.node, node, "node");
    ok(Math.hypot(...state.force) > 1e-3, "the tissue pulls");
    equal(sim.read((s) => s.tools().length), 1, "tools");
    sim.removeTool(tool);
    const ball = sim.addTool({ kind: "ball", position: [start[0], start[1], start[2] + 30e-3], radius: 2e-3 });
    ok(sim.tool(ball).distance > 0, "distance of a ball");
    sim.dispose();
  },

  a_ray_meets_leaflets_chords_and_heads({ mvs }) {
    const sim = closed(mvs);
    sim.read((s) => {
      const { origin, atrium } = s.frame();
      const from = origin.map((value, k) => value + 0.1 * atrium[k]);
      const leaflet = s.pick({ origin: from, direction: atrium.map((v) => -v) });
      equal(leaflet.kind, "leaflet", "kind");
      ok(/^[AP]\d$/.test(leaflet.name), `scallop ${leaflet.name}`);
      near(leaflet.u[0] + leaflet.u[1] + leaflet.u[2], 1, 1e-9, "barycentric coordinates");
      sim.check("chord_add", { head: "AL1", site: { triangle: leaflet.index, u: leaflet.u } });
      for (const index of [0, 5, 11]) {
        const { middle, ...ray } = rayAt(s, index);
        const met = s.pick({ ...ray, radius: 1e-5, kinds: ["chord"] });
        equal(met?.kind, "chord", "kind");
        near(Math.hypot(...met.point.map((v, k) => v - middle[k])), 0, 2e-4, "distance from its middle");
      }
      const node = s.array("head_nodes")[0];
      const at = Array.from(s.array("node_position").subarray(3 * node, 3 * node + 3));
      const head = s.pick({ origin: [at[0], at[1], at[2] - 0.1], direction: [0, 0, 2] });
      equal(head.kind, "head", "kind");
      equal(head.name, s.parts("head")[0].name, "name");
      equal(s.pick({ origin: [1, 1, 1], direction: [1, 0, 0] }), undefined, "nothing is met");
    });
    sim.dispose();
  },

  async bad_rays_are_refused({ mvs }) {
    const sim = closed(mvs);
    const s = sim.snapshot();
    const ray = { origin: [0, 0, 0.1], direction: [0, 0, -1] };
    ok(s.pick(ray), "a ray that meets");
    const cases = [
      [null, /null/, "ray"], [{ direction: [0, 0, 1] }, /3 numbers/, "ray.origin"], [{ origin: [0, 0, 1] }, /3 numbers/, "ray.direction"],
      [{ ...ray, direction: [0, 0, 0] }, /length 0/, "ray.direction"], [{ ...ray, direction: [0, -1] }, /3 numbers/, "ray.direction"],
      [{ ...ray, direction: [0, 0, NaN] }, /NaN/, "ray.direction"], [{ ...ray, origin: [0, "1", 0] }, /element 1/, "ray.origin"],
      [{ ...ray, origin: [Infinity, 0, 0] }, /Infinity/, "ray.origin"], [{ ...ray, radus: 1 }, /no field radus/, "ray.radus"],
      [{ ...ray, radius: -1 }, /-1/, "ray.radius"], [{ ...ray, radius: NaN }, /NaN/, "ray.radius"], [{ ...ray, spread: "1" }, /from 0/, "ray.spread"],
      [{ ...ray, kinds: ["chrod"] }, /one of leaflet, chord, head/, "ray.kinds"], [{ ...ray, kinds: "chord" }, /not an array/, "ray.kinds"],
    ];
    for (const [given, sentence, part] of cases) await fails(() => s.pick(given), "MVS_E_ARGUMENT", sentence, part);
    ok(s.pick({ ...ray, radius: 0 }), "a radius of 0 meets a leaflet");
    equal(s.pick({ ...ray, kinds: [] }), undefined, "no kinds");
    s.dispose();
    sim.dispose();
  },

  async bad_counts_and_options_are_refused({ mvs }) {
    const sim = closed(mvs);
    const before = hashOf(sim);
    for (const count of [-1, NaN, 1.5, "3", null, true, Infinity]) {
      await fails(() => sim.step({}, count), "MVS_E_ARGUMENT", /count/, "count");
    }
    for (const vertices of [null, true, "425"]) {
      await fails(() => sim.generateValve({ vertices }), "MVS_E_ARGUMENT", /vertices is/, "desc.vertices");
    }
    await fails(() => sim.setLeaflet(undefined, { law: "fung" }), "MVS_E_ARGUMENT", /leaflet is missing/, "leaflet");
    await fails(() => sim.settleInSlices(null), "MVS_E_ARGUMENT", /null/, "options");
    await fails(() => sim.settleInSlices({ slise: 1 }), "MVS_E_ARGUMENT", /no field slise; its fields are slice, onProgress, signal, /, "options.slise");
    for (const slice of ["1", NaN, -1, null]) await fails(() => sim.settleInSlices({ slice }), "MVS_E_ARGUMENT", /slice/, "options.slice");
    for (const signal of [5, null, {}]) await fails(() => sim.settleInSlices({ signal }), "MVS_E_ARGUMENT", /AbortSignal/, "options.signal");
    await fails(() => sim.settleInSlices({ onProgress: 5 }), "MVS_E_ARGUMENT", /function/, "options.onProgress");
    equal(hashOf(sim), before, "hash");
    sim.step({}, 0);
    ok(sim.addTool({ kind: "grasp", node: 200, by_node: true, position: [0, 0, 0.01] }) > 0n, "true is 1");
    sim.dispose();
  },

  read_outs_of_leak_cost_and_shape({ mvs }) {
    const sim = mvs.simulator();
    sim.generateValve({ annulus_scale: 1.25, chord_slack: 1.1, shape: "founding" });
    sim.setLoad();
    sim.settle();
    const s = sim.snapshot();
    const measures = s.measure("orifice", "annulus");
    ok(measures.regurgitant_orifice_area > 0, "it leaks");
    ok(Number.isNaN(measures.coaptation_area), "other groups are not measured");
    const parts = s.orificeParts();
    near(parts.reduce((sum, part) => sum + part.area, 0), measures.regurgitant_orifice_area, 1e-12, "area of the parts");
    equal(s.regions().length, s.parts("scallop").length + 2, "regions");
    const section = s.section(s.frame().origin, s.frame().cc);
    ok(section.length > 0 && section.length % 6 === 0, "section");
    equal(s.compare(s).node_max, 0, "compared with itself");
    equal(s.stability().stable, 1, "stable");
    const { cost, opened } = s.cost({ flow: 2e-4 });
    ok(cost.open_area > 1e-4 && cost.gradient > 0, "open area and gradient");
    opened.dispose();
    s.dispose();
    sim.dispose();
  },

  async sensitivities_take_lists({ mvs }) {
    const sim = closed(mvs);
    const s = sim.snapshot();
    const quantities = [{ kind: "measure", measure: "coaptation_area" }];
    const parameters = [3, 4, 5].map((index) => ({ kind: "chord_rest_length", index }));
    const run = mvs.c.mvs_sensitivity_run(s.handle, quantities, parameters);
    const rows = mvs.c.mvs_sensitivity_get_array(run, "derivative");
    equal(rows.values.length, 3, "derivatives");
    const single = mvs.c.mvs_sensitivity_run(s.handle, quantities, parameters.slice(1, 2));
    near(mvs.c.mvs_sensitivity_get_array(single, "derivative").values[0], rows.values[1], 1e-9 * Math.abs(rows.values[1]), "derivative of the second");
    for (const one of [run, single]) mvs.c.mvs_sensitivity_release(one);
    await fails(() => mvs.c.mvs_sensitivity_run(s.handle, quantities[0], parameters), "MVS_E_ARGUMENT", /not an array/, "quantities");
    await fails(() => mvs.c.mvs_sensitivity_run(s.handle, quantities, [{ kind: "chord" }]), "MVS_E_ARGUMENT", /one of/, "parameters[0].kind");
    await fails(() => mvs.c.mvs_sensitivity_run(s.handle, quantities), "MVS_E_ARGUMENT", /parameters is missing/, "parameters");
    s.dispose();
    sim.dispose();
  },

  coarser_and_finer_meshes({ mvs }) {
    const sim = mvs.simulator();
    sim.generateValve({ vertices: 800 });
    equal(sim.coarsen({ vertices: 500 }).vertices, 500, "vertices");
    sim.refine();
    ok(sim.read((s) => s.view("triangle_nodes").count) > 2000, "triangles");
    sim.dispose();
  },

  a_surface_is_read_and_becomes_a_valve({ mvs }) {
    const source = mvs.simulator();
    source.generateValve({ vertices: 600 });
    let text = "OFF\n";
    const tips = [];
    source.read((s) => {
      const x = s.array("node_rest");
      const t = s.array("triangle_nodes");
      const count = Math.max(...t) + 1;
      text += `${count} ${t.length / 3} 0\n`;
      for (let k = 0; k < count; ++k) text += `${1e3 * x[3 * k]} ${1e3 * x[3 * k + 1]} ${1e3 * x[3 * k + 2]}\n`;
      for (let k = 0; k < t.length; k += 3) text += `3 ${t[k]} ${t[k + 1]} ${t[k + 2]}\n`;
      for (const node of s.array("head_nodes")) tips.push(Array.from(x.subarray(3 * node, 3 * node + 3)));
    });
    const surface = mvs.readSurface(text, "folder/leaflets.off", { unit: "mm" });
    equal(surface.format, "OFF", "format");
    equal(surface.points.length / 3 > 500, true, "points");
    const sim = mvs.simulator();
    const findings = sim.buildValve({ points: surface.points, triangles: surface.triangles, papillary_tips: tips }, { chords: 60 });
    ok(findings.some((finding) => finding.name === "annulus" && finding.sentence.length > 10), "findings");
    sim.setLoad();
    sim.settle();
    ok(sim.read((s) => s.measure("coaptation").coaptation_area) > 0, "leaflets coapt");
    for (const owned of [source, sim]) owned.dispose();
  },
};
