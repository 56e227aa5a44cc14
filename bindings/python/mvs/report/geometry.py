"""What is drawn, in millimetres: X to the right, Y towards the anterior leaflet, Z to the atrium."""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import PartKind, Snapshot

Points = NDArray[np.float64]


@dataclass(eq=False)
class Drawing:
    """A snapshot in the coordinates of the pictures.

    X is to the surgeon's right when he looks from the atrium with the anterior leaflet up.
    """

    snapshot: Snapshot

    def place(self, points: Points) -> Points:
        """Points in m (..., 3) in the picture's millimetres."""
        local = self.snapshot.frame.to_local(points) * 1e3
        return np.stack([-local[..., 1], local[..., 0], local[..., 2]], axis=-1)

    @cached_property
    def nodes(self) -> Points:
        return self.place(self.snapshot.node_position)

    @cached_property
    def rest(self) -> Points:
        return self.place(self.snapshot.node_rest)

    @cached_property
    def triangles(self) -> NDArray[np.int64]:
        return self.snapshot.triangle_nodes.astype(np.int64)

    @property
    def annulus(self) -> Points:
        return self.nodes[self.snapshot.annulus_nodes]

    @property
    def free_edge(self) -> Points:
        return self.nodes[self.snapshot.free_edge_nodes]

    @property
    def heads(self) -> Points:
        return self.nodes[self.snapshot.head_nodes]

    @property
    def contact_thickness(self) -> float:
        return float(self.snapshot.valve_constants[1]) * 1e3

    def names(self, kind: PartKind) -> list[str]:
        return [part.name for part in self.snapshot.parts if part.kind == kind]

    @cached_property
    def normals(self) -> Points:
        """Unit normals of the triangles; they point into the atrium."""
        a, b, c = (self.nodes[self.triangles[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        return normal / np.where(length > 0, length, 1)

    def scallop_anchor(self, scallop: int, towards: Points) -> Points:
        """A point on a scallop that the eye sees from the direction `towards`."""
        mine = self.snapshot.triangle_scallop == scallop
        centres = self.nodes[self.triangles].mean(axis=1)
        facing = np.clip(self.normals @ towards, 0, None) ** 2
        weight = np.where(mine, facing + 1e-9, 0)
        return np.asarray((centres * weight[:, None]).sum(axis=0) / weight.sum())

    def to_nodes(self, values: NDArray[Any]) -> NDArray[np.float64]:
        """Values of triangles as means at the nodes, for smooth colours."""
        total = np.zeros(len(self.nodes))
        count = np.zeros(len(self.nodes))
        for k in range(3):
            np.add.at(total, self.triangles[:, k], values)
            np.add.at(count, self.triangles[:, k], 1)
        return total / np.maximum(count, 1)


@dataclass(eq=False)
class Unrolled:
    """The leaflets cut at a commissure and unrolled into a plane, in mm.

    Across: position along the annulus; down: distance from the annulus along the sheet at rest.
    """

    across: Points
    down: Points
    triangles: NDArray[np.int64]
    rows: NDArray[np.int64]
    """the triangles shown, as rows of the snapshot's; those over the cut are left out"""
    width: float


def unroll(drawing: Drawing) -> Unrolled:
    """Unrolls the open valve by an angle that is harmonic over the sheet and the geodesic distance
    from the annulus."""
    snapshot = drawing.snapshot
    edges = edges_of(drawing.triangles)
    loop = snapshot.annulus_nodes.astype(np.int64)
    sides = np.linalg.norm(drawing.rest[np.roll(loop, -1)] - drawing.rest[loop], axis=1)
    width = float(sides.sum())
    along = np.concatenate([[0.0], np.cumsum(sides)[:-1]]) / width
    down, nearest = ways_along(drawing.rest, edges, loop)
    turn = np.exp(2j * np.pi * along[nearest])
    fixed = np.isin(np.arange(len(turn)), loop)
    turn = _smooth(turn, fixed, edges)
    across = np.mod(np.angle(turn) / (2 * np.pi) - _seam(drawing, along, loop), 1.0) * width
    if _runs_backwards(drawing, across, width):
        across = width - across
    corners = across[drawing.triangles]
    whole = np.ptp(corners, axis=1) < width / 2
    return Unrolled(across, down, drawing.triangles[whole], np.flatnonzero(whole), width)


def edges_of(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Each edge of a mesh once, as pairs of nodes."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0)


def ways_along(
    points: Points, edges: NDArray[np.int64], sources: NDArray[np.int64]
) -> tuple[Points, NDArray[np.int64]]:
    """Shortest ways along edges from the sources, and which source each node is nearest to."""
    near: list[list[tuple[int, float]]] = [[] for _ in points]
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    for (a, b), length in zip(edges.tolist(), lengths.tolist()):
        near[a].append((b, length))
        near[b].append((a, length))
    way = np.full(len(points), np.inf)
    nearest = np.zeros(len(points), dtype=np.int64)
    queue = [(0.0, int(node), k) for k, node in enumerate(sources)]
    while queue:
        length, node, source = heapq.heappop(queue)
        if length >= way[node]:
            continue
        way[node], nearest[node] = length, source
        for other, side in near[node]:
            if length + side < way[other]:
                heapq.heappush(queue, (length + side, other, source))
    return np.where(np.isfinite(way), way, 0.0), nearest


def _smooth(
    turn: NDArray[np.complex128], fixed: NDArray[np.bool_], edges: NDArray[np.int64]
) -> NDArray[np.complex128]:
    """Averages over neighbours until smooth; enough rounds to cross a sheet of many rows."""
    a, b = edges.T
    count = np.maximum(np.bincount(edges.ravel(), minlength=len(turn)), 1)
    for _ in range(300):
        total = np.zeros_like(turn)
        for part, put in ((turn.real, 1), (turn.imag, 1j)):
            total += put * np.bincount(a, part[b], len(turn))
            total += put * np.bincount(b, part[a], len(turn))
        mean = total / count
        turn = np.where(fixed | (mean == 0), turn, mean / np.maximum(np.abs(mean), 1e-12))
    return turn


def _first_nodes(drawing: Drawing, leaflet: int) -> NDArray[np.bool_]:
    touched = np.zeros(len(drawing.nodes), dtype=bool)
    touched[drawing.triangles[drawing.snapshot.triangle_leaflet == leaflet]] = True
    return touched


def _seam(drawing: Drawing, along: Points, loop: NDArray[np.int64]) -> float:
    """Where to cut: the commissure on the surgeon's left, or the leftmost point if there is none."""
    both = loop[_first_nodes(drawing, 0)[loop] & _first_nodes(drawing, 1)[loop]]
    candidates = both if len(both) else loop
    left = candidates[np.argmin(drawing.nodes[candidates, 0])]
    return float(along[np.flatnonzero(loop == left)[0]])


def _runs_backwards(drawing: Drawing, across: Points, width: float) -> bool:
    """The first leaflet (the anterior) is drawn left of the others."""
    mine = drawing.snapshot.triangle_leaflet == 0
    centre = across[drawing.triangles[mine]].mean()
    return bool(mine.any() and not mine.all() and centre > width / 2)
