"""Spreads the chordae of a papillary head over an area, as in anatomy, and scales their diameters.

The parametric valve has three points per muscle at which a dozen chordae end; a volume of them would
show one thick bundle. Each chord gets a head of its own, displaced across the mean direction of the
chordae at the old head towards its own direction; rest lengths change with the distances.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ...arrays import Valve

Points = NDArray[np.float64]


def with_spread_heads(valve: Valve, spread: float, diameter: float) -> Valve:
    """The valve with heads that are up to `spread` (m) from the old ones, diameters times `diameter`."""
    changed = dataclasses.replace(valve)
    if valve.chord_nodes is None or not len(valve.chord_nodes):
        return changed
    area = valve.chord_area
    if area is None:
        area = np.full(len(valve.chord_nodes), np.pi / 4 * 1e-6)  # the library's default, 1 mm wide
    changed.chord_area = np.ascontiguousarray(area * diameter**2)
    if spread > 0:
        _spread(changed, spread)
    return changed


def _spread(valve: Valve, spread: float) -> None:
    """Moves the heads of a valve in place: one for each chord that ends at a head."""
    chords, heads = np.array(valve.chord_nodes), np.asarray(valve.head_nodes)
    nodes = np.asarray(valve.nodes, dtype=float)
    rest = np.linalg.norm(nodes[chords[:, 0]] - nodes[chords[:, 1]], axis=1)
    if valve.chord_rest_length is not None:
        given = np.asarray(valve.chord_rest_length)
        rest = np.where(given > 0, given, rest)
    origin, offset = list(range(len(nodes))), [np.zeros(3)] * len(nodes)
    new_heads = []
    for head in heads:
        rows = np.flatnonzero((chords == head).any(axis=1))
        side = (chords[rows] == head).argmax(axis=1)
        others = nodes[chords[rows, 1 - side]] - nodes[head]
        moves = spread * _lateral(others)
        for n, (row, s) in enumerate(zip(rows, side)):
            before = np.linalg.norm(others[n])
            rest[row] *= np.linalg.norm(others[n] - moves[n]) / before
            if n == 0:  # the old node serves the first chord
                offset[head] = moves[n]
                new_heads.append(int(head))
                continue
            chords[row, s] = len(origin)
            new_heads.append(len(origin))
            origin.append(int(head))
            offset.append(moves[n])
        if not len(rows):
            new_heads.append(int(head))
    for name in ("nodes", "nodes_loaded", "nodes_open"):
        points = getattr(valve, name)
        if points is not None:
            setattr(valve, name, np.ascontiguousarray(points[origin] + np.array(offset)))
    valve.chord_nodes = np.ascontiguousarray(chords.astype(np.uint32))
    valve.chord_rest_length = np.ascontiguousarray(rest)
    valve.head_nodes = np.array(new_heads, dtype=np.uint32)
    valve.head_id = valve.head_names = valve.node_origin = None


def _lateral(ways: Points) -> Points:
    """The parts of the directions across their mean, scaled so that the largest has length 1.

    0 where there is one chord only.
    """
    ways = ways / np.linalg.norm(ways, axis=1, keepdims=True)
    mean = ways.sum(axis=0)
    mean /= max(float(np.linalg.norm(mean)), 1e-9)
    across = ways - (ways @ mean)[:, None] * mean
    largest = float(np.linalg.norm(across, axis=1).max())
    return np.asarray(across / largest if largest > 1e-6 else 0 * across)
