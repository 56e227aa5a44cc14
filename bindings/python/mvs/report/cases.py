"""The valves of a report, each open and closed under systolic pressure."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

import mvs
from mvs import ChordKind, PartKind, Simulator, Snapshot, Stats

# the shipped valve stays sealed up to 1.25
DILATION = 1.3
ELONGATION = 1.25


@dataclass
class Case:
    """A valve of the report."""

    key: str
    title: str
    note: str
    opened: Snapshot
    closed: Snapshot
    stats: Stats

    @property
    def verdict(self) -> str:
        """The result of the closure in a few words."""
        return verdict(self.closed, self.stats)


def verdict(closed: Snapshot, stats: Stats) -> str:
    """The result of a closure in a few words: sealed, leaking, crossing, or not at rest."""
    measures = closed.measures
    if not (stats.converged and measures.at_rest):
        return "not at rest"
    if not measures.under_load:
        return "no load"
    if measures.intersections:
        return f"leaflets cross ({measures.intersections} pairs of triangles): its figures do not count"
    area = measures.regurgitant_orifice_area * 1e6
    return "sealed" if area == 0 else f"leaks through {area:.1f} mm²"


def close(sim: Simulator, key: str, title: str, note: str, pressure_pa: float) -> Case:
    """Settles the open valve in a simulator under a pressure."""
    opened = sim.snapshot()
    sim.set_load(pressure_pa)
    stats = sim.settle()
    return Case(key, title, note, opened, sim.snapshot(), stats)


def shipped(pressure_pa: float) -> Case:
    """The parametric valve with default dimensions."""
    with Simulator() as sim:
        sim.generate()
        note = "The parametric valve of libmvs with its default dimensions, those of an adult."
        return close(sim, "shipped", "Shipped valve", note, pressure_pa)


def leaking(pressure_pa: float) -> Case:
    """The shipped valve with its annulus dilated and one strut chord elongated."""
    with Simulator() as sim:
        sim.generate(annulus_scale=DILATION)
        opened = sim.snapshot()
        valve = mvs.valve_of(opened)
        row, name = strut_chord(opened)
        assert valve.chord_rest_length is not None
        valve.chord_rest_length[row] *= ELONGATION
        valve.name = "leaking"
        sim.set_valve(valve)
        note = (
            f"The same valve with its annulus dilated by {DILATION - 1:.0%} under load and the "
            f"strut chord {name} elongated by {ELONGATION - 1:.0%}."
        )
        return close(sim, "leaking", "Leaking variant", note, pressure_pa)


def from_file(path: Path, key: str, asked_pa: float | None = None) -> Case:
    """The valve of a file, closed from its open shape; the saved state is ignored.

    The pressure is the one given (Pa), else that of the load in the file, else 120 mmHg.
    """
    with Simulator() as sim:
        sim.load(path)
        saved = sim.snapshot()
        pressure_pa = asked_pa
        if pressure_pa is None:
            pressure_pa = saved.load_case.pressure or mvs.SYSTOLE_PA
        valve = mvs.valve_of(saved)
        valve.nodes_now = None
        sim.set_valve(valve)
        return close(sim, key, path.stem, f"Read from {path.name}.", pressure_pa)


def strut_chord(snapshot: Snapshot) -> tuple[int, str]:
    """The first strut chord: its row and its name."""
    rows = np.flatnonzero(snapshot.chord_kind == ChordKind.STRUT)
    if len(rows) == 0:
        raise mvs.IdError("the valve has no strut chord")
    names = [part.name for part in snapshot.parts if part.kind == PartKind.CHORD]
    return int(rows[0]), names[rows[0]]
