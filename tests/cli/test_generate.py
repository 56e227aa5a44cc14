"""`mvs generate`: defaults, tissue, dimensions, chordae, refusals."""
import re
import unittest

from command import Command


class Generate(Command):
    def test_defaults_in_the_help_are_those_of_the_library(self):
        help_text = self.ok("generate", "--help").stdout
        defaults = re.findall(r"^\s+(--[\w-]+)[^\n\[]*(?:\n\s+[^\n\[-]*)?"
                              r"\[([\d.]+)(?:; +founding\s+([\d.]+))?\]", help_text, re.M)
        self.assertEqual(len(defaults), 16)
        healthy = [word for option, value, _ in defaults for word in (option, value)]
        founding = [word for option, value, other in defaults for word in (option, other or value)]
        self.assertEqual(self.json("generate", "-o", "explicit.obj", *healthy)["hash"],
                         self.json("generate", "-o", "default.obj")["hash"])
        self.assertEqual(
            self.json("generate", "--shape", "founding", "-o", "explicit.obj", *founding)["hash"],
            self.json("info", "v.obj")["hash"])

    def test_the_membrane_is_the_tissue_of_the_default_valve(self):
        def tissue(*words):
            self.json("generate", "-o", "tissue.obj", "--vertices", 200, *words)
            return self.json("close", "tissue.obj", "--pressure", 0)["leaflet"]
        self.assertEqual(tissue(), "bilinear")
        self.assertEqual(tissue("--leaflet", "membrane"), "bilinear")
        self.assertEqual(tissue("--leaflet", "spring"), "spring")
        self.assertEqual(tissue("--shape", "founding"), "spring")
        self.assertEqual(tissue("--shape", "founding", "--leaflet", "fung"), "fung")

    def test_a_factor_of_one_on_a_chord_changes_no_bit(self):
        name = "P2/1"
        same = self.json("generate", "--shape", "founding", "-o", "same.obj", "--chord-factor", name + "=1")
        self.assertEqual(same["hash"], self.json("info", "v.obj")["hash"])

    def test_straight_and_branching_chordae_exclude_each_other(self):
        self.assertIn("--branching excludes --straight",
                      self.misused("generate", "-o", "x.obj", "--straight", "--branching"))

    def test_a_longer_chord_is_the_only_difference(self):
        def lines(file):
            return (self.dir / file).read_text().splitlines()
        self.ok("generate", "--shape", "founding", "-o", "longer.obj", "--chord-factor", "P2/1=1.25")
        changed = [(a, b) for a, b in zip(lines("v.obj"), lines("longer.obj")) if a != b]
        self.assertEqual(len(lines("v.obj")), len(lines("longer.obj")))
        self.assertEqual(len(changed), 1, changed)

    def test_dimensions_reach_the_valve(self):
        self.ok("generate", "--shape", "founding", "-o", "big.obj", "--annulus-ap", 30, "--annulus-cc", 38,
                "--vertices", 1000)
        info = self.json("info", "big.obj")
        # 1000 is approximate: the mesh has whole rows and columns
        self.assertTrue(800 < info["vertices"] < 1200, info["vertices"])
        # the annulus is a polygon in a smooth curve: under 1 % shorter at this size
        self.assertAlmostEqual(info["annulus_ap_mm"], 30, delta=0.3)
        self.assertAlmostEqual(info["annulus_cc_mm"], 38, delta=0.38)

    def test_an_impossible_valve_is_refused_with_its_range(self):
        self.assertIn("annulus_ap", self.misused("generate", "--shape", "founding", "-o", "x.obj", "--annulus-ap",
                                                 500))

    def test_a_dimension_that_is_no_number_above_zero_is_refused(self):
        for given in ("0", "-3", "nan", "1e400", "wide"):
            said = self.misused("generate", "-o", "x.obj", "--saddle-height", given)
            self.assertIn(f"--saddle-height: a number above 0 is needed, not {given}\n", said)

    def test_an_unknown_chord_is_refused_by_name(self):
        self.assertIn("P9/1", self.fails("generate", "--shape", "founding", "-o", "x.obj", "--chord-factor",
                                         "P9/1=2").stderr)

    def test_a_missing_folder_is_reported(self):
        self.assertIn("no/such", self.fails("generate", "--shape", "founding", "-o", "no/such/folder/v.obj").stderr)


if __name__ == "__main__":
    unittest.main()
