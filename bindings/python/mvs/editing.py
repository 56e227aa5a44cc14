"""Copies the valve of a snapshot to editable arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from ._core import Snapshot
from .arrays import Curve, Leaflet, Ring, Valve
from .kinds import ChordLaw, LeafletLaw, PartKind, RingKind
from .laws import ZERO, exact, leaflet_law
from .values import Part


_COPIED = {
    "nodes": "node_rest",
    "nodes_loaded": "node_loaded",
    "nodes_open": "node_open",
    "nodes_now": "node_position",
    "triangles": "triangle_nodes",
    "annulus": "annulus_nodes",
    **{name: name for name in (
        "node_origin", "triangle_leaflet", "triangle_scallop", "triangle_thickness",
        "triangle_fibre", "chord_nodes", "chord_rest_length", "chord_kind", "chord_young",
        "chord_area", "chord_law", "chord_constants", "chord_id", "head_nodes",
    )},
}
"""The array of mvs.Snapshot for each array of mvs.Valve."""


if TYPE_CHECKING:

    class _FilledValve(Valve):
        """For type checkers: the fields that valve_of always fills are not None."""

        leaflets: Sequence[Leaflet]
        triangle_leaflet: NDArray[Any]
        nodes: NDArray[Any]
        nodes_loaded: NDArray[Any]
        nodes_open: NDArray[Any]
        triangles: NDArray[Any]
        annulus: NDArray[Any]
        node_origin: NDArray[Any]
        scallops: Sequence[str]
        scallop_id: NDArray[Any]
        triangle_scallop: NDArray[Any]
        triangle_thickness: NDArray[Any]
        triangle_fibre: NDArray[Any]
        chord_nodes: NDArray[Any]
        chord_rest_length: NDArray[Any]
        chord_kind: NDArray[Any]
        chord_young: NDArray[Any]
        chord_area: NDArray[Any]
        chord_law: NDArray[Any]
        chord_constants: NDArray[Any]
        chord_id: NDArray[Any]
        chord_names: Sequence[str]
        head_nodes: NDArray[Any]
        head_id: NDArray[Any]
        head_names: Sequence[str]
        density: float
        contact_thickness: float
        contact_stiffness: float
        bending_scale: float


def valve_of(snapshot: Snapshot) -> _FilledValve:
    """Copies the valve of a snapshot to arrays, with ids and names.

    ``sim.set_valve(mvs.valve_of(snapshot))`` sets the same valve; change the arrays first to set a
    different one. Constants that are zero are -0.0, as 0.0 would be the default of the law. The
    start shape is that of the snapshot; velocities are not part of a valve.
    """
    parts = {kind: [p for p in snapshot.parts if p.kind == kind] for kind in PartKind}
    leaflets = [
        Leaflet(part.name, float(row[0]), _constants(int(law), row[1:]), LeafletLaw(int(law)), part.id)
        for part, law, row in zip(
            parts[PartKind.LEAFLET], snapshot.leaflet_law, snapshot.leaflet_constants
        )
    ]
    density, contact_thickness, contact_stiffness, bending = map(float, snapshot.valve_constants)
    copied = {field: getattr(snapshot, array).copy() for field, array in _COPIED.items()}
    constants, law = copied["chord_constants"], copied["chord_law"]
    has_them = (law == ChordLaw.BILINEAR) | (law == ChordLaw.OGDEN)
    constants[(constants == 0) & has_them[:, None]] = ZERO
    filled = Valve(
        **copied,
        leaflets=leaflets,
        scallops=[part.name for part in parts[PartKind.SCALLOP]],
        scallop_id=_ids(parts[PartKind.SCALLOP]),
        curves=_curves(snapshot, parts[PartKind.CURVE]),
        chord_names=[part.name for part in parts[PartKind.CHORD]],
        head_id=_ids(parts[PartKind.HEAD]),
        head_names=[part.name for part in parts[PartKind.HEAD]],
        rings=_rings(snapshot, parts[PartKind.RING]),
        name=snapshot.name,
        density=density,
        contact_thickness=contact_thickness,
        contact_stiffness=contact_stiffness,
        bending_scale=bending,
    )
    return cast("_FilledValve", filled)


def _constants(law: int, values: NDArray[np.float64]) -> tuple[float, ...]:
    count = len(leaflet_law(law).constants)
    return (*map(exact, values[:count]), *map(float, values[count:]))


def _rings(snapshot: Snapshot, parts: Sequence[Part]) -> list[Ring]:
    start = snapshot.ring_start
    curves = [snapshot.ring_points[a:b].copy() for a, b in zip(start, start[1:])]
    return [
        Ring(part.name, curve, RingKind(int(kind)), part.id)
        for part, curve, kind in zip(parts, curves, snapshot.ring_kind)
    ]


def _curves(snapshot: Snapshot, parts: Sequence[Part]) -> list[Curve]:
    start = snapshot.curve_start
    return [
        Curve(part.name, snapshot.curve_points[a:b].copy(), part.id)
        for part, a, b in zip(parts, start, start[1:])
    ]


def _ids(parts: Sequence[Part]) -> NDArray[np.uint64]:
    return np.array([part.id for part in parts], dtype=np.uint64)
