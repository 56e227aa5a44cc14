"""The surgeon's changes to the valve that a simulator holds; its shape stays as it is."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import ChordKind, NodeKind, PartKind, Simulator, Snapshot, valve_of

YOUNG_PA = 40e6
AREA_M2 = float(np.pi / 4 * 1e-6)
"""Of new chordae: 40 MPa and 1 mm thick, as in the founding paper."""

_PER_CHORD = ("nodes", "rest_length", "kind", "young", "area", "id")


def scale_annulus(sim: Simulator, factor: float) -> None:
    """Scales the loaded annulus about its centroid; the leaflets' rest shape stays as it is."""
    valve: Any = valve_of(sim.snapshot())
    ring = valve.nodes_loaded[valve.annulus]
    centre = ring.mean(axis=0)
    valve.nodes_loaded[valve.annulus] = centre + factor * (ring - centre)
    sim.set_valve(valve)


def scale_chord(sim: Simulator, chord_id: int, factor: float) -> None:
    """Multiplies the rest length of a chord segment."""
    snapshot = sim.snapshot()
    valve: Any = valve_of(snapshot)
    valve.chord_rest_length[_row(snapshot, chord_id)] *= factor
    sim.set_valve(valve)


def add_chord(sim: Simulator, head_id: int, vertex: int, length: float) -> None:
    """Ties a leaflet vertex to a papillary head; length in m."""
    snapshot = sim.snapshot()
    valve: Any = valve_of(snapshot)
    head = snapshot.head_nodes[_row(snapshot, head_id, PartKind.HEAD)]
    values = ([[head, vertex]], [length], [ChordKind.OTHER], [YOUNG_PA], [AREA_M2], [0])
    for field, value in zip(_PER_CHORD, values):
        _append(valve, f"chord_{field}", value)
    valve.chord_names = [*valve.chord_names, f"new/{len(valve.chord_names) + 1}"]
    sim.set_valve(valve)


def remove_chord(sim: Simulator, chord_id: int) -> None:
    """Cuts a chord segment, and takes out what it branches into."""
    snapshot = sim.snapshot()
    valve: Any = valve_of(snapshot)
    rows = _tree(snapshot, _row(snapshot, chord_id))
    ends = snapshot.chord_nodes[rows, 1]
    gone = ends[snapshot.node_kind[ends] == NodeKind.BRANCH]
    for field in _PER_CHORD:
        name = f"chord_{field}"
        setattr(valve, name, np.delete(getattr(valve, name), rows, axis=0))
    valve.chord_names = [name for k, name in enumerate(valve.chord_names) if k not in rows]
    _drop_nodes(valve, gone)
    sim.set_valve(valve)


def _row(snapshot: Snapshot, part_id: int, kind: PartKind = PartKind.CHORD) -> int:
    return next(part.index for part in snapshot.parts if (part.kind, part.id) == (kind, part_id))


def _tree(snapshot: Snapshot, row: int) -> list[int]:
    below = np.flatnonzero(snapshot.chord_nodes[:, 0] == snapshot.chord_nodes[row, 1])
    return [row, *(r for other in below for r in _tree(snapshot, int(other)))]


def _append(valve: Any, name: str, value: Any) -> None:
    old = getattr(valve, name)
    setattr(valve, name, np.concatenate([old, np.array(value, dtype=old.dtype)]))


def _drop_nodes(valve: Any, gone: NDArray[np.uint32]) -> None:
    left = np.setdiff1d(np.arange(len(valve.nodes)), gone)
    number = np.zeros(len(valve.nodes), dtype=np.uint32)
    number[left] = np.arange(len(left))
    for name in ("nodes", "nodes_loaded", "nodes_now"):
        setattr(valve, name, getattr(valve, name)[left])
    for name in ("triangles", "annulus", "chord_nodes", "head_nodes"):
        setattr(valve, name, number[getattr(valve, name)])
