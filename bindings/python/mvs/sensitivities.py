"""Derivatives of a closed valve with labels: Snapshot.sensitivity and Simulator.sensitivity."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from .drawing.snapshots import Picture, need
from .errors import ArgumentError
from .kinds import PartKind
from .sensitivity_rows import SHORT, Asked, parameters, quantities, rows_of
from .tables import Table
from .words import did_you_mean, listed

Array = NDArray[np.float64]

MOTION, NO_TEST = 1, 4 | 8
"""Flags of mvs_sensitivity_options: also dx/dp; neither a test of both sides nor the margin."""
SHOWN = {"m": (1e3, "mm"), "m2": (1e6, "mm2"), "m3": (1e6, "ml"), "N": (1.0, "N"), "Pa": (1e-3, "kPa")}
"""Scale and unit that pictures show."""
NOTES = {
    1: "switch", 2: "chord", 4: "snap", 8: "differences", 16: "raster", 32: "extreme", 64: "envelope",
    128: "contact", 256: "kink", 512: "sides", 1024: "tied",
}
"""Words of MVS_SENSITIVITY_NOTE_*."""


@dataclasses.dataclass(frozen=True)
class Sensitivity:
    """Derivatives of quantities (rows) with respect to parameters (columns), SI units.

    of, to: labels of the rows and columns; of_units, to_units: their units
    value: (q,) of each quantity
    derivative: (q, p); above, below: (q, p) for a growing and a falling parameter, which differ from
        it only where a chord, a spring or contact is about to switch
    of_notes, to_notes: words about each row and column: "switch" (both sides differ within `slack`),
        "chord", "contact", "kink" (see above and below), "sides" (the forces confirm both), "snap",
        "differences", "raster" (see libmvs/measure/DEFINITIONS.md), "extreme", "tied" (two chordae share the largest value; the derivative is
        that of one of them), "envelope" (mvs/sensitivity.h)
    motion: (p, n, 3) dx/dp of all nodes, or None
    weak_contacts: vertices whose contact is about to switch
    smooth: no "switch", "chord", "contact", "kink" or "snap"
    """

    of: tuple[str, ...]
    to: tuple[str, ...]
    of_units: tuple[str, ...]
    to_units: tuple[str, ...]
    value: Array
    derivative: Array
    above: Array
    below: Array
    of_notes: tuple[tuple[str, ...], ...]
    to_notes: tuple[tuple[str, ...], ...]
    motion: Optional[Array]
    weak_contacts: NDArray[np.uint32]
    smooth: bool
    adjoint_solves: int
    direct_solves: int
    residual: float
    linear_error: float
    stiffness_margin: float
    snapshot: _core.Snapshot = dataclasses.field(repr=False)

    def plot(self, of: Optional[str] = None) -> Picture:
        """The valve from below with its chordae coloured by their influence on a quantity: its change
        for a rest length 1 mm longer. Needs all rest lengths (to="chords"); extra ``report``."""
        row = self._row(self.of[0] if of is None else of)
        names = [part.name for part in self.snapshot.parts if part.kind == PartKind.CHORD]
        columns = [f"chords {name}" for name in names]
        if not set(columns) <= set(self.to):
            raise ArgumentError('plot: needs the rest lengths of all chordae: to="chords"', "to")
        need("Sensitivity.plot")
        from .drawing.geometry import Drawing
        from .drawing.influence import influence_map

        scale, unit = SHOWN.get(self.of_units[row], (1.0, ""))
        change = self.derivative[row, [self.to.index(c) for c in columns]] * scale * 1e-3
        text = f"{self.of[row]}: change in {unit or '1'} for a chord 1 mm longer"
        return Picture(influence_map(Drawing(self.snapshot), change, names, text))

    def __getitem__(self, label: str) -> Array:
        """The row of a quantity, by its label."""
        return np.asarray(self.derivative[self._row(label)])

    def _row(self, label: str) -> int:
        label = SHORT.get(label, label)
        if label not in self.of:
            near = did_you_mean(label, self.of)
            raise KeyError(f'no quantity "{label}"{near}; there are {listed(self.of)}')
        return self.of.index(label)

    def table(self, sort: Optional[str] = None) -> Table:
        """A row a parameter, with the derivative of each quantity; sorted by influence.

        sort: the quantity whose derivative is largest in magnitude in the first row; None: the first
        """
        row = self._row(self.of[0] if sort is None else sort)
        order = np.argsort(-np.abs(self.derivative[row]), kind="stable")
        units = {"parameter": "", "unit": ""}
        units |= {f"d {name}": unit for name, unit in zip(self.of, self.of_units)}
        units["notes"] = ""
        return Table(
            (
                {"parameter": self.to[p], "unit": self.to_units[p]}
                | {f"d {name}": float(self.derivative[q, p]) for q, name in enumerate(self.of)}
                | {"notes": ", ".join(self.to_notes[p])}
                for p in order
            ),
            units,
        )

    def __repr__(self) -> str:
        words = "smooth" if self.smooth else "with notes"
        return f"<mvs.Sensitivity: {len(self.of)} quantities by {len(self.to)} parameters, {words}>"


def sensitivity(
    self: _core.Snapshot,
    of: Union[Asked, Iterable[Asked]],
    to: Union[Asked, Iterable[Asked]],
    *,
    slack: Optional[float] = None,
    motion: bool = False,
    test: bool = True,
    progress: Optional[Callable[[float, float], object]] = None,
) -> Sensitivity:
    """Derivatives of a valve at rest (mvs.Sensitivity): how it answers to each of its parameters.

        closed.sensitivity(of=["coaptation", "tension"], to="chords").table()

    of: quantities, one or several of
        the name of a measure ("coaptation_area"; "coaptation" and "orifice" for short), "measures"
        (all that have a derivative), "tension", "strain", "length" (of every chord) or one of them
        ("tension P2/3"), "force" (magnitude of the force on every head) or one ("force PM1"), an array (n, 3) of weights of
        the positions, a pair (label, array) or a mapping of labels to arrays
    to: parameters, one or several of
        "chords" (rest lengths), "areas", "moduli" (of every chord) or one ("chords P2/3"), "sites"
        or one ("sites P2/3": metres of unloaded tissue by which its insertion moves along each edge
        of the leaflet, "site P2/3 to 57" is that to node 57), "tissue"
        (every constant of every leaflet), "thickness" (by leaflet), "scallops" (thickness by
        scallop), "pressure", "prestrain", "heads" (their coordinates), "annulus" (coordinates of its
        nodes), "annulus_scale" (also of a ring: its size times this), an array (n, 3) that moves
        prescribed nodes (a mode), a pair (label, array) or a mapping; also each label of
        Sensitivity.to ("head PM1 x")
    slack: m, the distance at which both sides are tested [1e-7]
    motion: also dx/dp of all nodes
    test: False: no test of both sides, no margin; faster
    progress: as for Simulator.settle

    StateError if the valve is not at rest or not stable.
    """
    rows = rows_of(of, lambda item: quantities(self, item))
    columns = rows_of(to, lambda item: parameters(self, item))
    flags = (MOTION if motion else 0) | (0 if test else NO_TEST)
    found = self._sensitivity([r[2] for r in rows], [c[2] for c in columns], flags, slack, progress)
    moved = found.pop("motion")
    nodes = len(self.node_position)
    of_notes, to_notes = (
        tuple(map(_words, found.pop(key).tolist())) for key in ("of_notes", "to_notes")
    )
    found.pop("weak_chords")
    for key in ("derivative", "above", "below"):
        found[key] = found[key].reshape(len(rows), len(columns))  # a view of one column has one axis
    return Sensitivity(
        of=tuple(r[0] for r in rows),
        to=tuple(c[0] for c in columns),
        of_units=tuple(r[1] for r in rows),
        to_units=tuple(c[1] for c in columns),
        of_notes=of_notes,
        to_notes=to_notes,
        snapshot=self,
        motion=moved.reshape(len(columns), -1, 3)[:, :nodes] if motion else None,
        **found,
    )


def simulator_sensitivity(self: _core.Simulator, *args: Any, **options: Any) -> Sensitivity:
    """Snapshot.sensitivity of the present snapshot."""
    return sensitivity(self.snapshot(), *args, **options)


def _words(bits: int) -> tuple[str, ...]:
    return tuple(word for bit, word in NOTES.items() if bits & bit)
