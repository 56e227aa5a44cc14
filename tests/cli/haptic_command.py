"""The command `mvs haptics` with recorded and simulated hands."""
import os
import pathlib

from command import Shell, mvs

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRASP = ROOT / "haptic_drivers/replay/trajectories/grasp_a2.txt"
REPLAY = ["--driver", "replay", "--virtual", "--option"]
LIARS = pathlib.Path(os.environ.get("MVS_LIARS_DIR", ""))
# simulated hand at rest in the middle of a Touch
HAND = ["--driver", "hand", "--virtual"]


def samples(path):
    """The rows of a recording as numbers."""
    lines = pathlib.Path(path).read_text().splitlines()
    assert lines[0] == "mvs-recording 1"
    rows = [line.split() for line in lines[1:] if line[:1].isdigit() or line[:1] == "-"]
    return [[float(word) for word in row] for row in rows]


class Haptics(Shell):
    def fails(self, *arguments, code=1):
        done = mvs("haptics", *arguments, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr
