"""Signed distances of points to solids: sheets with a thickness, and round cones. Negative inside.

A round cone is the hull of two spheres; a tube is a round cone with equal radii.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Values = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Sheet:
    """All points within half a thickness of a triangle surface.

    points: (n, 3); triangles: (m, 3); half: (n,) half thickness at the points, linear in between
    """

    points: Points
    triangles: NDArray[np.int64]
    half: Values

    def __len__(self) -> int:
        return len(self.triangles)


@dataclasses.dataclass(frozen=True)
class Cones:
    """Round cones from `start` to `end`, (n, 3), with radii `first` and `last`, (n,)."""

    start: Points
    end: Points
    first: Values
    last: Values

    def __len__(self) -> int:
        return len(self.start)

    def pieces(self, element: int, size: float) -> list[tuple[Points, Points, float]]:
        """Parts of the axis of about a diameter each: start, end, largest radius of the cone."""
        a, b = self.start[element], self.end[element]
        radius = float(max(self.first[element], self.last[element]))
        count = max(1, int(np.ceil(np.linalg.norm(b - a) / (2 * radius + size))))
        knots = a + np.linspace(0, 1, count + 1)[:, None] * (b - a)
        return [(p, q, radius) for p, q in zip(knots, knots[1:])]

    def distance(self, element: int, at: Points) -> Values:
        """Signed distance of points (k, 3) to a cone.

        The smallest of |x - c(s)| - r(s) over the spheres along the axis; it is convex in s and
        smallest where (y - s) = slope |x - c(s)|, y and x being axial and radial coordinates.
        """
        a, first, last = self.start[element], self.first[element], self.last[element]
        axis = self.end[element] - a
        length = float(np.linalg.norm(axis))
        out = at - a
        if length <= abs(first - last):  # one sphere holds the other
            centre = np.zeros(3) if first >= last else axis
            return np.asarray(np.linalg.norm(out - centre, axis=1) - max(first, last))
        slope = (first - last) / length
        y = out @ (axis / length)
        x = np.sqrt(np.maximum(np.einsum("ij,ij->i", out, out) - y * y, 0))
        s = np.clip(y - slope / np.sqrt(1 - slope * slope) * x, 0, length)
        return np.asarray(np.sqrt(x * x + (y - s) ** 2) - first + slope * s)


def distance_to_sheet(sheet: Sheet, triangle: NDArray[np.int32], at: Points) -> Values:
    """Signed distances of points (n, 3) to the solids of one triangle each.

    The nearest point is the foot in the plane where it lies inside, else the nearest of those on
    the three sides; the half thickness there is subtracted.
    """
    nodes = sheet.triangles[triangle]
    corner = [sheet.points[nodes[:, k]] for k in range(3)]
    half = [sheet.half[nodes[:, k]] for k in range(3)]
    best = np.full(len(at), np.inf)
    thick = np.zeros(len(at))
    for p, q in ((0, 1), (1, 2), (2, 0)):
        side, rest = corner[q] - corner[p], at - corner[p]
        share = np.clip(_dot(rest, side) / np.maximum(_dot(side, side), 1e-30), 0, 1)
        rest -= share[:, None] * side
        square = _dot(rest, rest)
        nearer = square < best
        best = np.where(nearer, square, best)
        thick = np.where(nearer, half[p] + share * (half[q] - half[p]), thick)
    ab, ac, out = corner[1] - corner[0], corner[2] - corner[0], at - corner[0]
    normal = np.cross(ab, ac)
    area2 = np.maximum(_dot(normal, normal), 1e-30)
    beta, gamma = _dot(np.cross(out, ac), normal) / area2, _dot(np.cross(ab, out), normal) / area2
    inside = (beta >= 0) & (gamma >= 0) & (beta + gamma <= 1)
    best = np.where(inside, np.minimum(best, _dot(out, normal) ** 2 / area2), best)
    linear = half[0] + beta * (half[1] - half[0]) + gamma * (half[2] - half[0])
    return np.asarray(np.sqrt(best) - np.where(inside, linear, thick))


def sheet_samples(sheet: Sheet, gap: float) -> tuple[Points, NDArray[np.int32]]:
    """Points of the triangles of a sheet at most about `gap` apart, and the triangle of each."""
    corners = sheet.points[sheet.triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    counts = np.maximum(1, np.ceil(sides / gap)).astype(int)
    points, owners = [], []
    for count in np.unique(counts):
        own = np.flatnonzero(counts == count)
        u, v = np.meshgrid(np.arange(count + 1), np.arange(count + 1))
        keep = u + v <= count
        u, v = u[keep] / count, v[keep] / count
        weights = np.stack([1 - u - v, u, v], axis=1)
        points.append(np.einsum("sk,tkd->tsd", weights, corners[own]).reshape(-1, 3))
        owners.append(np.repeat(own, len(weights)))
    if not points:
        return np.zeros((0, 3)), np.zeros(0, dtype=np.int32)
    return np.concatenate(points), np.concatenate(owners).astype(np.int32)


def _dot(a: Points, b: Points) -> Values:
    return np.asarray(np.einsum("ij,ij->i", a, b))
