"""A real tricuspid valve, closed by libmvs and compared node by node with Abaqus/Explicit.

The valve is the healthy Texas TriValve 1.1 (CC BY 4.0, github SoftTissueBiomechanicsLab; Mathur et
al. 2022, 10.1007/s00366-022-01659-w): an input file and three result frames of its own mesh. This
file reads and compares; `texas_tables.py` says what is changed and prints it. Run it to print
every table and to write the pictures:

    python tests/validation/texas.py [--long] [--only levels,...] [--data DIR] [--out DIR]
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Callable, Optional

import mvs
import numpy as np

FOLDER = "texas_trivalve_1.1_healthy"
INPUT = "Healthy_QuasiStatic.inp"
LEAFLETS = ("Posterior", "Anterior", "Septal")
"""in the order of `element_sets` 1 to 3 of the frames, which is not that of the input"""
CLOSED_FRAME, MIDDLE_FRAME, OPEN_FRAME = 20, 10, 0

PRESSURE = 3060.0
"""Pa: the pressure of the input file"""

MM = 1e3

Change = Callable[[mvs.Valve], None]
"""A change of the arrays of a valve before it is set."""


def data_folder() -> Path:
    """Where the valve is searched for."""
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    return Path(os.environ.get("MVS_TEST_DATA", default)) / FOLDER


@dataclass(frozen=True)
class AbaqusFrame:
    """A result frame of Abaqus: its n leaflet nodes in the order of the file, and its q shells.

    points: (n, 3), m; quads: (q, 4); leaflet: (n,) and quad_leaflet: (q,), rows of LEAFLETS;
    stress: (q,), Pa, the largest principal one, or None; contact: (n,), True where nodes touch
    """

    points: np.ndarray
    quads: np.ndarray
    leaflet: np.ndarray
    quad_leaflet: np.ndarray
    stress: Optional[np.ndarray]
    contact: Optional[np.ndarray]


@cache
def read_frame(folder: Path, number: int = CLOSED_FRAME) -> AbaqusFrame:
    """Frame 0 (open), 10 or 20 (closed) of the folder; needs pyvista.

    The nodes of the frame are those of the input: shells first, then the inner points of chordae,
    which the import merges and which are left out here.
    """
    import pyvista

    grid = pyvista.read(folder / f"Healthy_QuasiStatic_{number}.vtu")
    quads = np.asarray(grid.cells).reshape(-1, 5)[:, 1:]
    count = int(quads.max()) + 1
    of_quad = np.asarray(grid.cell_data["element_sets"]).astype(int) - 1
    leaflet = np.zeros(count, dtype=int)
    for k in range(4):
        leaflet[quads[:, k]] = of_quad
    stress, contact = (
        np.asarray(data[name], dtype=float) * unit if name in data else None
        for data, name, unit in (
            (grid.cell_data, "Max_Princ_Stress_(MPa)", 1e6),
            (grid.point_data, "Contact_Boolean", 1),
        )
    )
    points = np.asarray(grid.points, dtype=float)[:count] / MM
    touches = None if contact is None else contact[:count] > 0.5
    return AbaqusFrame(points, quads, leaflet, of_quad, stress, touches)


def open_valve(
    folder: Path,
    vertices: Optional[int] = None,
    change: Optional[Change] = None,
    change_mesh: Optional[Change] = None,
) -> mvs.Snapshot:
    """The valve of the input file, open; with about so many leaflet vertices, None: all 8,587.

    `change` is given the arrays of the level and may change its tissue, `change_mesh` those of the
    full mesh before it is made coarser.
    """
    with mvs.Simulator() as sim:
        sim.load(folder / INPUT)
        if change_mesh is not None:
            _set_changed(sim, change_mesh)
        if vertices is not None and vertices < mesh_vertices(sim.snapshot()):
            sim.coarsen(vertices=vertices)
        if change is not None:
            _set_changed(sim, change)
        return sim.snapshot()


def _set_changed(sim: mvs.Simulator, change: Change) -> None:
    valve = mvs.valve_of(sim.snapshot())
    valve.nodes_now = None
    change(valve)
    sim.set_valve(valve)


def shape_of(frame: AbaqusFrame, opened: mvs.Snapshot) -> mvs.Snapshot:
    """The full valve with its leaflets where a frame has them, under the whole load, to measure.

    Chordae keep their ends at the heads; inner branch points are not where Abaqus has them.
    """
    valve = mvs.valve_of(opened)
    valve.nodes_now = np.array(valve.nodes_loaded)
    valve.nodes_now[: len(frame.points)] = frame.points
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        sim.set_load(PRESSURE)
        return sim.snapshot()


def touching(snapshot: mvs.Snapshot) -> np.ndarray:
    """(n,): nodes on which contact presses."""
    return np.any(snapshot.node_contact_force != 0, axis=1)


def mesh_vertices(snapshot: mvs.Snapshot) -> int:
    """How many vertices the leaflets have."""
    return len(np.unique(snapshot.triangle_nodes))


def kept_nodes(snapshot: mvs.Snapshot, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the snapshot whose node is one of the first `count` of the file, and which one."""
    rows = np.unique(snapshot.triangle_nodes)
    origin = snapshot.node_origin[rows].astype(np.int64)
    kept = origin < count
    return rows[kept], origin[kept]


@dataclass
class Errors:
    """Distances between two shapes at the nodes that both have, in m."""

    nodes: int
    rms: float
    max: float
    median: float
    p95: float
    leaflet_rms: dict[str, float]
    distance: np.ndarray = field(repr=False)
    """(n,), in the order of the frame, nan where a node was not kept"""


def distances(points: np.ndarray, origin: np.ndarray, frame: AbaqusFrame) -> Errors:
    """The distances of points from nodes `origin` of a frame."""
    d = np.linalg.norm(points - frame.points[origin], axis=1)
    leaflet = frame.leaflet[origin]
    everywhere = np.full(len(frame.points), np.nan)
    everywhere[origin] = d
    by_leaflet = {name: _rms(d[leaflet == k]) for k, name in enumerate(LEAFLETS)}
    median, p95 = (float(np.percentile(d, share)) for share in (50, 95))
    return Errors(len(d), _rms(d), float(d.max()), median, p95, by_leaflet, everywhere)


def errors_of(snapshot: mvs.Snapshot, frame: AbaqusFrame) -> Errors:
    """How far a closed valve of the file, or a coarser level of it, is from a frame."""
    rows, origin = kept_nodes(snapshot, len(frame.points))
    return distances(snapshot.node_position[rows], origin, frame)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


@dataclass
class Result:
    """A closure, its cost, and its distance from the closed frame of Abaqus."""

    closed: mvs.Snapshot
    stats: mvs.Stats
    iterations: int
    cpu_s: float
    errors: Errors


def close(
    opened: mvs.Snapshot, frame: AbaqusFrame, solver: str = "newton", increments: int = 1
) -> Result:
    """Closes an open valve under the file's pressure, boundary and pressure in equal increments."""
    with mvs.Simulator() as sim:
        sim.restore(opened)
        started, iterations = time.process_time(), 0
        for k in range(1, increments + 1):
            sim.set_load(PRESSURE * k / increments, k / increments)
            stats = sim.settle(solver=solver)
            iterations += stats.iterations
        cpu = time.process_time() - started
        closed = sim.snapshot()
    return Result(closed, stats, iterations, cpu, errors_of(closed, frame))


def triangle_of_quad(frame: AbaqusFrame, snapshot: mvs.Snapshot) -> np.ndarray:
    """(m,): which quad of the frame each triangle of the full mesh is half of.

    The import keeps the order of the file and cuts each quad in two; anything else is refused.
    """
    quad = np.repeat(np.arange(len(frame.quads)), 2)
    if len(quad) != len(snapshot.triangle_nodes):
        raise ValueError("this is not the full mesh: it has not two triangles a quad")
    inside = np.isin(snapshot.triangle_nodes.astype(np.int64) + 10**6 * quad[:, None],
                     frame.quads[quad] + 10**6 * quad[:, None])
    if not inside.all():
        raise ValueError("the triangles are not in the order of the quads")
    return quad


def split_other_way(frame: AbaqusFrame) -> Change:
    """A change of the full mesh: every quad is cut along its other diagonal."""

    def change(valve: mvs.Valve) -> None:
        pairs = valve.triangles.reshape(-1, 2, 3)
        for first, second in pairs:
            # first = (a, s, t) and second = (b, t, s) in some rotation; (a, s, b) and (b, t, a)
            k = next(k for k in range(3) if first[k] not in second)
            a, s, t = first[k], first[(k + 1) % 3], first[(k + 2) % 3]
            b = next(node for node in second if node not in first)
            first[:], second[:] = (a, s, b), (b, t, a)

    return change


if __name__ == "__main__":
    from texas_tables import main

    main()
