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
from ..console import Console
from ..findings import finding
from ..needs import need
from .chords import ChordNetwork
from .loaded import Closure, Loaded, settled
from .muscles import SAME_MUSCLE

Points = NDArray[np.float64]
SAME_CHORD = 4e-3
"""m: an insertion in the loaded image this near to a simulated one may be the same"""
MOST_CHANGE = 0.25
"""A way that differs by more between the images is of two different chordae."""
SAME_CHANGE = 0.1
"""Changes of lengths that differ by more from their median are of ways that were paired wrongly, or lead over
chordae that touch in one image."""
LEAST_PAIRS = 5
"""Pairs from which on their median counts for all chordae."""
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
        chain: list[int] = []
        node = end
        while node in arriving and len(chain) < len(network.segments):
            chain.append(arriving[node])
            node = int(network.segments[arriving[node], 0])
        if chain and node < network.heads:
            ways.append(Way(tuple(chain[::-1]), node, end))
    return ways


def with_loaded_lengths(valve: mvs.Valve, closed: mvs.Snapshot, network: ChordNetwork,
                        loaded: Loaded, console: Console) -> tuple[Closure, list[mvs.Finding]]:
    """Rest lengths with which the simulated chordae are as long as those in the loaded image.

    Fixed-point iteration on the closed valve: the loaded length over the stretch that the law of the
    chords has under the simulated tension, 1 for slack chordae, whose arcs are as long as at rest.
    Chords whose change is not known get the median one (`agreed_changes`): lengths in the open image have
    an error in common, as paths cut slack arcs short where these touch, and end before the heads do.
    """
    rest = np.array(valve.chord_rest_length)
    open_rest = rest.copy()
    # ends have moved to vertices of the mesh: the lengths of the loaded image change by as much
    moved = open_rest - network.length
    pairs = paired_ways(closed, network, loaded, valve)
    stats = None
    opened = closed
    ways = ways_of(network)
    loaded_length = {way: length for way, length in pairs}
    for _ in range(2):
        stretched = np.maximum(_lengths(closed, valve), rest)
        before = np.array([open_rest[list(way.segments)].sum() for way in ways])
        change = np.full(len(ways), np.nan)
        for k, way in enumerate(ways):
            chain = list(way.segments)
            if way in loaded_length:
                wanted = (loaded_length[way] + moved[chain].sum()) * rest[chain].sum() / stretched[chain].sum()
                change[k] = np.clip(wanted / before[k], 1 - MOST_CHANGE, 1 + MOST_CHANGE)
        for way, wanted in zip(ways, before * agreed_changes(change)):
            chain = list(way.segments)
            last = chain[-1]
            rest[last] = max(wanted - rest[chain[:-1]].sum(), LEAST_SEGMENT * open_rest[last])
        valve.chord_rest_length = rest.copy()
        opened, closed, stats = settled(valve, console)
    assert stats is not None
    found = np.array([rest[list(way.segments)].sum() / open_rest[list(way.segments)].sum() - 1
                      for way, _ in pairs])
    return (opened, closed, stats), [finding(
        "loaded_chordae", mvs.FindingSource.MEASURED, 0.6 if len(pairs) else 0.2,
        _sentence_of(found, len(ways_of(network))), rest / open_rest - 1, "")]


def agreed_changes(change: Points) -> Points:
    """Factors on the lengths of all chordae from those of the paired ones, which are numbers; others are nan.

    The median for chordae without a number, and for those whose number is far from it. With few pairs each
    number is its own, and 1 where there is none.
    """
    known = np.isfinite(change)
    if known.sum() < LEAST_PAIRS:
        return np.where(known, change, 1.0)
    median = float(np.median(change[known]))
    near = known & (np.abs(np.where(known, change, median) / median - 1) <= SAME_CHANGE)
    return np.where(near, change, median)


def _sentence_of(change: Points, count: int) -> str:
    if not len(change):
        return ("no chord of the open image was found in the loaded one: all keep the length that they have "
                "in the open image, and nothing shows whether they are as long under load")
    return (f"{len(change)} of {count} chordae were found in the loaded image, too; their rest lengths "
            f"changed by {100 * np.median(change):.1f} % in the median, so that they are as long under load "
            "as there" + ("; those of the others by as much" if len(change) >= LEAST_PAIRS else ""))


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
