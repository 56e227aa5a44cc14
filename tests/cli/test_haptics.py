"""`mvs haptics` without hardware: drivers and checks."""
import json
import os
import pathlib
import shutil
import subprocess
import unittest

from command import MVS, mvs
from haptic_command import GRASP, Haptics


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
        self.assertIn("no option", self.fails("list", "--driver", "replay", "--option", "x=1", code=2))
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


if __name__ == "__main__":
    unittest.main()
