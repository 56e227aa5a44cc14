"""Run time against error: which element, solver, mesh and tolerance buy what.

Every run closes a valve from open, one after the other in the order of the table. Times are CPU
time (the machine may be shared), of the closure only. Error: distance of the closed surface, both
ways, from the finest level of the same element (closed level by level, so that refining does not
change folds; tests/validation/convergence.py), and from the shape of another model: FEBio's,
Abaqus's, and of the shipped valve the finest membrane, which tells what springs cost.

Baselines: the founding paper's explicit method and dynamic relaxation, with viscous and with
kinetic damping, each with the settings that close this valve soonest (bench_baseline, a program of
its own; the search for settings is not counted). The explicit method is run on the coarsest mesh.

At rest is: below the tolerance, at a stable equilibrium of the contact law of the method. Where
sheets cross it is an equilibrium of the penalty contact alone: tissue cannot be there.

    python tests/bench/time_error.py [--long] [--valves shipped,febio,texas] [--out DIR]

writes DIR/time_error.csv and DIR/time_error.png. 20 min of CPU, of which the searches for settings
take most; --long: one level more, much longer. Texas, where it is named, takes minutes more. Needs
matplotlib.
"""

from __future__ import annotations

import argparse
import csv
import os
import subprocess
import sys
import tempfile
import time
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Iterator, Optional

import mvs
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "time_error"))
from error_picture import draw  # noqa: E402
from timed_valves import LEVELS, SUBJECTS, Subject  # noqa: E402

SOLVERS = ("newton", "implicit")
BASELINES = ("explicit", "viscous", "kinetic")
TOLERANCES = (1e-1, 1e-3, 1e-5)
STEPS = {"newton": 600, "implicit": 4000}
"""limits after which a run stops; its `converged` is then `no`"""

COLUMNS = ("valve", "element", "solver", "vertices", "tolerance_N", "converged", "stable",
           "iterations", "cpu_s", "times_fastest", "error_rms_mm", "error_max_mm", "other_rms_mm",
           "other_max_mm", "crossings", "settings")

PROGRAM = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "bench_baseline"


@dataclass
class Run:
    """A closure from open: its shape, whether it is at rest, and its cost."""

    closed: mvs.Snapshot
    verdict: str
    stable: bool
    iterations: int
    cpu_s: float
    settings: str = ""


def close(subject: Subject, element: str, solver: str, level: int, tolerance: float) -> Run:
    """One closure, stopped after so many steps."""
    with mvs.Simulator() as sim:
        subject.prepare(element, level)(sim)
        sim.set_load(subject.pressure_pa)
        started = time.process_time()
        try:
            stats = sim.settle(solver=solver, residual=tolerance, max_iterations=STEPS[solver])
        except mvs.DivergedError:
            return Run(sim.snapshot(), "diverged", False, 0, time.process_time() - started)
        cpu_s = time.process_time() - started
        return Run(sim.snapshot(), "yes" if stats.converged else "no", stats.stable,
                   stats.iterations, cpu_s)


def close_by_baseline(program: Path, subject: Subject, element: str, method: str, level: int,
                      tolerance: float) -> Run:
    """The same by a baseline at its best."""
    with mvs.Simulator() as sim, tempfile.TemporaryDirectory() as folder:
        subject.prepare(element, level)(sim)
        sim.set_load(subject.pressure_pa)
        opened, closed = Path(folder) / "open.obj", Path(folder) / "closed.obj"
        sim.snapshot().save(opened)
        told = subprocess.run([program, method, "--valve", opened, "--residual", str(tolerance),
                               "-o", closed], check=True, capture_output=True, text=True).stdout
        found = next(csv.DictReader(told.splitlines()))
        with warnings.catch_warnings():  # sheets that cross are a result here
            warnings.simplefilter("ignore", mvs.ValveWarning)
            sim.load(closed)
        return Run(sim.snapshot(), "diverged" if found["diverged"] == "yes" else found["converged"],
                   found["stable"] == "yes", int(found["steps"]), float(found["cpu_s"]),
                   found["settings"])


def run(subject: Subject, element: str, solver: str, level: int, tolerance: float,
        program: Path = PROGRAM) -> dict:
    """One closure and its row."""
    if solver in BASELINES:
        found = close_by_baseline(program, subject, element, solver, level, tolerance)
    else:
        found = close(subject, element, solver, level, tolerance)
    row = dict.fromkeys(COLUMNS, "")
    row |= {"valve": subject.name, "element": element, "solver": solver,
            "vertices": len(np.unique(found.closed.triangle_nodes)), "tolerance_N": tolerance,
            "converged": found.verdict, "stable": "yes" if found.stable else "no",
            "iterations": found.iterations, "cpu_s": found.cpu_s, "settings": found.settings}
    if found.verdict != "diverged":
        row |= errors("error", found.closed, subject.finest.get(element))
        row |= errors("other", found.closed, subject.other)
        row["crossings"] = found.closed.measures.intersections
    return row


def errors(name: str, closed: mvs.Snapshot, goal: Optional[mvs.Snapshot]) -> dict[str, float]:
    """RMS and largest distance from a shape, if there is one."""
    if goal is None:
        return {}
    found = closed.compare(goal)
    return {f"{name}_rms_mm": found.surface_rms * 1e3, f"{name}_max_mm": found.surface_max * 1e3}


def rows_of(subject: Subject, long: bool, program: Path) -> Iterator[dict]:
    """Every run of a valve; baselines only where they take minutes, not hours."""
    for level in range(subject.levels):
        for element in subject.elements:
            for solver in SOLVERS:
                for tolerance in TOLERANCES:
                    yield run(subject, element, solver, level, tolerance)
            for method in BASELINES if program.exists() else ():
                if level > int(long) + (method != "explicit"):
                    continue
                for tolerance in TOLERANCES[int(level > 0):2]:
                    yield run(subject, element, method, level, tolerance, program)


def write(rows: list[dict], path: Path) -> None:
    """The table, with times beside the fastest of the same valve that came to rest."""
    for row in rows:
        at_rest = [r["cpu_s"] for r in rows
                   if r["valve"] == row["valve"] and r["converged"] == "yes"]
        row["times_fastest"] = row["cpu_s"] / min(at_rest) if at_rest else ""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.4g}" if isinstance(v, float) else v
                             for k, v in row.items()})


def main() -> None:
    """Runs the grid, prints each row as it comes, writes table and picture."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--long", action="store_true",
                        default=bool(os.environ.get("MVS_TEST_LONG")),
                        help="one level more, and the baselines, too")
    parser.add_argument("--valves", default="shipped,healthy,febio", metavar="NAMES",
                        help="of shipped, healthy, febio, texas [shipped,healthy,febio]")
    parser.add_argument("--baseline", type=Path, default=PROGRAM, metavar="PROGRAM",
                        help="bench_baseline [build/release/bin/bench_baseline]")
    parser.add_argument("--out", type=Path, default=Path("out/time_error"), metavar="DIR")
    arguments = parser.parse_args()
    if not arguments.baseline.exists():
        print(f"{arguments.baseline} is missing: without baselines; build bench_baseline")
    arguments.out.mkdir(parents=True, exist_ok=True)
    shown = ("valve", "element", "solver", "vertices", "tolerance_N", "converged", "stable",
             "iterations", "cpu_s", "error_rms_mm", "other_rms_mm", "crossings")
    print(" ".join(f"{name:>12}" for name in shown))
    rows: list[dict] = []
    for name in arguments.valves.split(","):
        subject = SUBJECTS[name](LEVELS[name] + int(arguments.long))
        for row in rows_of(subject, arguments.long, arguments.baseline):
            rows.append(row)
            print(" ".join(f"{v:12.4g}" if isinstance(v := row[k], float) else f"{v:>12}"
                           for k in shown), flush=True)
            write(rows, arguments.out / "time_error.csv")
    draw(rows, arguments.out / "time_error.png")


if __name__ == "__main__":
    main()
