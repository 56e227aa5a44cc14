"""`mvs import`: a surface and landmarks in files become a valve; findings are edited and read back."""
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

MVS = os.environ["MVS_COMMAND"]


def mvs(*arguments):
    return subprocess.run([MVS, *map(str, arguments)], capture_output=True, text=True, timeout=300)


def read_obj(path):
    """Points in m and triangles of an OBJ file in mm; points without a triangle are left out."""
    points, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(1e-3 * float(word) for word in words[1:4]))
        elif words[:1] == ["f"]:
            triangles.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:4]))
    used = sorted({k for t in triangles for k in t})
    place = {old: new for new, old in enumerate(used)}
    return [points[k] for k in used], [tuple(place[k] for k in t) for t in triangles]


def write_stl(path, points, triangles):
    """Binary STL in mm."""
    with path.open("wb") as out:
        out.write(b"leaflets".ljust(80) + struct.pack("<I", len(triangles)))
        for t in triangles:
            corners = [1e3 * x for k in t for x in points[k]]
            out.write(struct.pack("<12fH", 0, 0, 0, *corners, 0))


def write_ply(path, points, triangles, frame):
    """Text PLY in mm, with the comment by which 3D Slicer states the frame."""
    lines = ["ply", "format ascii 1.0", f"comment SPACE={frame}", f"element vertex {len(points)}",
             "property double x", "property double y", "property double z",
             f"element face {len(triangles)}", "property list uchar int vertex_indices",
             "end_header"]
    lines += [" ".join(repr(1e3 * x) for x in p) for p in points]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_markups(path, points, frame, names=None):
    """Points of 3D Slicer in mm."""
    controls = [{"id": str(k), "label": names[k] if names else f"F-{k}", "position": [1e3 * x for x in p],
                 "positionStatus": "defined"} for k, p in enumerate(points)]
    path.write_text(json.dumps({"markups": [
        {"type": "Fiducial", "coordinateSystem": frame, "coordinateUnits": "mm",
         "controlPoints": controls}]}), encoding="utf-8")


class OpenSurface(unittest.TestCase):
    """The leaflets of a generated valve as `open.stl` in a folder of their own."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.dir = pathlib.Path(folder.name)
        assert mvs("generate", "-o", cls.dir / "made.obj").returncode == 0
        cls.points, cls.triangles = read_obj(cls.dir / "made.obj")
        write_stl(cls.dir / "open.stl", cls.points, cls.triangles)


class SurfaceImport(OpenSurface):
    def ok(self, *arguments):
        done = mvs(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fails(self, code, word, *arguments):
        done = mvs(*arguments)
        self.assertEqual(done.returncode, code, done.stdout)
        self.assertIn(word, done.stderr)

    def imported(self, surface, out, *arguments, edge=2.4):
        done = self.ok("import", self.dir / surface, "-o", self.dir / out, "--json",
                       "--edge", edge, *arguments)  # 350 vertices: fast
        return json.loads(done.stdout)

    def test_a_surface_alone_becomes_a_valve_that_closes(self):
        printed = self.imported("open.stl", "alone.h5")
        self.assertGreater(printed["vertices"], 250)
        closed = json.loads(self.ok("close", self.dir / "alone.h5", "-o", self.dir / "closed.h5",
                                    "--json").stdout)
        self.assertTrue(closed["converged"], closed)
        found = {row["name"]: row for row in printed["findings"]}
        self.assertEqual(found["papillary_tips"]["source"], "assumed")
        self.assertEqual(found["annulus"]["source"], "guessed")
        self.assertEqual(len(found["leak"]["values"]), 3)

    def test_what_is_not_used_of_a_whole_valve_is_said(self):
        done = self.ok("import", self.dir / "made.obj", "-o", self.dir / "leaflets.h5", "--edge", "2.4")
        self.assertIn("made.obj is a whole valve: its annulus, chordae", done.stderr)
        done = self.ok("import", self.dir / "open.stl", "-o", self.dir / "leaflets.h5", "--edge", "2.4")
        self.assertEqual(done.stderr, "")

    def test_findings_read_back_change_no_bit_and_edited_ones_count(self):
        first = self.imported("open.stl", "first.h5", "--edge-error", "0.4")
        findings = self.dir / "first.import.json"
        self.assertEqual(json.loads(findings.read_text())["findings"], first["findings"])
        again = self.imported("open.stl", "again.h5", "--with", findings)
        self.assertEqual(again["hash"], first["hash"])
        before, after = ({row["name"]: (row["source"], row["confidence"]) for row in made["findings"]}
                         for made in (first, again))
        for name in ("commissures", "anterior", "thickness", "papillary_tips"):  # unedited
            self.assertIn(before[name][0], ("guessed", "assumed"))
            self.assertEqual(after[name], before[name])
        self.assertEqual(after["edge_error"][0], "given")  # by the option
        for made in (first, again):
            interval = next(row for row in made["findings"] if row["name"] == "leak_interval")
            self.assertIn("errors of the papillary heads and commissures, which were not given", interval["sentence"])
        edited = json.loads(findings.read_text())
        for row in edited["findings"]:
            if row["name"] == "papillary_tips":
                row["values"][2] -= 0.002
            if row["name"] == "edge_error":
                self.assertEqual(row["values"], [0.4 * 1e-3])
                row["values"] = [0.6e-3]
        findings.write_text(json.dumps(edited))
        other = self.imported("open.stl", "other.h5", "--with", findings)
        self.assertNotEqual(other["hash"], first["hash"])
        rows = {row["name"]: row for row in other["findings"]}
        self.assertEqual(rows["papillary_tips"]["source"], "given")
        self.assertEqual(rows["edge_error"]["values"], [0.6e-3])
        self.assertIn("0.6 mm farther out", rows["leak_interval"]["sentence"])

    def test_a_tissue_that_is_given_is_a_finding_that_is_read_back(self):
        given = self.imported("open.stl", "prot.h5", "--leaflet", "prot")
        findings = self.dir / "prot.import.json"
        again = self.imported("open.stl", "prot_again.h5", "--with", findings)
        self.assertEqual(again["hash"], given["hash"])
        rows = json.loads(findings.read_text())
        tissue = next(row for row in rows["findings"] if row["name"] == "tissue")
        self.assertEqual((tissue["source"], tissue["sentence"]), ("given", "prot, as given"))
        for wrong in (2.5, 0, -1, 99, 1e300):
            tissue["values"] = [wrong]
            findings.write_text(json.dumps(rows))
            self.fails(1, "the number of a law of leaflets, 1 to 6", "import", self.dir / "open.stl", "-o",
                       self.dir / "wrong.h5", "--with", findings)
        self.assertFalse((self.dir / "wrong.h5").exists())

    def test_the_tissue_of_closed_leaflets_is_found(self):
        """Closed with another tissue than the default; the finding gives the same bits as an input."""
        self.imported("open.stl", "soft.h5", "--leaflet", "may_newman_yin", edge=3.2)
        self.ok("close", self.dir / "soft.h5", "-o", self.dir / "soft.obj")
        write_stl(self.dir / "soft.stl", *read_obj(self.dir / "soft.obj"))
        found = self.imported("open.stl", "found.h5", "--closed", self.dir / "soft.stl", "--closed-error", "0.2",
                              edge=3.2)
        rows = {row["name"]: row for row in found["findings"]}
        # one of both exponential tissues, which differ by less than a fit does
        self.assertRegex(rows["tissue"]["sentence"], "^(may_newman_yin|prot), by distances")
        self.assertEqual(rows["tissue"]["source"], "guessed")
        again = self.imported("open.stl", "found_again.h5", "--closed", self.dir / "soft.stl", "--with",
                              self.dir / "found.import.json", edge=3.2)
        self.assertEqual(again["hash"], found["hash"])
        known = {row["name"]: row for row in again["findings"]}
        for one in rows["closed_error"], known["closed_error"]:
            self.assertEqual((one["source"], one["values"]), ("given", [0.2e-3]))
        self.assertIn("0.72 mm", known["shown_gaps"]["sentence"] + known["closed_error"]["sentence"])
        self.fails(2, "--closed-error requires --closed", "import", self.dir / "open.stl", "-o", self.dir / "x.h5",
                   "--closed-error", "0.2")

    def test_the_loaded_annulus_and_tips_are_inputs(self):
        found = {f["name"]: f for f in self.imported("open.stl", "still.h5")["findings"]}
        self.assertNotIn("closed_annulus", found)
        tips = found["papillary_tips"]["values"]
        tips = [tips[k:k + 3] for k in range(0, len(tips), 3)][::-1]  # findings keep this order
        around = found["annulus"]["values"]
        wider = [[1.1 * x for x in around[k:k + 3]] for k in range(0, len(around), 3)]
        write_markups(self.dir / "tips.mrk.json", tips, "LPS")
        write_markups(self.dir / "tips2.mrk.json", [[x, y, z + 2e-3] for x, y, z in tips], "LPS")
        write_markups(self.dir / "annulus2.mrk.json", wider, "LPS")
        moved = self.imported("open.stl", "moved.h5", "--tips", self.dir / "tips.mrk.json", "--frame", "LPS",
                              "--closed-annulus", self.dir / "annulus2.mrk.json",
                              "--closed-tips", self.dir / "tips2.mrk.json")
        rows = {f["name"]: f for f in moved["findings"]}
        self.assertEqual(rows["closed_annulus"]["source"], "given")
        self.assertIn("move by 2.0 to 2.0 mm under load", rows["closed_tips"]["sentence"])
        again = self.imported("open.stl", "moved_again.h5", "--with", self.dir / "moved.import.json")
        self.assertEqual(again["hash"], moved["hash"])
        self.ok("close", self.dir / "moved.h5", "-o", self.dir / "moved_closed.h5", "--residual", "1e-2")
        before, after = (json.loads(self.ok("info", self.dir / name, "--json").stdout)["annulus_cc_mm"]
                         for name in ("moved.h5", "moved_closed.h5"))
        self.assertAlmostEqual(after / before, 1.1, delta=0.02)  # points slide along the curve
        self.fails(1, "give the same tips in the same order", "import", self.dir / "open.stl", "-o",
                   self.dir / "x.h5", "--closed-tips", self.dir / "tips2.mrk.json", "--frame", "LPS")

    def test_an_anterior_point_on_the_posterior_leaflet_is_warned_of(self):
        found = {f["name"]: f for f in self.imported("open.stl", "as_is.h5")["findings"]}
        anterior = found["anterior"]["values"]
        around = found["annulus"]["values"]
        rim = [around[k:k + 3] for k in range(0, len(around), 3)]
        across = max(rim, key=lambda p: sum((a - b) ** 2 for a, b in zip(p, anterior)))
        for name, point, warned in (("right", anterior, False), ("wrong", across, True)):
            write_markups(self.dir / f"{name}.mrk.json", [point], "LPS")
            done = self.ok("import", self.dir / "open.stl", "-o", self.dir / f"{name}.h5", "--json", "--edge", "2.4",
                           "--frame", "LPS", "--anterior", self.dir / f"{name}.mrk.json")
            self.assertEqual("mvs: warning: anterior, " in done.stderr, warned, done.stderr)

    def test_landmarks_of_another_known_frame_are_turned(self):
        def negated(points):
            return [(-x, -y, z) for x, y, z in points]

        found = {row["name"]: row["values"]
                 for row in self.imported("open.stl", "plain.h5")["findings"]}
        tips = [found["papillary_tips"][k:k + 3] for k in range(0, len(found["papillary_tips"]), 3)]
        write_ply(self.dir / "lps.ply", self.points, self.triangles, "LPS")
        write_markups(self.dir / "ras.mrk.json", negated(tips), "RAS")
        write_markups(self.dir / "lps.mrk.json", tips, "LPS")
        same = [self.imported("lps.ply", f"{k}.h5", "--tips", self.dir / name)
                for k, name in enumerate(("ras.mrk.json", "lps.mrk.json"))]
        self.assertEqual(same[0]["frame"], "LPS")
        self.assertEqual(same[0]["hash"], same[1]["hash"])

    def test_landmarks_of_slicer_without_a_frame_are_told(self):
        found = {row["name"]: row["values"]
                 for row in self.imported("open.stl", "unframed.h5")["findings"]}
        tips = [found["papillary_tips"][k:k + 3] for k in range(0, len(found["papillary_tips"]), 3)]
        path = self.dir / "unframed.mrk.json"
        write_markups(path, tips, "LPS")
        markups = json.loads(path.read_text())
        del markups["markups"][0]["coordinateSystem"]
        path.write_text(json.dumps(markups))
        arguments = ["import", self.dir / "open.stl", "-o", self.dir / "unframed.h5", "--edge", "2.4",
                     "--tips", path]
        self.assertIn("unframed.mrk.json: states no frame", self.ok(*arguments).stderr)
        self.assertEqual(self.ok(*arguments, "--frame", "LPS").stderr, "")

    def test_a_valve_from_a_surface_in_RAS_is_written_in_LPS(self):
        def negated(points):
            return [(-x, -y, z) for x, y, z in points]

        write_ply(self.dir / "in_lps.ply", self.points, self.triangles, "LPS")
        write_ply(self.dir / "in_ras.ply", negated(self.points), self.triangles, "RAS")
        write_stl(self.dir / "in_ras.stl", negated(self.points), self.triangles)
        made = self.imported("in_lps.ply", "lps.obj")
        stated = self.imported("in_ras.ply", "ras.obj")
        given = self.imported("in_ras.stl", "given.obj", "--frame", "RAS")
        self.assertEqual((made["frame"], stated["frame"], given["frame"]), ("LPS", "LPS", "LPS"))
        written = (self.dir / "given.obj").read_text(encoding="utf-8")
        self.assertIn("# SPACE=LPS", written)
        made, stated, given = (
            {row["name"]: row["values"] for row in printed["findings"]}["papillary_tips"]
            for printed in (made, stated, given))
        self.assertEqual(stated, made)
        for a, b in zip(made, given):  # from points in single precision
            self.assertAlmostEqual(a, b, delta=1e-6)

    def test_landmarks_in_two_frames_need_that_of_the_surface(self):
        found = {row["name"]: row["values"]
                 for row in self.imported("open.stl", "two.h5")["findings"]}

        def points(name):
            return [found[name][k:k + 3] for k in range(0, len(found[name]), 3)]

        write_markups(self.dir / "tips_ras.mrk.json",
                      [(-x, -y, z) for x, y, z in points("papillary_tips")], "RAS")
        write_markups(self.dir / "ends_lps.mrk.json", points("commissures"), "LPS")
        both = ["--tips", self.dir / "tips_ras.mrk.json",
                "--commissures", self.dir / "ends_lps.mrk.json"]
        self.fails(2, "give the frame of the surface by --frame", "import", self.dir / "open.stl",
                   "-o", self.dir / "two.h5", *both)
        turned = self.imported("open.stl", "two.h5", "--frame", "LPS", *both)
        rows = {row["name"]: row["values"] for row in turned["findings"]}
        self.assertEqual(rows["papillary_tips"], found["papillary_tips"])

    def test_bad_input_is_refused_with_a_sentence_and_leaves_files_alone(self):
        out = self.dir / "kept.h5"
        out.write_bytes(b"kept")
        self.fails(1, "mm", "import", self.dir / "open.stl", "-o", out, "--unit", "m")
        self.fails(1, "cannot", "import", self.dir / "missing.stl", "-o", out)
        for name, way in (("open.nii.gz", "mvs-image"), ("valve.inp", "mvs close")):
            (self.dir / name).write_bytes(b"")
            self.fails(2, way, "import", self.dir / name, "-o", out)
        (self.dir / "cut.stl").write_bytes((self.dir / "open.stl").read_bytes()[:-7])
        self.fails(1, "cut.stl", "import", self.dir / "cut.stl", "-o", out)
        far = [(0.5 + x, y, z) for x, y, z in self.points[:2]]
        write_markups(self.dir / "far.mrk.json", far, "LPS")
        self.fails(1, "LPS or RAS", "import", self.dir / "open.stl", "-o", out,
                   "--commissures", self.dir / "far.mrk.json")
        (self.dir / "other.json").write_text("{}")
        self.fails(1, "mvs import", "import", self.dir / "open.stl", "-o", out,
                   "--with", self.dir / "other.json")
        (self.dir / "other.json").write_text(json.dumps({"format": "libmvs import", "version": 1, "findings": [
            {"name": "papilary_tips", "source": "given", "values": [0.01, 0.0, -0.02]}]}))
        self.fails(1, '"papilary_tips" is no input of a build; inputs are annulus, commissures', "import",
                   self.dir / "open.stl", "-o", out, "--with", self.dir / "other.json")
        self.fails(2, "--kind", "import", self.dir / "open.stl", "-o", out, "--kind", "outer")
        self.assertEqual(out.read_bytes(), b"kept")
        self.assertFalse((self.dir / "kept.import.json").exists())


if __name__ == "__main__":
    unittest.main()
