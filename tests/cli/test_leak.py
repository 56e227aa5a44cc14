"""`mvs leak`: where a valve leaks."""
from command import Shell


class Leak(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        founding = ("--shape", "founding", "--leaflet", "spring")
        cls.ok("generate", *founding, "-o", "v.obj")
        cls.ok("generate", *founding, "--annulus-scale", 1.2, "-o", "wide.obj")
        cls.closed = cls.json("close", "v.obj", "-o", "closed.obj")["measures"]
        cls.leaking = cls.json("close", "wide.obj", "-o", "leaking.obj")["measures"]

    def test_scallops_add_up_to_the_measures(self):
        for file, measures in (("closed.obj", self.closed), ("leaking.obj", self.leaking)):
            found = self.json("leak", file)
            scallops = [row for row in found["regions"] if row["kind"] == "scallop"]
            self.assertEqual([row["name"] for row in found["regions"]],
                             ["A1", "A2", "A3", "P1", "P2", "P3", "A1-P1", "A3-P3"])
            for key in ("coaptation_area_mm2",):
                self.assertAlmostEqual(sum(row[key] for row in scallops), measures[key], 6)
            area = measures["regurgitant_orifice_area_mm2"]
            self.assertAlmostEqual(sum(row["orifice_area_mm2"] for row in scallops), area, 6)
            self.assertAlmostEqual(sum(row["area_mm2"] for row in found["openings"]), area, 6)
            self.assertAlmostEqual(max(row["billow_height_mm"] for row in scallops),
                                   measures["billow_height_mm"], 6)

    def test_figures_of_the_whole_valve_have_the_bits_and_units_of_the_measures(self):
        for file, measures in (("closed.obj", self.closed), ("leaking.obj", self.leaking)):
            found = self.json("leak", file)
            key = "regurgitant_orifice_area_mm2"
            self.assertEqual(found[key], measures[key])
            self.assertEqual(found[key], self.json("measure", file)["measures"][key])
            for row in found["regions"]:
                self.assertLessEqual({key for key in row if key.startswith(("tenting", "billow"))},
                                     set(measures))
            for key in "tenting_volume_ml", "billow_volume_ml":
                scallops = [row[key] for row in found["regions"] if row["kind"] == "scallop"]
                self.assertAlmostEqual(sum(scallops), measures[key], 9)

    def test_a_sealed_valve_has_no_opening(self):
        self.assertEqual(self.json("leak", "closed.obj")["openings"], [])
        lines = self.ok("leak", "closed.obj").stdout.splitlines()
        self.assertEqual(lines[0], "closed.obj: sealed under 120 mmHg")
        self.assertEqual(len(lines), 2 + 8)

    def test_a_dilated_annulus_leaks_between_A2_and_P2(self):
        first = self.json("leak", "leaking.obj")["openings"][0]
        self.assertIn("A2", first["anterior"].split("+"))
        self.assertIn("P2", first["posterior"].split("+"))
        self.assertGreater(first["gap_mm"], 1)
        self.assertAlmostEqual(sum(d * d for d in first["direction"]), 1, 9)
        text = self.ok("leak", "leaking.obj").stdout
        self.assertRegex(text, r"^leaking\.obj: orifice \d+\.\d\d mm2 under 120 mmHg\n")
        self.assertRegex(text, r"\n  opening 1: .* between A\S*A?2\S* and P\S*")

    def test_a_valve_that_is_not_closed_is_said_to_be_not_at_rest(self):
        found = self.json("leak", "v.obj")
        self.assertFalse(found["at_rest"])
        self.assertIn("not at rest", self.ok("leak", "v.obj").stdout.splitlines()[0])


if __name__ == "__main__":
    import unittest
    unittest.main()
