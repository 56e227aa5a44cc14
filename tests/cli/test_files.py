"""Commands that compare, convert and remesh files."""
import unittest

from command import Command


class Compare(Command):
    def test_a_valve_has_zero_distance_from_itself(self):
        same = self.json("compare", "v.obj", "v.obj")
        self.assertTrue(same["same_mesh"])
        for figures in same["as_they_lie"], same["registered"]:
            for key in ("node_rms_mm", "node_max_mm", "surface_rms_mm", "surface_max_mm"):
                # a rigid motion of 0.1 m coordinates rounds at 1e-17 m
                self.assertLess(figures[key], 1e-9)

    def test_different_meshes_have_no_node_distance(self):
        self.ok("generate", "--shape", "founding", "-o", "fine.obj", "--vertices", 900)
        other = self.json("compare", "v.obj", "fine.obj")
        self.assertFalse(other["same_mesh"])
        self.assertIsNone(other["as_they_lie"]["node_rms_mm"])
        # one smooth surface, two meshes of about 1.5 mm: they differ by its sagitta
        self.assertTrue(0 < other["as_they_lie"]["surface_rms_mm"] < 0.5)

    def test_closing_moves_the_leaflets_by_millimetres(self):
        moved = self.json("compare", "v.obj", "closed.obj")["as_they_lie"]
        self.assertTrue(1 < moved["node_max_mm"] < 40, moved)
        self.assertLessEqual(moved["node_rms_mm"], moved["node_max_mm"])


class Convert(Command):
    def test_obj_to_obj_keeps_every_bit(self):
        self.ok("convert", "closed.obj", "-o", "again.obj")
        self.assertEqual((self.dir / "again.obj").read_bytes(),
                         (self.dir / "closed.obj").read_bytes())

    def test_a_session_is_read_beside_a_file_with_the_name_of_this_command(self):
        # HDF5 refused the image of a file in memory, which had this name
        self.ok("convert", "v.obj", "-o", "v.h5")
        (self.dir / "mvs").write_text("any file", encoding="ascii")
        self.assertEqual(self.json("info", "v.h5")["hash"], self.json("info", "v.obj")["hash"])

    def test_vtp_is_vtk_xml(self):
        self.ok("convert", "closed.obj", "-o", "closed.vtp")
        if "hdf5" in self.ok("--version").stdout:
            self.ok("convert", "closed.obj", "-o", "closed.h5")
            self.ok("convert", "closed.h5", "-o", "back.obj")
            self.assertEqual((self.dir / "back.obj").read_bytes(),
                             (self.dir / "closed.obj").read_bytes())
        self.assertIn("PolyData", (self.dir / "closed.vtp").read_text()[:400])

    def test_unknown_ending_is_refused(self):
        self.assertIn(".xyz", self.misused("convert", "v.obj", "-o", "v.xyz"))


class Remesh(Command):
    def test_refining_splits_triangles_into_four(self):
        coarse = self.json("info", "v.obj")
        done = self.json("remesh", "closed.obj", "-o", "fine.obj", "--refine", "2")
        self.assertEqual(done["faces"], 16 * coarse["faces"])
        self.assertEqual(done["chords"], coarse["chords"])
        self.assertEqual(done["vertices_before"], coarse["vertices"])
        # the same surface with more triangles; files hold every digit
        apart = self.json("compare", "closed.obj", "fine.obj")["as_they_lie"]
        self.assertLess(apart["surface_max_mm"], 1e-9)

    def test_coarsening_by_vertices_or_by_edge(self):
        done = self.json("remesh", "v.obj", "-o", "coarse.obj", "--vertices", "220")
        self.assertEqual(done["vertices"], 220)
        self.assertEqual(self.json("info", "coarse.obj")["vertices"], 220)
        self.assertLess(done["coarsening"]["surface_rms_mm"], 0.2)
        coarsened = self.ok("remesh", "v.obj", "-o", "coarse.obj", "--vertices", "220")
        self.assertIn("220", coarsened.stdout)
        by_edge = self.json("remesh", "v.obj", "-o", "coarse.obj", "--edge", "3")
        self.assertTrue(120 < by_edge["vertices"] < 300, by_edge)

    def test_too_few_vertices_are_refused_with_the_minimum(self):
        self.assertRegex(self.misused("remesh", "v.obj", "-o", "no.obj", "--vertices", "5"),
                         r"it needs \d+")

    def test_one_target_is_required(self):
        for line in ([], ["--refine", "1", "--vertices", "9"], ["--refine", "0"], ["--edge", "-1"]):
            with self.subTest(line):
                self.misused("remesh", "v.obj", "-o", "no.obj", *line)


if __name__ == "__main__":
    unittest.main()
