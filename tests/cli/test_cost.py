"""`mvs cost` and `mvs sweep --cost`: the cost of a repair."""
import csv
import unittest

from command import Shell, mvs


class Cost(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "-o", "v.obj")
        cls.ok("close", "v.obj", "-o", "closed.obj")
        (cls.dir / "septum.txt").write_text("# mm\n0, 60, -10\n5, 80, -10\n")

    def test_an_open_valve_is_measured_and_written(self):
        found = self.json("cost", "closed.obj", "-o", "opened.obj", "--flow", 250)
        cost = found["cost"]
        self.assertTrue(cost["opened"] and found["at_rest"])
        opened = self.json("measure", "opened.obj")
        self.assertAlmostEqual(opened["pressure_mmHg"], -5, 9)
        self.assertEqual(opened["boundary_fraction"], 0)
        self.assertAlmostEqual(opened["measures"]["regurgitant_orifice_area_mm2"],
                               cost["open_area_mm2"], 9)
        speed = 250e-6 / (0.85 * cost["open_area_mm2"] * 1e-6)
        self.assertAlmostEqual(cost["gradient_mmHg"], 0.5 * 1060 * speed**2 / 133.322, 9)
        self.assertEqual(cost["sam_risk"], "not determined")
        self.assertIsNone(cost["septal_distance_mm"])

    def test_points_of_the_septum_give_the_risk(self):
        text = self.ok("cost", "closed.obj", "--septum", "septum.txt").stdout
        self.assertRegex(text, r"Coaptation to septum +\d+\.\d\d mm\n")
        self.assertRegex(text, r"Risk of SAM +low\n")
        self.assertRegex(text, r"Gradient +not known\n")

    def test_a_sweep_weighs_the_leak_against_the_open_area(self):
        sweep = ("sweep", "v.obj", "--op", "ring size=28,34", "--csv", "t.csv")
        lines = self.ok(*sweep, "--cost", "--sort", "open_area_mm2", "--largest").stdout
        self.assertRegex(lines, r"first\n +\d+\.?\d* +ring_size_mm=34\n +\d+\.?\d* +ring_size_mm=28")
        with open(self.dir / "t.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["sam_risk"] for row in rows], ["not determined"] * 2)
        self.assertEqual(rows[0]["cost"], "diastole 5 mmHg")
        self.assertLess(float(rows[0]["open_area_mm2"]), float(rows[1]["open_area_mm2"]))
        self.refused(1, "other options of costs", *sweep, "--cost", "--flow", 250)

    def test_a_valve_without_load_is_not_said_to_be_closed(self):
        done = mvs("cost", "v.obj", cwd=self.dir)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^v\.obj: under no pressure, not at rest; opened by 5 mmHg\n")
        self.assertIn("warning: v.obj is under no pressure", done.stderr)

    def test_an_open_valve_is_not_said_to_be_closed(self):
        self.ok("cost", "closed.obj", "-o", "opened.obj")
        done = mvs("cost", "opened.obj", cwd=self.dir)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^opened\.obj: open under -5 mmHg, at rest; opened by 5 mmHg\n")
        self.assertIn("warning: opened.obj is open under -5 mmHg: figures of the closed valve", done.stderr)

    def test_a_point_of_the_septum_that_is_no_number_is_named_by_its_line(self):
        cost = ("cost", "closed.obj", "--septum", "broken.txt")
        for line in ("60, nan, -10", "inf 0 0"):
            (self.dir / "broken.txt").write_text(f"60, 0, -10\n{line}\n")
            self.refused(1, "broken.txt:2: needs three numbers", *cost)
            (self.dir / "broken.txt").write_text(f"{line}\n60, 0, -10\n")
            self.refused(1, "broken.txt:1: needs three numbers", *cost)

    def test_a_row_of_a_sweep_is_of_the_contents_of_the_septum(self):
        sweep = ("sweep", "v.obj", "--op", "ring size=28", "--csv", "s.csv", "--cost", "--septum",
                 "moved.txt")
        (self.dir / "moved.txt").write_text("0, 60, -10\n")
        self.ok(*sweep)
        self.assertEqual(self.json(*sweep)["closed_now"], 0)
        (self.dir / "moved.txt").write_text("0, 50, -10\n")
        self.refused(1, "files with other contents", *sweep)

    def test_points_behind_the_coaptation_are_not_of_the_septum(self):
        (self.dir / "behind.txt").write_text("0 -40 -10\n0 -40 -15\n")
        self.refused(1, "mm behind the line where the leaflets meet, on the side of the posterior",
                     "cost", "closed.obj", "--septum", "behind.txt")

    def test_a_flow_in_litres_is_refused(self):
        self.refused(2, "0.25 ml/s is no flow through an open mitral valve", "cost", "closed.obj",
                     "--flow", 0.25)
        for flow, accepted in ((9.99, False), (10, True), (10000, True), (10001, False)):
            if accepted:
                self.ok("cost", "closed.obj", "--flow", flow)
            else:
                self.refused(2, ", 10 to 10000 are accepted", "cost", "closed.obj", "--flow", flow)

    def test_wrong_input_is_named(self):
        sweep = ("sweep", "v.obj", "--op", "ring size=28", "--csv", "u.csv")
        self.refused(1, "none.txt", "cost", "closed.obj", "--septum", "none.txt")
        self.refused(2, "--cost", *sweep, "--flow", 250)
        self.refused(2, "--cost only", *sweep, "--sort", "open_area_mm2")

    def refused(self, code, words, *arguments):
        done = mvs(*arguments, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
