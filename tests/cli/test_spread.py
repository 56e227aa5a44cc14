"""`mvs close --paths`: what a script reads of the spread, and what people do."""
import unittest

from test_cli import Shell, mvs

PATHS = 4


class Spread(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "-o", "thin.obj", "--vertices", 250, "--thickness", 0.5)
        cls.plain = cls.json("close", "thin.obj", "-o", "plain.obj")
        cls.found = cls.json("close", "thin.obj", "--paths", PATHS, "-o", "closed.obj")

    def test_the_valve_is_the_one_without_paths(self):
        for key in ("hash", "iterations", "energy_J", "residual_N", "measures", "intersections"):
            self.assertEqual(self.found[key], self.plain[key], key)
        self.assertEqual((self.dir / "closed.obj").read_bytes(),
                         (self.dir / "plain.obj").read_bytes())
        self.assertNotIn("spread", self.plain)

    def test_statistics_are_those_of_the_closures(self):
        spread = self.found["spread"]
        self.assertEqual(len(spread["closures"]), PATHS)
        self.assertEqual(spread["converged"], PATHS)
        self.assertEqual(spread["closures"][0]["hash"], self.found["hash"])
        for key in self.found["measures"]:
            values = [c["measures"][key] for c in spread["closures"]]
            told = spread["measures"][key]
            if None in values:
                continue
            self.assertEqual((told["min"], told["max"]), (min(values), max(values)), key)
            if "mean" in told:
                self.assertEqual(told["paths"], PATHS)
                # sums in another order
                size = max(map(abs, values)) or 1
                self.assertAlmostEqual(told["mean"] / size, sum(values) / PATHS / size, 12)

    def test_shapes_and_equilibria_are_those_of_the_closures(self):
        spread = self.found["spread"]
        numbers = [c["equilibrium"] for c in spread["closures"]]
        self.assertEqual(spread["equilibria"], len(set(numbers)))
        energies = [c["energy_J"] for c in spread["closures"]]
        self.assertEqual(spread["lowest"], energies.index(min(energies)))
        self.assertEqual(spread["surface_max_mm"],
                         max(c["surface_max_mm"] for c in spread["closures"]))

    def test_same_seed_same_figures(self):
        def hashes(found):
            return [c["hash"] for c in found["spread"]["closures"]]

        again = self.json("close", "thin.obj", "--paths", PATHS, "--seed", 0)
        other = self.json("close", "thin.obj", "--paths", PATHS, "--seed", 9)
        self.assertEqual(hashes(again), hashes(self.found))
        self.assertEqual(hashes(other)[0], hashes(self.found)[0])
        self.assertNotEqual(hashes(other)[1:], hashes(self.found)[1:])

    def test_no_disturbance_leaves_the_ways_of_loading(self):
        found = self.json("close", "thin.obj", "--paths", 2, "--perturbation", 0)
        self.assertEqual([c["perturbation_mm"] for c in found["spread"]["closures"]], [0, 0])

    def test_errors_against_a_reference_have_their_spread(self):
        self.ok("generate", "-o", "other.obj", "--vertices", 250)
        self.ok("close", "other.obj", "-o", "reference.obj")
        line = ["close", "thin.obj", "--reference", "reference.obj"]
        alone = self.json(*line)["reference"]
        compared = self.json("compare", "plain.obj", "reference.obj")
        for key in ("node_rms_mm", "node_max_mm", "surface_rms_mm", "surface_max_mm"):
            self.assertEqual(alone[key], compared["as_they_lie"][key])
            registered = key.replace("_mm", "_registered_mm")
            self.assertEqual(alone[registered], compared["registered"][key])
        self.assertNotIn("spread", alone)
        found = self.json(*line, "--paths", PATHS)["reference"]
        over = found.pop("spread")
        self.assertEqual(found, alone)
        self.assertEqual(over["paths"], PATHS)
        # the coarse thin valve folds in more ways than one, so the error has a range
        self.assertLess(over["node_max_mm"]["min"], over["node_max_mm"]["max"])
        self.assertLessEqual(over["surface_rms_mm"]["min"], found["surface_rms_mm"])
        self.assertRegex(self.ok(*line, "--paths", PATHS).stdout,
                         rf"Surfaces, RMS +{found['surface_rms_mm']:.3f}  \(")
        self.assertIn("nowhere.obj", mvs("close", "thin.obj", "--reference", "nowhere.obj",
                                         cwd=self.dir).stderr)

    def test_people_read_value_range_and_paths(self):
        told = self.ok("close", "thin.obj", "--paths", PATHS).stdout
        self.assertIn(f"{PATHS} of {PATHS} paths at rest", told)
        self.assertRegex(told, r"plain +least +most +deviation\n")
        area = [self.found["measures"]["coaptation_area_mm2"]]
        spread = self.found["spread"]["measures"]["coaptation_area_mm2"]
        area += [spread["min"], spread["max"], spread["deviation"]]
        self.assertRegex(told, r"Coaptation area +" + r" +".join(f"{a:.2f}" for a in area) + " mm2")
        self.assertRegex(told, r"\n +2 +2  pressure first +0\.50 ")
        self.assertRegex(told, r"\n +3 +in 60 ms  together +0\.50 ")

    def test_paths_not_at_rest_are_named(self):
        done = self.ok("close", "thin.obj", "--paths", 2, "--max-iterations", 2)
        self.assertIn("0 of 2 paths at rest", done.stdout)
        self.assertEqual(done.stdout.count("NOT at rest"), 3)
        self.assertIn("not converged", done.stderr)
        found = self.json("close", "thin.obj", "--paths", 2, "--max-iterations", 2)["spread"]
        self.assertIsNone(found["lowest"])
        self.assertIsNone(found["measures"]["annulus_ap_mm"]["mean"])
        self.assertEqual(found["measures"]["annulus_ap_mm"]["paths"], 0)

    def test_wrong_numbers_are_usage_errors(self):
        for line in (["--paths", 0], ["--paths", 1001], ["--seed", 1],
                     ["--paths", 2, "--perturbation", 6], ["--paths", 2, "--perturbation", -1]):
            with self.subTest(line):
                done = mvs("close", "thin.obj", *line, cwd=self.dir)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
