// Operations on a valve: descriptions, application, sites, refusals, groups and checkpoints.
import { closed, hashOf } from "./life.mjs";
import { equal, fails, near, ok } from "../check.mjs";

export const operations = {
  operations_are_described_for_forms({ mvs }) {
    const names = mvs.operations.map((one) => one.name);
    ok(names.includes("chord_length") && names.includes("patch"), `operations: ${names}`);
    const ring = mvs.operations.find((one) => one.name === "ring");
    const size = ring.fields.find((field) => field.name === "size");
    equal(size.type, "number", "type of ring.size");
    equal(size.unit, "m", "unit of ring.size");
    ok(size.high > size.low && size.help.length > 0 && size.label.length > 0, "range, help, label of ring.size");
    const transfer = mvs.operations.find((one) => one.name === "chord_transfer");
    equal(transfer.fields.find((field) => field.name === "end").words.head, 2, "word of a choice");
    ok(mvs.fields("measures").some((field) => field.name === "coaptation_area" && field.unit === "m2"), "fields of measures");
    ok(mvs.laws().leaflet.some((law) => law.word === "fung"), "laws");
  },

  operations_by_name_are_applied_and_undone({ mvs }) {
    const sim = closed(mvs);
    const before = hashOf(sim);
    const length = () => sim.read((s) => s.chords().find((chord) => chord.name === "A2/7").rest_length);
    const whole = length();
    equal(sim.apply("chord_length", { chord: "A2/7", factor: 0.75 }), 0n, "part made");
    near(length(), 0.75 * whole, 1e-12, "length");
    sim.undo();
    equal(hashOf(sim), before, "hash after undo");
    sim.redo();
    const made = sim.apply("neochord", { head: "PM1", site: { scallop: "P2", u: [0.5, 1] }, length: 14e-3 });
    ok(made > 0n, "id of the neochord");
    sim.apply("ring", { size: 0.032, name: "34" });
    sim.apply("head_move", { head: "AL1", by: [0, 0, -1e-3], frame: "valve" });
    sim.read((s) => {
      equal(s.part("chord", made).id, made, "part by its id");
      equal(s.parts("ring")[0].name, "34", "ring");
      equal(s.history().done.length, 4, "operations");
      equal(s.history().done[0].kind, "chord_length", "kind");
    });
    sim.dispose();
  },

  every_kind_of_site_is_written({ mvs }) {
    const sim = closed(mvs);
    const node = sim.read((s) => s.array("node_kind").findIndex((kind, k) => kind === 0 && k > 100));
    for (const site of [{ node }, { triangle: 40, u: [0.2, 0.3, 0.5] }, { scallop: "A2", u: [0.62, 0.85] }]) {
      sim.check("chord_add", { head: "AL1", site });
    }
    sim.check("ring", { curve: Float64Array.from({ length: 30 }, (_, k) => 0.015 * (k % 3 === 2 ? 0 : k % 3 === 1 ? Math.sin(k / 5) : Math.cos(k / 5))) });
    sim.dispose();
  },

  bad_operations_are_refused_with_part_and_remedy: async ({ mvs }) => {
    const sim = closed(mvs);
    const before = hashOf(sim);
    await fails(() => sim.apply("mend", {}), "MVS_E_ARGUMENT", /no operation is called mend; there are chord_length/, "operation");
    await fails(() => sim.apply("ring", { sise: 1 }), "MVS_E_ARGUMENT", /ring has no field sise; its fields are/, "ring.sise");
    await fails(() => sim.apply("ring", { size: "34" }), "MVS_E_ARGUMENT", /ring.size is not a number/, "ring.size");
    await fails(() => sim.apply("chord_remove", { chord: "Z9/1" }), "MVS_E_ID", /Z9\/1/);
    await fails(() => sim.apply("chord_remove", { chord: 999999n }), "MVS_E_ID", /999999/);
    await fails(() => sim.apply("chord_transfer", { chord: "A2/2", end: "tail" }), "MVS_E_ARGUMENT", /one of .*leaflet.*head/);
    await fails(() => sim.apply("chord_add", { head: "AL1", site: { where: 1 } }), "MVS_E_ARGUMENT", /\{ node \}/);
    await fails(() => sim.apply("chord_length", { chord: "A2/7", factor: NaN }), "MVS_E_ARGUMENT", /factor/);
    await fails(() => sim.undo(), "MVS_E_STATE", /undo/);
    equal(hashOf(sim), before, "hash");
    sim.dispose();
  },

  words_of_choices_are_those_of_the_types({ libmvs, mvs }) {
    const types = { "chord_add.type": "ChordKind", "chord_transfer.end": "ChordEnd", "head_move.frame": "Axes" };
    for (const { name, fields } of mvs.operations) {
      for (const { words, ...field } of fields.filter((one) => one.type === "choice")) {
        const type = libmvs[types[`${name}.${field.name}`]];
        for (const [word, number] of Object.entries(type)) {
          if (Object.values(words).includes(number)) equal(words[word], number, `${name}.${field.name} ${word}`);
        }
      }
    }
  },

  a_description_cannot_be_changed: async ({ mvs }) => {
    const { operations: table } = mvs;
    for (const part of [table, table[0], table[0].fields, table[0].fields[0], table[0].fields[0].words]) ok(Object.isFrozen(part), "frozen");
  },

  bad_fields_and_sites_are_refused: async ({ mvs }) => {
    const sim = closed(mvs);
    const curve = Array.from({ length: 12 }, (_, k) => [0.015 * Math.cos(k / 2), 0.015 * Math.sin(k / 2), 0]);
    await fails(() => sim.check("clip", null), "MVS_E_ARGUMENT", /fields is null/, "fields");
    await fails(() => sim.apply("clip", 5), "MVS_E_ARGUMENT", /fields is 5/, "fields");
    await fails(() => sim.check("chord_add", { head: "AL1", site: { node: 200, u: [0, 1] } }), "MVS_E_ARGUMENT", /no field u/, "chord_add.site.u");
    await fails(() => sim.check("chord_add", { head: "AL1", site: { scallop: "A2", u: [0.5, 0.9], w: 1 } }), "MVS_E_ARGUMENT", /no field w/, "chord_add.site.w");
    sim.check("ring", { curve });
    sim.check("ring", { curve: curve.map((row) => Float64Array.from(row)) });
    await fails(() => sim.check("ring", { curve: curve.map(([x, y]) => [x, y]) }), "MVS_E_ARGUMENT", /row 0 of 2 numbers: each row has 3/, "ring.curve");
    await fails(() => sim.check("ring", { curve: [...curve, [0, 0], [0, 0, 0, 0]] }), "MVS_E_ARGUMENT", /row 12 of 2 numbers/, "ring.curve");
    await fails(() => sim.check("ring", { curve: [...curve, 0, 0, 0] }), "MVS_E_ARGUMENT", /row 12 of no numbers/, "ring.curve");
    sim.dispose();
  },

  a_group_does_not_wait: async ({ mvs }) => {
    const sim = closed(mvs);
    const before = hashOf(sim);
    const work = async () => void sim.apply("chord_length", { chord: "A2/7", factor: 0.9 });
    await fails(() => sim.group("late", work), "MVS_E_ARGUMENT", /work returns a promise/, "work");
    equal(hashOf(sim), before, "hash");
    equal(sim.group("none", () => null), null, "result");
    sim.dispose();
  },

  groups_and_checkpoints({ mvs }) {
    const sim = closed(mvs);
    const before = hashOf(sim);
    sim.setCheckpoint("start");
    sim.group("both", () => {
      sim.apply("chord_length", { chord: "A2/7", factor: 0.9 });
      sim.apply("chord_remove", { chord: "P2/2" });
    });
    equal(sim.read((s) => s.history().done.map((entry) => entry.in_group).join()), "both,both", "groups");
    sim.undo();
    equal(sim.read((s) => s.history().undone.length), 2, "undone together");
    let thrown;
    try {
      sim.group("broken", () => {
        sim.apply("chord_remove", { chord: "P2/2" });
        throw new Error("mine");
      });
    } catch (error) {
      thrown = error.message;
    }
    equal(thrown, "mine", "the exception of the caller");
    sim.restoreCheckpoint("start");
    equal(sim.read((s) => s.array("node_position").length) > 0, true, "restored");
    equal(sim.read((s) => s.history().checkpoints.join()), "start", "checkpoints");
    equal(hashOf(sim), before, "hash");
    sim.dispose();
  },
};
