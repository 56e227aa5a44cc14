"""The command `mvs` for scripts: its output on stdout and stderr, its files, its exit codes."""
import json
import math
import re
import unittest

from command import Command, mvs

# Keys of the JSON object of `close`, on which scripts rely.
CLOSE_KEYS = {"converged", "iterations", "wall_s", "residual_N", "vertices", "faces", "chords",
              "intersections", "measures"}
MEASURES_KEYS = {
    "regurgitant_orifice_area_mm2", "coaptation_area_mm2", "coaptation_length_mean_mm",
    "coaptation_length_max_mm", "tenting_height_mm", "billow_height_mm", "annulus_ap_mm",
    "annulus_cc_mm", "annulus_area_mm2", "max_chord_strain", "max_leaflet_strain"}


class Json(Command):
    def test_every_command_prints_one_object_and_nothing_else(self):
        for line in (["generate", "--shape", "founding", "-o", "w.obj"], ["info", "v.obj"], ["measure", "v.obj"],
                     ["compare", "v.obj", "closed.obj"], ["convert", "v.obj", "-o", "w.vtp"]):
            done = self.ok(*line, "--json")
            self.assertIsInstance(json.loads(done.stdout), dict, line)
            self.assertEqual(done.stderr, "", line)

    def test_close_prints_every_documented_key(self):
        self.assertLessEqual(CLOSE_KEYS, set(self.closed))
        self.assertLessEqual(MEASURES_KEYS, set(self.closed["measures"]))

    def test_a_failure_is_an_object(self):
        error = json.loads(self.fails("close", "nowhere.obj", "--json").stdout)["error"]
        self.assertEqual(set(error), {"code", "message", "part", "line"})
        self.assertEqual(error["code"], "MVS_E_IO")
        self.assertIn("nowhere.obj", error["message"])

    def test_progress_goes_to_stderr(self):
        done = self.ok("close", "v.obj", "--json", "--progress")
        json.loads(done.stdout)
        self.assertRegex(done.stderr, r"out-of-balance")


class Info(Command):
    def test_parts_add_up(self):
        info = self.json("info", "v.obj")
        for kind in "leaflets", "scallops":
            self.assertEqual(sum(part["faces"] for part in info[kind]), info["faces"])
        self.assertEqual(sum(kind["count"] for kind in info["chord_kinds"]), info["chords"])
        self.assertEqual([part["name"] for part in info["leaflets"]], ["A", "P"])
        self.assertTrue(math.isclose(info["boundary_fraction"], 0))

    def test_tissue_is_that_of_the_file(self):
        self.ok("generate", "-o", "neo.obj", "--leaflet", "neo_hookean", "--thickness", "1.2")
        text = (self.dir / "neo.obj").read_text(encoding="ascii")
        mu = float(re.search(r"law=neo_hookean.* mu=(\S+)", text)[1])
        for row in self.json("info", "neo.obj")["tissue"]:
            self.assertEqual(row["law"], "neo_hookean")
            self.assertEqual(row["constants"], {"mu": mu, "bending": 112e3})
            self.assertEqual(row["units"], {"mu": "Pa", "bending": "Pa"})
            self.assertAlmostEqual(row["thickness_min_mm"], 1.2)
            self.assertAlmostEqual(row["thickness_max_mm"], 1.2)
        self.assertIn("neo_hookean, mu 200000 Pa, bending 112000 Pa, 1.20 mm thick", self.ok("info", "neo.obj").stdout)


class BadInput(Command):
    def bad(self, name, content):
        (self.dir / name).write_bytes(content)
        done = self.fails("close", name, "-o", "never.obj")
        self.assertIn(name, done.stderr)
        return done.stderr

    def test_each_is_refused_with_the_file_and_the_line(self):
        good = (self.dir / "v.obj").read_bytes()
        first_vertex = re.search(rb"^v .*$", good, re.M).group(0)
        first_face = re.search(rb"^f .*$", good, re.M).group(0)
        cases = {
            "truncated.obj": good[: len(good) // 2],
            "empty.obj": b"",
            "noise.obj": bytes(range(256)) * 40,
            "nan.obj": good.replace(first_vertex, b"v nan 0 0", 1),
            "huge.obj": good.replace(first_vertex, b"v 1e300 0 0", 1),
            "nowhere.obj": good.replace(first_face, b"f 1 2 999999", 1),
            "degenerate.obj": good.replace(first_face, b"f 1 1 2", 1),
            "torn.obj": good.replace(first_face + b"\n", b"", 1),
        }
        for name, content in cases.items():
            with self.subTest(name):
                self.bad(name, content)

    def test_a_part_that_the_checks_of_a_valve_refuse_is_named_by_its_line(self):
        good = (self.dir / "v.obj").read_bytes().splitlines()
        line = next(i for i, text in enumerate(good) if text.startswith(b"#mvs chord "))
        good[line] = re.sub(rb" young=\S+", b"", good[line]) + b" young=1e-3"
        self.assertRegex(self.bad("soft.obj", b"\n".join(good)), rf"soft\.obj:{line + 1}: chord \S+ has Young")

    def test_line_is_in_the_message(self):
        good = (self.dir / "v.obj").read_bytes().splitlines()
        line = next(i for i, text in enumerate(good) if text.startswith(b"v "))
        good[line] = b"v 1 2 three"
        self.assertIn(f"three.obj:{line + 1}: ", self.bad("three.obj", b"\n".join(good)))

    def test_a_folder_is_not_a_valve(self):
        (self.dir / "folder.obj").mkdir()
        self.assertNotEqual(self.misused("info", "."), "")
        self.assertEqual(mvs("info", "folder.obj", cwd=self.dir).returncode, 1)
        (self.dir / "folder.obj").rmdir()


class Usage(Command):
    def test_unknown_words_of_an_option_list_the_known_ones(self):
        self.assertIn("spring", self.misused("close", "v.obj", "--leaflet", "rubber"))

    def test_a_pressure_in_pa_is_refused(self):
        for pressure in (15998.64, -20000, "inf", "nan"):
            for line in (["close", "v.obj", f"--pressure={pressure}"],
                         ["op", "v.obj", "annulus-scale", "--factor=1", f"--settle={pressure}"]):
                self.assertIn("pressures are in mmHg", self.misused(*line))
        for line in (["close", "--help"], ["op", "v.obj", "ring", "--help"]):
            self.assertRegex(self.ok(*line).stdout, r"--(pressure|settle) MMHG +\S")

    def test_only_backends_of_this_build_are_offered(self):
        shown = re.search(r"--backend \S+ in \{([^}]*)\}|--backend[^{]*\{([^}]*)\}",
                          self.ok("close", "--help").stdout)
        offered = (shown.group(1) or shown.group(2)).split(", ")
        self.assertLessEqual({"default", "eigen", "block"}, set(offered))
        self.assertEqual("cholmod" in offered, "cholmod" in self.ok("--version").stdout)
        for backend in offered:
            done = self.json("close", "v.obj", "--backend", backend)
            self.assertTrue(done["converged"], backend)
        if "cholmod" not in offered:
            self.assertIn("-DMVS_CHOLMOD=ON", self.misused("close", "v.obj", "--backend",
                                                           "cholmod"))

    def test_unknown_words_are_usage_errors(self):
        for line in ([], ["fly"], ["close"], ["close", "v.obj", "--solver", "magic"],
                     ["close", "v.obj", "--pressure", "high"], ["generate"],
                     ["generate", "--shape", "founding", "-o", "x.obj", "--annulus-ap", "-3"],
                     ["generate", "--shape", "founding", "-o", "x.obj", "--chord-factor", "P2/1"],
                     ["compare", "v.obj"], ["convert", "v.obj"]):
            with self.subTest(line):
                self.assertNotEqual(self.misused(*line), "")

    def test_help_and_version_succeed(self):
        self.assertIn("close", self.ok("--help").stdout)
        self.assertRegex(self.ok("--version").stdout, r"^libmvs \d+\.\d+\.\d+ ")


if __name__ == "__main__":
    unittest.main()
