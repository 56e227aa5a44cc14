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
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Iterator, Optional

import mvs
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "validation"))
import convergence  # noqa: E402
import febio  # noqa: E402

ELEMENTS = ("spring", "bilinear")
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
class Subject:
    """A valve, how it is made at each level, and the reference for its closed shape."""

    name: str
    elements: tuple[str, ...]
    prepare: Callable[[str, int], Callable[[mvs.Simulator], None]]
    levels: int
    pressure_pa: float
    finest: dict[str, mvs.Snapshot]
    other: Optional[mvs.Snapshot]


def refined(
    make: Callable[[mvs.Simulator], None], law: str, level: int
) -> Callable[[mvs.Simulator], None]:
    """Prepares a valve, its law and its level."""

    def prepare(sim: mvs.Simulator) -> None:
        make(sim)
        if law != "spring":
            sim.set_leaflet(law=law)
        sim.refine(level)

    return prepare


def finest_of(make: Callable[[mvs.Simulator], None], levels: int,
              elements: tuple[str, ...] = ELEMENTS) -> dict[str, mvs.Snapshot]:
    """The closed finest level of each element: one finer than those that are timed."""
    found = {}
    for law in elements:
        closed = convergence.close_levels(refined(make, law, 0), levels + 1)
        if not closed[-1].stats.converged:
            print(f"the finest level of {law} is not at rest: {closed[-1].stats.residual:.1e} N")
        found[law] = closed[-1].closed
    return found


def shipped(levels: int) -> Subject:
    """The founding valve: 432 vertices, and refined."""
    def make(sim: mvs.Simulator) -> None:
        sim.generate(shape="founding")

    finest = finest_of(make, levels)
    return Subject("shipped", ELEMENTS, lambda law, k: refined(make, law, k), levels,
                   mvs.SYSTOLE_PA, finest, finest["bilinear"])


def healthy(levels: int) -> Subject:
    """The default parametric valve, a membrane: 432 vertices, and refined."""
    def make(sim: mvs.Simulator) -> None:
        sim.generate()

    finest = finest_of(make, levels, ("bilinear",))
    return Subject("healthy", ("bilinear",), lambda law, k: refined(make, law, k), levels,
                   mvs.SYSTOLE_PA, finest, finest["bilinear"])


def febio_case(levels: int) -> Subject:
    """The case that FEBio closed (tests/validation/febio.py): 468 vertices, and refined."""
    theirs = febio.Theirs(febio.data_file())
    springs = replace(febio.BASE, law=mvs.LeafletLaw.SPRING)

    def make(sim: mvs.Simulator) -> None:
        sim.set_valve(febio.read(theirs, springs))

    with mvs.Simulator() as sim:
        valve = febio.read(theirs, springs)
        valve.nodes_now = theirs.closed
        sim.set_valve(valve)
        other = sim.snapshot()
    return Subject("febio", ELEMENTS, lambda law, k: refined(make, law, k), levels,
                   mvs.SYSTOLE_PA, finest_of(make, levels), other)


TEXAS_VERTICES = (800, 1500, 4000, None)


def texas_case(levels: int) -> Subject:
    """The Texas valve (tests/validation/texas.py), coarsened, with its own law; and Abaqus's."""
    import texas

    folder = texas.data_folder()

    def prepare(law: str, level: int) -> Callable[[mvs.Simulator], None]:
        return lambda sim: sim.restore(texas.open_valve(folder, TEXAS_VERTICES[level]))

    with mvs.Simulator() as sim:
        frame = texas.read_frame(folder)
        valve = mvs.valve_of(texas.open_valve(folder))
        valve.nodes_now = valve.nodes.copy()
        valve.nodes_now[: len(frame.points)] = frame.points
        sim.set_valve(valve)
        other = sim.snapshot()
    return Subject("texas", ("fung",), prepare, min(levels + 1, len(TEXAS_VERTICES)),
                   texas.PRESSURE, {}, other)


# levels that are timed, without --long; FEBio's case folds in many ways and takes longer
LEVELS = {"shipped": 2, "healthy": 1, "febio": 1, "texas": 1}
SUBJECTS = {"shipped": shipped, "healthy": healthy, "febio": febio_case, "texas": texas_case}


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


COLOURS = {"newton": "#1b6ca8", "implicit": "#e08e0b", "explicit": "#b3262e",
           "viscous": "#3f8f4a", "kinetic": "#8b5fb0"}
NAMES = {"viscous": "relaxation, viscous", "kinetic": "relaxation, kinetic"}
MARKERS = {"spring": "o", "bilinear": "s", "fung": "D"}


def draw(rows: list[dict], path: Path) -> None:
    """Error over time, a panel a valve; larger markers are finer meshes, hollow ones crossed, and
    a cross is not at a stable rest."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    valves = list(dict.fromkeys(row["valve"] for row in rows))
    columns = len(valves) if len(valves) < 4 else 2
    lines = -(-len(valves) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(6 * columns, 0.8 + 4.8 * lines),
                                squeeze=False)
    for ax, valve in zip(axes.flat, valves):
        _draw_valve(ax, valve, [r for r in rows
                                if r["valve"] == valve and r["converged"] != "diverged"])
    handles = [plt.Line2D([], [], color=c, marker="o", ls="", label=NAMES.get(s, s))
               for s, c in COLOURS.items() if any(r["solver"] == s for r in rows)]
    handles += [plt.Line2D([], [], color="#555555", marker=MARKERS[e], ls="", label=name)
                for e, name in (("spring", "springs"), ("bilinear", "membrane"), ("fung", "Fung"))
                if any(r["element"] == e for r in rows)]
    handles.append(plt.Line2D([], [], color="#555555", marker="o", ls="", mfc="none",
                              label="crosses itself"))
    if any(row["converged"] == "no" for row in rows):
        handles.append(plt.Line2D([], [], color="#555555", marker="x", ls="",
                                  label="not at a stable rest"))
    rows_of_keys = 3 if columns == 1 else 2
    figure.legend(handles=handles, loc="lower center", ncols=-(-len(handles) // rows_of_keys),
                  frameon=False)
    figure.tight_layout(rect=(0, (0.3 + 0.25 * rows_of_keys) / figure.get_figheight(), 1, 1))
    figure.savefig(path, dpi=130)
    plt.close(figure)


def _draw_valve(ax: Any, name: str, rows: list[dict]) -> None:
    """The runs of one valve that did not diverge."""
    from matplotlib.ticker import LogLocator

    own = any(row["error_rms_mm"] for row in rows)
    sizes = sorted({row["vertices"] for row in rows})
    for row in rows:
        colour = COLOURS[row["solver"]]
        place = row["cpu_s"], row["error_rms_mm" if own else "other_rms_mm"]
        size = 40 + 90 * sizes.index(row["vertices"])
        if row["converged"] == "no":
            ax.scatter(*place, s=size, marker="x", linewidths=1.4, color=colour, alpha=0.75)
            continue
        ax.scatter(*place, s=size, marker=MARKERS[row["element"]], linewidths=1.4,
                   edgecolors=colour, alpha=0.75,
                   facecolors="none" if row["crossings"] else colour)
    goal = "its finest level" if own else "Abaqus"
    ax.set(xscale="log", yscale="log", xlabel="CPU time to close, s",
           ylabel=f"distance from {goal}, RMS, mm",
           title=f"{name}: {' and '.join(f'{size:,}' for size in sizes)} vertices")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("")
    ax.grid(True, which="both", alpha=0.25)
    ax.spines[["top", "right"]].set_visible(False)


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
