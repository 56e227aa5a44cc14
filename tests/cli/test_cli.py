"""The command `mvs` for scripts: its output on stdout and stderr, its files, its exit codes."""
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

MVS = os.environ["MVS_COMMAND"]

# Keys of the JSON object of `close`, on which scripts rely.
CLOSE_KEYS = {"converged", "iterations", "wall_s", "residual_N", "vertices", "faces", "chords",
              "intersections", "measures"}
MEASURES_KEYS = {
    "regurgitant_orifice_area_mm2", "coaptation_area_mm2", "coaptation_length_mean_mm",
    "coaptation_length_max_mm", "tenting_height_mm", "billow_height_mm", "annulus_ap_mm",
    "annulus_cc_mm", "annulus_area_mm2", "max_chord_strain", "max_leaflet_strain"}


def mvs(*arguments, cwd):
    return subprocess.run([MVS, *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
                          timeout=300)


class Shell(unittest.TestCase):
    """Runs commands in a temporary folder."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.dir = pathlib.Path(cls.folder.name)

    @classmethod
    def ok(cls, *arguments):
        done = mvs(*arguments, cwd=cls.dir)
        assert done.returncode == 0, done.stderr
        return done

    @classmethod
    def json(cls, *arguments):
        return json.loads(cls.ok(*arguments, "--json").stdout)


class Command(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "v.obj")
        cls.closed = cls.json("close", "v.obj", "-o", "closed.obj")

    def fails(self, *arguments):
        """Runs a command that must fail and leave the folder unchanged."""
        before = {p.name: p.read_bytes() for p in self.dir.iterdir()}
        done = mvs(*arguments, cwd=self.dir)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual({p.name: p.read_bytes() for p in self.dir.iterdir()}, before)
        return done

    def misused(self, *arguments):
        done = mvs(*arguments, cwd=self.dir)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr


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


class Close(Command):
    def test_shipped_valve_is_sealed(self):
        self.assertTrue(self.closed["converged"])
        self.assertEqual(self.closed["intersections"], 0)
        self.assertEqual(self.closed["measures"]["regurgitant_orifice_area_mm2"], 0)

    def test_dilated_annulus_leaks(self):
        # annulus dilated by 15 %, one strut chord longer by 25 %
        self.ok("generate", "--shape", "founding", "-o", "dilated.obj", "--annulus-scale", 1.15,
                "--chord-factor", "A2/7=1.25")
        leaking = self.json("close", "dilated.obj")
        self.assertTrue(leaking["converged"])
        self.assertEqual(leaking["intersections"], 0)
        # the requirement for this lesion
        self.assertGreater(leaking["measures"]["regurgitant_orifice_area_mm2"], 10)

    def test_residual_is_below_the_requested_one(self):
        self.assertLessEqual(self.json("close", "v.obj", "--residual", 1e-3)["residual_N"], 1e-3)

    def test_workers_change_no_bit_of_the_result(self):
        self.ok("close", "v.obj", "-o", "alone.obj")
        self.ok("close", "v.obj", "-o", "shared.obj", "--workers", 2)
        alone, shared = ((self.dir / name).read_bytes() for name in ("alone.obj", "shared.obj"))
        self.assertEqual(alone, shared)
        self.assertIn("--workers", self.misused("close", "v.obj", "--workers", 0))

    def test_a_valve_that_is_not_at_rest_is_written_marked_and_ends_with_1(self):
        early = ["close", "v.obj", "--json", "--max-iterations", 2, "-o", "early.obj"]
        done = mvs(*early, cwd=self.dir)
        self.assertEqual(done.returncode, 1)
        self.assertFalse(json.loads(done.stdout)["converged"])
        self.assertIn("not converged", done.stderr)
        found = self.json("measure", "early.obj")["measures"]
        self.assertEqual((found["at_rest"], found["under_load"]), (False, True))
        self.assertIn("(no grade: not at rest)", self.ok("measure", "early.obj").stdout)
        self.ok(*early, "--allow-unsettled")

    def test_measure_prints_only_the_groups_asked_for(self):
        whole = self.json("measure", "closed.obj")
        some = self.json("measure", "closed.obj", "--only", "orifice,coaptation")
        keys = {key for key in whole["measures"] if key.startswith(("coaptation", "regurgitant"))}
        self.assertEqual(set(some["measures"]), keys | {"at_rest", "under_load"})
        self.assertTrue(all(some["measures"][key] == whole["measures"][key] for key in keys))
        self.assertNotIn("intersections", some)
        self.assertEqual(self.json("measure", "closed.obj", "--only", "crossings")["intersections"], 0)
        shown = self.ok("measure", "closed.obj", "--only", "annulus").stdout
        self.assertIn("Annulus AP diameter", shown)
        self.assertNotIn("sealed", shown)
        self.assertIn("'leaks' is unknown; choose from: crossings, orifice,",
                      self.misused("measure", "closed.obj", "--only", "annulus,leaks"))

    def test_only_a_valve_at_rest_under_load_is_graded(self):
        self.assertIn("(no grade: no load)", self.ok("measure", "v.obj").stdout)
        self.assertIn("(sealed)", self.ok("measure", "closed.obj").stdout)
        self.ok("op", "closed.obj", "ring", "--size", 30, "-o", "ringed.obj")
        self.assertIn("(no grade: not at rest)", self.ok("measure", "ringed.obj").stdout)

    def test_tissue_that_cannot_bear_the_pressure_is_named(self):
        done = self.fails("close", "v.obj", "--leaflet", "neo_hookean", "--pressure", 1500)
        self.assertIn("yields without end", done.stderr)
        self.ok("close", "v.obj", "--leaflet", "neo_hookean")

    def test_same_command_gives_the_same_bits(self):
        self.assertEqual(self.json("close", "v.obj")["hash"], self.closed["hash"])

    def test_measure_of_the_written_file_is_that_of_close(self):
        written = self.json("measure", "closed.obj")
        self.assertEqual(written["measures"], self.closed["measures"])
        self.assertEqual(written["pressure_mmHg"], 120)

    def test_without_pressure_the_leaflets_stay_apart(self):
        still = self.json("close", "v.obj", "--pressure", 0)
        self.assertLess(still["measures"]["max_leaflet_strain"],
                        self.closed["measures"]["max_leaflet_strain"])


class Generate(Command):
    def test_defaults_in_the_help_are_those_of_the_library(self):
        help_text = self.ok("generate", "--help").stdout
        defaults = re.findall(r"^\s+(--[\w-]+)[^\n\[]*(?:\n\s+[^\n\[-]*)?"
                              r"\[([\d.]+)(?:; +founding\s+([\d.]+))?\]", help_text, re.M)
        self.assertEqual(len(defaults), 16)
        healthy = [word for option, value, _ in defaults for word in (option, value)]
        founding = [word for option, value, other in defaults for word in (option, other or value)]
        self.assertEqual(self.json("generate", "-o", "explicit.obj", *healthy)["hash"],
                         self.json("generate", "-o", "default.obj")["hash"])
        self.assertEqual(
            self.json("generate", "--shape", "founding", "-o", "explicit.obj", *founding)["hash"],
            self.json("info", "v.obj")["hash"])

    def test_the_membrane_is_the_tissue_of_the_default_valve(self):
        def tissue(*words):
            self.json("generate", "-o", "tissue.obj", "--vertices", 200, *words)
            return self.json("close", "tissue.obj", "--pressure", 0)["leaflet"]
        self.assertEqual(tissue(), "bilinear")
        self.assertEqual(tissue("--leaflet", "membrane"), "bilinear")
        self.assertEqual(tissue("--leaflet", "spring"), "spring")
        self.assertEqual(tissue("--shape", "founding"), "spring")
        self.assertEqual(tissue("--shape", "founding", "--leaflet", "fung"), "fung")

    def test_a_factor_of_one_on_a_chord_changes_no_bit(self):
        name = "P2/1"
        same = self.json("generate", "--shape", "founding", "-o", "same.obj", "--chord-factor", name + "=1")
        self.assertEqual(same["hash"], self.json("info", "v.obj")["hash"])

    def test_a_longer_chord_is_the_only_difference(self):
        def lines(file):
            return (self.dir / file).read_text().splitlines()
        self.ok("generate", "--shape", "founding", "-o", "longer.obj", "--chord-factor", "P2/1=1.25")
        changed = [(a, b) for a, b in zip(lines("v.obj"), lines("longer.obj")) if a != b]
        self.assertEqual(len(lines("v.obj")), len(lines("longer.obj")))
        self.assertEqual(len(changed), 1, changed)

    def test_dimensions_reach_the_valve(self):
        self.ok("generate", "--shape", "founding", "-o", "big.obj", "--annulus-ap", 30, "--annulus-cc", 38,
                "--vertices", 1000)
        info = self.json("info", "big.obj")
        # 1000 is approximate: the mesh has whole rows and columns
        self.assertTrue(800 < info["vertices"] < 1200, info["vertices"])
        # the annulus is a polygon in a smooth curve: under 1 % shorter at this size
        self.assertAlmostEqual(info["annulus_ap_mm"], 30, delta=0.3)
        self.assertAlmostEqual(info["annulus_cc_mm"], 38, delta=0.38)

    def test_an_impossible_valve_is_refused_with_its_range(self):
        self.assertIn("annulus_ap", self.fails("generate", "--shape", "founding", "-o", "x.obj", "--annulus-ap",
                                               500).stderr)

    def test_an_unknown_chord_is_refused_by_name(self):
        self.assertIn("P9/1", self.fails("generate", "--shape", "founding", "-o", "x.obj", "--chord-factor",
                                         "P9/1=2").stderr)

    def test_a_missing_folder_is_reported(self):
        self.assertIn("no/such", self.fails("generate", "--shape", "founding", "-o", "no/such/folder/v.obj").stderr)


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
            self.assertEqual(row["constants"], {"mu": mu})
            self.assertEqual(row["units"], {"mu": "Pa"})
            self.assertAlmostEqual(row["thickness_min_mm"], 1.2)
            self.assertAlmostEqual(row["thickness_max_mm"], 1.2)
        self.assertIn("neo_hookean, mu 200000 Pa, 1.20 mm thick", self.ok("info", "neo.obj").stdout)


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

    def test_line_is_in_the_message(self):
        good = (self.dir / "v.obj").read_bytes().splitlines()
        line = next(i for i, text in enumerate(good) if text.startswith(b"v "))
        good[line] = b"v 1 2 three"
        self.assertIn(f"three.obj:{line + 1}: ", self.bad("three.obj", b"\n".join(good)))

    def test_a_folder_is_not_a_valve(self):
        self.assertNotEqual(self.fails("info", ".").stderr, "")


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
