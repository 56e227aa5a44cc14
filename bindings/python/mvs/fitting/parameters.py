"""Free parameters of a fit: their effect on a valve, their priors and bounds.

A parameter is measured in standard deviations z of its prior from its value at the start, so that all
have one scale: z = 0 is the start, the prior is the unit normal distribution.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Optional

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..arrays import Leaflet, Valve
from ..editing import valve_of
from ..errors import ArgumentError
from ..laws import exact, leaflet_law
from ..sensitivity_rows import AXES
from ..words import did_you_mean, listed
from .rows import THICKNESS, rows_of

if TYPE_CHECKING:
    from ..editing import _FilledValve

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Prior:
    """Spread of a group of parameters before the data: standard deviation and bounds.

    deviation: relative to the value at the start for chords and thickness; for tissue to its distance from the low
        end of the range of the law's constant (mvs.leaflet_law), which is 3 for Ic and 0 or next to it for others;
        of a constant at that end, relative to the distance of its default; m for heads; strain for prestrain
    reach: bounds, in standard deviations from the start, within the values that the library accepts
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
thickness of each leaflet (the same change for all its triangles), coordinates of the heads, prestrain of the
leaflets. The constant `bending` of a neo-Hookean leaflet is not free where it is 0, which means no limit."""


@dataclasses.dataclass(frozen=True)
class Free:
    """The free parameters of one fit, in the order of their rows (rows.py). lowest, highest: the values that the
    library accepts, in the units of the parameters."""

    labels: tuple[str, ...]
    units: tuple[str, ...]
    groups: tuple[str, ...]
    rows: tuple[tuple[int, int, int, None], ...]
    start: Array
    deviation: Array
    reach: Array
    lowest: Array
    highest: Array
    base: _FilledValve

    @property
    def low(self) -> Array:
        """Lower bounds of z."""
        return np.maximum(-self.reach, (self.lowest - self.start) / self.deviation)

    @property
    def high(self) -> Array:
        """Upper bounds of z."""
        return np.minimum(self.reach, (self.highest - self.start) / self.deviation)

    def at_bound(self, z: Array) -> NDArray[np.bool_]:
        """Which parameters are at a bound, to a thousandth of their reach."""
        near = 1e-3 * self.reach
        return (z < self.low + near) | (z > self.high - near)

    def values(self, z: Array) -> Array:
        """Parameters in their units; rounding does not lead out of what the library accepts."""
        return np.clip(self.start + self.deviation * z, self.lowest, self.highest)

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
            assert isinstance(leaflet.constants, tuple)  # Leaflet makes a tuple of a mapping too
            keys = [constant.key for constant in leaflet_law(leaflet.law).constants]
            constants = [value.get(f"tissue {leaflet.name} {key}", old)
                         for key, old in zip(keys, leaflet.constants)]
            made.append(dataclasses.replace(leaflet, constants=tuple(map(exact, constants))))
        return made

    def _set_thickness(self, made: _FilledValve, value: Mapping[str, float]) -> None:
        for row, leaflet in enumerate(self.base.leaflets):
            label = f"thickness {leaflet.name}"
            if label not in value:
                continue
            change = value[label] - leaflet.thickness
            mine = self.base.triangle_leaflet == row
            changed = np.clip(made.triangle_thickness + change, *THICKNESS)  # beyond it by rounding only
            made.triangle_thickness = np.where(mine, changed, made.triangle_thickness)

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
    rows = [row for group in dict.fromkeys(groups) for row in rows_of(start, group, known[group])]
    if not rows:
        raise ArgumentError("free: the valve has no parameters of these groups", "free")

    def numbers(name: str) -> Array:
        return np.array([getattr(row, name) for row in rows], float)

    return Free(tuple(row.label for row in rows), tuple(row.unit for row in rows), tuple(row.group for row in rows),
                tuple(row.binding for row in rows), numbers("start"), numbers("deviation"), numbers("reach"),
                numbers("lowest"), numbers("highest"), valve_of(start))
