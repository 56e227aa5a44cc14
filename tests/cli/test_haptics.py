"""`mvs haptics` without hardware: drivers, checks, tests and recordings."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from test_cli import MVS, Shell, mvs

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRASP = ROOT / "haptic_drivers/replay/trajectories/grasp_a2.txt"
REPLAY = ["--driver", "replay", "--virtual", "--option"]
LIARS = pathlib.Path(os.environ.get("MVS_LIARS_DIR", ""))
# simulated hand at rest in the middle of a Touch
HAND = ["--driver", "hand", "--virtual"]


def samples(path):
    """The rows of a recording as numbers."""
    lines = pathlib.Path(path).read_text().splitlines()
    assert lines[0] == "mvs-recording 1"
    rows = [line.split() for line in lines[1:] if line[:1].isdigit() or line[:1] == "-"]
    return [[float(word) for word in row] for row in rows]


class Haptics(Shell):
    def fails(self, *arguments, code=1):
        done = mvs("haptics", *arguments, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr


class List(Haptics):
    def test_drivers_are_named_with_their_files(self):
        drivers = {row["name"]: row for row in self.json("haptics", "list")["drivers"]}
        self.assertLessEqual({"template", "replay", "hand"}, set(drivers))
        for row in drivers.values():
            self.assertTrue(pathlib.Path(row["path"]).is_file(), row)
        self.assertEqual(drivers["template"]["devices"][0]["name"], "desk")
        self.assertIn("desk", self.ok("haptics", "list").stdout)

    def test_options_lead_to_devices(self):
        (row,) = self.json("haptics", "list", "--driver", "replay",
                           "--option", f"file={GRASP}")["drivers"]
        self.assertEqual(row["devices"], [{"name": str(GRASP), "model": "Touch"}])

    def test_a_driver_that_fails_to_load_is_reported(self):
        self.assertIn("mvs haptics list", self.fails("list", "--driver", "nowhere"))
        (self.dir / "junk.so").write_text("no library")
        self.assertIn("cannot be loaded", self.fails("list", "--driver", "./junk.so"))
        self.assertIn("no option", self.fails("list", "--driver", "replay", "--option", "x=1"))
        self.fails("list", "--option", "x=1", code=2)
        self.fails("list", "--driver", "replay", "--option", "x", code=2)


class Doctor(Haptics):
    def test_system_and_driver_are_examined(self):
        printed = self.json("haptics", "doctor", "--driver", "replay", "--option", f"file={GRASP}")
        self.assertEqual(printed["faults"], 0)
        checks = {(row["about"], row["check"]): row for row in printed["findings"]}
        self.assertIn("libmvs", checks["system", "library"]["sentence"])
        self.assertIn("samples", checks["replay", "recording"]["sentence"])
        priority = checks["system", "real-time priority"]
        if priority["verdict"] == "warning" and "container" not in priority["sentence"]:
            self.assertIn("/etc/security/limits.d", priority["sentence"])

    def test_missing_realtime_permission_is_a_warning(self):
        # root is allowed despite the limit
        if os.geteuid() == 0 and not shutil.which("capsh"):
            self.skipTest("root, and no capsh to drop the right")
        limit = "ulimit -r 0 && "
        command = f"{limit}{MVS} haptics doctor --driver template --json"
        line = ["sh", "-c", command]
        if os.geteuid() == 0:
            line = ["capsh", "--drop=cap_sys_nice", "--", "-c", command]
        done = subprocess.run(line, capture_output=True, text=True, timeout=60)
        printed = json.loads(done.stdout)["findings"]
        (priority,) = [row for row in printed if row["check"] == "real-time priority"]
        self.assertEqual(priority["verdict"], "warning")
        self.assertIn("rtprio 60", priority["sentence"])

    def test_a_missing_vendor_library_is_a_note_unless_named(self):
        if mvs("haptics", "list", "--driver", "phantom", cwd=self.dir).returncode == 0:
            self.skipTest("OpenHaptics is installed here")
        printed = self.json("haptics", "doctor")
        self.assertEqual(printed["faults"], 0)
        (phantom,) = [row for row in printed["findings"] if row["about"] == "phantom"]
        self.assertEqual((phantom["verdict"], phantom["check"]), ("note", "driver"))
        self.assertIn("not installed", phantom["sentence"])
        self.assertEqual(mvs("haptics", "doctor", "--driver", "phantom",
                             cwd=self.dir).returncode, 1)

    def test_the_mouse_without_a_window_is_a_note_and_cannot_be_tested(self):
        printed = self.json("haptics", "doctor", "--driver", "mouse")
        self.assertEqual(printed["faults"], 0)
        (window,) = [row for row in printed["findings"] if row["check"] == "window"]
        self.assertEqual(window["verdict"], "note")
        for command in ("list", "test"):
            done = mvs("haptics", command, "--driver", "mouse", cwd=self.dir)
            self.assertEqual(done.returncode, 1)
            self.assertIn("start the example phantom, whose window the mouse drives", done.stderr)

    def test_faults_set_the_exit_code(self):
        done = mvs("haptics", "doctor", "--driver", "replay", "--option", "file=nowhere.txt",
                   "--json", cwd=self.dir)
        self.assertEqual(done.returncode, 1)
        printed = json.loads(done.stdout)
        self.assertEqual(printed["faults"], 1)
        (fault,) = [row for row in printed["findings"] if row["verdict"] == "fault"]
        self.assertIn("nowhere.txt", fault["sentence"])
        self.assertIn("faults", done.stderr)
        self.assertIn("no driver", mvs("haptics", "doctor", "--driver", "nowhere",
                                       cwd=self.dir).stdout)


class Test(Haptics):
    def test_a_virtual_clock_ticks_evenly(self):
        printed = self.json("haptics", "test", *REPLAY, f"file={GRASP}", "--seconds", 2)
        self.assertEqual(printed["device"]["model"], "Touch")
        self.assertEqual((printed["clock"], printed["late"], printed["lost"]), ("virtual", 0, 0))
        self.assertEqual(printed["ticks"], 2000)
        self.assertIsNone(printed["latched"])
        self.assertIsNone(printed["servo_us"])
        for name in ("p50", "p99", "p99_9", "max"):
            # times are sums of 2000 periods
            self.assertAlmostEqual(printed["period_us"][name], 1000, 6)
        counts = [row["count"] for row in printed["histogram"]]
        self.assertEqual((sum(counts), max(counts)), (1999, 1999))

    def test_a_rate_is_that_of_the_servo(self):
        printed = self.json("haptics", "test", *REPLAY, f"file={GRASP}", "--seconds", 1,
                         "--rate", 2000)
        self.assertEqual(printed["ticks"], 2000)
        self.assertAlmostEqual(printed["rate_Hz"], 2000, 6)

    def test_a_real_clock_reports_its_jitter(self):
        done = mvs("haptics", "test", "--driver", "template", "--seconds", 0.5, "--json",
                   cwd=self.dir)
        printed = json.loads(done.stdout)
        # a pause of the machine of 100 ms looks like a fault of the device
        self.assertEqual(done.returncode, 0 if printed["latched"] is None else 1)
        if printed["lost"] == 0:
            counted = sum(row["count"] for row in printed["histogram"])
            self.assertEqual(counted + 1, printed["ticks"])
        for figure in (printed["period_us"], printed["servo_us"]):
            in_order = [figure[name] for name in ("p50", "p99", "p99_9", "max")]
            self.assertEqual(in_order, sorted(in_order))
            self.assertGreater(in_order[0], 0)
        self.assertIsInstance(printed["realtime"], bool)

    def test_text_has_the_same_figures(self):
        printed = self.ok("haptics", "test", *REPLAY, f"file={GRASP}", "--seconds", 1).stdout
        self.assertIn("Touch, driver replay", printed)
        self.assertIn("1000 ticks", printed)
        self.assertRegex(printed, r"900 to +1100 us +999 +100.000 %")

    def test_a_disconnected_device_is_a_fault(self):
        printed = self.fails("test", *HAND, "--option", "fault=unplug", "--option", "fault_at=0.5")
        self.assertIn("the device was disconnected", printed)

    def test_samples_of_a_broken_driver_are_named_with_the_remedy(self):
        for lie, faults, remedy in (
                ("nan_position", ["number"], "finite numbers"),
                ("inf_velocity", ["number"], "finite numbers"),
                ("no_quaternion", ["orientation"], "norm 1"),
                ("long_quaternion", ["orientation"], "norm 1"),
                ("millimetres", ["far"], "not millimetres"),
                ("no_sequence", ["sequence"], "increase `sequence`"),
                ("no_time", ["clock"], "`now_ns`"),
                ("clock_back", ["clock"], "`now_ns`"),
                ("garbage", ["number", "orientation"], "norm 1"),
                ("honest", [], "")):
            driver = LIARS / f"{lie}.so"
            if not driver.is_file():
                self.skipTest(f"{driver} is not built")
            # on a real clock a late thread could miss the 0.1 s without a new sample
            for clock in (["--virtual"], []) if lie in ("nan_position", "honest") else (
                    ["--virtual"],):
                with self.subTest(lie, clock=clock):
                    done = mvs("haptics", "test", "--driver", driver, *clock, "--seconds", 0.15,
                               "--json", cwd=self.dir)
                    printed = json.loads(done.stdout)
                    self.assertEqual([row["name"] for row in printed["faults"]], faults)
                    self.assertEqual(done.returncode, 1 if faults else 0, done.stderr)
                    self.assertIn(remedy, done.stderr)
                    self.assertEqual(printed["bad_samples"] > 0, bool(faults))

    def test_a_device_that_falls_silent_is_a_fault(self):
        printed = self.fails("test", *HAND, "--seconds", 1, "--option", "fault=silent",
                             "--option", "fault_at=0.5")
        self.assertIn("no new sample for 0.1 s", printed)
        done = mvs("haptics", "test", *HAND, "--seconds", 0.5, "--option", "fault=nan_position",
                   "--option", "fault_at=0.25", cwd=self.dir)
        self.assertRegex(done.stdout, r"\d+ of \d+ samples are faulty\n  fault: a position")

    def test_the_end_of_a_recording_is_no_fault(self):
        printed = self.json("haptics", "test", *REPLAY, f"file={GRASP}", "--option", "end=stop",
                         "--seconds", 60)
        self.assertEqual(printed["latched"], "software")

    def test_pushes_are_small_and_felt(self):
        printed = self.json("haptics", "test", *HAND, "--seconds", 0.1, "--force", "--yes")
        # a quarter of the Touch's 0.88 N
        stiffness = 135  # N/m, of the simulated arm
        self.assertEqual([row["direction"] for row in printed["pushes"]],
                         ["+x", "-x", "+y", "-y", "+z", "-z"])
        for row in printed["pushes"]:
            self.assertAlmostEqual(row["asked_N"], 0.22, 12)
            # limited to the requested force; less where damping removes energy of the loop
            self.assertAlmostEqual(row["sent_N"], 0.22, delta=0.01)
            self.assertLessEqual(row["across_N"], 0.02)
            self.assertTrue(row["motors_on"])
            # static displacement of the arm, and at most twice that in a swing
            self.assertGreater(row["moved_mm"], 0.8e3 * 0.22 / stiffness)
            self.assertLess(row["moved_mm"], 2e3 * 0.22 / stiffness)

    def test_a_strong_device_pushes_with_half_a_newton(self):
        # 3 N continuous
        printed = self.json("haptics", "test", *HAND, "--option", "device=premium30", "--seconds", 0.1,
                         "--force", "--yes")
        self.assertEqual({row["asked_N"] for row in printed["pushes"]}, {0.5})

    def test_a_push_needs_confirmation(self):
        for answer in ("", "n\n"):
            done = subprocess.run([MVS, "haptics", "test", *HAND, "--force"], input=answer,
                                  capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1)
            self.assertIn("not confirmed", done.stderr)
        self.fails("test", *HAND, "--yes", code=2)
        self.assertIn("no motors", self.fails("test", *REPLAY, f"file={GRASP}", "--option",
                                              "force=0", "--force", "--yes"))

    def test_a_push_that_latches_reports_the_cause(self):
        printed = self.fails("test", *HAND, "--seconds", 0.1, "--force", "--yes", "--option",
                          "fault=hot", "--option", "fault_at=2")
        self.assertIn("thermal", printed)


class Record(Haptics):
    def record(self, *arguments):
        return self.json("haptics", "record", *arguments)

    def test_replay_plays_the_recording(self):
        first = self.record(*REPLAY, f"file={GRASP}", "-o", "first.txt", "--seconds", 5)
        self.record(*REPLAY, "file=first.txt", "-o", "second.txt", "--seconds", 5)
        one, two = samples(self.dir / "first.txt"), samples(self.dir / "second.txt")
        self.assertEqual((first["samples"], len(one), len(two)), (5000, 5000, 5000))
        for a, b in zip(one, two):
            self.assertEqual(a[0], b[0])
            for k in range(1, 8):
                self.assertAlmostEqual(a[k], b[k], delta=2e-9)  # nine decimals, rounded twice
        buttons = [[row[8] for row in rows] for rows in (one, two)]
        self.assertIn(1, buttons[0])
        # changes occur at samples: rounding can delay one by a tick
        self.assertLessEqual(sum(a != b for a, b in zip(*buttons)), 2)
        header = (self.dir / "first.txt").read_text().splitlines()[:12]
        for line in ("device Touch", "force 3.3", "stiffness 400", "buttons 2"):
            self.assertIn(line, header)

    def test_the_recording_contains_the_original(self):
        self.record(*REPLAY, f"file={GRASP}", "-o", "dense.txt", "--seconds", 4)
        dense = samples(self.dir / "dense.txt")
        for row in samples(GRASP):
            if row[0] < 4:
                same = dense[round(1000 * row[0])]
                for k in range(1, 4):
                    self.assertAlmostEqual(row[k], same[k], delta=1e-8)

    def test_the_end_of_a_recording_ends_recording(self):
        made = self.record(*REPLAY, f"file={GRASP}", "--option", "end=stop", "-o", "all.txt",
                           "--seconds", 100)
        self.assertAlmostEqual(made["seconds"], samples(GRASP)[-1][0], delta=2e-3)

    def test_ctrl_c_ends_it_and_the_file_is_complete(self):
        out = self.dir / "stopped.txt"
        process = subprocess.Popen([MVS, "haptics", "record", "--driver", "template", "-o", out,
                                    "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        until = time.monotonic() + 60
        while time.monotonic() < until and not (out.exists() and len(samples_or_none(out)) > 10):
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        printed, complaints = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, complaints)
        self.assertEqual(json.loads(printed)["samples"], len(samples(out)))
        self.json("haptics", "list", "--driver", "replay", "--option", f"file={out}")

    def test_nothing_is_written_for_a_missing_device(self):
        self.assertIn("file", self.fails("record", "--driver", "replay", "-o", "none.txt"))
        self.assertFalse((self.dir / "none.txt").exists())
        self.assertIn("--seconds", self.fails("record", *REPLAY, f"file={GRASP}", "-o", "none.txt"))
        self.assertFalse((self.dir / "none.txt").exists())
        self.assertIn("cannot be written", self.fails(
            "record", *REPLAY, f"file={GRASP}", "-o", "nowhere/r.txt", "--seconds", 1))


def samples_or_none(path):
    text = pathlib.Path(path).read_text()
    return samples(path) if text.startswith("mvs-recording 1\n") else []


class Interrupted(Haptics):
    def test_ctrl_c_stops_a_test(self):
        process = subprocess.Popen([MVS, "haptics", "test", "--driver", "template", "--seconds",
                                    "60"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        time.sleep(0.5)  # before its start the default handler ends it
        process.send_signal(signal.SIGINT)
        _, complaints = process.communicate(timeout=50)
        self.assertIn(process.returncode, (1, -signal.SIGINT))
        if process.returncode == 1:
            self.assertIn("forces are off", complaints)


if __name__ == "__main__":
    unittest.main()
