"""Run time against error: which element, solver, mesh and tolerance buy what.

Every run closes a valve from open, alone in this process, one after the other in the order of the
table. Times are CPU time of the process (the machine may be shared), of the closure only. Error:
distance of the closed surface, both ways, from the finest level of the same element (closed level
by level, so that refining does not change folds; tests/validation/convergence.py), and from the
shape of another model: FEBio's, Abaqus's, and of the shipped valve the finest membrane, which
tells what springs cost. The explicit method steps by 8 us on the coarsest mesh and half of it on
the next, and by half of that again, up to three times, where it diverges; the time is that of the
run shown.

    python tests/bench/time_error.py [--long] [--valves shipped,febio,texas] [--out DIR]

writes DIR/time_error.csv and DIR/time_error.png. 2 min of CPU; --long: one level more, much longer.
Texas, where it is named, takes minutes more. Needs matplotlib.
"""

from __future__ import annotations

import argparse
import csv
import os
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Iterator, Optional

import mvs
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "validation"))
import convergence  # noqa: E402
import febio  # noqa: E402

ELEMENTS = ("spring", "bilinear")
SOLVERS = ("newton", "implicit", "explicit")
TOLERANCES = (1e-1, 1e-3, 1e-5)
STEPS = {"newton": 600, "implicit": 4000, "explicit": 60000}
"""limits after which a run stops; its `converged` is then `no`"""

COLUMNS = ("valve", "element", "solver", "dt_us", "vertices", "tolerance_N", "converged",
           "iterations", "cpu_s", "times_fastest", "error_rms_mm", "error_max_mm", "other_rms_mm",
           "other_max_mm", "crossings")


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


def finest_of(make: Callable[[mvs.Simulator], None], levels: int) -> dict[str, mvs.Snapshot]:
    """The closed finest level of each element: one finer than those that are timed."""
    found = {}
    for law in ELEMENTS:
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
LEVELS = {"shipped": 2, "febio": 1, "texas": 1}
SUBJECTS = {"shipped": shipped, "febio": febio_case, "texas": texas_case}


@dataclass
class Run:
    """A closure from open: its shape, whether it is at rest, and its cost."""

    closed: mvs.Snapshot
    verdict: str
    iterations: int
    cpu_s: float


def close(subject: Subject, element: str, solver: str, level: int, tolerance: float,
          dt: Optional[float]) -> Run:
    """One closure, stopped after so many steps."""
    with mvs.Simulator() as sim:
        subject.prepare(element, level)(sim)
        sim.set_load(subject.pressure_pa)
        steps = STEPS[solver] * (2**level if solver == "explicit" else 1)
        verdict, iterations, started = "diverged", 0, time.process_time()
        try:
            stats = sim.settle(solver=solver, residual=tolerance, dt=dt, max_iterations=steps)
            verdict, iterations = ("yes" if stats.converged else "no"), stats.iterations
        except mvs.DivergedError:
            pass
        cpu_s = time.process_time() - started
        return Run(sim.snapshot(), verdict, iterations, cpu_s)


def run(subject: Subject, element: str, solver: str, level: int, tolerance: float) -> dict:
    """One closure and its row."""
    dt = 8e-6 / 2**level if solver == "explicit" else None
    found = close(subject, element, solver, level, tolerance, dt)
    for _ in range(3):
        if dt is None or found.verdict != "diverged":
            break
        dt /= 2
        found = close(subject, element, solver, level, tolerance, dt)
    row = dict.fromkeys(COLUMNS, "")
    row |= {"valve": subject.name, "element": element, "solver": solver, "dt_us": (dt or 0) * 1e6,
            "vertices": len(np.unique(found.closed.triangle_nodes)), "tolerance_N": tolerance,
            "converged": found.verdict, "iterations": found.iterations, "cpu_s": found.cpu_s}
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


def rows_of(subject: Subject, long: bool) -> Iterator[dict]:
    """Every run of a valve; the explicit method only where it takes minutes, not hours."""
    for level in range(subject.levels):
        for element in subject.elements:
            for solver in SOLVERS:
                if solver == "explicit" and level > int(long):
                    continue
                for tolerance in TOLERANCES[: 2 if solver == "explicit" and not long else 3]:
                    yield run(subject, element, solver, level, tolerance)


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


COLOURS = {"newton": "#1b6ca8", "implicit": "#e08e0b", "explicit": "#b3262e"}
MARKERS = {"spring": "o", "bilinear": "s", "fung": "D"}


def draw(rows: list[dict], path: Path) -> None:
    """Error over time, a panel a valve; larger markers are finer meshes, hollow ones crossed."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    valves = list(dict.fromkeys(row["valve"] for row in rows))
    figure, axes = plt.subplots(1, len(valves), figsize=(6 * len(valves), 5.6), squeeze=False)
    for ax, valve in zip(axes[0], valves):
        _draw_valve(ax, valve, [r for r in rows if r["valve"] == valve and r["converged"] == "yes"])
    handles = [plt.Line2D([], [], color=c, marker="o", ls="", label=s) for s, c in COLOURS.items()]
    handles += [plt.Line2D([], [], color="#555555", marker=MARKERS[e], ls="", label=name)
                for e, name in (("spring", "springs"), ("bilinear", "membrane"), ("fung", "Fung"))
                if any(r["element"] == e for r in rows)]
    handles.append(plt.Line2D([], [], color="#555555", marker="o", ls="", mfc="none",
                              label="crosses itself"))
    figure.legend(handles=handles, loc="lower center", ncols=3 * len(valves), frameon=False)
    figure.tight_layout(rect=(0, 0.1 if len(valves) == 1 else 0.06, 1, 1))
    figure.savefig(path, dpi=130)
    plt.close(figure)


def _draw_valve(ax: Any, name: str, rows: list[dict]) -> None:
    """The runs of one valve that came to rest."""
    from matplotlib.ticker import LogLocator

    own = any(row["error_rms_mm"] for row in rows)
    sizes = sorted({row["vertices"] for row in rows})
    for row in rows:
        colour = COLOURS[row["solver"]]
        ax.scatter(row["cpu_s"], row["error_rms_mm" if own else "other_rms_mm"],
                   s=40 + 90 * sizes.index(row["vertices"]), marker=MARKERS[row["element"]],
                   linewidths=1.4, edgecolors=colour, alpha=0.75,
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
                        help="one level more, and the explicit method on two")
    parser.add_argument("--valves", default="shipped,febio", metavar="NAMES",
                        help="of shipped, febio, texas [shipped,febio]")
    parser.add_argument("--out", type=Path, default=Path("out/time_error"), metavar="DIR")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    shown = ("valve", "element", "solver", "vertices", "tolerance_N", "converged", "iterations",
             "cpu_s", "error_rms_mm", "other_rms_mm", "crossings")
    print(" ".join(f"{name:>12}" for name in shown))
    rows: list[dict] = []
    for name in arguments.valves.split(","):
        subject = SUBJECTS[name](LEVELS[name] + int(arguments.long))
        for row in rows_of(subject, arguments.long):
            rows.append(row)
            print(" ".join(f"{v:12.4g}" if isinstance(v := row[k], float) else f"{v:>12}"
                           for k in shown), flush=True)
            write(rows, arguments.out / "time_error.csv")
    draw(rows, arguments.out / "time_error.png")


if __name__ == "__main__":
    main()
