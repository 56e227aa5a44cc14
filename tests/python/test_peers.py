"""tests/bench/peers.py: the NumPy forces equal those of the library, and the engines run."""

import csv
import subprocess
import sys
from pathlib import Path

import mvs
import numpy as np
import pytest

pytest.importorskip("scipy")
BENCH = Path(__file__).resolve().parents[1] / "bench"
sys.path[:0] = [str(BENCH), str(BENCH / "peers")]

import export  # noqa: E402
import forces  # noqa: E402
import peers  # noqa: E402


@pytest.fixture(scope="module")
def opened():
    return peers.opened_valve(200, "spring")


@pytest.fixture(scope="module")
def goal(opened):
    return peers.Goal(opened, mvs.SYSTOLE_PA, 1)


def test_numpy_law_gives_the_forces_of_the_library(opened, goal):
    """Springs, bending, chordae and pressure of a closed valve, without contact."""
    closed = goal.shapes[0]
    law = forces.Law(export.arrays(opened, mvs.SYSTOLE_PA), "none")
    ours = closed.node_force - closed.node_contact_force
    ours = np.where(goal.free[:, None], ours, 0)
    # the same sums in another order: rounding of forces of at most about 1 N
    assert np.abs(law.forces(closed.node_position) - ours).max() < 1e-12


@pytest.mark.parametrize("contact", ["barrier", "penalty"])
def test_numpy_forces_are_the_gradient_of_the_numpy_energy(opened, goal, contact):
    x = goal.shapes[0].node_position
    law = forces.Law(export.arrays(opened, mvs.SYSTOLE_PA), contact)
    frozen = law.frozen_rim(x)
    way = np.random.default_rng(1).normal(size=x.shape) * goal.free[:, None]
    h = 1e-8  # m: a central difference has an error of h^2, rounding one of 1e-16 J / h
    rise = (law.energy(x + h * way, frozen)[0] - law.energy(x - h * way, frozen)[0]) / (2 * h)
    slope = -(law.energy(x, frozen)[1] * way).sum()
    # the forces have kinks: of springs, and of contact where the nearest triangle changes
    assert rise == pytest.approx(slope, rel=0.02)


def test_shapes_are_checked_by_the_exact_test_and_the_library_forces(goal):
    at_rest = goal.judge(goal.shapes[0].node_position)
    assert at_rest["node_max_mm"] == 0 and at_rest["crossings"] == 0
    assert at_rest["force_max_N"] < 1e-6  # closed to 1e-7 N
    moved = goal.shapes[0].node_position + 1e-3 * goal.free[:, None] * [0, 0, 1]
    found = goal.judge(moved)
    assert 0 < found["node_rms_mm"] <= 1 + 1e-9 and found["force_max_N"] > 1e-3


def test_the_driver_writes_a_row_for_each_case(tmp_path):
    done = subprocess.run(
        [sys.executable, BENCH / "peers.py", "--engines", "numpy,mujoco,febio", "--vertices", "200",
         "--limit", "1", "--paths", "1", "--out", tmp_path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with (tmp_path / "peers.csv").open() as file:
        rows = list(csv.DictReader(file))
    verdicts = {row["engine"]: row["verdict"] for row in rows}
    assert verdicts["febio"] == "not given" and verdicts["mujoco"] == "not installed"
    for row in (row for row in rows if row["engine"] == "numpy"):
        assert row["verdict"] in ("rest", "limit", "stalled")
        # the limit of 1 s of CPU excludes the last step and the set-up
        assert float(row["cpu_s"]) < 5 and float(row["node_max_mm"]) < 50


def test_an_unknown_engine_is_named(tmp_path):
    done = subprocess.run([sys.executable, BENCH / "peers.py", "--engines", "abacus"],
                          capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 2 and "abacus" in done.stderr
