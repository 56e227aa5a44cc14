"""The tables of the Texas valve: by level and solver, by part of the model, stress, spread.

The command is `python tests/validation/texas.py`; a table is a list of rows, printed and written as
CSV. Lengths in mm, areas in mm2, times in seconds of CPU.
"""

from __future__ import annotations

import argparse
import csv
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Optional

import mvs
import numpy as np
from texas import (
    CLOSED_FRAME, LEAFLETS, MIDDLE_FRAME, MM, PRESSURE, AbaqusFrame, Errors, Result, close,
    data_folder, distances, errors_of, mesh_vertices, open_valve, read_frame, split_other_way,
    triangle_of_quad,
)

Row = dict[str, Any]
Change = Callable[[mvs.Valve], None]

LEVELS = (800, 1500)
LONG_LEVELS = (4000, None)
"""None is the full mesh of 8,587 vertices"""
SOLVERS = ("newton", "implicit")
PART_LEVEL = 1500
"""vertices: where parts of the model are changed, and where the spread is"""


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


class Study:
    """The data, the settings and the closures that more than one table needs."""

    def __init__(self, folder: Path, out: Path, long: bool, paths: int) -> None:
        self.folder, self.out, self.long, self.paths = folder, out, long, paths
        self.frame = read_frame(folder, CLOSED_FRAME)
        self.finest: Optional[Result] = None

    def levels(self) -> Iterator[Row]:
        """Every level with every solver, and how far Abaqus' own frames are from each other."""
        for vertices in LEVELS + (LONG_LEVELS if self.long else ()):
            opened = open_valve(self.folder, vertices)
            for solver in SOLVERS:
                result = close(opened, self.frame, solver)
                if solver == "newton":
                    self.finest = result
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
            options = dict(options)
            level = options.pop("vertices", PART_LEVEL)
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
        spread = opened.spread(PRESSURE, paths=self.paths)
        for k, path in enumerate(spread.paths):
            row: Row = {"path": k, "at rest": "yes" if path.converged else "no",
                        "from path 0, RMS": path.node_rms * MM,
                        "from path 0, max": path.node_max * MM}
            if path.converged:
                row |= error_columns(errors_of(spread.snapshot(k), self.frame))
            yield row
        summary = spread.summary
        yield {"path": "any two", "at rest": f"{summary.converged} of {summary.paths}",
               "from path 0, RMS": summary.node_rms * MM,
               "from path 0, max": summary.node_max * MM}

    def stress(self) -> Iterator[Row]:
        """Largest principal stress on the full mesh, beside that of the shells of Abaqus."""
        result = self.finest
        if result is None or mesh_vertices(result.closed) < len(self.frame.points):
            result = close(open_valve(self.folder), self.frame)
        ours = stress_of_quads(result.closed, self.frame)
        near = near_everywhere(result.errors, self.frame, 0.5e-3)
        touching = self.frame.contact[self.frame.quads].any(axis=1)
        for title, chosen in (("all", np.ones(len(ours), bool)), ("not in contact", ~touching),
                              ("in contact", touching),
                              ("not in contact, nodes within 0.5 mm", ~touching & near)):
            yield {"shells": title, **stress_columns(ours, self.frame.stress, chosen)}
        for k, name in enumerate(LEAFLETS):
            chosen = ~touching & (self.frame.quad_leaflet == k)
            yield {"shells": f"not in contact, {name}",
                   **stress_columns(ours, self.frame.stress, chosen)}

    def pictures(self) -> Iterator[Row]:
        """Maps and histogram of the finest closure by Newton that was made."""
        from texas_pictures import draw

        result = self.finest or close(open_valve(self.folder, PART_LEVEL), self.frame)
        for path in draw(result, self.frame, self.out):
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


def variants(frame: AbaqusFrame) -> Iterable[tuple[str, dict[str, Any]]]:
    """What is changed, one thing at a time: arguments of open_valve and of close."""
    yield "nothing", {}
    yield "mesh: 1,450 vertices", {"vertices": 1450}
    yield "mesh: 1,550 vertices", {"vertices": 1550}
    yield "mesh: quads cut along the other diagonal", {"change_mesh": split_other_way(frame)}
    yield "solver: implicit", {"solver": "implicit"}
    yield "path: 2 increments", {"increments": 2}
    yield "path: 8 increments", {"increments": 8}
    for thickness in (0.1e-3, 0.4e-3, 0.65e-3):
        yield (f"contact thickness {thickness * MM:g} mm (0.234)",
               {"change": setting("contact_thickness", lambda _, t=thickness: t)})
    for factor in (0.25, 4):
        yield (f"contact stiffness x {factor:g}",
               {"change": setting("contact_stiffness", lambda old, f=factor: f * old)})
    for scale in (0.0, 4.0, 10.0):
        yield (f"bending scale {scale:g} (1)",
               {"change": setting("bending_scale", lambda _, s=scale: s)})
    yield "chordae: no slack", {"change": taut}
    yield "chordae: linear, 40 MPa", {"change": linear_chordae}
    yield "leaflets: neo-Hookean, same modulus at rest", {"change": neo_hookean}
    yield "leaflets: bilinear membrane", {"change": lawful(mvs.LeafletLaw.BILINEAR)}
    yield "leaflets: bilinear springs", {"change": lawful(mvs.LeafletLaw.SPRING)}
    yield "founding model: springs, linear chordae", {"change": founding}


def setting(name: str, value: Callable[[float], float]) -> Change:
    """A constant of the valve made another one."""
    return lambda valve: setattr(valve, name, value(getattr(valve, name)))


def taut(valve: mvs.Valve) -> None:
    """No chord is longer at rest than the distance of its ends."""
    ends = valve.nodes[valve.chord_nodes]
    straight = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    valve.chord_rest_length = np.minimum(valve.chord_rest_length, straight)


def linear_chordae(valve: mvs.Valve) -> None:
    """The founding paper's chordae, of 40 MPa, with the areas of the file."""
    count = len(valve.chord_nodes)
    valve.chord_law = np.full(count, mvs.ChordLaw.LINEAR, dtype=np.uint32)
    valve.chord_young = np.full(count, 40e6)
    valve.chord_constants = None


def neo_hookean(valve: mvs.Valve) -> None:
    """W = mu / 2 (I1 - 3) with mu = C0: the exponential of the file's law adds nothing at rest."""
    valve.leaflets = [
        replace(leaflet, law=mvs.LeafletLaw.NEO_HOOKEAN, constants=leaflet.constants[:1])
        for leaflet in valve.leaflets
    ]


def lawful(law: mvs.LeafletLaw) -> Change:
    """Leaflets of a law with its default constants, which the founding paper has: no tissue's."""

    def change(valve: mvs.Valve) -> None:
        valve.leaflets = [replace(each, law=law, constants=()) for each in valve.leaflets]

    return change


def founding(valve: mvs.Valve) -> None:
    """Springs and linear chordae, everything else as in the file."""
    lawful(mvs.LeafletLaw.SPRING)(valve)
    linear_chordae(valve)


def stress_of_quads(closed: mvs.Snapshot, frame: AbaqusFrame) -> np.ndarray:
    """(q,), Pa: the largest principal stress of each quad, the mean of its two triangles."""
    stress = closed.triangle_stress[:, 0]
    return np.bincount(triangle_of_quad(frame, closed), stress) / 2


def near_everywhere(errors: Errors, frame: AbaqusFrame, limit: float) -> np.ndarray:
    """(q,): quads none of whose corners is farther than `limit` from its place in the frame."""
    return (errors.distance[frame.quads] <= limit).all(axis=1)


def stress_columns(ours: np.ndarray, theirs: np.ndarray, chosen: np.ndarray) -> Row:
    """How two fields of stress compare: medians in kPa, ratio, correlation, ranks."""
    a, b = ours[chosen], theirs[chosen]
    ranks = [np.argsort(np.argsort(values)) for values in (a, b)]
    return {
        "count": int(chosen.sum()), "ours kPa": np.median(a) / 1e3,
        "Abaqus kPa": np.median(b) / 1e3, "median ratio": float(np.median(a[b > 0] / b[b > 0])),
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
    "parts": f"one part of the model changed at a time, {PART_LEVEL} vertices",
    "spread": f"closures along several paths, {PART_LEVEL} vertices",
    "stress": "largest principal Cauchy stress, full mesh",
    "pictures": "written",
}


def main() -> None:
    """Prints every table, or those asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, default=data_folder(), metavar="DIR")
    parser.add_argument("--out", type=Path, default=Path("out/texas"), metavar="DIR")
    parser.add_argument("--only", default=",".join(TITLES), metavar="LIST",
                        help="tables, with commas: levels,parts,spread,stress,pictures [all]")
    parser.add_argument("--paths", type=int, default=4, metavar="N", help="of the spread [4]")
    parser.add_argument("--long", action="store_true",
                        help="also 4,000 vertices and the full mesh, and stress, which needs it")
    arguments = parser.parse_args()
    if not (arguments.data / "Healthy_QuasiStatic.inp").is_file():
        print(f"skipped: no Texas valve in {arguments.data} (--data, or set MVS_TEST_DATA)")
        return
    study = Study(arguments.data, arguments.out, arguments.long, arguments.paths)
    for name in arguments.only.split(","):
        if name not in TITLES:
            parser.error(f"no table is called {name!r}: there are {', '.join(TITLES)}")
        if name == "stress" and not arguments.long:
            print("\nstress: left out, it needs the full mesh (--long)")
            continue
        print_table(f"{name}: {TITLES[name]}", getattr(study, name)(), arguments.out)
