"""Exit codes of every command, and its error object with --json: 2 is wrong usage, 1 a failure."""
import json
import os
import re
import unittest

from command import Command, mvs

# A line of each command whose file is not there.
NO_FILE = (["info", "no.obj"], ["chords", "no.obj"], ["leak", "no.obj"], ["cost", "no.obj"],
           ["op", "no.obj", "annulus-scale", "--factor", 0.9, "-o", "x.obj"], ["close", "no.obj"],
           ["measure", "no.obj"], ["compare", "no.obj", "v.obj"], ["convert", "no.obj", "-o", "x.obj"],
           ["plan", "show", "no.json"], ["plan", "check", "no.json", "--on", "v.obj"],
           ["plan", "replay", "no.json", "--on", "v.obj"], ["remesh", "no.obj", "-o", "x.obj", "--refine", 1],
           ["repair", "v.obj", "--plan", "no.json"], ["sensitivity", "no.obj"],
           ["sweep", "no.obj", "--op", "annulus-scale factor=0.9", "--csv", "x.csv"],
           ["import", "no.stl", "-o", "x.obj"], ["generate", "-o", "no/x.obj"])

# Values that no file makes right: refused by the parser, by the command or by the library.
WRONG_VALUES = (["close", "v.obj", "--residual", 1e9], ["close", "v.obj", "--residual", 0],
                ["close", "v.obj", "--pressure", 1e5], ["close", "v.obj", "--solver", "implicit", "--dt", 9],
                ["close", "v.obj", "--members", 2, "--perturbation", 6],
                ["close", "v.obj", "-o", "x.xyz"], ["convert", "v.obj", "-o", "x.xyz"], ["info", "v.xyz"],
                ["cost", "closed.obj", "--flow", 0.25], ["cost", "closed.obj", "--diastole", 0],
                ["generate", "-o", "x.obj", "--annulus-ap", 9e3], ["generate", "-o", "x.obj", "--vertices", 5],
                ["generate", "-o", "x.obj", "--thickness", -1],
                ["remesh", "v.obj", "-o", "x.obj", "--edge", 1e9], ["remesh", "v.obj", "-o", "x.obj", "--refine", 9],
                ["op", "v.obj", "annulus-scale", "--factor", 99, "-o", "x.obj"],
                ["op", "v.obj", "head-move", "--head", "PM1", "--by", "500,0,0", "-o", "x.obj"],
                ["sweep", "v.obj", "--op", "annulus-scale factor=wide", "--csv", "x.csv"],
                ["sensitivity", "closed.obj", "--of", "colour"], ["sensitivity", "closed.obj", "--sort", "colour"],
                ["sensitivity", "closed.obj", "--to", "pressure", "--chord", "P2/1"],
                ["chords", "v.obj", "--sort", "colour"], ["measure", "v.obj", "--only", "colour"],
                ["repair", "v.obj", "--plan", "p.json", "--save-plan", "p.json"],
                ["import", "v.obj", "-o", "x.h5", "--thickness", 99],
                ["import", "v.obj", "-o", "x.h5", "--findings", "x.h5"], ["plan", "fly"], [])

# Contents of files, and parts of a valve, that are wrong.
WRONG_CONTENTS = (["plan", "check", "far.json", "--on", "v.obj"], ["plan", "replay", "far.json", "--on", "v.obj"],
                  ["plan", "show", "unknown.json"], ["repair", "v.obj", "--plan", "far.json"],
                  ["op", "v.obj", "ring", "--curve", "points.txt", "-o", "x.obj"],
                  ["op", "v.obj", "chord-remove", "--chord", "P9/9", "-o", "x.obj"],
                  ["op", "v.obj", "chord-add", "--head", "PM1", "--site", "node:99999", "-o", "x.obj"],
                  ["cost", "closed.obj", "--septum", "points.txt"],
                  ["import", "v.obj", "-o", "x.h5", "--labels", "colour"],
                  ["sensitivity", "v.obj"], ["info", "points.obj"])


class ExitCodes(Command):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        head = {"format": "mvs-plan", "version": 1}
        ball = {"do": "tool_add", "tool": 2**48, "kind": "ball", "position_m": [5, 0, 0], "radius_m": 0.002,
                "stiffness_N/m": 200, "max_force_N": 5}
        for name, steps in (("p", []), ("far", [ball]),
                            ("unknown", [{"do": "annulus_scale", "factor": 0.9, "size": 1}])):
            (cls.dir / f"{name}.json").write_text(json.dumps({**head, "steps": steps}))
        (cls.dir / "points.txt").write_text("nan,0,0\n1,0,0\n")
        (cls.dir / "points.obj").write_text("v 0 0 0\n")

    def error(self, code, line):
        """Runs a line with --json, which has to fail; returns the error object."""
        before = set(os.listdir(self.dir))
        plain = mvs(*line, cwd=self.dir)
        done = mvs(*line, "--json", cwd=self.dir)
        self.assertEqual((plain.returncode, done.returncode), (code, code), done.stderr + done.stdout)
        self.assertEqual(plain.stdout, "")
        self.assertNotEqual(done.stderr, "")
        self.assertEqual(set(os.listdir(self.dir)), before)
        error = json.loads(done.stdout)["error"]
        self.assertEqual(set(error), {"code", "message", "part", "line"})
        self.assertEqual(error["code"] == "MVS_E_ARGUMENT", code == 2, error)
        return error

    def test_a_file_that_is_not_there_is_a_failure(self):
        for line in NO_FILE:
            with self.subTest(line):
                self.error(1, line)

    def test_a_value_that_no_file_makes_right_is_wrong_usage(self):
        for line in WRONG_VALUES:
            with self.subTest(line):
                self.error(2, line)

    def test_wrong_contents_of_a_file_are_a_failure(self):
        for line in WRONG_CONTENTS:
            with self.subTest(line):
                self.error(1, line)

    def test_every_command_refuses_unknown_options_as_wrong_usage(self):
        help_text = mvs("--help", cwd=self.dir).stdout
        commands = re.findall(r"^  ([\w-]+) ", help_text[help_text.index("Subcommands:"):], re.M)
        self.assertGreater(len(commands), 15)
        for command in commands:
            with self.subTest(command):
                self.assertNotIn("\n", self.error(2, [command, "--colour"])["message"])
                self.error(2, [command, "--colour", "red", "v.obj"])
        self.assertEqual({line[0] for line in NO_FILE} | {"haptics"}, set(commands))

    def test_help_is_no_failure(self):
        done = mvs("close", "--help", "--json", cwd=self.dir)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
