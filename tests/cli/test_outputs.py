"""Files that the command itself writes are replaced whole."""
import json
import os
import resource
import signal
import stat
import subprocess
import unittest

from command import MVS, Shell


class Replaced(Shell):
    """Tables of sweeps, as files that the command itself replaces."""
    SWEEP = ("sweep", "v.obj", "--op", "annulus-scale factor=1.1,1.2", "--csv")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "v.obj", "--vertices", 200)
        cls.ok(*cls.SWEEP, "t.csv")

    def names(self):
        return {path.name for path in self.dir.iterdir()}

    def test_links_and_modes_stay(self):
        (self.dir / "far").mkdir()
        os.chmod(self.dir / "t.csv", 0o640)
        (self.dir / "far" / "t.csv").write_bytes((self.dir / "t.csv").read_bytes())
        os.chmod(self.dir / "far" / "t.csv", 0o606)
        (self.dir / "link.csv").symlink_to("far/t.csv")
        (self.dir / "new.csv").symlink_to("far/new.csv")
        for name in ("t.csv", "link.csv", "new.csv"):
            self.ok(*self.SWEEP, name)
        self.assertTrue((self.dir / "link.csv").is_symlink() and (self.dir / "new.csv").is_symlink())
        self.assertEqual((self.dir / "far" / "new.csv").read_bytes(), (self.dir / "t.csv").read_bytes())
        for name, mode in (("t.csv", 0o640), ("far/t.csv", 0o606)):
            self.assertEqual(stat.S_IMODE((self.dir / name).stat().st_mode), mode)

    def test_a_file_that_cannot_be_written_whole_leaves_the_old_one_and_no_other(self):
        def no_space():  # a write beyond 100 bytes fails, as on a full disk
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

        before, names = (self.dir / "t.csv").read_bytes(), self.names()
        done = subprocess.run([MVS, *self.SWEEP, "t.csv", "--json"], cwd=self.dir, capture_output=True,
                              text=True, timeout=300, preexec_fn=no_space, restore_signals=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        error = json.loads(done.stdout)["error"]
        self.assertEqual((error["code"], error["part"]), ("MVS_E_IO", "csv"))
        self.assertRegex(error["message"], r"^t\.csv: cannot write .*t\.csv: ")
        self.assertEqual((self.dir / "t.csv").read_bytes(), before)
        self.assertEqual(self.names(), names)


if __name__ == "__main__":
    unittest.main()
