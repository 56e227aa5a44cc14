"""`mvs haptics record`: recordings are those of the hand, and of a bad device none."""
import json
import os
import pathlib
import resource
import signal
import subprocess
import time
import unittest

from command import MVS, mvs
from haptic_command import GRASP, HAND, REPLAY, Haptics, samples


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
        self.assertIn("file", self.fails("record", "--driver", "replay", "-o", "none.txt", code=2))
        self.assertFalse((self.dir / "none.txt").exists())
        self.assertIn("--seconds", self.fails("record", *REPLAY, f"file={GRASP}", "-o", "none.txt",
                                            code=2))
        self.assertFalse((self.dir / "none.txt").exists())
        self.assertIn("cannot be written", self.fails(
            "record", *REPLAY, f"file={GRASP}", "-o", "nowhere/r.txt", "--seconds", 1))


class Faults(Haptics):
    def record(self, *arguments):
        return mvs("haptics", "record", *arguments, "--seconds", 0.3, cwd=self.dir)

    def test_refused_samples_end_with_the_time(self):
        for fault, part in (("nan_position", "finite numbers"), ("inf_velocity", "finite numbers"),
                            ("silent", "no new sample")):
            for clock in (["--virtual"], []) if fault == "silent" else (["--virtual"],):
                with self.subTest(fault, clock=clock):
                    done = self.record("--driver", "hand", *clock, "-o", "bad.txt",
                                       "--option", f"fault={fault}", "--option", "fault_at=0.1")
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertIn(part, done.stderr)
                    self.assertIn("no good samples", done.stderr)
                    self.assertGreater(len(samples(self.dir / "bad.txt")), 50)

    def test_a_device_without_a_good_sample_leaves_the_former_recording(self):
        self.json("haptics", "record", *HAND, "-o", "kept.txt", "--seconds", 0.1)
        before = (self.dir / "kept.txt").read_text()
        for fault in ("nan_position", "uncalibrated"):
            with self.subTest(fault):
                done = self.record(*HAND, "-o", "kept.txt", "--option", f"fault={fault}")
                self.assertEqual(done.returncode, 1)
                self.assertEqual((self.dir / "kept.txt").read_text(), before)
                self.assertEqual(list(self.dir.glob(".mvs-*")), [])

    def test_a_full_disk_leaves_the_former_recording(self):
        def no_space():  # a write beyond 20,000 bytes fails, as on a full disk
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        self.json("haptics", "record", *HAND, "-o", "full.txt", "--seconds", 0.1)
        os.chmod(self.dir / "full.txt", 0o640)
        before = (self.dir / "full.txt").read_text()
        line = [MVS, "haptics", "record", *HAND, "-o", "full.txt", "--seconds", "1"]
        done = subprocess.run(line, cwd=self.dir, capture_output=True, text=True, timeout=60,
                              preexec_fn=no_space, restore_signals=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("full.txt cannot be written", done.stderr)
        self.assertEqual((self.dir / "full.txt").read_text(), before)
        self.assertEqual(list(self.dir.glob(".mvs-*")), [])
        self.ok(*line[1:])
        self.assertEqual(len(samples(self.dir / "full.txt")), 1000)
        self.assertEqual((self.dir / "full.txt").stat().st_mode & 0o777, 0o640)

    def test_a_lost_device_is_a_fault(self):
        done = self.record(*HAND, "-o", "lost.txt", "--option", "fault=unplug",
                           "--option", "fault_at=0.1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the device was disconnected", done.stderr)
        self.assertGreater(len(samples(self.dir / "lost.txt")), 50)

    def test_a_link_stays_a_link(self):
        (self.dir / "real.txt").write_text("old")
        (self.dir / "link.txt").symlink_to("real.txt")
        self.assertEqual(self.record(*HAND, "-o", "link.txt").returncode, 0)
        self.assertTrue((self.dir / "link.txt").is_symlink())
        self.assertEqual(len(samples(self.dir / "real.txt")), 300)


def samples_or_none(path):
    text = pathlib.Path(path).read_text()
    return samples(path) if text.startswith("mvs-recording 1\n") else []


if __name__ == "__main__":
    unittest.main()
