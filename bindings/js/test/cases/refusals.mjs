// Bad input is refused: its code, its part, a sentence, and the simulator as before.
import { closed, hashOf } from "./life.mjs";
import { equal, fails, ok } from "../check.mjs";

export const refusals = {
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
};
