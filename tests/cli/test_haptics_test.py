"""`mvs haptics test` without hardware: clocks, faulty drivers, pushes."""
import json
import signal
import subprocess
import time
import unittest

from command import MVS, mvs
from haptic_command import GRASP, HAND, LIARS, REPLAY, Haptics


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

    def test_a_device_that_is_not_calibrated_is_a_fault(self):
        printed = self.fails("test", *HAND, "--seconds", 0.5, "--option", "fault=uncalibrated",
                             "--option", "fault_at=0.25")
        self.assertIn("not calibrated", printed)

    def test_a_device_on_which_forces_could_not_stay_on_is_a_fault(self):
        for fault, name, remedy in (("jump", "jump", "latched off"), ("hot", "warm", "let the device cool"),
                                    ("clock_jump", "clock_ahead", "`now_ns`"), ("stuck_button", None, "")):
            with self.subTest(fault):
                done = mvs("haptics", "test", *HAND, "--seconds", 0.5, "--option", f"fault={fault}",
                           "--option", "fault_at=0.25", "--json", cwd=self.dir)
                self.assertEqual([row["name"] for row in json.loads(done.stdout)["faults"]], [name] if name else [])
                self.assertEqual(done.returncode, 1 if name else 0)
                self.assertIn(remedy, done.stderr)

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
