"""Inputs of `mvs import`: units, landmarks, edited findings, options, and outputs that are inputs."""
import json
import unittest

from test_surface_import import OpenSurface, mvs, write_markups, write_ply


class ImportInputs(OpenSurface):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.first = cls.run_import("first.h5")
        rows = json.loads((cls.dir / "first.import.json").read_text())["findings"]
        cls.found = {row["name"]: row for row in rows}

    @classmethod
    def run_import(cls, out, *arguments, surface="open.stl"):
        return mvs("import", cls.dir / surface, "-o", cls.dir / out, "--edge", "3.2", "--no-leak", *arguments)

    def points_of(self, name):
        values = self.found[name]["values"]
        return [values[k:k + 3] for k in range(0, len(values), 3)]

    def refused(self, words, *arguments, code=1):
        done = self.run_import("refused.h5", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertFalse((self.dir / "refused.h5").exists())

    def test_the_leak_is_left_out_if_it_is_not_wanted(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        self.assertIn("chordae", self.found)
        for name in ("leak", "leak_interval", "leak_limits"):
            self.assertNotIn(name, self.found)

    def test_markups_without_a_unit_have_that_of_the_option_and_a_stated_unit_counts(self):
        tips = self.points_of("papillary_tips")
        path = self.dir / "tips.mrk.json"
        write_markups(path, tips, "LPS")
        stated = json.loads(path.read_text())
        del stated["markups"][0]["coordinateUnits"]
        path.write_text(json.dumps(stated))
        done = self.run_import("mm.h5", "--tips", path, "--frame", "LPS")
        self.assertEqual(done.returncode, 0, done.stderr)
        write_ply(self.dir / "mm.ply", self.points, self.triangles, "LPS")
        text = (self.dir / "mm.ply").read_text().replace("comment SPACE=LPS", "comment SPACE=LPS\ncomment units=mm")
        (self.dir / "mm.ply").write_text(text)
        done = self.run_import("stated.h5", "--unit", "m", surface="mm.ply")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.run_import("refused.h5", "--unit", "m", "--tips", path, surface="mm.ply")
        self.assertIn("are both in one frame (LPS or RAS), in m (--unit of a file)", done.stderr)

    def test_landmarks_that_are_a_surface_or_no_points_of_a_valve_are_refused(self):
        self.refused("is a surface of triangles", "--annulus", self.dir / "open.stl")
        table = self.dir / "far.csv"
        table.write_text("x,y,z\n1e300,5,0\n-10,5,0\n")
        self.refused("row 0 of commissures", "--commissures", table)
        self.refused("row 0 of annulus", "--annulus", table)
        table.write_text("x,y,z\n0,5,0\n1,5,0\n")
        self.refused("anterior has 2 points: give one point", "--anterior", table)
        (self.dir / "empty.stl").write_bytes(b"")
        done = self.run_import("refused.h5", surface="empty.stl")
        self.assertIn("empty.stl: the file is empty", done.stderr)

    def test_an_output_that_is_an_input_is_refused(self):
        for name in ("same.obj", "same2.obj"):
            path = self.dir / name
            path.write_bytes((self.dir / "made.obj").read_bytes())
        (self.dir / "link.obj").symlink_to(self.dir / "same.obj")
        for out in ("same.obj", "link.obj"):
            done = self.run_import(out, surface="same.obj")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("is the input", done.stderr)
        self.assertEqual((self.dir / "same.obj").read_bytes(), (self.dir / "made.obj").read_bytes())
        tips = self.dir / "marks.mrk.json"
        write_markups(tips, self.points_of("papillary_tips"), "LPS")
        done = self.run_import("tips.h5", "--frame", "LPS", "--tips", tips, "--findings", tips)
        self.assertIn("is the input", done.stderr)

    def test_edited_values_that_are_not_used_are_named(self):
        edited = self.dir / "edited.json"
        rows = json.loads((self.dir / "first.import.json").read_text())
        for row in rows["findings"]:
            if row["name"] in ("surface", "thickness"):
                row["values"] = [row["values"][0] * 1.5]
        edited.write_text(json.dumps(rows))
        done = self.run_import("edited.h5", "--with", edited)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('the edited value of "surface" is not used', done.stderr)
        self.assertNotIn("thickness", done.stderr)
        self.assertEqual(done.stderr.count("is not used"), 1)

    def test_fields_of_findings_with_another_type_are_refused_by_name(self):
        edited = self.dir / "types.json"
        for key, value, kind in (("source", None, "a text"), ("confidence", "0.9", "a number"),
                                 ("doubtful", 1, "true or false"), ("unedited", 5, "a text")):
            rows = json.loads((self.dir / "first.import.json").read_text())
            row = next(r for r in rows["findings"] if r["name"] == "papillary_tips")
            self.assertIn(row["source"], ("guessed", "assumed"))
            row[key] = value
            edited.write_text(json.dumps(rows))
            with self.subTest(key):
                self.refused(f'types.json: the finding "papillary_tips" has a "{key}" that is not {kind}',
                             "--with", edited)
                error = json.loads(self.run_import("refused.h5", "--with", edited, "--json").stdout)["error"]
                self.assertEqual((error["code"], error["part"]), ("MVS_E_FORMAT", "papillary_tips"))
        for key in ("format", "version"):
            edited.write_text(json.dumps({**rows, key: {}}))
            self.refused("types.json: ", "--with", edited)

    def test_names_that_contradict_the_sides_of_the_valve_are_warned_of(self):
        tips, commissures = self.points_of("papillary_tips"), self.points_of("commissures")
        marks = self.dir / "named.mrk.json"
        for option, points in (("--tips", tips), ("--commissures", commissures)):
            for names, others in ((("AL", "PM"), None), (("F-1", "F-2"), None), (("almost", "PMX"), None),
                                  (("PM tip", "anterolateral"), '"PM tip", "anterolateral"'), (("AL1", "AL2"), '"AL2"')):
                with self.subTest(option, names=names):
                    write_markups(marks, points, "LPS", names)
                    done = self.run_import("named.h5", "--frame", "LPS", option, marks)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual("than their names say" in done.stderr, others is not None, done.stderr)
                    self.assertIn(f"PM: posteromedial): {others}. Are" if others else "", done.stderr)

    def test_ranges_of_options_are_in_mm(self):
        for option, value, range_ in (("--thickness", "30", "0.1 to 5 mm"), ("--chords", "500", "20 to 400"),
                                      ("--coaptation-length", "nan", "1 to 20 mm"), ("--edge-lost", "0", "0.001 to 5 mm")):
            self.refused(f"a number from {range_} is needed, not {value}", option, value, code=2)
        done = mvs("import", self.dir / "open.stl", "-o", self.dir / "wide.h5", "--edge", "20")
        self.assertEqual(done.returncode, 2)
        self.assertIn("0.2 to 5 mm is needed, not 20", done.stderr)


if __name__ == "__main__":
    unittest.main()
