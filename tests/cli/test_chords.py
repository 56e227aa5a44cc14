"""`mvs chords`: the table of chordae."""
import re

from command import Shell, mvs


class Chords(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "v.obj", "--chord-factor", "A2/7=0.8")
        cls.closed = cls.json("close", "v.obj", "-o", "closed.obj")["measures"]
        cls.table = cls.json("chords", "closed.obj")

    def rows(self, *arguments, file="closed.obj"):
        return self.json("chords", file, *arguments)["chords"]

    def test_each_chord_is_a_row_with_the_figures_of_measure(self):
        rows = self.table["chords"]
        info = self.json("info", "closed.obj")
        self.assertEqual(self.table["pressure_mmHg"], 120)
        self.assertEqual(len(rows), info["chords"])
        self.assertEqual(len({row["name"] for row in rows}), len(rows))
        self.assertEqual(max(row["strain"] for row in rows), self.closed["max_chord_strain"])
        self.assertEqual(max(row["tension_N"] for row in rows), self.closed["max_chord_tension_N"])
        kinds = {kind["kind"]: kind["count"] for kind in info["chord_kinds"]}
        for kind, count in kinds.items():
            self.assertEqual(sum(row["kind"] == kind for row in rows), count)
        for row in rows:
            # the definition of strain; both sides are rounded
            self.assertAlmostEqual(row["length_mm"], row["rest_length_mm"] * (1 + row["strain"]), 9)

    def test_each_chord_leads_from_a_head_to_the_scallop_of_its_name(self):
        heads = {head["name"] for head in self.json("info", "closed.obj")["heads"]}
        for row in self.table["chords"]:
            with self.subTest(row["name"]):
                self.assertIn(row["head"], heads)
                if row["kind"] == "trunk":
                    self.assertRegex(row["site"], r"^[AP]\d(\+[AP]\d)*$")
                else:
                    self.assertRegex(row["site"], r"^[AP]\d$")
                # a chord at the border of two scallops may end on a vertex of the other one
                self.assertEqual(row["site"][0], row["name"][0])

    def test_mirrored_chordae_have_mirrored_sites(self):
        def mirrored(text):
            return re.sub(r"(?<=[AP])[13]", lambda found: "13"[found[0] == "1"], text)

        self.ok("generate", "-o", "even.obj")  # mirrors itself, with vertices between scallops
        site = {row["name"]: set(row["site"].split("+")) for row in self.rows(file="even.obj")}
        sides = [name for name in site if name[1] in "13"]
        self.assertGreater(len(sides), 40)
        for name in sides:
            self.assertEqual(site[mirrored(name)], {mirrored(part) for part in site[name]}, name)

    def test_a_chord_ends_at_the_site_where_it_was_tied(self):
        self.ok("op", "closed.obj", "neochord", "--head", "PM1", "--site", "P2:0.5:0.9", "--name",
                "loop", "-o", "tied.obj")
        (loop,) = [row for row in self.rows(file="tied.obj") if row["name"] == "loop"]
        self.assertEqual((loop["kind"], loop["head"], loop["site"]), ("marginal", "PM1", "P2"))

    def test_rows_are_sorted_as_asked(self):
        for key, column in (("tension", "tension_N"), ("strain", "strain"),
                            ("length", "length_mm")):
            values = [row[column] for row in self.rows("--sort", key)]
            self.assertEqual(values, sorted(values, reverse=True))
        self.assertEqual(self.rows("--sort", "tension"), self.table["chords"])
        names = [row["name"] for row in self.rows("--sort", "name")]
        counted = [[int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]
                   for name in names]
        self.assertEqual(counted, sorted(counted))
        self.assertEqual(mvs("chords", "v.obj", "--sort", "colour", cwd=self.dir).returncode, 2)

    def test_flags_are_those_of_measure(self):
        flags = [flag for row in self.table["chords"] for flag in row["flags"]]
        self.assertEqual(flags.count("over strain"), self.closed["chords_over_strain"])
        self.assertEqual(flags.count("over tension"), self.closed["chords_over_tension"])
        self.assertLessEqual(set(flags), {"over strain", "over tension", "slack"})
        for row in self.table["chords"]:
            self.assertEqual("slack" in row["flags"], row["tension_N"] == 0)
        self.ok("op", "closed.obj", "chord-length", "--chord", "A2/7", "--factor", 2, "-o",
                "long.obj")
        (long,) = [row for row in self.rows(file="long.obj") if row["name"] == "A2/7"]
        self.assertEqual((long["flags"], long["tension_N"]), (["slack"], 0))

    def test_text_has_units_and_the_same_order(self):
        lines = self.ok("chords", "closed.obj").stdout.splitlines()
        self.assertRegex(lines[0], r"^closed\.obj: \d+ chordae under 120 mmHg, by tension$")
        self.assertEqual(re.split(r"\s{2,}", lines[1].strip()),
                         ["name", "kind", "head", "site", "length mm", "rest mm", "strain %",
                          "tension N", "flag"])
        self.assertEqual([line.split()[0] for line in lines[2:]],
                         [row["name"] for row in self.table["chords"]])


if __name__ == "__main__":
    import unittest
    unittest.main()
