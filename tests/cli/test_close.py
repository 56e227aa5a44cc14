"""`mvs close` and `mvs measure`: rest, leaks, grades, files, equal bits."""
import json
import unittest

from command import Command, mvs


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

    def test_a_valve_whose_leaflets_cross_is_not_said_to_be_sealed(self):
        self.ok("generate", "-o", "membrane.obj")
        done = mvs("close", "membrane.obj", "--solver", "explicit", "-o", "crossing.obj", cwd=self.dir)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"^membrane\.obj: at rest, leaflets CROSS, under 120 mmHg")
        self.assertIn("(no grade: the leaflets cross)", done.stdout)
        self.assertRegex(done.stderr, r"the leaflets of membrane\.obj cross \(\d+ pairs of triangles\)")
        self.assertIn("(no grade: the leaflets cross)",
                      self.ok("measure", "crossing.obj", "--only", "orifice").stdout)
        leak = self.ok("leak", "crossing.obj").stdout.splitlines()[0]
        self.assertIn("the leaflets cross", leak)
        self.assertNotIn("sealed", done.stdout + leak)

    def test_numbers_that_are_none_are_named_in_short(self):
        said = self.misused("close", "v.obj", "--pressure", "nan")
        self.assertEqual(said.splitlines()[0],
                         "--pressure: nan is no number: pressures are in mmHg, 120 in systole")
        for given in ("inf", "nan", 0, -1):
            said = self.misused("close", "v.obj", "--dt", given)
            self.assertEqual(said.splitlines()[0], f"--dt: a number above 0 is needed, not {given}")

    def test_a_time_step_of_newton_is_refused(self):
        said = self.misused("close", "v.obj", "--dt", 1e-3)
        self.assertEqual(said.splitlines()[0],
                         "--dt: newton has no time steps: give --solver implicit or explicit")

    def test_a_pressure_in_kpa_is_warned_of_in_mmhg(self):
        said = self.ok("close", "v.obj", "--pressure", 0.12).stderr
        self.assertIn("mvs: a pressure of 0.12 mmHg is unusual: pressures are in mmHg", said)
        self.assertNotIn(" Pa", said)

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

    def test_a_warning_of_the_mesh_is_said_once(self):
        self.ok("generate", "-o", "fine.obj", "--vertices", 1100)
        done = self.ok("close", "fine.obj", "--leaflet", "neo_hookean")  # loads the valve, then changes two leaflets
        self.assertEqual(done.stderr.count("edges are shorter than the contact thickness"), 1)

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


if __name__ == "__main__":
    unittest.main()
