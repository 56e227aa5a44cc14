"""The plans of examples/plans: each valve leaks, and `mvs repair` seals it."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

MVS = os.environ["MVS_COMMAND"]
PLANS = pathlib.Path(__file__).resolve().parents[2] / "examples" / "plans"

# Commands of README.md of that folder; names of strut chordae depend on the mesh.
SICK = {
    1: ["--annulus-scale", "1.15", "--chord-factor", "{strut}=1.25"],
    2: ["--chord-factor", "A2/4=0.70"],
    3: ["--annulus-scale", "1.10", "--chord-factor", "A2/4=0.67"],
    4: ["--annulus-scale", "1.05"],
}
# Plans that make a valve ill, by names of chordae at 425 vertices.
RUPTURE = {4: PLANS / "flail.json"}
STRUT = {425: "A1/11"}
if os.environ.get("MVS_TEST_LONG"):
    STRUT[1700] = "A2/6"

# Gaps below 1 mm are closed, so that the smallest measurable opening has 0.8 mm2.
LEAK_MM2 = 3


class Plans(unittest.TestCase):
    def json(self, *arguments):
        done = subprocess.run([MVS, *map(str, arguments), "--json"], cwd=self.folder.name,
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def repaired(self, number, vertices):
        sick = [word.format(strut=STRUT[vertices]) for word in SICK[number]]
        self.json("generate", "--shape", "founding", "--vertices", vertices, "--posterior-height", 12, *sick,
                  "-o", "sick.obj")
        if number in RUPTURE:
            whole = self.json("repair", "sick.obj", "--plan", RUPTURE[number], "-o", "sick.obj")["before"]
            self.assertEqual(whole["measures"]["regurgitant_orifice_area_mm2"], 0, "the rupture makes it leak")
        return self.json("repair", "sick.obj", "--plan", PLANS / f"valve{number}.json")

    def test_each_repair_seals_its_valve(self):
        for vertices in STRUT:
            for number in SICK if vertices == 425 else SICK.keys() - RUPTURE.keys():
                with self.subTest(vertices=vertices, valve=number):
                    found = self.repaired(number, vertices)
                    before, after = found["before"], found["after"]
                    self.assertGreater(before["measures"]["regurgitant_orifice_area_mm2"], LEAK_MM2)
                    self.assertEqual(after["measures"]["regurgitant_orifice_area_mm2"], 0)
                    for side in (before, after):
                        self.assertTrue(side["converged"])
                        self.assertEqual(side["intersections"], 0)

    def test_a_plan_names_the_chordae_that_it_attaches_in_vain(self):
        self.json("generate", "--shape", "founding", "-o", "v.obj")
        tie = [{"do": "neochord", "head": "PM1", "site": {"scallop": "P2", "along": along, "height": 1.0},
                "length_m": length, "name": name} for name, along, length in
               (("long", 0.4, 0.040), ("short", 0.6, 0.010))]
        plan = {"format": "mvs-plan", "version": 1, "units": "SI: m, N, Pa, s", "steps": tie}
        pathlib.Path(self.folder.name, "tie.json").write_text(json.dumps(plan))
        found = self.json("repair", "v.obj", "--plan", "tie.json")
        self.assertEqual([chord["name"] for chord in found["slack_new_chordae"]], ["long"])

    def test_every_plan_is_explained(self):
        text = (PLANS / "README.md").read_text()
        files = sorted(path.name for path in PLANS.glob("*.json"))
        self.assertEqual(files, sorted([path.name for path in RUPTURE.values()]
                                       + [f"valve{number}.json" for number in SICK]))
        for number in SICK:
            self.assertIn(f"valve{number}.obj", text)
            self.assertTrue(json.loads((PLANS / f"valve{number}.json").read_text())["notes"])


if __name__ == "__main__":
    unittest.main()
