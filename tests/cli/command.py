"""The command `mvs` run in a temporary folder, and what may be asked of its output."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

MVS = os.environ["MVS_COMMAND"]


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
