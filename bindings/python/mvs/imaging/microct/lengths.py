"""Rest lengths of chordae from the loaded image.

A way is the chain of segments from a papillary head over branch points to an insertion. The ways of
both images are paired by their insertions in the closed valve; the last segment of a way, which no other
way has, takes the difference of the lengths.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

import mvs
from ..findings import finding
from ..needs import need
from .chords import ChordNetwork
from .loaded import Loaded, settled
from .muscles import SAME_MUSCLE

Points = NDArray[np.float64]
SAME_CHORD = 4e-3
"""m: an insertion in the loaded image this near to a simulated one may be the same"""
MOST_CHANGE = 0.25
"""A way that differs by more between the images is of two different chordae."""
LEAST_SEGMENT = 0.3
"""The last segment of a way keeps at least this share of its length in the open image."""


@dataclasses.dataclass(frozen=True)
class Way:
    """Segments from a head to an insertion, in this order; the nodes at both ends."""

    segments: tuple[int, ...]
    head: int
    end: int


def ways_of(network: ChordNetwork) -> list[Way]:
    """The way to each insertion; segments that lead to no head are left out."""
    arriving = {int(b): k for k, (_, b) in enumerate(network.segments)}
    ways = []
    for end in range(network.heads + network.branches, len(network.nodes)):
        chain, node = [], end
        while node in arriving and len(chain) < len(network.segments):
            chain.append(arriving[node])
            node = int(network.segments[arriving[node], 0])
        if chain and node < network.heads:
            ways.append(Way(tuple(chain[::-1]), node, end))
    return ways


def with_loaded_lengths(valve: mvs.Valve, closed: mvs.Snapshot, network: ChordNetwork,
                        loaded: Loaded) -> tuple[mvs.Snapshot, mvs.Snapshot, mvs.Stats, mvs.Finding]:
    """Rest lengths with which the simulated chordae are as long as those in the loaded image.

    Fixed-point iteration on the closed valve: the loaded length over the stretch that the law of the
    chords has under the simulated tension, 1 for slack chordae, whose arcs are as long as at rest.
    Chords that are found in one image only keep the length of the open image.
    """
    rest = np.array(valve.chord_rest_length)
    open_rest = rest.copy()
    # ends have moved to vertices of the mesh: the lengths of the loaded image change by as much
    moved = open_rest - network.length
    pairs = paired_ways(closed, network, loaded, valve)
    stats = None
    opened = closed
    for _ in range(2):
        stretched = np.maximum(_lengths(closed, valve), rest)
        for way, length in pairs:
            chain = list(way.segments)
            before = open_rest[chain].sum()
            wanted = (length + moved[chain].sum()) * rest[chain].sum() / stretched[chain].sum()
            wanted = np.clip(wanted, (1 - MOST_CHANGE) * before, (1 + MOST_CHANGE) * before)
            last = chain[-1]
            rest[last] = max(wanted - rest[chain[:-1]].sum(), LEAST_SEGMENT * open_rest[last])
        valve.chord_rest_length = rest.copy()
        opened, closed, stats = settled(valve)
    assert stats is not None
    found = np.array([rest[list(way.segments)].sum() / open_rest[list(way.segments)].sum() - 1
                      for way, _ in pairs])
    return opened, closed, stats, finding(
        "loaded_chordae", mvs.FindingSource.MEASURED, 0.6 if len(pairs) else 0.2,
        _sentence_of(found, len(ways_of(network))), rest / open_rest - 1, "")


def _sentence_of(change: Points, count: int) -> str:
    if not len(change):
        return ("no chord of the open image was found in the loaded one: all keep the length that they have "
                "in the open image, and nothing shows whether they are as long under load")
    return (f"{len(change)} of {count} chordae were found in the loaded image, too; their rest lengths "
            f"changed by {100 * np.median(change):.1f} % in the median, so that they are as long under load "
            "as there")


def _lengths(closed: mvs.Snapshot, valve: mvs.Valve) -> Points:
    points = np.asarray(closed.node_position)
    ends = np.asarray(valve.chord_nodes, np.int64)
    return np.asarray(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1))


def paired_ways(closed: mvs.Snapshot, network: ChordNetwork, loaded: Loaded,
                valve: mvs.Valve) -> list[tuple[Way, float]]:
    """Ways that both images have, with their lengths in the loaded image, m.

    One to one, so that the sum of the distances between the insertions and of the differences of the
    lengths is least: neighbours insert 2 mm apart, hardly more than a simulated insertion is off.
    """
    other = loaded.network
    mine, theirs = ways_of(network), ways_of(other)
    if not mine or not theirs:
        return []
    points = np.asarray(closed.node_position)
    ends = np.asarray(valve.chord_nodes, np.int64)

    def apart(nodes: list[int], others: list[int]) -> Points:
        return np.asarray(np.linalg.norm(points[nodes][:, None] - other.nodes[others][None], axis=2))

    away = apart([ends[way.segments[-1], 1] for way in mine], [way.end for way in theirs])
    heads = apart([ends[way.segments[0], 0] for way in mine], [way.head for way in theirs])
    possible = (away < SAME_CHORD) & (heads < SAME_MUSCLE)
    lengths = np.array([other.length[list(way.segments)].sum() for way in theirs])
    own = np.array([network.length[list(way.segments)].sum() for way in mine])
    cost = np.where(possible, away + np.abs(own[:, None] - lengths), 1.0)
    rows, columns = need("scipy.optimize").linear_sum_assignment(cost)
    return [(mine[r], float(lengths[c])) for r, c in zip(rows, columns) if possible[r, c]]
