"""The tables of the Texas valve: by level and solver, by part of the model, stress, spread.

The command is `python tests/validation/texas.py`; a table is a list of rows, printed and written as
CSV. Lengths in mm, areas in mm2, times in seconds of CPU.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path
from typing import Any, Iterable, Iterator, Optional

import mvs
import numpy as np
from texas import (
    CLOSED_FRAME, INPUT, LEAFLETS, MIDDLE_FRAME, MM, PRESSURE, AbaqusFrame, Errors, Result, close,
    data_folder, distances, errors_of, kept_nodes, mesh_vertices, open_valve, read_frame, shape_of,
    touching, triangle_of_quad,
)
from texas_parts import variants

Row = dict[str, Any]

LEVELS = (800, 1500)
LONG_LEVELS = (4000, None)
"""None is the full mesh of 8,587 vertices"""
SOLVERS = ("newton", "implicit")
PART_LEVEL = 1500
"""vertices: where parts of the model are changed, and where the ensemble is run"""


def error_columns(errors: Errors) -> Row:
    """The columns of a distance."""
    row: Row = {"RMS": errors.rms * MM, "max": errors.max * MM, "median": errors.median * MM,
                "p95": errors.p95 * MM}
    return row | {name: errors.leaflet_rms[name] * MM for name in LEAFLETS}


def result_columns(result: Result) -> Row:
    """The columns of a closure."""
    measures = result.closed.measures
    return error_columns(result.errors) | {
        "iterations": result.iterations, "CPU s": result.cpu_s,
        "at rest": "yes" if result.stats.converged else "no",
        "residual N": f"{result.stats.residual:.0e}",
        "crossings": measures.intersections,
        "orifice": measures.regurgitant_orifice_area * 1e6,
    }


def measure_columns(shape: mvs.Snapshot) -> Row:
    """The measures of a closed shape."""
    found = shape.measures
    return {"crossings": found.intersections, "orifice": found.regurgitant_orifice_area * 1e6,
            "coaptation": found.coaptation_area * 1e6, "leaflet area": found.leaflet_area * 1e6,
            "tenting": found.tenting_height * MM}


class Study:
    """The data, the settings and the closures that several tables share."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.folder, self.out, self.paths = options.data, options.out, options.paths
        self.mesh_levels, self.solvers = options.levels, options.solvers
        self.parts_named, self.part_level = options.parts, options.part_level
        self.frame = read_frame(self.folder, CLOSED_FRAME)
        self.by_newton: list[Result] = []
        """closures of finer and finer levels"""

    def levels(self) -> Iterator[Row]:
        """Every level with every solver, and how far Abaqus' own frames are from each other."""
        for vertices in self.mesh_levels:
            opened = open_valve(self.folder, vertices)
            for solver in self.solvers:
                result = close(opened, self.frame, solver)
                if solver == "newton":
                    self.by_newton.append(result)
                yield {"vertices": mesh_vertices(opened), "solver": solver,
                       **result_columns(result)}
        middle = read_frame(self.folder, MIDDLE_FRAME)
        count = len(middle.points)
        between = distances(middle.points, np.arange(count), self.frame)
        yield {"vertices": count, "solver": "Abaqus, frame 10", **error_columns(between)}

    def parts(self) -> Iterator[Row]:
        """One part of the model changed at a time; `moved` is how far that moves the closed valve."""
        reference: Optional[Result] = None
        for title, options in variants(self.frame):
            if not (reference is None or self.parts_named in title):
                continue
            level = options.pop("vertices", self.part_level)
            solver = options.pop("solver", "newton")
            increments = options.pop("increments", 1)
            opened = open_valve(self.folder, level, **options)
            result = close(opened, self.frame, solver, increments)
            reference = reference or result
            yield {"changed": title, "moved": moved(result, reference, self.frame) * MM,
                   **result_columns(result)}

    def spread(self) -> Iterator[Row]:
        """Closures along several paths: the error of each beside how far they are apart."""
        opened = open_valve(self.folder, PART_LEVEL)
        ensemble = opened.ensemble(PRESSURE, members=self.paths)
        for k, path in enumerate(ensemble.members):
            row: Row = {"path": k, "at rest": "yes" if path.converged else "no",
                        "from path 0, RMS": path.node_rms * MM,
                        "from path 0, max": path.node_max * MM}
            if path.converged:
                row |= error_columns(errors_of(ensemble.snapshot(k), self.frame))
            yield row
        summary = ensemble.summary
        yield {"path": "any two", "at rest": f"{summary.converged} of {summary.members}",
               "from path 0, RMS": summary.node_rms * MM,
               "from path 0, max": summary.node_max * MM}

    def closures(self) -> list[Result]:
        """The closures by Newton; a new one, if none was made before."""
        if not self.by_newton:
            opened = open_valve(self.folder, self.mesh_levels[-1])
            self.by_newton.append(close(opened, self.frame))
        return self.by_newton

    def contact(self) -> Iterator[Row]:
        """Where leaflets touch and what that measures, ours by Newton and in Abaqus' frames.

        `both`: nodes that touch in both, as 2 |A and B| / (|A| + |B|) over the nodes kept.
        """
        opened = open_valve(self.folder)
        target = shape_of(self.frame, opened)
        for result in self.closures():
            closed = result.closed
            rows, origin = kept_nodes(closed, len(self.frame.points))
            own, other = touching(closed)[rows], self.frame.contact[origin]
            found = closed.compare(target)
            yield {"shape": f"ours, {mesh_vertices(closed)} vertices", "touching": own.mean(),
                   "both": 2 * np.sum(own & other) / (own.sum() + other.sum()),
                   **measure_columns(closed), "surface RMS": found.surface_rms * MM,
                   "surface max": found.surface_max * MM}
        for number in (MIDDLE_FRAME, CLOSED_FRAME):
            frame = read_frame(self.folder, number)
            yield {"shape": f"Abaqus, frame {number}", "touching": frame.contact.mean(),
                   **measure_columns(shape_of(frame, opened))}

    def stress(self) -> Iterator[Row]:
        """Largest principal stress: ours, what the frame reports, the law on the frame's shape.

        All are of shells of the full mesh. The third is our law, in the middle of the sheet, where
        Abaqus has its nodes: where it is not what the frame reports, the field is another one.
        """
        result = self.closures()[-1]
        opened = open_valve(self.folder)
        if mesh_vertices(result.closed) < len(self.frame.points):
            result = close(opened, self.frame)
        frame = self.frame
        ours = stress_of_quads(result.closed, frame)
        on_shape = stress_of_quads(shape_of(frame, opened), frame)
        pressed = frame.contact[frame.quads].any(axis=1)
        near = near_everywhere(result.errors, frame, 0.5e-3)
        places = {"in contact": pressed, "not in contact": ~pressed,
                  "not in contact, within 0.5 mm": ~pressed & near}
        for of, a, b in (("ours, reported", ours, frame.stress),
                         ("law on their shape, reported", on_shape, frame.stress),
                         ("ours, law on their shape", ours, on_shape)):
            for place, chosen in places.items():
                yield {"of": f"{of}: {place}", **stress_columns(a[chosen], b[chosen])}

    def pictures(self) -> Iterator[Row]:
        """Maps and histogram of the finest closure by Newton that was made."""
        from texas_pictures import draw

        for path in draw(self.closures()[-1], self.frame, self.out):
            yield {"picture": path}


def moved(result: Result, reference: Result, frame: AbaqusFrame) -> float:
    """RMS distance in m of two closures at the nodes of the file that both have."""
    own, other = (r.closed for r in (result, reference))
    as_frame = np.full_like(frame.points, np.nan)
    rows = np.unique(other.triangle_nodes)
    as_frame[other.node_origin[rows]] = other.node_position[rows]
    rows = np.unique(own.triangle_nodes)
    d = np.linalg.norm(own.node_position[rows] - as_frame[own.node_origin[rows]], axis=1)
    return float(np.sqrt(np.nanmean(d**2)))


def stress_of_quads(closed: mvs.Snapshot, frame: AbaqusFrame) -> np.ndarray:
    """(q,), Pa: the largest principal stress of each quad, the mean of its two triangles."""
    stress = closed.triangle_stress[:, 0]
    return np.bincount(triangle_of_quad(frame, closed), stress) / 2


def near_everywhere(errors: Errors, frame: AbaqusFrame, limit: float) -> np.ndarray:
    """(q,): quads none of whose corners is farther than `limit` from its place in the frame."""
    return (errors.distance[frame.quads] <= limit).all(axis=1)


def stress_columns(a: np.ndarray, b: np.ndarray) -> Row:
    """How two fields of stress compare: medians in kPa, median of the ratio, correlations."""
    ranks = [np.argsort(np.argsort(values)) for values in (a, b)]
    return {
        "count": len(a), "first kPa": np.median(a) / 1e3, "second kPa": np.median(b) / 1e3,
        "median ratio": float(np.median(a[b > 0] / b[b > 0])),
        "correlation": float(np.corrcoef(a, b)[0, 1]),
        "of ranks": float(np.corrcoef(*ranks)[0, 1]),
    }


def shown(value: Any) -> str:
    """A value in a table; lengths and times to three places."""
    return f"{value:.3f}" if isinstance(value, float) else str(value)


def print_table(title: str, rows: Iterable[Row], out: Path) -> None:
    """Prints rows as they come, and writes them as CSV when all are there."""
    print(f"\n{title}", flush=True)
    names: list[str] = []
    kept = []
    for row in rows:
        if not names:
            names = list(row)
            wide = {name: max(9, len(name)) for name in names} | {names[0]: 45}
            print("  ".join(f"{name:>{wide[name]}}" for name in names))
        kept.append(row)
        print("  ".join(f"{shown(row.get(n, '')):>{wide[n]}}" for n in names), flush=True)
    out.mkdir(parents=True, exist_ok=True)
    with open(out / f"{title.split(':')[0]}.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, names)
        writer.writeheader()
        writer.writerows(kept)


TITLES = {
    "levels": "distance from Abaqus' closed frame, mm, by level and solver",
    "parts": f"one part of the model changed at a time, on {PART_LEVEL} vertices or --part-level",
    "spread": f"closures along several paths, {PART_LEVEL} vertices",
    "contact": "where leaflets touch, mm and mm2",
    "stress": "largest principal Cauchy stress, full mesh",
    "pictures": "written",
}


def main() -> None:
    """Prints every table, or those asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, default=data_folder(), metavar="DIR")
    parser.add_argument("--out", type=Path, default=Path("out/texas"), metavar="DIR")
    parser.add_argument("--only", default=",".join(TITLES), metavar="LIST",
                        help="tables, with commas: levels,parts,spread,contact,stress,pictures [all]")
    parser.add_argument("--paths", type=int, default=4, metavar="N", help="of the spread [4]")
    parser.add_argument("--long", action="store_true",
                        help="also 4,000 vertices and the full mesh, and stress, which needs it")
    parser.add_argument("--levels", metavar="LIST", help="vertices of the levels, or `full`")
    parser.add_argument("--parts", default="", metavar="TEXT",
                        help="of the parts only those whose name contains this")
    parser.add_argument("--part-level", default=PART_LEVEL, metavar="N",
                        type=lambda text: None if text == "full" else int(text),
                        help="vertices on which parts are changed, or `full` [1500]")
    parser.add_argument("--solvers", default=",".join(SOLVERS), metavar="LIST")
    options = parser.parse_args()
    names = options.only.split(",")
    for name in set(names) - set(TITLES):
        parser.error(f"no table is called {name!r}: there are {', '.join(TITLES)}")
    options.solvers = options.solvers.split(",")
    options.levels = levels_of(options)
    if not (options.data / INPUT).is_file():
        print(f"skipped: no Texas valve in {options.data} (--data, or set MVS_TEST_DATA)")
        return
    study = Study(options)
    for name in names:
        if name == "stress" and None not in options.levels:
            print("\nstress: left out, it needs the full mesh (--long)")
        else:
            print_table(f"{name}: {TITLES[name]}", getattr(study, name)(), options.out)


def levels_of(options: argparse.Namespace) -> tuple[Optional[int], ...]:
    """The levels asked for, the finest last; None is the full mesh."""
    if options.levels:
        return tuple(None if each == "full" else int(each) for each in options.levels.split(","))
    return LEVELS + (LONG_LEVELS if options.long else ())
