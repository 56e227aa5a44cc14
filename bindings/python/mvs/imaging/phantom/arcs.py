"""The axes of chordae in a phantom: straight if taut; slack, a circular arc as long as the rest length.

An arc may bend to any side. Two solids are never in one place: of SIDES directions that is chosen in which the least
of the chord lies within the leaflets, from the one away from the valve's axis on.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..._core import Snapshot
from .distance import Sheet, sheet_samples
from .settings import Settings
from .truth import MM

Points = NDArray[np.float64]
SIDES = 16
"""Directions that are tried: an arc that bulges by 5 mm moves by 2 mm from one to the next"""
NEAR_END = 1.5
"""mm: a chord comes into its leaflet at its insertion"""
SAMPLE = 0.25
"""mm: between points of the leaflets and of an arc whose distances are compared"""


def chord_paths(snapshot: Snapshot, settings: Settings, sheets: Sequence[Sheet]) -> tuple[Points, ...]:
    """The axis of each chord in mm, from its first node to its second."""
    nodes = MM * np.asarray(snapshot.node_position)
    axis, centre = snapshot.frame.axes[2], MM * snapshot.frame.origin
    leaflets = _Leaflets(sheets)
    radius = MM * np.sqrt(np.asarray(snapshot.chord_area) / np.pi)
    found = []
    for (a, b), rest, r in zip(np.asarray(snapshot.chord_nodes), MM * np.asarray(snapshot.chord_rest_length), radius):
        p, q = nodes[a], nodes[b]
        out = (p + q) / 2 - centre
        out -= out @ axis * axis
        length = rest if settings.chord_shape == "arc" else 0.0
        found.append(_clear_arc(p, q, length, out, leaflets, float(r)))
    return tuple(found)


class _Leaflets:
    """How much of a line lies within the leaflets."""

    def __init__(self, sheets: Sequence[Sheet]) -> None:
        points, half = [], []
        for sheet in sheets:
            at, triangle = sheet_samples(sheet, SAMPLE)
            points.append(at)
            half.append(sheet.half[sheet.triangles[triangle]].mean(axis=1))
        self._half = np.concatenate(half)
        self._tree = cKDTree(np.concatenate(points))

    def within(self, path: Points, radius: float) -> float:
        """The length, mm, of a tube along a path that overlaps the leaflets, but for its ends."""
        along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
        at = np.arange(NEAR_END, along[-1] - NEAR_END, SAMPLE)
        if not len(at):
            return 0.0
        away, row = self._tree.query(np.column_stack([np.interp(at, along, path[:, k]) for k in range(3)]))
        return SAMPLE * float((away < self._half[row] + radius).sum())


def _clear_arc(p: Points, q: Points, length: float, out: Points, leaflets: _Leaflets, radius: float) -> Points:
    first = _arc(p, q, length, out)
    least = leaflets.within(first, radius) if len(first) > 2 else 0.0
    if least == 0:
        return first
    along = (q - p) / np.linalg.norm(q - p)
    side = _across(out, along)
    other = np.cross(along, side)
    best = first
    turns = np.pi * np.array([(-1) ** k * (k // 2) for k in range(2, SIDES + 1)]) / (SIDES // 2)
    for turn in turns:
        arc = _arc(p, q, length, np.cos(turn) * side + np.sin(turn) * other)
        inside = leaflets.within(arc, radius)
        if inside < least:
            best, least = arc, inside
    return best


def _across(out: Points, along: Points) -> Points:
    """The unit vector of the part of a vector across another; an arbitrary one across it if both are parallel."""
    side = out - out @ along * along
    if np.linalg.norm(side) < 1e-6:
        side = np.eye(3)[np.argmin(np.abs(along))]
        side = side - side @ along * along
    return np.asarray(side / np.linalg.norm(side))


def _arc(p: Points, q: Points, length: float, out: Points) -> Points:
    """A circular arc of a length from p to q that bends towards `out`; straight if it is no longer."""
    chord = float(np.linalg.norm(q - p))
    if length <= chord * (1 + 1e-4) or chord < 1e-9:
        return np.array([p, q])
    along = (q - p) / chord
    side = _across(out, along)
    half = _half_angle(chord / length)
    radius = length / (2 * half)
    count = max(2, int(np.ceil(2 * half / 0.3)))
    angles = np.linspace(-half, half, count + 1)
    x = radius * np.sin(angles) + chord / 2
    y = radius * (np.cos(angles) - np.cos(half))
    path: Points = p + x[:, None] * along + y[:, None] * side
    path[0], path[-1] = p, q
    return path


def _half_angle(ratio: float) -> float:
    """The half angle of an arc whose chord is `ratio` times its length: sin(h) / h = ratio."""
    low, high = 1e-6, np.pi
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if np.sin(middle) / middle > ratio else (low, middle)
    return (low + high) / 2
