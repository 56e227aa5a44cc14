"""Finer meshes converge to one closed shape (tests/validation/convergence.py); run time against
error (tests/bench/time_error.py) keeps working."""

import csv
import sys

import mvs
import pytest
from conftest import ROOT


def founding(sim):
    sim.generate(shape="founding")


@pytest.fixture(scope="module")
def levels():
    import convergence

    return convergence.close_levels(convergence.shipped("bilinear"), 3, chained=False)


def test_every_level_comes_to_rest_without_crossings(levels):
    assert all(level.stats.converged for level in levels)
    assert all(level.closed.measures.intersections == 0 for level in levels)


def test_levels_converge(levels):
    import convergence

    # linear triangles converge with order 2 without contact; contact borders leave 1 to 2
    assert 1 < convergence.orders(levels)[0] < 2.5
    assert "6276" in convergence.table("membrane", levels)


def test_a_run_has_its_row_and_its_place_in_the_picture(levels, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "bench"))
    import time_error
    from timed_valves import refined

    subject = time_error.Subject(
        "shipped", ("bilinear",),
        lambda law, k: refined(founding, law, k),
        1, mvs.SYSTOLE_PA, {"bilinear": levels[-1].closed}, None,
    )
    rows = [time_error.run(subject, "bilinear", solver, 0, 1e-3)
            for solver in ("newton", "implicit")]
    time_error.write(rows, tmp_path / "table.csv")
    time_error.draw(rows, tmp_path / "picture.png")
    with (tmp_path / "table.csv").open() as file:
        read = list(csv.DictReader(file))
    assert [row["solver"] for row in read] == ["newton", "implicit"]
    assert min(float(row["times_fastest"]) for row in read) == 1
    # 432 vertices lie 0.09 mm from 6,276, for every solver
    assert all(0.05 < float(row["error_rms_mm"]) < 0.15 for row in read)
    assert (tmp_path / "picture.png").stat().st_size > 10_000


BASELINE = """#!{python}
import shutil, sys
shutil.copy(sys.argv[3], sys.argv[7])
print("method,converged,diverged,stable,steps,cpu_s,residual_N,crossings,settings")
print(sys.argv[1] + ',no,no,no,40,0.5,0.1,0,"masses times 2"')
"""


def test_a_baseline_that_does_not_rest_has_its_row_and_its_cross(tmp_path, monkeypatch):
    """A program stands in for bench_baseline: it returns the open valve."""
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "bench"))
    import time_error
    from timed_valves import refined

    program = tmp_path / "baseline"
    program.write_text(BASELINE.format(python=sys.executable))
    program.chmod(0o755)
    subject = time_error.Subject("shipped", ("bilinear",),
                                 lambda law, k: refined(founding, law, k),
                                 1, mvs.SYSTOLE_PA, {}, None)
    rows = [time_error.run(subject, "bilinear", "newton", 0, 1e-3),
            time_error.run(subject, "bilinear", "viscous", 0, 1e-3, program)]
    assert [row["stable"] for row in rows] == ["yes", "no"]
    found = rows[1]
    assert found["converged"] == "no" and found["iterations"] == 40 and found["cpu_s"] == 0.5
    assert found["settings"] == "masses times 2" and found["crossings"] == 0
    for row in rows:
        row["error_rms_mm"] = 0.1
    time_error.draw(rows, tmp_path / "picture.png")
    assert (tmp_path / "picture.png").stat().st_size > 10_000
