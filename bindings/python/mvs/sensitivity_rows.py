"""Quantities and parameters of a sensitivity: their names as labelled rows for the binding."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import ArgumentError
from .kinds import NodeKind, PartKind
from .laws import leaflet_law
from .measures import Measures
from .values import unit_of
from .words import did_you_mean, listed, shown

Array = NDArray[np.float64]
Labelled = tuple[str, str, tuple[Any, ...]]
"""A label, its unit, and the row for the binding."""
Asked = Union[str, NDArray[Any], tuple[str, NDArray[Any]], Mapping[str, NDArray[Any]]]

SHORT = {"orifice": "regurgitant_orifice_area", "coaptation": "coaptation_area"}
"""Short names of measures."""
AXES = "xyz"
QUANTITY = {"position": 1, "linear": 2, "length": 4, "strain": 5, "tension": 6, "force": 7, "measure": 8}
PARAMETER = {
    "length": 1, "young": 2, "area": 3, "constant": 4, "leaflet_thickness": 5,
    "scallop_constant": 6, "thickness": 7, "prestrain": 8, "pressure": 9, "node": 10, "head": 11,
    "annulus_scale": 12, "mode": 13, "site": 14,
}
OF_WORDS = ("measures", "tension", "strain", "length", "force")
TO_WORDS = (
    "chords", "areas", "moduli", "tissue", "thickness", "scallops", "pressure", "prestrain", "heads",
    "annulus", "annulus_scale", "sites",
)


def rows_of(asked: Any, meaning: Any) -> list[Labelled]:
    """The rows of one item or of several: `meaning` gives those of an item."""
    several = isinstance(asked, (list, set, frozenset)) or isinstance(asked, Iterator)
    several = several or (isinstance(asked, tuple) and not _is_pair(asked))
    rows = [row for item in (asked if several else [asked]) for row in meaning(item)]
    if not rows:
        raise ArgumentError("sensitivity: at least one quantity and one parameter are needed", "of")
    return rows


def _is_pair(item: Any) -> bool:
    return isinstance(item, tuple) and len(item) == 2 and isinstance(item[1], np.ndarray)


def _arrays(item: Any, label: str) -> Optional[list[tuple[str, Array]]]:
    """Labels and arrays of an item that is not a text."""
    if isinstance(item, np.ndarray):
        return [(label, item)]
    if _is_pair(item):
        return [item]
    return list(item.items()) if isinstance(item, Mapping) else None


def quantities(snapshot: _core.Snapshot, item: Asked) -> list[Labelled]:
    """The quantities that one item of `of` asks for."""
    arrays = _arrays(item, "functional")
    if arrays is not None:
        kind = QUANTITY["linear"]
        return [(label, "", (kind, 0, 0, None, None, weights)) for label, weights in arrays]
    if not isinstance(item, str):
        raise ArgumentError(f"of: a name or an array is needed, not {shown(item)}", "of")
    if item == "measures":
        return [row for name in measure_names() for row in quantities(snapshot, name)]
    name = SHORT.get(item, item)
    if name in measure_names():
        return [(name, unit_of(Measures, name), (QUANTITY["measure"], 0, 0, name, None, None))]
    word, _, part = item.partition(" ")
    if word == "force":
        kind = QUANTITY["force"]
        heads = _parts(snapshot, PartKind.HEAD, part)
        return [(f"force {n}", "N", (kind, k, 3, None, None, None)) for k, n in heads]
    units = {"tension": "N", "strain": "", "length": "m"}
    if word in units:
        chords = _parts(snapshot, PartKind.CHORD, part)
        return [
            (f"{word} {n}", units[word], (QUANTITY[word], k, 0, None, None, None)) for k, n in chords
        ]
    known = [*SHORT, *OF_WORDS, *measure_names()]
    raise ArgumentError(
        f'of: "{item}" is not known{did_you_mean(item, known)}; there are {listed(known)}', "of"
    )


def parameters(snapshot: _core.Snapshot, item: Asked) -> list[Labelled]:
    """The parameters that one item of `to` asks for."""
    arrays = _arrays(item, "mode")
    if arrays is not None:
        return [(label, "", (PARAMETER["mode"], 0, 0, mode)) for label, mode in arrays]
    if not isinstance(item, str):
        raise ArgumentError(f"to: a name or an array is needed, not {shown(item)}", "to")
    word, _, part = item.partition(" ")
    if word in ("pressure", "prestrain", "annulus_scale") and not part:
        return [(word, "Pa" if word == "pressure" else "", (PARAMETER[word], 0, 0, None))]
    of_parts = {
        "chords": (PartKind.CHORD, "length", "m"), "areas": (PartKind.CHORD, "area", "m2"),
        "moduli": (PartKind.CHORD, "young", "Pa"),
        "thickness": (PartKind.LEAFLET, "leaflet_thickness", "m"),
        "scallops": (PartKind.SCALLOP, "thickness", "m"),
    }
    if word in of_parts:
        kind, what, unit = of_parts[word]
        return [
            (f"{word} {n}", unit, (PARAMETER[what], k, 0, None))
            for k, n in _parts(snapshot, kind, part)
        ]
    if word == "sites":
        return [row for k, n in _parts(snapshot, PartKind.CHORD, part)
                for row in _sites(snapshot, k, n, bool(part))]
    if word == "tissue":
        rows = [row for k, n in _parts(snapshot, PartKind.LEAFLET, "")
                for row in _constants(snapshot, k, n)]
        one = [row for row in rows if row[0] == item]  # a label of Sensitivity.to
        return one or [row for k, n in _parts(snapshot, PartKind.LEAFLET, part)
                       for row in _constants(snapshot, k, n)]
    if word == "heads":
        return [(f"head {n} {AXES[a]}", "m", (PARAMETER["head"], k, a, None))
                for k, n in _parts(snapshot, PartKind.HEAD, part) for a in range(3)]
    if word == "annulus" and not part:
        return [(f"annulus {i} {AXES[a]}", "m", (PARAMETER["node"], int(i), a, None))
                for i in snapshot.annulus_nodes for a in range(3)]
    several = {"head": "heads", "annulus": "annulus", "site": "sites"}.get(word)
    if several and part:  # a label of Sensitivity.to
        one = [row for row in parameters(snapshot, several) if row[0] == item]
        if one:
            return one
    raise ArgumentError(
        f'to: "{item}" is not known{did_you_mean(item, TO_WORDS)}; there are {listed(TO_WORDS)}', "to"
    )


def measure_names() -> tuple[str, ...]:
    """Measures that have a derivative."""
    fields = (f for f in dataclasses.fields(Measures) if str(f.type).startswith("Annotated[float"))
    return tuple(f.name for f in fields if not f.name.endswith(("_p50", "_p95", "_p99")))


def _parts(snapshot: _core.Snapshot, kind: PartKind, name: str) -> list[tuple[int, str]]:
    if name:
        part = snapshot.find(kind, name)
        return [(part.index, part.name)]
    return [(part.index, part.name) for part in snapshot.parts if part.kind == kind]


def _sites(snapshot: _core.Snapshot, chord: int, name: str, alone: bool) -> list[Labelled]:
    """The insertion of a chord along each edge of the leaflet; none for a chord that ends on no leaflet."""
    on_leaflet = [int(i) for i in snapshot.chord_nodes[chord] if snapshot.node_kind[i] == NodeKind.LEAFLET]
    if len(on_leaflet) != 1:
        if alone:
            raise ArgumentError(f"to: chord {name} does not end on a leaflet", "to")
        return []
    around = snapshot.triangle_nodes[(snapshot.triangle_nodes == on_leaflet[0]).any(axis=1)]
    return [(f"site {name} to {j}", "m", (PARAMETER["site"], chord, int(j), None))
            for j in np.unique(around) if j != on_leaflet[0]]


def _constants(snapshot: _core.Snapshot, leaflet: int, name: str) -> list[Labelled]:
    law = leaflet_law(int(snapshot.leaflet_law[leaflet]))
    return [
        (f"tissue {name} {constant.key}", constant.unit, (PARAMETER["constant"], leaflet, c, None))
        for c, constant in enumerate(law.constants)
    ]
