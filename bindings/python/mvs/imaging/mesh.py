"""Triangle sheets in NumPy: boundary loops, pieces, topology, smoothing on the surface."""

from __future__ import annotations

import dataclasses
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from .needs import need

Points = NDArray[np.float64]
Triangles = NDArray[np.int64]


@dataclasses.dataclass(eq=False)
class Sheet:
    """A triangle surface with values of its points.

    points: (n, 3) m
    triangles: (m, 3) int64
    values: arrays (n,) or (n, k) by name
    """

    points: Points
    triangles: Triangles
    values: dict[str, NDArray[Any]] = dataclasses.field(default_factory=dict)

    def __str__(self) -> str:
        size = 1e4 * areas(self.points, self.triangles).sum()
        return f"{len(self.triangles)} triangles, {size:.1f} cm2"

    def part(self, kept: NDArray[np.bool_]) -> "Sheet":
        """The triangles that are kept, with their points only."""
        triangles = self.triangles[kept]
        used, index = np.unique(triangles, return_inverse=True)
        return Sheet(self.points[used], index.reshape(-1, 3).astype(np.int64),
                     {name: value[used] for name, value in self.values.items()})


def edges_with_triangles(triangles: Triangles) -> tuple[Triangles, NDArray[np.int64]]:
    """All directed edges (3m, 2) and their triangles."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return edges, np.tile(np.arange(len(triangles)), 3)


def edge_numbers(triangles: Triangles) -> tuple[NDArray[np.int64], int]:
    """One number a * count + b for the undirected edge a < b of each directed one, and the count.

    Sorts as the pairs do, ten times as fast.
    """
    edges = edges_with_triangles(triangles)[0]
    count = int(triangles.max(initial=0)) + 1
    return edges.min(axis=1) * count + edges.max(axis=1), count


def unique_edges(triangles: Triangles) -> tuple[Triangles, NDArray[np.int64]]:
    """Undirected edges (e, 2) and the number of triangles at each."""
    number, count = edge_numbers(triangles)
    found, uses = np.unique(number, return_counts=True)
    return np.column_stack(np.divmod(found, count)), uses


def areas(points: Points, triangles: Triangles) -> Points:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def normals(points: Points, triangles: Triangles) -> Points:
    """Unit normals of the points, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    faces = np.cross(b - a, c - a)
    total = np.zeros_like(points)
    for k in range(3):
        for axis in range(3):
            total[:, axis] += np.bincount(triangles[:, k], faces[:, axis], len(points))
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return total / np.where(length > 0, length, 1)


def pieces(triangles: Triangles, count: int) -> NDArray[np.int64]:
    """The connected piece of each triangle; pieces share points."""
    sparse, graph = need("scipy.sparse"), need("scipy.sparse.csgraph")
    edges = edges_with_triangles(triangles)[0]
    links = sparse.coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), (count, count))
    _, label = graph.connected_components(links, directed=False)
    return np.asarray(label[triangles[:, 0]], dtype=np.int64)


def boundary_loops(triangles: Triangles) -> list[NDArray[np.int64]]:
    """The closed loops of edges with one triangle, each as points in order.

    Each edge is in one loop; a point at which loops touch may be in several. In a surface without
    edges of three triangles every point has an even number of such edges, so that loops close.
    """
    edges, count = unique_edges(triangles)
    rim = edges[count == 1]
    beside: dict[int, list[int]] = {}
    for a, b in rim.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    loops = []
    for start in sorted(beside):
        while beside[start]:
            loop, at = [], start
            while True:
                loop.append(at)
                after = beside[at].pop()
                beside[after].remove(at)
                at = after
                if at == start or not beside[at]:
                    break
            loops.append(np.array(loop))
    return loops


def manifold(triangles: Triangles, points: Points) -> Triangles:
    """Without the smallest triangles at edges that more than two triangles share."""
    for _ in range(10):
        owner = np.tile(np.arange(len(triangles)), 3)
        _, inverse, count = np.unique(edge_numbers(triangles)[0], return_inverse=True,
                                      return_counts=True)
        crowded = count[inverse.ravel()] > 2
        if not crowded.any():
            break
        size = areas(points, triangles)
        rows, edge = owner[crowded], inverse.ravel()[crowded]
        order = np.lexsort((size[rows], edge))
        _, first = np.unique(edge[order], return_index=True)
        triangles = np.delete(triangles, np.unique(rows[order][first]), axis=0)
    return triangles


MOST_TWISTED = 8
"""Triangles that go to make a sheet two-sided; one that needs more is twisted as a whole, and the build refuses it."""


def two_sided(triangles: Triangles, points: Points) -> Triangles:
    """Without the smallest triangles whose removal lets all be wound alike: strips of a few triangles with half a turn,
    where tissue of one leaflet lies on that of the other."""
    size, kept = areas(points, triangles), np.arange(len(triangles))
    for _ in range(MOST_TWISTED):
        pairs = _unlike_neighbours(triangles[kept])
        if not len(pairs):
            break
        rows = kept[pairs]
        kept = np.setdiff1d(kept, rows[np.arange(len(rows)), size[rows].argmin(axis=1)])
    else:
        return triangles
    return triangles[kept] if len(triangles) - len(kept) <= MOST_TWISTED else triangles


def _unlike_neighbours(triangles: Triangles) -> NDArray[np.int64]:
    """Pairs (k, 2) of neighbours that a walk over the sheet, breadth first, would wind in two ways."""
    edges, owner = edges_with_triangles(triangles)
    number = edge_numbers(triangles)[0]
    order = np.argsort(number, kind="stable")
    first = order[:-1][number[order[:-1]] == number[order[1:]]]
    second = order[1:][number[order[:-1]] == number[order[1:]]]
    unlike = edges[first, 0] == edges[second, 0]  # both pass the edge the same way
    if not unlike.any():
        return np.zeros((0, 2), np.int64)
    beside: list[list[tuple[int, bool]]] = [[] for _ in triangles]
    pairs: NDArray[np.int64] = np.column_stack([owner[first], owner[second]])
    for (a, b), turn in zip(pairs.tolist(), unlike.tolist()):
        beside[a].append((b, turn))
        beside[b].append((a, turn))
    turned: list[Optional[bool]] = [None] * len(triangles)
    for start in range(len(triangles)):
        if turned[start] is not None:
            continue
        turned[start] = False
        front = [start]
        for here in front:  # grows as it is walked
            for other, turn in beside[here]:
                if turned[other] is None:
                    turned[other] = bool(turned[here]) != turn
                    front.append(other)
    way = np.array(turned, bool)
    return np.asarray(pairs[(way[pairs[:, 0]] != way[pairs[:, 1]]) != unlike])


def loop_length(points: Points, loop: NDArray[np.int64]) -> float:
    return float(np.linalg.norm(points[loop] - points[np.roll(loop, -1)], axis=1).sum())


def loops_by_length(sheet: Sheet) -> list[NDArray[np.int64]]:
    """The boundary loops, the longest first."""
    return sorted(boundary_loops(sheet.triangles), key=lambda loop: -loop_length(sheet.points, loop))


def spanned(points: Points, loop: NDArray[np.int64]) -> float:
    """The area in m2 that a loop spans."""
    x = points[loop] - points[loop].mean(axis=0)
    return float(np.linalg.norm(np.cross(x, np.roll(x, -1, axis=0)).sum(axis=0)) / 2)


CRUMPLED = 4.0
"""length2 / (4 pi area) of a rim: a circle has 1, a slit six times as long as wide 2.6, the rims of whole
holes in the labels of four phantoms 1.0 to 1.4, those with shreds of spurs 3.4 to 7."""


def is_crumpled(points: Points, loop: NDArray[np.int64], length: float) -> bool:
    return length ** 2 > CRUMPLED * 4 * np.pi * spanned(points, loop)


def handles(sheet: Sheet) -> int:
    """The genus of one connected sheet: tunnels through it, which no leaflet has."""
    edges, _ = unique_edges(sheet.triangles)
    euler = len(np.unique(sheet.triangles)) - len(edges) + len(sheet.triangles)
    return max(0, (2 - len(boundary_loops(sheet.triangles)) - euler) // 2)


class Smoothing:
    """Averages of point values over a neighbourhood of the surface: heat flow with uniform weights.

    One pass replaces a value by the mean of itself and its neighbours.
    """

    def __init__(self, triangles: Triangles, count: int) -> None:
        sparse = need("scipy.sparse")
        edges, _ = unique_edges(triangles)
        ends = np.concatenate([edges, edges[:, ::-1]])
        links = sparse.coo_matrix((np.ones(len(ends)), ends.T), (count, count)).tocsr()
        links = links + sparse.identity(count, format="csr")
        weight = np.asarray(links.sum(axis=1)).ravel()
        self._mean = sparse.diags(1 / weight) @ links

    def __call__(self, values: NDArray[Any], passes: int,
                 weight: Optional[NDArray[Any]] = None) -> NDArray[Any]:
        """Values (n,) or (n, k) after some passes; points of weight 0 take part with none."""
        if weight is None:
            for _ in range(passes):
                values = self._mean @ values
            return values
        column = weight if values.ndim == 1 else weight[:, None]
        total, share = values * column, weight.astype(float)
        for _ in range(passes):
            total, share = self._mean @ total, self._mean @ share
        column = share if values.ndim == 1 else share[:, None]
        return np.asarray(total / np.maximum(column, 1e-12))


def smooth_rims(sheet: Sheet, passes: int) -> None:
    """Moves the points of boundary loops to the mean with their neighbours along the loop.

    Taubin's two steps (1995) keep the length of the loop.
    """
    for loop in boundary_loops(sheet.triangles):
        if len(loop) < 8:
            continue
        line = sheet.points[loop]
        for _ in range(passes):
            for step in (0.5, -0.53):
                line = line + step * ((np.roll(line, 1, 0) + np.roll(line, -1, 0)) / 2 - line)
        sheet.points[loop] = line


def in_largest_piece(sheet: Sheet, rows: NDArray[np.int64], area: Points) -> NDArray[np.bool_]:
    """Which of some triangles, given by their rows and areas, are in the piece of the largest area among them."""
    piece = pieces(sheet.triangles[rows], len(sheet.points))
    return np.asarray(piece == np.bincount(piece, area).argmax())


def largest_piece(sheet: Sheet) -> tuple[Sheet, list[float]]:
    """The piece of the largest area, and the areas (m2) of the others, largest first."""
    label = pieces(sheet.triangles, len(sheet.points))
    size = np.bincount(label, areas(sheet.points, sheet.triangles))
    order = np.argsort(-size, kind="stable")
    order = order[size[order] > 0]
    return sheet.part(label == order[0]), [float(size[k]) for k in order[1:]]
