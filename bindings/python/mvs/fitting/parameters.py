"""Free parameters of a fit: their effect on a valve, their priors and bounds.

A parameter is measured in standard deviations z of its prior from its value at the start, so that all
have one scale: z = 0 is the start, the prior is the unit normal distribution.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..arrays import Leaflet, Valve
from ..editing import valve_of
from ..errors import ArgumentError
from ..kinds import PartKind
from ..laws import exact, leaflet_law
from ..sensitivity_rows import AXES, PARAMETER
from ..words import did_you_mean, listed

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Prior:
    """Spread of a group of parameters before the data: standard deviation and bounds.

    deviation: relative to the value at the start for chords and tissue; m for heads; strain for
        prestrain
    reach: bounds, in standard deviations from the start
    """

    deviation: float
    reach: float = 4.0


PRIORS: dict[str, Prior] = {
    "chords": Prior(0.1, 3.0),
    "tissue": Prior(0.2, 3.0),
    "thickness": Prior(0.2, 3.0),
    "heads": Prior(2e-3),
    "prestrain": Prior(0.05, 2.0),
}
"""Groups of parameters and their default priors: rest lengths of the chordae, constants of each leaflet,
thickness of each leaflet, coordinates of the heads, prestrain of the leaflets."""


@dataclasses.dataclass(frozen=True)
class Free:
    """The free parameters of one fit. Rows: label, unit, group, binding row, start, deviation, reach."""

    labels: tuple[str, ...]
    units: tuple[str, ...]
    groups: tuple[str, ...]
    rows: tuple[tuple[int, int, int, None], ...]
    start: Array
    deviation: Array
    reach: Array
    base: Valve

    def values(self, z: Array) -> Array:
        """Parameters in their units."""
        return self.start + self.deviation * z

    def valve(self, z: Array, now: Array) -> Valve:
        """The valve with these parameters, in the shape `now`."""
        value = dict(zip(self.labels, self.values(z)))
        made = dataclasses.replace(self.base, nodes_now=np.ascontiguousarray(now))
        made.chord_rest_length = self._chords(value)
        made.leaflets = self._leaflets(value)
        self._set_thickness(made, value)
        self._move_heads(made, value)
        if "prestrain" in value:
            made.nodes = self._shrunk(made, 1 / (1 + value["prestrain"]))
        return made

    def _chords(self, value: Mapping[str, float]) -> Array:
        lengths = self.base.chord_rest_length.copy()
        for row, name in enumerate(self.base.chord_names or ()):
            lengths[row] = value.get(f"chords {name}", lengths[row])
        return lengths

    def _leaflets(self, value: Mapping[str, float]) -> list[Leaflet]:
        made = []
        for leaflet in self.base.leaflets:
            assert isinstance(leaflet, Leaflet)
            keys = [constant.key for constant in leaflet_law(leaflet.law).constants]
            constants = [value.get(f"tissue {leaflet.name} {key}", old)
                         for key, old in zip(keys, leaflet.constants)]
            made.append(dataclasses.replace(leaflet, constants=tuple(map(exact, constants))))
        return made

    def _set_thickness(self, made: Valve, value: Mapping[str, float]) -> None:
        for row, leaflet in enumerate(self.base.leaflets):
            label = f"thickness {leaflet.name}"  # type: ignore[union-attr]
            if label not in value:
                continue
            change = value[label] - leaflet.thickness  # type: ignore[union-attr]
            mine = self.base.triangle_leaflet == row
            made.triangle_thickness = np.where(mine, made.triangle_thickness + change,
                                               made.triangle_thickness)

    def _move_heads(self, made: Valve, value: Mapping[str, float]) -> None:
        for name, node in zip(self.base.head_names or (), self.base.head_nodes):
            for axis, letter in enumerate(AXES):
                label = f"head {name} {letter}"
                if label not in value:
                    continue
                for places in ("nodes_loaded", "nodes_open", "nodes_now"):
                    moved = getattr(made, places).copy()
                    start = self.start[self.labels.index(label)]
                    # from the place of the base; nodes_now may have moved before
                    base = getattr(self.base, places)[node, axis]
                    moved[node, axis] = base + value[label] - start
                    setattr(made, places, moved)

    def _shrunk(self, made: Valve, scale: float) -> Array:
        """The rest shape of the sheet; prescribed nodes keep their targets."""
        return np.ascontiguousarray(self.base.nodes * scale)


def free_parameters(
    start: _core.Snapshot, groups: Iterable[str], priors: Optional[Mapping[str, Prior]]
) -> Free:
    """The parameters of these groups at a snapshot."""
    known = {**PRIORS, **(priors or {})}
    for group in (*groups, *(priors or ())):
        if group not in PRIORS:
            raise ArgumentError(
                f'free: "{group}" is not known{did_you_mean(group, PRIORS)}; there are '
                f"{listed(PRIORS)}", "free"
            )
    rows = [row for group in dict.fromkeys(groups) for row in _rows(start, group, known[group])]
    if not rows:
        raise ArgumentError("free: the valve has no parameters of these groups", "free")
    labels, units, names, binding, values, deviations, reaches = zip(*rows)
    return Free(labels, units, names, binding, np.array(values), np.array(deviations),
                np.array(reaches), valve_of(start))


def _rows(start: _core.Snapshot, group: str, prior: Prior) -> list[tuple]:  # type: ignore[type-arg]
    parts = {kind: [p for p in start.parts if p.kind == kind] for kind in PartKind}
    if not prior.deviation > 0 or not prior.reach > 0:
        raise ArgumentError(f"priors: those of {group} need a positive deviation and reach", "priors")

    def row(label: str, unit: str, key: str, index: int, component: int, value: float,
            deviation: float) -> tuple:  # type: ignore[type-arg]
        return (label, unit, group, (PARAMETER[key], index, component, None), value, deviation,
                prior.reach)

    if group == "chords":
        return [row(f"chords {p.name}", "m", "length", p.index, 0, length, prior.deviation * length)
                for p, length in zip(parts[PartKind.CHORD], start.chord_rest_length.tolist())]
    if group == "heads":
        return [row(f"head {p.name} {AXES[a]}", "m", "head", p.index, a,
                    float(start.node_position[start.head_nodes[p.index], a]), prior.deviation)
                for p in parts[PartKind.HEAD] for a in range(3)]
    if group == "prestrain":
        return [row("prestrain", "", "prestrain", 0, 0, 0.0, prior.deviation)]
    rows = []
    for p in parts[PartKind.LEAFLET]:
        constants = start.leaflet_constants[p.index]
        if group == "thickness":
            rows.append(row(f"thickness {p.name}", "m", "leaflet_thickness", p.index, 0,
                            float(constants[0]), prior.deviation * float(constants[0])))
            continue
        law = leaflet_law(int(start.leaflet_law[p.index]))
        for c, constant in enumerate(law.constants):
            value = float(constants[1 + c])
            rows.append(row(f"tissue {p.name} {constant.key}", constant.unit, "constant", p.index, c,
                            value, prior.deviation * (abs(value) or constant.default or 1.0)))
    return rows
