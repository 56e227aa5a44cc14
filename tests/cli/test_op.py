"""`mvs op`: one surgical operation from the command line."""
import json
import math
import re
import unittest

from command import Command

# Operations of each kind, with options of every type.
EXAMPLES = {
    "chord-length": [["--chord", "P2/3", "--factor", 0.75], ["--chord", "P2/3", "--length", 15],
                     ["--chord", "P2/3", "--drag-to", "-1,0,2.5"]],
    "chord-remove": [["--chord", "P2/3"]],
    "chord-add": [["--head", "PM1", "--site", "P2:0.4:0.8", "--type", "rough_zone",
                   "--young", 30, "--area", 1, "--name", "mine"],
                  ["--head", "PM1", "--site", "triangle:5:0.3:0.3:0.4"]],
    "chord-transfer": [["--chord", "P2/3", "--site", "A2:0.5:0.9"],
                       ["--chord", "A1/2", "--end", "head", "--head", "PM2"]],
    "annulus-scale": [["--factor", 0.95]],
    "ring": [["--size", 34]],
    "band": [["--factor", 0.9]],
    "neochord": [["--head", "PM1", "--site", "P2:0.5:1", "--strands", 4]],
    "head-move": [["--head", "PM1", "--by", "0,-0.5,2", "--frame", "valve"]],
    "clip": [[], ["--angle", 15]],
    "resect": [["--scallop", "P2", "--width", 6, "--depth", 6]],
    "patch": [["--site", "P2:0.5:0.5"]],
}


class Op(Command):
    def op(self, *arguments, file="v.obj"):
        return self.json("op", file, *arguments, "-o", "op.obj")

    def test_every_kind_writes_another_valve_with_a_title(self):
        listed = re.search(r"Subcommands:\n(.*?)\n\n", self.ok("op", "--help").stdout, re.S)
        kinds = re.findall(r"^  ([\w-]+)", listed.group(1), re.M)
        self.assertGreaterEqual(len(kinds), 7)
        first = self.json("info", "v.obj")["hash"]
        for kind in kinds:
            for options in EXAMPLES[kind]:
                with self.subTest([kind, *options]):
                    done = self.op(kind, *options)
                    self.assertEqual(done["operation"], kind.replace("-", "_"))
                    self.assertNotEqual(done["hash"], first)
                    self.assertEqual(self.json("info", "op.obj")["hash"], done["hash"])
                    self.assertIn(done["title"], self.ok("op", "v.obj", kind, *options, "-o",
                                                         "op.obj").stdout)

    def test_help_of_every_kind_needs_no_file_and_uses_mm(self):
        self.assertRegex(self.ok("op", "chord-length", "--help").stdout,
                         r"--length mm +new rest length, mm; 0.1 to 200")
        self.assertRegex(self.ok("op", "neochord", "--help").stdout,
                         r"--diameter mm +of one strand, mm \[0.3\]; 0.01 to 5")
        self.assertRegex(self.ok("op", "chord-add", "--help").stdout,
                         r"--young MPa +Young's modulus, MPa \[40\]")

    def test_an_operation_has_its_name_in_plans_too(self):
        fields = ("--chord", "P2/3", "--factor", 0.75)
        self.assertEqual(self.op("chord_length", *fields)["hash"], self.op("chord-length", *fields)["hash"])

    def test_sentences_of_the_library_are_in_the_units_of_the_command(self):
        angles = [math.pi * k / 6 for k in range(12)]
        (self.dir / "metres.txt").write_text("".join(
            "%g,%g,0\n" % (11e-3 * math.cos(a), 15e-3 * math.sin(a)) for a in angles))
        (self.dir / "microns.txt").write_text("".join(
            "%g,%g,0\n" % (11e3 * math.cos(a), 15e3 * math.sin(a)) for a in angles))
        move = ("head-move", "--head", "PM1", "--by", "500,0,0")
        self.assertIn("a coordinate of 500 mm, it has to be within 50 mm: lengths are in mm",
                      self.misused("op", "v.obj", *move, "-o", "q.obj"))
        for options, words in (
            (("chord-length", "--chord", "P2/3", "--drag-to", "900,0,0"),
             "mm long where it was dragged to: 0.1 to 200 mm are"),
            (("ring", "--curve", "metres.txt"), "in other units than mm"),
            (("ring", "--curve", "microns.txt"), "lengths are in mm"),
        ):
            with self.subTest(options):
                said = self.fails("op", "v.obj", *options, "-o", "q.obj").stderr
                self.assertIn(words, said)
                self.assertNotRegex(said, r"\d m\b|\bas m\b|\bthan m\b")
        done = self.ok("op", "v.obj", "neochord", "--head", "PM1", "--site", "P2:0.5:1", "--young",
                       0.0004, "-o", "q.obj")
        self.assertRegex(done.stderr, r"chord \S+ bears .*: moduli are in MPa \(1 of them\)")

    def test_help_says_which_shape_is_operated_on(self):
        for command in ("op", "sweep"):
            said = " ".join(self.ok(command, "--help").stdout.split())
            self.assertIn("give", said)
            self.assertIn("closed", said)
            self.assertIn("same figures", said)

    def test_millimetres_and_factors_agree(self):
        half = self.op("chord-length", "--chord", "P2/3", "--factor", 0.5)
        length = re.search(r"([\d.]+) mm", half["title"]).group(1)
        again = self.op("chord-length", "--chord", "P2/3", "--length", length)
        # titles have three digits
        self.assertIn(f"{length} mm", again["title"])

    def test_a_created_part_is_reported_by_name(self):
        made = self.op("neochord", "--head", "PM1", "--site", "P2:0.5:0.9", "--name", "loop")
        self.assertEqual(made["made"]["name"], "loop")
        self.op("chord-remove", "--chord", "loop", file="op.obj")
        self.assertIsNone(self.op("chord-remove", "--chord", "P2/3")["made"])

    def test_settle_measures_before_and_after_from_the_same_shape(self):
        done = self.json("op", "v.obj", "annulus-scale", "--factor", 1.2, "--settle")
        self.assertEqual(done["pressure_mmHg"], 120)
        self.assertTrue(done["before"]["converged"] and done["after"]["converged"])
        self.assertEqual(done["before"]["measures"], self.closed["measures"])
        self.assertGreater(done["after"]["measures"]["annulus_area_mm2"],
                           1.3 * done["before"]["measures"]["annulus_area_mm2"])
        other = self.json("op", "v.obj", "annulus-scale", "--factor", 1.2, "--settle", 80)
        self.assertEqual(other["pressure_mmHg"], 80)
        too_much = ("op", "v.obj", "annulus-scale", "--factor", 1.2, "--settle", "1e999")
        self.assertIn("pressures are in mmHg", self.misused(*too_much))
        table = self.ok("op", "v.obj", "annulus-scale", "--factor", 1.2, "--settle").stdout
        self.assertRegex(table, r"Annulus CC diameter +35\.00 +42\.00 mm")

    def test_a_new_chord_that_carries_no_force_is_warned_of(self):
        tie = ("closed.obj", "neochord", "--head", "PM1", "--site", "P2:0.5:1", "--name", "loop")
        slack = self.json("op", *tie, "--length", 40, "--settle")["slack_new_chordae"]
        self.assertEqual([chord["name"] for chord in slack], ["loop"])
        self.assertEqual(slack[0]["rest_length_mm"], 40)
        self.assertLess(slack[0]["length_mm"], 40)
        said = self.ok("op", *tie, "--length", 40, "--settle", "-o", "op.obj").stderr
        self.assertRegex(said, r"chord loop carries no force in the closed valve: its rest length is 40.00 mm")
        # the length that the sentence names is the limit: 5 % below it the chord pulls
        short = 0.95 * slack[0]["length_mm"]
        pulling = self.ok("op", *tie, "--length", short, "--settle", "-o", "op.obj", "--json")
        self.assertEqual(json.loads(pulling.stdout)["slack_new_chordae"], [])
        self.assertNotIn("carries no force", pulling.stderr)
        tied = next(c for c in self.json("chords", "op.obj")["chords"] if c["name"] == "loop")
        self.assertGreater(tied["tension_N"], 0)

    def test_chordae_of_an_open_valve_are_not_called_slack(self):
        tie = ("v.obj", "neochord", "--head", "PM1", "--site", "P2:0.5:1", "--length", 40)
        opened = self.ok("op", *tie, "--settle", 0, "--json")
        self.assertEqual(json.loads(opened.stdout)["slack_new_chordae"], [])
        self.assertNotIn("carries no force", opened.stderr)
        self.assertNotIn("slack_new_chordae", self.json("op", *tie, "-o", "op.obj"))

    def test_points_come_from_text_in_mm(self):
        names = self.ok("op", "--help").stdout
        if " ring " not in names:
            self.skipTest("this library has no ring")
        rows = [(17 * c, 13 * s, 0) for c, s in ((1, 0), (.7, .7), (0, 1), (-.7, .7), (-1, 0),
                                                 (-.7, -.7), (0, -1), (.7, -.7))]
        hashes = set()
        for name, comma, head in (("a.csv", ",", "x,y,z\n"), ("b.xyz", " ", "# a ring\n\n"),
                                  ("c.txt", " ;\t", "")):
            text = head + "\n".join(comma.join(map(str, row)) for row in rows)
            (self.dir / name).write_text(text)
            hashes.add(self.op("ring", "--curve", name)["hash"])
        self.assertEqual(len(hashes), 1)
        (self.dir / "bad.csv").write_text("x,y,z\n1,2,3\n1,2\n")
        self.assertIn("bad.csv:3: ", self.refused("ring", "--curve", "bad.csv"))
        (self.dir / "empty.csv").write_text("x,y,z\n")
        self.assertIn("has no points", self.refused("ring", "--curve", "empty.csv"))
        self.assertIn("none.csv", self.refused("ring", "--curve", "none.csv"))
        self.assertIn("has 1 points", self.one_point())

    def one_point(self):
        (self.dir / "one.csv").write_text("1,2,3\n")
        return self.refused("ring", "--curve", "one.csv")

    def refused(self, *arguments):
        return self.fails("op", "v.obj", *arguments, "-o", "never.obj").stderr

    def test_impossible_operations_are_refused_with_a_reason(self):
        for words, options in (
                ('no chord named "P9/1"', ["chord-length", "--chord", "P9/1", "--factor", 2]),
                ('no papillary head named "PM9"',
                 ["neochord", "--head", "PM9", "--site", "node:3"]),
                ('no scallop named "Q2"', ["neochord", "--head", "PM1", "--site", "Q2:0.1:1"]),
                ("node 1000000", ["chord-add", "--head", "PM1", "--site", "node:1000000"]),
                ('no chord named "P2/33"; near: P2/3', ["chord-remove", "--chord", "P2/33"]),
                ('no chord named "p2/3"; near: P2/3', ["chord-remove", "--chord", "p2/3"]),
                ("nowhere", ["chord-remove", "--chord", "nowhere"])):
            with self.subTest(options):
                self.assertIn(words, self.refused(*options))

    def test_values_out_of_range_are_usage_errors(self):
        for words, options in (
                ("length is 20000 mm, the range is 0.1 to 200",
                 ["chord-length", "--chord", "P2/3", "--length", 20000]),
                ("factor is 0, the range is", ["chord-length", "--chord", "P2/3", "--factor", 0]),
                ("factor is nan", ["chord-length", "--chord", "P2/3", "--factor", "nan"]),
                ("strands is 99", ["neochord", "--head", "PM1", "--site", "node:3", "--strands",
                                   99]),
                ("0 of length, factor and drag_to", ["chord-length", "--chord", "P2/3"]),
                ("coordinate of 1.5", ["chord-add", "--head", "PM1", "--site", "P2:1.5:1"])):
            with self.subTest(options):
                self.assertIn(words, self.misused("op", "v.obj", *options, "-o", "never.obj"))
        self.assertFalse((self.dir / "never.obj").exists())

    def test_malformed_options_are_usage_errors(self):
        chord = ["chord-length", "--chord", "P2/3"]
        for words, line in (
                ("'fly' is unknown; choose from: chord-length", ["v.obj", "fly"]),
                ("'chord' is unknown; choose from: chord-length", ["v.obj", "chord", "--factor", 2]),
                ("an operation", ["v.obj"]),
                ("an operation", []),
                ("file is required", [*chord, "--factor", 2, "-o", "x.obj"]),
                ("--output or --settle", ["v.obj", *chord, "--factor", 2]),
                ("--chord is required", ["v.obj", "chord-remove", "-o", "x.obj"]),
                ("--lenght", ["v.obj", *chord, "--lenght", 2, "-o", "x.obj"]),
                ("not a number in mm", ["v.obj", *chord, "--length", "long", "-o", "x.obj"]),
                ("not a number in mm", ["v.obj", *chord, "--length", "15mm", "-o", "x.obj"]),
                ("X,Y,Z in mm", ["v.obj", *chord, "--drag-to", "1,2", "-o", "x.obj"]),
                ("choose from: leaflet, head",
                 ["v.obj", "chord-transfer", "--chord", "P2/3", "--end", "tail", "-o", "x.obj"]),
                ("SCALLOP:ALONG:HEIGHT",
                 ["v.obj", "chord-add", "--head", "PM1", "--site", "P2", "-o", "x.obj"]),
                ("SCALLOP:ALONG:HEIGHT",
                 ["v.obj", "chord-add", "--head", "PM1", "--site", "node:-1", "-o", "x.obj"]),
                ("non-negative integer", ["v.obj", "neochord", "--head", "PM1", "--site", "node:3",
                                  "--strands", 2.5, "-o", "x.obj"])):
            with self.subTest(line):
                self.assertIn(words, self.misused("op", *line))
        self.assertFalse((self.dir / "x.obj").exists())


if __name__ == "__main__":
    unittest.main()
