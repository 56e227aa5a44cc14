"""Abaqus input and FEBio models with the command: messages, and the pressure of the closure."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest
from xml.etree import ElementTree

MVS = os.environ["MVS_COMMAND"]
TOY = pathlib.Path(__file__).resolve().parents[1] / "formats" / "data" / "three_leaflets.inp"
PA_PER_MMHG = 133.322


def mvs(*arguments):
    return subprocess.run([MVS, *map(str, arguments)], capture_output=True, text=True, timeout=300)


class Import(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dir = pathlib.Path(folder.name)

    def ok(self, *arguments):
        done = mvs(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_info_lists_the_parts_and_the_ignored_lines(self):
        done = self.ok("info", TOY, "--json")
        printed = json.loads(done.stdout)
        self.assertEqual([leaflet["name"] for leaflet in printed["leaflets"]],
                         ["Anterior", "Septal", "Posterior"])
        self.assertEqual(printed["faces"], 48)
        self.assertAlmostEqual(printed["pressure_mmHg"], 3000 / PA_PER_MMHG, places=9)
        line = 1 + TOY.read_text(encoding="ascii").splitlines().index("*Friction")
        self.assertIn(f"mvs: line {line}: `*FRICTION` is left out", done.stderr)

    def test_close_takes_the_pressure_of_the_file_unless_given_another(self):
        printed = json.loads(self.ok("close", TOY, "--json").stdout)
        self.assertAlmostEqual(printed["pressure_mmHg"], 3000 / PA_PER_MMHG, places=9)
        printed = json.loads(self.ok("close", TOY, "--pressure", 10, "--json").stdout)
        self.assertEqual(printed["pressure_mmHg"], 10)

    def test_a_valve_made_from_the_file_keeps_its_pressure(self):
        for name in ("toy.obj", "toy.h5"):
            self.ok("convert", TOY, "-o", self.dir / name)
            printed = json.loads(self.ok("close", self.dir / name, "--json").stdout)
            self.assertAlmostEqual(printed["pressure_mmHg"], 3000 / PA_PER_MMHG, places=9)
            for settle, pressure in ((["--settle"], 3000 / PA_PER_MMHG), (["--settle", 10], 10)):
                printed = json.loads(self.ok("op", self.dir / name, "annulus-scale", "--ap",
                                          0.9, *settle, "--json").stdout)
                self.assertAlmostEqual(printed["pressure_mmHg"], pressure, places=9)

    def test_convert_keeps_the_valve_and_writes_febio_models(self):
        before = json.loads(self.ok("info", TOY, "--json").stdout)
        self.ok("convert", TOY, "-o", self.dir / "toy.obj")
        after = json.loads(self.ok("info", self.dir / "toy.obj", "--json").stdout)
        self.assertEqual(after["hash"], before["hash"])
        self.ok("convert", TOY, "-o", self.dir / "toy.feb")
        root = ElementTree.parse(self.dir / "toy.feb").getroot()
        self.assertEqual(len(root.findall("Mesh/Elements/elem")), 48)

    def test_a_fault_is_reported_with_its_line(self):
        path = self.dir / "bad.inp"
        path.write_text("*NODE\n1, 0., 0., zero\n", encoding="ascii")
        done = mvs("info", path)
        self.assertEqual(done.returncode, 1)
        self.assertIn("bad.inp:2: `zero` is not a number", done.stderr)


if __name__ == "__main__":
    unittest.main()
