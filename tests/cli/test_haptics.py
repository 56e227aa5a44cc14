"""`mvs haptics` without hardware: drivers, checks and recordings."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from command import MVS, mvs
from haptic_command import GRASP, REPLAY, Haptics, samples


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
            self.assertIn("start the example phantom", done.stderr)

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


if __name__ == "__main__":
    unittest.main()
