"""A snapshot as editable arrays, so that a valve can be changed and set again."""

from __future__ import annotations

from ._core import Snapshot
from .values import Curve, Leaflet, LeafletLaw, PartKind, Ring, RingKind, Valve

import numpy as np


def valve_of(snapshot: Snapshot) -> Valve:
    """The valve of a snapshot as arrays of its own, ids and names included.

    ``sim.set_valve(mvs.valve_of(snapshot))`` sets the same valve; change the arrays before it to
    set another one. The shape to start from is the snapshot's; velocities are not part of a valve.
    """
    parts = {kind: [p for p in snapshot.parts if p.kind == kind] for kind in PartKind}
    leaflets = [
        Leaflet(part.name, float(row[0]), tuple(map(float, row[1:])), LeafletLaw(int(law)), part.id)
        for part, law, row in zip(
            parts[PartKind.LEAFLET], snapshot.leaflet_law, snapshot.leaflet_constants
        )
    ]
    density, contact_thickness, contact_stiffness, bending = map(float, snapshot.valve_constants)
    return Valve(
        nodes=snapshot.node_rest.copy(),
        triangles=snapshot.triangle_nodes.copy(),
        annulus=snapshot.annulus_nodes.copy(),
        leaflets=leaflets,
        triangle_leaflet=snapshot.triangle_leaflet.copy(),
        nodes_loaded=snapshot.node_loaded.copy(),
        nodes_open=snapshot.node_open.copy(),
        nodes_now=snapshot.node_position.copy(),
        node_origin=snapshot.node_origin.copy(),
        scallops=[part.name for part in parts[PartKind.SCALLOP]],
        scallop_id=_ids(parts[PartKind.SCALLOP]),
        triangle_scallop=snapshot.triangle_scallop.copy(),
        triangle_thickness=snapshot.triangle_thickness.copy(),
        triangle_fibre=snapshot.triangle_fibre.copy(),
        chord_nodes=snapshot.chord_nodes.copy(),
        chord_rest_length=snapshot.chord_rest_length.copy(),
        chord_kind=snapshot.chord_kind.copy(),
        chord_young=snapshot.chord_young.copy(),
        chord_area=snapshot.chord_area.copy(),
        chord_law=snapshot.chord_law.copy(),
        chord_constants=snapshot.chord_constants.copy(),
        curves=_curves(snapshot, parts[PartKind.CURVE]),
        chord_id=snapshot.chord_id.copy(),
        chord_names=[part.name for part in parts[PartKind.CHORD]],
        head_nodes=snapshot.head_nodes.copy(),
        head_id=_ids(parts[PartKind.HEAD]),
        head_names=[part.name for part in parts[PartKind.HEAD]],
        rings=_rings(snapshot, parts[PartKind.RING]),
        name=snapshot.name,
        density=density,
        contact_thickness=contact_thickness,
        contact_stiffness=contact_stiffness,
        bending_scale=bending,
    )


def _rings(snapshot: Snapshot, parts: list) -> list[Ring]:
    start = snapshot.ring_start
    curves = [snapshot.ring_points[a:b].copy() for a, b in zip(start, start[1:])]
    return [
        Ring(part.name, curve, RingKind(int(kind)), part.id)
        for part, curve, kind in zip(parts, curves, snapshot.ring_kind)
    ]


def _curves(snapshot: Snapshot, parts: list) -> list[Curve]:
    start = snapshot.curve_start
    return [
        Curve(part.name, snapshot.curve_points[a:b].copy(), part.id)
        for part, a, b in zip(parts, start, start[1:])
    ]


def _ids(parts: list) -> np.ndarray:
    return np.array([part.id for part in parts], dtype=np.uint64)
