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

    def box(self, element: int) -> tuple[Points, Points]:
        """Bounds of a triangle with its thickness."""
        corners = self.points[self.triangles[element]]
        reach = self.half[self.triangles[element]].max()
        return corners.min(axis=0) - reach, corners.max(axis=0) + reach

    def pieces(self, element: int, _size: float) -> list[tuple[Points, Points]]:
        """Boxes that cover the solid of a triangle."""
        return [self.box(element)]

    def distance(self, element: int, at: Points) -> Values:
        """Signed distance of points (k, 3) to the solid of a triangle."""
        nodes = self.triangles[element]
        return _triangle_distance(self.points[nodes], self.half[nodes], at)


@dataclasses.dataclass(frozen=True)
class Cones:
    """Round cones from `start` to `end`, (n, 3), with radii `first` and `last`, (n,)."""

    start: Points
    end: Points
    first: Values
    last: Values

    def __len__(self) -> int:
        return len(self.start)

    def pieces(self, element: int, size: float) -> list[tuple[Points, Points]]:
        """Boxes that cover a cone: one for each part of its axis of about its diameter."""
        a, b = self.start[element], self.end[element]
        radius = float(max(self.first[element], self.last[element]))
        count = max(1, int(np.ceil(np.linalg.norm(b - a) / (2 * radius + size))))
        knots = a + np.linspace(0, 1, count + 1)[:, None] * (b - a)
        return [
            (np.minimum(p, q) - radius, np.maximum(p, q) + radius)
            for p, q in zip(knots, knots[1:])
        ]

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
            return np.linalg.norm(out - centre, axis=1) - max(first, last)
        slope = (first - last) / length
        y = out @ (axis / length)
        x = np.sqrt(np.maximum(np.einsum("ij,ij->i", out, out) - y * y, 0))
        s = np.clip(y - slope / np.sqrt(1 - slope * slope) * x, 0, length)
        return np.sqrt(x * x + (y - s) ** 2) - first + slope * s


def _triangle_distance(corners: Points, half: Values, at: Points) -> Values:
    """Distance of points to a triangle less the half thickness at the nearest point.

    The nearest point is the foot in the plane where it lies inside, else the nearest of those on
    the three sides.
    """
    a, b, c = corners
    ab, ac, out = b - a, c - a, at - a
    normal = np.cross(ab, ac)
    square = float(normal @ normal)
    best = np.full(len(at), np.inf)
    thick = np.zeros(len(at))
    for p, q, hp, hq in ((a, b, *half[[0, 1]]), (b, c, *half[[1, 2]]), (c, a, *half[[2, 0]])):
        side = q - p
        length2 = max(float(side @ side), 1e-30)
        rest = at - p
        share = np.clip(rest @ side / length2, 0, 1)
        rest = rest - share[:, None] * side
        d2 = np.einsum("ij,ij->i", rest, rest)
        nearer = d2 < best
        best = np.where(nearer, d2, best)
        thick = np.where(nearer, hp + share * (hq - hp), thick)
    if square > 1e-30:
        beta = out @ (np.cross(ac, normal) / square)
        gamma = out @ (np.cross(normal, ab) / square)
        inside = (beta >= 0) & (gamma >= 0) & (beta + gamma <= 1)
        foot2 = (out @ normal) ** 2 / square
        best = np.where(inside, foot2, best)
        linear = half[0] + beta * (half[1] - half[0]) + gamma * (half[2] - half[0])
        thick = np.where(inside, linear, thick)
    return np.sqrt(best) - thick
