"""Data of a fit: tracked points, or a closed surface that the leaflets lie on."""

from __future__ import annotations

import dataclasses
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..errors import ArgumentError
from ..surfaces import Surface

Array = NDArray[np.float64]

FAR = 10e-3
"""m: a target whose median distance from the start is larger is in another frame, or of another valve."""
CANDIDATES = 16
"""Triangles with the nearest centres among which the nearest point of a surface is taken."""


class Target(Protocol):
    """Residuals in m of a shape, and the derivative of each: nodes (k,) and directions (k, 3)."""

    def residuals(self, x: Array) -> tuple[Array, NDArray[np.int64], Array]: ...


@dataclasses.dataclass(frozen=True)
class Points:
    """Places (k, 3) in m of tracked nodes (k,), as of implanted markers or of a registered mesh."""

    nodes: NDArray[Any]
    places: Array

    def residuals(self, x: Array) -> tuple[Array, NDArray[np.int64], Array]:
        """Each coordinate of each node."""
        away = (x[self.nodes] - self.places).ravel()
        return away, np.repeat(self.nodes, 3).astype(np.int64), np.tile(np.eye(3), (len(self.nodes), 1))


class SurfaceTarget:
    """A closed surface: the signed distance of every leaflet node from it."""

    def __init__(self, points: Array, triangles: NDArray[Any], nodes: NDArray[np.int64]) -> None:
        from scipy.spatial import cKDTree

        self.corners = np.asarray(points, float)[np.asarray(triangles, np.int64)]
        normal = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        size = np.linalg.norm(normal, axis=1, keepdims=True)
        self.corners, self.normal = self.corners[size[:, 0] > 0], (normal / np.where(size > 0, size, 1))
        self.normal = self.normal[size[:, 0] > 0]
        self.nodes = nodes
        self.tree = cKDTree(self.corners.mean(axis=1))

    def residuals(self, x: Array) -> tuple[Array, NDArray[np.int64], Array]:
        """Signed by the normal of the nearest triangle whose normal agrees with nothing but nearness."""
        p = x[self.nodes]
        count = min(CANDIDATES, len(self.corners))
        near = self.tree.query(p, count)[1].reshape(len(p), count)
        feet = closest_on_triangles(p[:, None, :], self.corners[near])
        best = np.argmin(((p[:, None, :] - feet) ** 2).sum(axis=2), axis=1)
        rows = np.arange(len(p))
        away = p - feet[rows, best]
        normal = self.normal[near[rows, best]]
        distance = np.linalg.norm(away, axis=1)
        sign = np.where((away * normal).sum(axis=1) < 0, -1.0, 1.0)
        # on the surface the direction of the distance is the normal
        unit = np.where((distance > 1e-9)[:, None], away / np.maximum(distance, 1e-9)[:, None] * sign[:, None],
                        normal)
        return sign * distance, self.nodes, unit


def closest_on_triangles(p: Array, corners: Array) -> Array:
    """The closest point of each triangle (..., 3, 3) to each point (..., 3), by Voronoi regions (Ericson,
    Real-Time Collision Detection, 2005)."""
    a, b, c = corners[..., 0, :], corners[..., 1, :], corners[..., 2, :]
    ab, ac = b - a, c - a
    d00, d01, d11 = dot(ab, ab), dot(ab, ac), dot(ac, ac)
    d20, d21 = dot(p - a, ab), dot(p - a, ac)
    det = d00 * d11 - d01 * d01
    v, w = (d11 * d20 - d01 * d21) / det, (d00 * d21 - d01 * d20) / det
    inside = (v >= 0) & (w >= 0) & (v + w <= 1)
    face = a + v[..., None] * ab + w[..., None] * ac
    least = np.where(inside, dot(p - face, p - face), np.inf)
    best = face
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        s = np.clip(dot(p - start, along) / dot(along, along), 0, 1)
        foot = start + s[..., None] * along
        square = dot(p - foot, p - foot)
        nearer = square < least
        best = np.where(nearer[..., None], foot, best)
        least = np.where(nearer, square, least)
    return np.asarray(best)


def dot(u: Array, v: Array) -> Array:
    """The products of vectors along the last axis."""
    return np.asarray((u * v).sum(axis=-1))


def target_of(start: _core.Snapshot, given: Any) -> Target:
    """The target that an argument describes; ArgumentError for one in another frame."""
    leaflet = np.unique(start.triangle_nodes).astype(np.int64)
    if isinstance(given, Points):
        target: Target = _checked_points(start, given)
    elif isinstance(given, Surface):
        target = SurfaceTarget(given.points, given.triangles, leaflet)
    elif isinstance(given, _core.Snapshot):
        if not given.at_rest:
            raise ArgumentError("target: the snapshot is not at rest: settle it first", "target")
        target = SurfaceTarget(given.node_position, given.triangle_nodes, leaflet)
    elif type(given).__module__.startswith("mvs.imaging") and hasattr(given, "masks"):
        target = _labelled(given, leaflet)
    elif isinstance(given, tuple) and len(given) == 2:
        target = SurfaceTarget(*_checked_surface(*given), leaflet)
    else:
        raise ArgumentError(
            "target: mvs.Points, a mvs.Surface, a closed mvs.Snapshot, a mvs.imaging.LabelMap, or (points, "
            "triangles) is needed",
            "target",
        )
    away = target.residuals(np.array(start.node_position))[0]
    if isinstance(target, Points):
        away = np.linalg.norm(away.reshape(-1, 3), axis=1)
    distance = float(np.median(np.abs(away)))
    if not distance <= FAR:
        raise ArgumentError(
            f"target: it lies {distance * 1e3:.0f} mm from the valve (median): it is in another frame, "
            "in other units (m are needed), or of another valve",
            "target",
        )
    return target


def _labelled(labels: Any, leaflet: NDArray[np.int64]) -> Target:
    """The mid-surfaces of the closed leaflets in a label map (mvs.imaging.closed_surface)."""
    from ..imaging import closed_surface

    sheet = closed_surface(labels)[0]
    return SurfaceTarget(sheet.points, sheet.triangles, leaflet)


def _numbers(values: Any, what: str) -> Array:
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        raise ArgumentError(f"target: {what} have to be numbers, in m", "target") from None


def _whole(values: Any, what: str) -> NDArray[np.int64]:
    """Indices; a mask or fractions are not."""
    found = np.asarray(values)
    if found.dtype.kind not in "iu":
        raise ArgumentError(f"target: {what} have to be whole numbers, not {found.dtype}", "target")
    return found.astype(np.int64)


def _checked_surface(points: Any, triangles: Any) -> tuple[Array, NDArray[np.int64]]:
    points, triangles = _numbers(points, "points"), _whole(triangles, "triangles")
    if points.ndim != 2 or points.shape[1] != 3 or triangles.ndim != 2 or triangles.shape[1] != 3:
        raise ArgumentError("target: points (k, 3) and triangles (t, 3) are needed", "target")
    if len(triangles) == 0:
        raise ArgumentError("target: the surface has no triangles", "target")
    if not np.isfinite(points).all() or triangles.min() < 0 or triangles.max() >= len(points):
        raise ArgumentError("target: a point is not finite, or a triangle has no such point", "target")
    a, b, c = (points[triangles[:, k]] for k in range(3))
    if not np.cross(b - a, c - a).any():
        raise ArgumentError("target: no triangle of the surface has an area", "target")
    return points, triangles


def _checked_points(start: _core.Snapshot, given: Points) -> Points:
    nodes, places = _whole(given.nodes, "nodes of Points"), _numbers(given.places, "places of Points")
    count = len(start.node_position)
    if nodes.ndim != 1 or places.shape != (len(nodes), 3) or not np.isfinite(places).all():
        raise ArgumentError("target: Points need nodes (k,) and finite places (k, 3)", "target")
    if len(nodes) == 0 or nodes.min() < 0 or nodes.max() >= count:
        raise ArgumentError(
            f"target: Points name a node outside of 0 to {count - 1}: they are of another valve", "target"
        )
    return Points(nodes, places)
