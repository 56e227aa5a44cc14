"""`mvs sweep`: combinations of operations as a table."""
import csv
import itertools
import json
import math
import pathlib
import resource
import signal
import subprocess
import time

from command import MVS, Shell, mvs

ORIFICE = "regurgitant_orifice_area_mm2"
# Six combinations of a small valve: one chord and the annulus.
GRID = ["--op", "annulus-scale factor=1.3:0.9:-0.2",
        "--op", "chord-length chord=P2/1 factor=0.80,1.20"]
LONG = ["sweep", "large.obj", "--op", "annulus-scale factor=1.3:1.0:-0.05", "--csv"]


class Sweep(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "v.obj", "--vertices", 200)
        cls.printed = cls.json("sweep", "v.obj", *GRID, "--csv", "all.csv", "--jobs", 1, "--sort",
                               ORIFICE)

    def rows(self, name):
        with open(self.dir / name, newline="") as file:
            return list(csv.DictReader(file))

    def bytes(self, name):
        return (self.dir / name).read_bytes()

    def test_every_combination_is_a_row_in_order(self):
        rows = self.rows("all.csv")
        self.assertEqual(
            [(row["annulus_scale_factor"], row["chord_length_chord"], row["chord_length_factor"])
             for row in rows],
            [(scale, "P2/1", factor) for scale, factor in
             itertools.product(("1.3", "1.1", "0.9"), ("0.8", "1.2"))])
        self.assertEqual((self.printed["combinations"], self.printed["closed_now"]), (6, 6))
        for row in rows:
            self.assertEqual((row["converged"], row["error"], row["pressure_mmHg"]),
                             ("true", "", "120.0"))
            self.assertEqual((row["at_rest"], row["under_load"]), ("true", "true"))
        self.assertIs(self.printed["best"][0]["converged"], True)

    def test_a_row_is_what_op_and_close_give(self):
        self.ok("close", "v.obj", "-o", "c.obj")
        self.ok("op", "c.obj", "annulus-scale", "--factor", 1.1, "-o", "d.obj")
        self.ok("op", "d.obj", "chord-length", "--chord", "P2/1", "--factor", 0.8, "-o", "e.obj")
        closed = self.json("close", "e.obj")
        row = self.rows("all.csv")[2]
        self.assertEqual(float(row["residual_N"]), closed["residual_N"])
        for key, value in closed["measures"].items():
            self.assertEqual(json.loads(row[key]) if row[key] else None, value, key)

    def test_the_table_is_the_same_for_any_number_of_processes(self):
        self.ok("sweep", "v.obj", *GRID, "--csv", "three.csv", "--jobs", 3)
        self.assertEqual(self.bytes("three.csv"), self.bytes("all.csv"))

    def test_a_stopped_sweep_continues_where_it_was(self):
        lines = self.bytes("all.csv").splitlines(keepends=True)
        # two rows, out of order, and the beginning of a third
        (self.dir / "part.csv").write_bytes(lines[0] + lines[5] + lines[2] + lines[1][:20])
        printed = self.json("sweep", "v.obj", *GRID, "--csv", "part.csv")
        self.assertEqual((printed["combinations"], printed["closed_now"]), (6, 4))
        self.assertEqual(self.bytes("part.csv"), self.bytes("all.csv"))
        again = self.json("sweep", "v.obj", *GRID, "--csv", "part.csv")
        self.assertEqual(again["closed_now"], 0)
        self.assertEqual(self.bytes("part.csv"), self.bytes("all.csv"))
        self.assertEqual({path.name for path in self.dir.glob("*.new")}, set())

    def test_best_rows_are_sorted_by_the_measure(self):
        best = self.printed["best"]
        self.assertEqual(len(best), 6)
        values = [row[ORIFICE] for row in best]
        self.assertEqual(values, sorted(values))
        largest = self.json("sweep", "v.obj", *GRID, "--csv", "all.csv", "--sort", "annulus_ap_mm",
                            "--largest")["best"]
        self.assertEqual(largest[0]["annulus_scale_factor"], 1.3)
        table = self.ok("sweep", "v.obj", *GRID, "--csv", "all.csv", "--sort", ORIFICE).stdout
        self.assertIn(f"{ORIFICE}, smallest first", table)
        self.assertEqual(table.count("annulus_scale_factor="), 6)

    def test_an_impossible_combination_is_a_row_with_the_reason(self):
        printed = self.json("sweep", "v.obj", "--op", "chord-remove chord=P2/1,P9/1", "--csv",
                            "some.csv", "--sort", ORIFICE)
        self.assertEqual((printed["failed"], len(printed["best"])), (1, 1))
        good, bad = self.rows("some.csv")
        self.assertTrue(math.isfinite(float(good[ORIFICE])))
        self.assertIn('no chord named "P9/1"', bad["error"])
        self.assertEqual((bad["converged"], bad[ORIFICE]), ("", ""))
        done = mvs("sweep", "v.obj", "--op", "chord-remove chord=P9/1", "--csv", "none.csv",
                   cwd=self.dir)
        self.assertEqual(done.returncode, 1)
        self.assertIn('no chord named "P9/1"', done.stderr)

    def test_a_table_without_a_combination_at_rest_is_a_failure(self):
        lines = self.bytes("all.csv").decode().splitlines(keepends=True)
        for rows, code in ((lines[1:], 0), (lines[1:6], 0), ([], 1)):
            moving = [line.replace(",true,", ",false,", 1) for line in lines[1 + len(rows):]]
            (self.dir / "rest.csv").write_text("".join([lines[0], *rows, *moving]))
            done = mvs("sweep", "v.obj", *GRID, "--csv", "rest.csv", cwd=self.dir)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual("no combination is at rest" in done.stderr, code == 1)
            self.assertEqual(f"{len(moving)} are not at rest" in done.stdout, len(moving) > 0)

    def test_rows_of_a_file_with_other_contents_are_refused(self):
        def curve(width):
            points = [(0.37 * width * math.cos(a), 0.5 * width * math.sin(a), 0)
                      for a in (2 * math.pi * k / 60 for k in range(60))]
            (self.dir / "curve.txt").write_text("".join("%g,%g,%g\n" % p for p in points))

        sweep = ("sweep", "v.obj", "--op", "ring curve=curve.txt", "--csv", "curve.csv")
        curve(32)
        first = self.json(*sweep)
        self.assertEqual((first["closed_now"], self.json(*sweep)["closed_now"]), (1, 0))
        self.assertRegex(self.rows("curve.csv")[0]["files"], "^[0-9a-f]{16}$")
        before = self.bytes("curve.csv")
        curve(30)
        done = mvs(*sweep, cwd=self.dir)
        self.assertEqual(done.returncode, 1)
        self.assertIn("files with other contents", done.stderr)
        self.assertEqual(self.bytes("curve.csv"), before)
        # a table of a version before has no column of the contents
        row = self.rows("curve.csv")[0]
        del row["files"]
        (self.dir / "curve.csv").write_text(",".join(row) + "\n")
        done = mvs(*sweep, cwd=self.dir)
        self.assertIn('other columns than this sweep, no "files": give', done.stderr)

    def test_the_table_of_another_sweep_is_not_touched(self):
        before = self.bytes("all.csv")
        for words, line in (("other columns", ["--op", "annulus-scale factor=1.1"]),
                            ("another valve or pressure", [*GRID, "--pressure", 80])):
            done = mvs("sweep", "v.obj", *line, "--csv", "all.csv", cwd=self.dir)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, f"all.csv: .*{words}")
            self.assertEqual(self.bytes("all.csv"), before)
        (self.dir / "notes").write_text("no table, and no line")
        for name in ("notes", "v.obj", "."):
            done = mvs("sweep", "v.obj", *GRID, "--csv", name, cwd=self.dir)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("the name of", done.stderr)
        self.assertEqual(self.bytes("notes"), b"no table, and no line")

    def test_a_row_may_be_longer_than_a_pipe_takes_at_once(self):
        (self.dir / "long.txt").write_text("".join(
            "%g,%g,0\n" % (12 * math.cos(k / 10), 16 * math.sin(k / 10)) for k in range(60)))
        path = "./" * 2030 + "long.txt"
        line = ("sweep", "v.obj", "--op", "annulus-scale factor=1.0,1.1,1.2", "--op", f"ring curve={path}",
                "--jobs", 3)
        printed = self.json(*line, "--csv", "long.csv")
        self.assertEqual((printed["combinations"], printed["failed"]), (3, 0))
        self.assertEqual([row["ring_curve_mm"] for row in self.rows("long.csv")], 3 * [path])
        self.assertGreater(len(self.bytes("long.csv").splitlines()[1]), 4096)

    def test_a_measure_that_needs_cost_is_refused_before_a_table_is_written(self):
        line = ("sweep", "nothing.obj", *GRID, "--csv", "early.csv", "--sort", "open_area_mm2")
        done = mvs(*line, cwd=self.dir)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("open_area_mm2 is measured with --cost only", done.stderr)
        self.assertFalse((self.dir / "early.csv").exists())

    def test_a_combination_without_memory_has_no_row_and_is_closed_by_the_next_run(self):
        self.ok("generate", "--shape", "founding", "-o", "large.obj", "--vertices", 800)
        line = ["sweep", "large.obj", "--op", "annulus-scale factor=1.3:1.0:-0.05", "--csv", "memory.csv"]
        with subprocess.Popen([MVS, *line, "--jobs", "1"], cwd=self.dir, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as running:
            children = pathlib.Path(f"/proc/{running.pid}/task/{running.pid}/children")
            while running.poll() is None:
                if process := children.read_text().split():
                    resource.prlimit(int(process[0]), resource.RLIMIT_AS, (2**20, 2**20))
                    break
                time.sleep(0.002)
            stderr = running.communicate()[1]
        self.assertEqual(running.returncode, 1, stderr)
        self.assertIn("run the same command again to continue", stderr)
        done = self.rows("memory.csv")
        self.assertLess(len(done), 7)
        self.assertEqual({row["error"] for row in done} | {""}, {""})
        again = self.json(*line)
        self.assertEqual((again["closed_now"], again["failed"]), (7 - len(done), 0))

    def started(self, csv):
        """A long sweep that has begun its first combinations, and the ids of its processes."""
        self.ok("generate", "--shape", "founding", "-o", "large.obj", "--vertices", 800)
        running = subprocess.Popen([MVS, *LONG, csv, "--jobs", "2"], cwd=self.dir, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        children = pathlib.Path(f"/proc/{running.pid}/task/{running.pid}/children")
        while running.poll() is None:
            if len(processes := children.read_text().split()) == 2:
                return running, [pathlib.Path("/proc") / process for process in processes]
            time.sleep(0.002)
        self.fail(running.communicate()[1])

    def test_a_second_sweep_into_a_table_is_refused_until_the_first_ends(self):
        running, _ = self.started("shared.csv")
        running.send_signal(signal.SIGSTOP)
        try:
            (self.dir / "link.csv").symlink_to("shared.csv")
            for name in ("shared.csv", "link.csv"):
                done = mvs(*LONG, name, cwd=self.dir)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(f"{name}: another sweep writes to it", done.stderr)
        finally:
            running.kill()
            running.communicate()
        self.ok(*LONG, "shared.csv")
        self.assertEqual(len(self.rows("shared.csv")), 7)

    def test_an_interrupt_of_its_own_process_stops_all(self):
        running, children = self.started("stopped.csv")
        with running:
            running.send_signal(signal.SIGINT)
            stderr = running.communicate(timeout=60)[1]
        self.assertEqual(running.returncode, 1, stderr)
        self.assertIn("stopped by Ctrl-C: run the same command again to continue", stderr)
        self.assertLess(len(self.rows("stopped.csv")), 7)
        self.assertFalse(any(child.exists() for child in children))

    def test_names_that_look_like_numbers_stay_text(self):
        valve = (self.dir / "v.obj").read_text()
        for name in ("007", "12"):
            (self.dir / "named.obj").write_text(valve.replace("name=P2/1 ", f"name={name} "))
            best = self.json("sweep", "named.obj", "--op", f"chord-length chord={name} factor=1.2", "--csv",
                             f"{name}.csv", "--sort", ORIFICE)["best"][0]
            self.assertEqual((best["chord_length_chord"], best["chord_length_factor"]), (name, 1.2))
            self.assertEqual((best["pressure_mmHg"], best["converged"], best["error"]), (120, True, None))

    def test_rows_that_cannot_be_applied_are_counted_and_not_warned_of(self):
        done = mvs("sweep", "v.obj", "--op", "chord-remove chord=P2/1,P9/1", "--csv", "counted.csv", cwd=self.dir)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("1 cannot be applied: see the column error", done.stdout)
        self.assertNotIn("warning", mvs("sweep", "--help", cwd=self.dir).stdout)

    def test_wrong_grids_are_usage_errors(self):
        for words, op in (("choose from: chord_length", "fly"),
                          ("choose from: chord, length", "chord-length colour=2"),
                          ("needs chord=CHORD", "chord-length factor=2"),
                          ("not a number", "annulus-scale factor=big"),
                          ("in at most", "annulus-scale factor=1:2:-0.1"),
                          ("FIRST:LAST:STEP", "annulus-scale factor=1:2"),
                          ("given twice", "annulus-scale factor=1,1.0"),
                          ("FIELD=VALUES", "annulus-scale 1.2"),
                          ("more than", "annulus-scale ap=0.5:1.5:0.0015 cc=0.5:1.5:0.0015")):
            with self.subTest(op):
                done = mvs("sweep", "v.obj", "--op", op, "--csv", "wrong.csv", cwd=self.dir)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(words, done.stderr)
        self.assertFalse((self.dir / "wrong.csv").exists())


if __name__ == "__main__":
    import unittest
    unittest.main()
