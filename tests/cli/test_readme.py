"""README.md: its program, its links, its folders and its length."""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text()


class Readme(unittest.TestCase):
    def test_program_is_the_tested_example(self):
        program = re.search(r"```c\n(.*?)```", README, re.S).group(1)
        self.assertEqual(program, (ROOT / "examples/hello.c").read_text())

    @unittest.skipUnless(importlib.util.find_spec("mvs"), "the Python module is not installed here")
    def test_python_program_runs(self):
        program = re.search(r"```python\n(.*?)```", README, re.S).group(1)
        names = {}
        exec(program, names)
        self.assertEqual(names["closed"].measures.regurgitant_orifice_area, 0)

    @unittest.skipUnless(importlib.util.find_spec("mvs"), "the Python module is not installed here")
    def test_commands_are_in_the_environment(self):
        folder = pathlib.Path(sys.prefix) / "bin"
        self.assertTrue(os.path.lexists(folder / "mvs"))  # part python alone does not build it
        shown = subprocess.run([folder / "mvs-image", "--help"], capture_output=True, text=True)
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("usage: mvs-image", shown.stdout)

    def test_links_have_targets(self):
        links = re.findall(r"\]\((?!https?:)([^)#]+)\)", README)
        self.assertGreater(len(links), 0)
        for link in links:
            self.assertTrue((ROOT / link).exists(), link)

    def test_map_names_folders_that_exist(self):
        folders = re.findall(r"^\| `([\w/.]+/)`", README, re.M)
        self.assertGreater(len(folders), 5)
        for folder in folders:
            self.assertTrue((ROOT / folder).is_dir(), folder)

    def test_is_short(self):
        self.assertLess(len(README.splitlines()), 180)


if __name__ == "__main__":
    unittest.main()
