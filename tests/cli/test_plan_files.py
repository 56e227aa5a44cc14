"""`mvs repair` and `mvs plan` with plans written by hand."""
import json
import re
import unittest

from command import Command


class Plans(Command):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "sick.obj", "--annulus-scale", 1.15, "--chord-factor", "A2/7=1.25")
        cls.plan("p.json", {"do": "annulus_scale", "factor": 0.85},
                 {"do": "chord_add", "head": "PM1",
                  "site": {"scallop": "A2", "along": 0.4, "height": 0.95}})

    @classmethod
    def plan(cls, name, *steps):
        (cls.dir / name).write_text(json.dumps(
            {"format": "mvs-plan", "version": 1, "valve": {"name": "any"}, "steps": steps}))

    def test_a_repair_seals_a_leaking_valve(self):
        done = self.json("repair", "sick.obj", "--plan", "p.json", "-o", "fixed.obj",
                         "--save-plan", "done.json")
        orifice = "regurgitant_orifice_area_mm2"
        self.assertGreater(done["before"]["measures"][orifice], 10)
        self.assertEqual(done["after"]["measures"][orifice], 0)
        self.assertEqual(len(done["operations"]), 2)
        self.assertEqual(done["after"]["intersections"], 0)
        # the applied plan replays to the same bits, and shows the effect of each operation
        again = self.json("plan", "replay", "done.json", "--on", "sick.obj", "-o", "again.obj")
        self.assertTrue(again["same_valve"] and again["same_result"])
        self.assertEqual(again["hash"], done["after"]["hash"])
        self.assertEqual((self.dir / "again.obj").read_bytes(),
                         (self.dir / "fixed.obj").read_bytes())
        self.assertIn("orifice", self.ok("plan", "show", "done.json").stdout)
        self.assertFalse(self.json("plan", "check", "done.json", "--on", "v.obj")["same_valve"])

    def test_an_inapplicable_plan_fails_before_anything_is_written(self):
        self.plan("bad.json", {"do": "annulus_scale", "factor": 0.9},
                  {"do": "chord_remove", "chord": "P9/9"})
        for line in (["repair", "sick.obj", "--plan", "bad.json", "-o", "x.obj"],
                     ["plan", "check", "bad.json", "--on", "v.obj"],
                     ["plan", "replay", "bad.json", "--on", "v.obj", "-o", "x.obj"]):
            with self.subTest(line):
                printed = self.fails(*line).stderr
                self.assertIn("step 2 of the plan", printed)
                self.assertIn("P9/9", printed)

    def test_a_handwritten_plan_is_refused_with_the_missing_part(self):
        step = {"do": "annulus_scale", "factor": 0.85}
        head = {"format": "mvs-plan", "version": 1}
        for text, words in (('{"format": "mvs-plan",\n "version": 1,\n}', "line 3"),
                            ({"steps": [step]}, 'lacks "format": "mvs-plan"'),
                            ({**head, "format": 3}, 'lacks "format": "mvs-plan"'),
                            (head, 'the plan has no "steps"'),
                            ({**head, "steps": 3}, '"steps" has to be a list'),
                            ({**head, "steps": [3]}, 'an object with a "do"'),
                            ({**head, "steps": [step], "valve": "any"}, 'valve has to be an object'),
                            ({**head, "steps": [{**step, "title": 3}]}, 'step 1: title has to be a text')):
            (self.dir / "own.json").write_text(text if isinstance(text, str) else json.dumps(text))
            for line in (["plan", "show", "own.json"],
                         ["repair", "sick.obj", "--plan", "own.json", "-o", "never.obj"]):
                with self.subTest(line, words=words):
                    self.assertIn(words, self.fails(*line).stderr)
        # "valve" is optional
        (self.dir / "own.json").write_text(json.dumps({**head, "steps": [step]}))
        self.assertIn("annulus_scale", self.ok("plan", "show", "own.json").stdout)
        self.assertEqual(self.json("plan", "check", "own.json", "--on", "v.obj")["operations"], 1)

    def test_deep_nesting_and_numbers_beyond_double_precision_are_refused(self):
        head = '{"format": "mvs-plan", "version": 1, "steps": [], "notes": '
        for text, words in (("[" * 80000 + "]" * 80000, "nested deeper than 64 levels"),
                            (head + "[" * 64 + "]" * 64 + "}", "nested deeper than 64 levels"),
                            (head + "1e400}", "a number is too large")):
            (self.dir / "deep.json").write_text(text)
            for line in (["plan", "show", "deep.json"], ["plan", "check", "deep.json", "--on", "v.obj"],
                         ["plan", "replay", "deep.json", "--on", "v.obj"],
                         ["repair", "sick.obj", "--plan", "deep.json"],
                         ["import", "v.obj", "-o", "x.h5", "--with", "deep.json"]):
                with self.subTest(line, words=words):
                    printed = self.fails(*line).stderr
                    self.assertRegex(printed, rf"^mvs: deep.json: [^\n]*{words}[^\n]*\n$")
                    self.assertNotIn("json.exception", printed)

    def test_a_load_of_a_plan_in_another_unit_is_warned_of(self):
        for pressure, words in ((120, "looks like mmHg given as Pa"), (15998.64, "")):
            self.plan("load.json", {"do": "load", "pressure_Pa": pressure, "boundary_fraction": 1})
            for part in "replay", "check":
                said = self.ok("plan", part, "load.json", "--on", "v.obj").stderr
                self.assertIn(words, said)
                self.assertEqual(words != "", said != "")

    def test_every_command_refuses_what_no_valve_could_have(self):
        ring = {"do": "ring", "size_m": 0.034}
        for step, words in (({**ring, "colour": "red"}, 'ring has no field "colour"'),
                            ({**ring, "size_m": "wide"}, "size_m has to be a number"),
                            ({"do": "fly"}, 'operation "fly" is not known'),
                            ({"do": "settle", "colour": "red"}, '"colour"'),
                            ({"do": "chord_add", "head": "PM1", "site": {"node": 1, "at": 2}},
                             'site has no field "at"')):
            self.plan("odd.json", ring, step)
            for line in (["plan", "show", "odd.json"], ["plan", "check", "odd.json", "--on", "v.obj"],
                         ["plan", "replay", "odd.json", "--on", "v.obj"],
                         ["repair", "sick.obj", "--plan", "odd.json"]):
                with self.subTest(line, words=words):
                    said = self.fails(*line).stderr
                    self.assertRegex(said, r"^mvs: odd\.json: step 2[^\n]*\n$")
                    self.assertIn(words, said)
        (self.dir / "odd.json").write_text(json.dumps(
            {"format": "mvs-plan", "version": 1, "steps": [], "colour": "red"}))
        self.assertIn('a plan has no field "colour"', self.fails("plan", "show", "odd.json").stderr)

    def test_a_file_that_is_not_a_plan_is_refused(self):
        (self.dir / "empty.json").write_text("")
        (self.dir / "number.json").write_text(json.dumps(
            {"format": "mvs-plan", "version": 1, "steps": [{"do": "load", "pressure_Pa": "high"}]}))
        for name, words in (("v.obj", "is no plan"), ("nowhere.json", "No such file"),
                            (".", "cannot be read"), ("empty.json", "is no plan"),
                            ("number.json", "step 1: pressure_Pa has to be a number")):
            with self.subTest(name):
                printed = self.fails("plan", "show", name).stderr
                self.assertRegex(printed, rf"^mvs: {re.escape(name)}: [^\n]*{words}[^\n]*\n$")
                self.assertNotIn("json.exception", printed)


if __name__ == "__main__":
    unittest.main()
