// Work on a valve: plans, files, arrays, instruments, picking, read-outs, meshes, surfaces.
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
