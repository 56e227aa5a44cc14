"""`mvs close --members`: the JSON object and the text of an ensemble of closures."""
import unittest

from command import Shell, mvs

MEMBERS = 4


class Ensemble(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "thin.obj", "--vertices", 250, "--thickness", 0.5)
        cls.plain = cls.json("close", "thin.obj", "-o", "plain.obj")
        cls.found = cls.json("close", "thin.obj", "--members", MEMBERS, "-o", "closed.obj")

    def test_the_valve_is_that_of_a_plain_closure(self):
        for key in ("hash", "iterations", "energy_J", "residual_N", "measures", "intersections"):
            self.assertEqual(self.found[key], self.plain[key], key)
        self.assertEqual((self.dir / "closed.obj").read_bytes(),
                         (self.dir / "plain.obj").read_bytes())
        self.assertNotIn("ensemble", self.plain)

    def test_statistics_are_those_of_the_closures(self):
        ensemble = self.found["ensemble"]
        self.assertEqual(len(ensemble["closures"]), MEMBERS)
        self.assertEqual(ensemble["converged"], MEMBERS)
        self.assertEqual(ensemble["closures"][0]["hash"], self.found["hash"])
        for key in self.found["measures"]:
            values = [c["measures"][key] for c in ensemble["closures"]]
            printed = ensemble["measures"][key]
            if None in values:
                continue
            self.assertEqual((printed["min"], printed["max"]), (min(values), max(values)), key)
            if "mean" in printed:
                self.assertEqual(printed["members"], MEMBERS)
                # the library sums in another order
                size = max(map(abs, values)) or 1
                self.assertAlmostEqual(printed["mean"] / size, sum(values) / MEMBERS / size, 12)

    def test_shapes_and_equilibria_are_those_of_the_closures(self):
        ensemble = self.found["ensemble"]
        numbers = [c["equilibrium"] for c in ensemble["closures"]]
        self.assertEqual(ensemble["equilibria"], len(set(numbers)))
        energies = [c["energy_J"] for c in ensemble["closures"]]
        self.assertEqual(ensemble["lowest"], energies.index(min(energies)))
        self.assertEqual(ensemble["surface_max_mm"],
                         max(c["surface_max_mm"] for c in ensemble["closures"]))

    def test_same_seed_same_figures(self):
        def hashes(found):
            return [c["hash"] for c in found["ensemble"]["closures"]]

        again = self.json("close", "thin.obj", "--members", MEMBERS, "--seed", 0)
        other = self.json("close", "thin.obj", "--members", MEMBERS, "--seed", 9)
        self.assertEqual(hashes(again), hashes(self.found))
        self.assertEqual(hashes(other)[0], hashes(self.found)[0])
        self.assertNotEqual(hashes(other)[1:], hashes(self.found)[1:])

    def test_without_perturbation_the_loading_paths_remain(self):
        found = self.json("close", "thin.obj", "--members", 2, "--perturbation", 0)
        self.assertEqual([c["perturbation_mm"] for c in found["ensemble"]["closures"]], [0, 0])

    def test_errors_against_a_reference_have_a_range(self):
        self.ok("generate", "--shape", "founding", "-o", "other.obj", "--vertices", 250)
        self.ok("close", "other.obj", "-o", "reference.obj")
        line = ["close", "thin.obj", "--reference", "reference.obj"]
        alone = self.json(*line)["reference"]
        compared = self.json("compare", "plain.obj", "reference.obj")
        for key in ("node_rms_mm", "node_max_mm", "surface_rms_mm", "surface_max_mm"):
            self.assertEqual(alone[key], compared["as_they_lie"][key])
            registered = key.replace("_mm", "_registered_mm")
            self.assertEqual(alone[registered], compared["registered"][key])
        self.assertNotIn("ensemble", alone)
        found = self.json(*line, "--members", MEMBERS)["reference"]
        over = found.pop("ensemble")
        self.assertEqual(found, alone)
        self.assertEqual(over["members"], MEMBERS)
        # the coarse thin valve has several equilibria, so that the error has a range
        self.assertLess(over["node_max_mm"]["min"], over["node_max_mm"]["max"])
        self.assertLessEqual(over["surface_rms_mm"]["min"], found["surface_rms_mm"])
        self.assertRegex(self.ok(*line, "--members", MEMBERS).stdout,
                         rf"Surfaces, RMS +{found['surface_rms_mm']:.3f}  \(")
        self.assertIn("nowhere.obj", mvs("close", "thin.obj", "--reference", "nowhere.obj",
                                         cwd=self.dir).stderr)

    def test_text_has_values_range_and_members(self):
        printed = self.ok("close", "thin.obj", "--members", MEMBERS).stdout
        self.assertIn(f"{MEMBERS} of {MEMBERS} members at rest", printed)
        self.assertRegex(printed, r"plain +min +max +deviation\n")
        area = [self.found["measures"]["coaptation_area_mm2"]]
        ensemble = self.found["ensemble"]["measures"]["coaptation_area_mm2"]
        area += [ensemble["min"], ensemble["max"], ensemble["deviation"]]
        self.assertRegex(printed, r"Coaptation area +" + r" +".join(f"{a:.2f}" for a in area) + " mm2")
        self.assertRegex(printed, r"\n +2 +2  pressure first +0\.50 ")
        self.assertRegex(printed, r"\n +3 +in 60 ms  together +0\.50 ")

    def test_members_not_at_rest_are_named(self):
        early = ["close", "thin.obj", "--members", 2, "--max-iterations", 2, "--allow-unsettled"]
        done = self.ok(*early)
        self.assertIn("0 of 2 members at rest", done.stdout)
        self.assertEqual(done.stdout.count("NOT at rest"), 3)
        self.assertIn("not at rest after 2 iterations", done.stderr)
        self.assertIn("--max-iterations", done.stderr)
        found = self.json(*early)["ensemble"]
        self.assertIsNone(found["lowest"])
        self.assertIsNone(found["measures"]["annulus_ap_mm"]["mean"])
        self.assertEqual(found["measures"]["annulus_ap_mm"]["members"], 0)

    def test_wrong_numbers_are_usage_errors(self):
        for line in (["--members", 0], ["--members", 1001], ["--seed", 1],
                     ["--members", 2, "--perturbation", 6], ["--members", 2, "--perturbation", -1]):
            with self.subTest(line):
                done = mvs("close", "thin.obj", *line, cwd=self.dir)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
