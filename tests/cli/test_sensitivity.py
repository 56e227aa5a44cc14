"""`mvs sensitivity`: derivatives of measures, sorted by influence."""
import unittest

from command import Shell, mvs


class Sensitivity(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--vertices", 250, "-o", "v.obj")
        cls.ok("close", "v.obj", "-o", "closed.obj")

    def test_rows_are_sorted_by_influence(self):
        found = self.json("sensitivity", "closed.obj", "--of", "coaptation,leaflet_area", "--to", "chords")
        key = "d_coaptation_area_mm2_per_mm"
        sizes = [abs(row[key]) for row in found["parameters"]]
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        self.assertGreater(sizes[0], 0)
        self.assertEqual(found["quantities"][0]["name"], "coaptation_area")
        other = self.json("sensitivity", "closed.obj", "--of", "coaptation,leaflet_area",
                          "--sort", "leaflet_area", "--top", 3)
        self.assertEqual(len(other["parameters"]), 3)
        by = {row["parameter"]: row[key] for row in found["parameters"]}
        for row in other["parameters"]:
            self.assertEqual(row[key], by[row["parameter"]])

    def test_no_parameters_are_asked_for_by_mistake(self):
        done = mvs("sensitivity", "closed.obj", "--top", 0, cwd=self.dir)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--top: a number above 0 is needed", done.stderr)

    def test_heads_scallops_and_load(self):
        for to, name in (("heads", "PM1 x"), ("scallops", "P2"), ("pressure", "pressure"),
                         ("annulus_scale", "annulus_scale")):
            text = self.ok("sensitivity", "closed.obj", "--to", to).stdout
            self.assertIn(f"\n  {name} ", text)
            self.assertRegex(text, r"coaptation = \d+\.?\d* mm2")

    def test_sites_of_a_neochord(self):
        self.ok("op", "closed.obj", "neochord", "--head", "PM1", "--site", "P2:0.5:0.9", "--length", 17,
                "--name", "gore", "--settle", 120, "-o", "neo.obj")
        found = self.json("sensitivity", "neo.obj", "--to", "sites")["parameters"]
        rows = self.json("sensitivity", "neo.obj", "--to", "sites", "--chord", "gore")["parameters"]
        # an inner vertex has about six edges, one of the free edge about four
        self.assertGreaterEqual(len(rows), 3)
        self.assertTrue(all(row["parameter"].startswith("gore to ") for row in rows))
        self.assertEqual(rows, [row for row in found if row["parameter"].startswith("gore to ")])
        self.assertTrue(any(row["d_coaptation_area_mm2_per_mm"] != 0 for row in rows))
        text = self.ok("sensitivity", "neo.obj", "--to", "sites", "--chord", "gore").stdout
        for row in rows:
            self.assertIn(f"\n  {row['parameter']} ", text)
        alone = self.json("sensitivity", "neo.obj", "--chord", "gore")["parameters"]
        self.assertEqual([row["parameter"] for row in alone], ["gore"])

    def test_a_chord_without_a_site_is_refused(self):
        # of this valve: a chord between a head and a branch point
        found = self.json("sensitivity", "closed.obj", "--to", "sites")["parameters"]
        inserted = {row["parameter"].split(" to ")[0] for row in found}
        chords = [row["parameter"] for row in self.json("sensitivity", "closed.obj")["parameters"]]
        trunk = next(name for name in chords if name not in inserted)
        self.assertIn("does not end on a leaflet",
                      self.refused("closed.obj", "--to", "sites", "--chord", trunk, code=1))
        self.assertIn("--to chords or --to sites",
                      self.refused("closed.obj", "--to", "heads", "--chord", trunk, code=2))
        self.assertIn("x1", self.refused("closed.obj", "--chord", "x1", code=1))

    def with_sides(self, vertices):
        """Rows, text, and whether both sides differ for some but not all chordae of a valve."""
        self.ok("generate", "--vertices", vertices, "-o", "near.obj")
        self.ok("close", "near.obj", "-o", "near.obj")
        arguments = ("sensitivity", "near.obj", "--of", "coaptation", "--to", "chords")
        found, text = self.json(*arguments), self.ok(*arguments).stdout
        sides = [[f"{row['d_coaptation_area_mm2_per_mm' + side]:.3g}" for side in ("_below", "_above")]
                 for row in found["parameters"]]
        return found, text, len({below == above for below, above in sides}) == 2

    def test_both_sides_are_printed_where_they_differ(self):
        # in one of these valves contact is about to switch, which matters to some of its chordae
        some = next((made for made in map(self.with_sides, (310, 330, 230, 300, 250)) if made[2]), None)
        self.assertIsNotNone(some)
        found, text, _ = some
        key = "d_coaptation_area_mm2_per_mm"
        differing = 0
        for row in found["parameters"]:
            line = next(line for line in text.splitlines() if line.startswith(f"  {row['parameter']} "))
            below, above = row[key + "_below"], row[key + "_above"]
            if f"{below:.3g}" == f"{above:.3g}":
                self.assertNotIn("/", line.split()[1])
                self.assertNotIn("about to switch", line)
            else:
                differing += 1
                self.assertEqual(line.split()[1], f"{below:.3g}/{above:.3g}")
                self.assertIn("about to switch", line)
        self.assertGreater(differing, 0)
        self.assertLess(differing, len(found["parameters"]))

    def refused(self, *arguments, code):
        done = mvs("sensitivity", *arguments, cwd=self.dir)
        self.assertEqual((done.returncode, done.stdout), (code, ""))
        return done.stderr

    def test_bad_input_is_refused(self):
        self.assertIn("not at rest", self.refused("v.obj", code=1))
        self.assertIn("no measure is named", self.refused("closed.obj", "--of", "x", code=2))
        self.assertIn("it has to be one of the quantities",
                      self.refused("closed.obj", "--sort", "orifice", code=2))
        self.assertIn("choose from", self.refused("closed.obj", "--to", "x", code=2))


if __name__ == "__main__":
    unittest.main()
