"""Parameters of each group at a snapshot, with the spread of their priors and the ranges that the library accepts."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Optional

import numpy as np

from .. import _core
from ..kinds import LeafletLaw, PartKind
from ..laws import leaflet_law
from ..sensitivity_rows import AXES, PARAMETER

if TYPE_CHECKING:
    from ..arrays import LawConstant
    from ..values import Part
    from .parameters import Prior

THICKNESS = (1e-5, 2e-2)
"""m, of each triangle (libmvs/model/checks/check_parts.cpp)."""
LENGTH = (1e-6, 1.0)
"""m, of a chord."""
SWITCHES = {(LeafletLaw.NEO_HOOKEAN, "bending")}
"""Constants whose 0 means that there is no limit, unlike that of small numbers: not free where they are 0."""


@dataclasses.dataclass(frozen=True)
class Row:
    """A parameter: label, unit, group, row for Snapshot._sensitivity, value at the start, deviation of its prior,
    bounds in deviations, and the values that the library accepts."""

    label: str
    unit: str
    group: str
    binding: tuple[int, int, int, None]
    start: float
    deviation: float
    reach: float
    lowest: float = -math.inf
    highest: float = math.inf


def rows_of(start: _core.Snapshot, group: str, prior: Prior) -> list[Row]:
    """The parameters of a group."""
    made = {"chords": _chords, "heads": _heads, "prestrain": _prestrain, "thickness": _thickness, "tissue": _tissue}
    return made[group](start, prior)


def _parts(start: _core.Snapshot, kind: PartKind) -> list[Part]:
    return [part for part in start.parts if part.kind == kind]


def _chords(start: _core.Snapshot, prior: Prior) -> list[Row]:
    return [Row(f"chords {p.name}", "m", "chords", (PARAMETER["length"], p.index, 0, None), length,
                prior.deviation * length, prior.reach, *LENGTH)
            for p, length in zip(_parts(start, PartKind.CHORD), start.chord_rest_length.tolist())]


def _heads(start: _core.Snapshot, prior: Prior) -> list[Row]:
    return [Row(f"head {p.name} {AXES[a]}", "m", "heads", (PARAMETER["head"], p.index, a, None),
                float(start.node_position[start.head_nodes[p.index], a]), prior.deviation, prior.reach)
            for p in _parts(start, PartKind.HEAD) for a in range(3)]


def _prestrain(start: _core.Snapshot, prior: Prior) -> list[Row]:
    return [Row("prestrain", "", "prestrain", (PARAMETER["prestrain"], 0, 0, None), 0.0, prior.deviation, prior.reach)]


def _thickness(start: _core.Snapshot, prior: Prior) -> list[Row]:
    """A change is added to all triangles of a leaflet, of which the thinnest and the thickest set the range."""
    rows = []
    for p in _parts(start, PartKind.LEAFLET):
        value = float(start.leaflet_constants[p.index, 0])
        each = np.append(start.triangle_thickness[start.triangle_leaflet == p.index], value)
        rows.append(Row(f"thickness {p.name}", "m", "thickness", (PARAMETER["leaflet_thickness"], p.index, 0, None),
                        value, prior.deviation * value, prior.reach, value + THICKNESS[0] - float(each.min()),
                        value + THICKNESS[1] - float(each.max())))
    return rows


def _tissue(start: _core.Snapshot, prior: Prior) -> list[Row]:
    return [row for p in _parts(start, PartKind.LEAFLET)
            for c, constant in enumerate(leaflet_law(int(start.leaflet_law[p.index])).constants)
            if (row := _constant(start, p, c, constant, prior))]


def _constant(start: _core.Snapshot, leaflet: Part, number: int, constant: LawConstant,
              prior: Prior) -> Optional[Row]:
    """None for a switch that is off. The deviation is a share of the distance from the low end of the range, which
    is that of the default for a constant at that end: Ic counts from 3, the value of I1 at rest."""
    value = float(start.leaflet_constants[leaflet.index, 1 + number])
    if value == 0 and (int(start.leaflet_law[leaflet.index]), constant.key) in SWITCHES:
        return None
    size = value - constant.low or constant.default - constant.low
    return Row(f"tissue {leaflet.name} {constant.key}", constant.unit, "tissue",
               (PARAMETER["constant"], leaflet.index, number, None), value, prior.deviation * size, prior.reach,
               constant.low, constant.high)
