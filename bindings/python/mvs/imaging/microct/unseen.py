"""Chordae that the images do not show, where none inserts near a place at which normal anatomy has one.

Chordae fray into threads as thin as a voxel, lie against leaflets and each other, and leave gaps of many millimetres
in a skeleton. Leaflets that are held at the chordae that are seen alone balloon between them. Where the leaflets are
known under load, a chord from the nearest head to each empty place gets the length that it has there; a fit then moves
the lengths of all. Without a loaded image nothing would tell a chord that is not seen from one that is torn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import mvs
from ..findings import finding
from ..mesh import Sheet
from ..needs import need
from ..valve import nearest_on
from .muscles import SAME_MUSCLE

if TYPE_CHECKING:
    from mvs.editing import _FilledValve

Points = NDArray[np.float64]
EMPTY = 2e-3
"""m: places of normal anatomy with no insertion this near are empty. Insertions are 2 to 4 mm apart, those that are
seen 1 mm off; with 1.5 mm five phantoms close as near, with 3 mm up to 0.3 mm farther (tests/validation/README.md)."""
SYSTOLIC_STRAIN = 0.015
"""Strain of chordae in the closed valve, as in libmvs/patient/chordae/patient_chordae.cpp"""


def with_unseen_chords(valve: _FilledValve, normal: mvs.Snapshot, closed: mvs.Snapshot,
                       loaded: Sheet) -> list[mvs.Finding]:
    """Adds chordae to a valve whose chordae are those that were seen.

    normal: the open valve with generated chordae on the same leaflets; closed: the valve as it is, under load;
    loaded: the leaflets in the loaded image
    """
    places = np.asarray(normal.chord_nodes, np.int64)
    leaves = np.flatnonzero(np.isin(places[:, 1], np.asarray(normal.triangle_nodes)))
    leaves = leaves[_are_empty(valve, places[leaves, 1])]
    if not len(leaves):
        return []
    ends = places[leaves, 1]
    wanted = nearest_on(np.asarray(closed.node_position)[ends], loaded.points, loaded.triangles)
    head, length = _heads_for(valve, np.asarray(normal.node_rest)[_roots(places, leaves)], wanted)
    kept = head >= 0
    leaves, ends, head, length = leaves[kept], ends[kept], head[kept], length[kept]
    seen = len(valve.chord_nodes)
    if not len(leaves):
        return []
    _append(valve, np.column_stack([head, ends]), length / (1 + SYSTOLIC_STRAIN),
            np.asarray(normal.chord_kind)[leaves])
    return [finding(
        "unseen_chordae", mvs.FindingSource.ASSUMED, 0.3,
        f"{len(leaves)} chordae were added to {seen} segments that are seen, at places of normal insertions with none "
        f"within {1e3 * EMPTY:.0f} mm: the leaflets in the loaded image give their lengths. If the valve has torn chordae "
        "there, remove the added ones (the last of the valve)", length, "m")]


def _are_empty(valve: mvs.Valve, nodes: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Which vertices have no insertion of the valve within EMPTY in the open shape."""
    points = np.asarray(valve.nodes)
    used = np.intersect1d(np.asarray(valve.chord_nodes, np.int64), np.asarray(valve.triangles, np.int64))
    away, _ = need("scipy.spatial").cKDTree(points[used]).query(points[nodes])
    return np.asarray(away > EMPTY)


def _roots(places: NDArray[np.int64], leaves: NDArray[np.int64]) -> NDArray[np.int64]:
    """The head to which each of some segments leads."""
    before = {int(b): int(a) for a, b in places}
    roots = []
    for node in places[leaves, 0].tolist():
        while node in before:
            node = before[node]
        roots.append(node)
    return np.array(roots, np.int64)


def _heads_for(valve: mvs.Valve, muscle: Points, wanted: Points) -> tuple[NDArray[np.int64], Points]:
    """For places under load, m, the node of the nearest head on the muscle of a given point, and its distance; -1: none."""
    nodes = np.asarray(valve.head_nodes, np.int64)
    own = np.linalg.norm(muscle[:, None] - np.asarray(valve.nodes)[nodes][None], axis=2) < SAME_MUSCLE
    under_load = np.asarray(valve.nodes if valve.nodes_loaded is None else valve.nodes_loaded)[nodes]
    away = np.where(own, np.linalg.norm(wanted[:, None] - under_load[None], axis=2), np.inf)
    best = away.argmin(axis=1)
    length = away[np.arange(len(away)), best]
    return np.where(np.isfinite(length), nodes[best], -1), length


def _append(valve: _FilledValve, ends: NDArray[np.int64], rest: Points, kind: NDArray[np.uint32]) -> None:
    """Adds chordae as thick and stiff as those that insert on the leaflets."""
    inserting = np.asarray(valve.chord_kind) != mvs.ChordKind.TRUNK
    count = len(ends)
    new = {"nodes": ends, "rest_length": rest, "kind": kind,
           "area": np.full(count, np.median(np.asarray(valve.chord_area)[inserting])),
           "young": np.full(count, np.median(valve.chord_young)), "law": np.full(count, valve.chord_law[0]),
           "constants": np.tile(valve.chord_constants[0], (count, 1))}
    for name, values in new.items():
        before = np.asarray(getattr(valve, f"chord_{name}"))
        setattr(valve, f"chord_{name}", np.concatenate([before, values]).astype(before.dtype))
