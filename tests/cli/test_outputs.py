"""Outputs that cannot be written are refused before the work, and files are replaced whole."""
import json
import os
import re
import resource
import signal
import stat
import subprocess
import unittest

from command import MVS, Shell, mvs

# Commands with -o after long work. Their inputs do not exist: only the output can be refused first.
COMMANDS = (("close", "nothing.obj"), ("cost", "nothing.obj"),
            ("op", "nothing.obj", "chord-remove", "--chord", "P2/1"),
            ("op", "nothing.obj", "chord-remove", "--chord", "P2/1", "--settle"),
            ("remesh", "nothing.obj", "--refine", 1),
            ("repair", "nothing.obj", "--plan", "nothing.json"),
            ("plan", "replay", "nothing.json", "--on", "nothing.obj"),
            ("import", "nothing.stl", "--findings", "findings.json"), ("generate",))


class Outputs(Shell):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ok("generate", "--shape", "founding", "-o", "v.obj", "--vertices", 200)

    def test_an_output_is_refused_before_the_work_with_the_sentence_of_the_save(self):
        (self.dir / "folder.obj").mkdir()
        (self.dir / "file").write_text("no folder")
        (self.dir / "loop.obj").symlink_to("loop.obj")
        (self.dir / "away.obj").symlink_to("nowhere/v.obj")
        os.mkfifo(self.dir / "pipe.obj")
        outs = ["v.xyz", "v", "v.inp", "nowhere/v.obj", "nowhere/v.vtm", "file/v.obj", "file.vtm",
                "folder.obj", "loop.obj", "away.obj", "pipe.obj", self.dir / "nowhere" / "v.h5"]
        if os.geteuid() != 0:
            (self.dir / "locked").mkdir(mode=0o555)
            (self.dir / "kept.obj").touch(mode=0o444)
            outs += ["locked/v.obj", "locked/v.vtm", "kept.obj"]
        for out in outs:
            saved = mvs("convert", "v.obj", "-o", out, "--json", cwd=self.dir)
            self.assertEqual(saved.returncode, 2 if out in ("v.xyz", "v") else 1, saved.stdout)
            for line in COMMANDS:
                with self.subTest(out=out, line=line):
                    done = mvs(*line, "-o", out, "--json", cwd=self.dir)
                    self.assertEqual((done.returncode, done.stderr, done.stdout),
                                     (saved.returncode, saved.stderr, saved.stdout))

    def test_endings_that_are_written_are_not_refused(self):
        for ending in ("obj", "OBJ", "vtkhdf", "h5", "vtp", "vtm", "feb"):
            out = f"written.{ending}"
            saved = mvs("convert", "v.obj", "-o", out, cwd=self.dir)
            done = mvs("op", "v.obj", "chord-remove", "--chord", "P2/1", "-o", out, cwd=self.dir)
            self.assertEqual((done.returncode, done.stderr), (saved.returncode, saved.stderr))

    def test_only_endings_that_are_written_are_named_for_an_output(self):
        for line in (("convert", "v.obj"), ("close", "v.obj")):
            said = mvs(*line, "-o", "v.xyz", cwd=self.dir).stderr
            self.assertIn("known endings are .obj, .h5, .vtkhdf, .vtp, .vtm and .feb", said)
        self.assertIn(".inp", mvs("info", "v.xyz", cwd=self.dir).stderr)

    def test_blocks_that_a_new_index_does_not_name_are_removed(self):
        self.ok("close", "v.obj", "-o", "closed.obj", "--allow-unsettled")
        self.ok("convert", "v.obj", "-o", "x.vtm")
        self.assertTrue((self.dir / "x" / "orifice.vtp").exists())
        (self.dir / "x" / "mine.vtp").write_text("not of the index")
        self.ok("convert", "closed.obj", "-o", "x.vtm")
        named = re.findall(r'file="x/(.*?)"', (self.dir / "x.vtm").read_text())
        self.assertNotIn("orifice.vtp", named)
        self.assertEqual({path.name for path in (self.dir / "x").iterdir()}, {*named, "mine.vtp"})

    def test_ctrl_c_is_named_as_the_reason(self):
        self.ok("generate", "-o", "large.obj", "--vertices", 1600)
        with subprocess.Popen([MVS, "close", "large.obj", "--progress"], cwd=self.dir, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
            running.stderr.readline()  # of the progress
            running.send_signal(signal.SIGINT)
            said = running.communicate(timeout=60)[1]
        self.assertEqual(running.returncode, 1, said)
        self.assertIn("settling was stopped by Ctrl-C", said)
        self.assertNotIn("callback", said)

    def test_other_outputs_are_refused_before_the_work_too(self):
        for line in (("repair", "nothing.obj", "--plan", "nothing.json", "--save-plan"),
                     ("import", "nothing.stl", "-o", "v.h5", "--findings")):
            done = mvs(*line, "nowhere/p.json", cwd=self.dir)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("nowhere/p.json: cannot write into folder nowhere: No such file or directory; create",
                          done.stderr)

    def test_an_import_does_not_write_two_outputs_to_one_file(self):
        (self.dir / "link.h5").symlink_to("one.h5")
        for findings in ("one.h5", "./one.h5", self.dir / "one.h5", "link.h5"):
            done = mvs("import", "nothing.stl", "-o", "one.h5", "--findings", findings, cwd=self.dir)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("is the output for the valve as well", done.stderr)

    def test_a_repair_does_not_write_over_its_files(self):
        (self.dir / "plan.json").write_text(json.dumps({"format": "mvs-plan", "version": 1, "steps": []}))
        (self.dir / "same.obj").symlink_to("v.obj")
        line, before = ("repair", "v.obj", "--plan", "plan.json"), (self.dir / "v.obj").read_bytes()
        for outs, words in ((("-o", "a.h5", "--save-plan", "./a.h5"), "is the output for the valve as well"),
                            (("--save-plan", "same.obj"), "is the input v.obj as well"),
                            (("--save-plan", "plan.json"), "is the input plan.json as well")):
            done = mvs(*line, *outs, cwd=self.dir)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(words, done.stderr)
        self.assertEqual((self.dir / "v.obj").read_bytes(), before)
        self.assertFalse((self.dir / "a.h5").exists())


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

    def test_a_file_whose_name_ends_in_new_stays(self):
        (self.dir / "n.csv.new").write_text("mine")
        self.ok(*self.SWEEP, "n.csv")
        self.assertEqual((self.dir / "n.csv.new").read_text(), "mine")
        self.assertEqual(list(self.dir.glob(".mvs-*")), [])

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
