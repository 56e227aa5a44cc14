"""Drawing coordinates in mm: X to the right, Y towards the anterior leaflet, Z to the atrium.

Also the unrolling of the leaflets into a plane.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mvs import PartKind, Snapshot
from mvs.mesh import edges_of, shortest_paths

Points = NDArray[np.float64]


@dataclass(eq=False)
class Drawing:
    """A snapshot in the coordinates of the pictures.

    X points to the surgeon's right in the view from the atrium with the anterior leaflet up.
    """

    snapshot: Snapshot

    def place(self, points: Points) -> Points:
        """Converts points (..., 3) from m to the coordinates of the drawing."""
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
        """A point on the part of a scallop that faces the direction `towards`."""
        mine = self.snapshot.triangle_scallop == scallop
        centres = self.nodes[self.triangles].mean(axis=1)
        facing = np.clip(self.normals @ towards, 0, None) ** 2
        weight = np.where(mine, facing + 1e-9, 0)
        return np.asarray((centres * weight[:, None]).sum(axis=0) / weight.sum())

    def to_nodes(self, values: NDArray[Any]) -> NDArray[np.float64]:
        """Means of triangle values at the nodes, for smooth colours."""
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
    """rows of the shown triangles in the snapshot; triangles across the cut are left out"""
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
    down, nearest = shortest_paths(drawing.rest, edges, loop)
    turn = np.exp(2j * np.pi * along[nearest])
    fixed = np.isin(np.arange(len(turn)), loop)
    turn = _smooth(turn, fixed, edges)
    across = np.mod(np.angle(turn) / (2 * np.pi) - _seam(drawing, along, loop), 1.0) * width
    if _runs_backwards(drawing, across, width):
        across = width - across
    corners = across[drawing.triangles]
    whole = np.ptp(corners, axis=1) < width / 2
    return Unrolled(across, down, drawing.triangles[whole], np.flatnonzero(whole), width)


def _smooth(
    turn: NDArray[np.complex128], fixed: NDArray[np.bool_], edges: NDArray[np.int64]
) -> NDArray[np.complex128]:
    """Jacobi smoothing of unit complex numbers; 300 sweeps cross a sheet of many rows."""
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
    """The cut: the commissure on the surgeon's left, else the leftmost point of the annulus."""
    both = loop[_first_nodes(drawing, 0)[loop] & _first_nodes(drawing, 1)[loop]]
    candidates = both if len(both) else loop
    left = candidates[np.argmin(drawing.nodes[candidates, 0])]
    return float(along[np.flatnonzero(loop == left)[0]])


def _runs_backwards(drawing: Drawing, across: Points, width: float) -> bool:
    """True if the first leaflet (the anterior) would be drawn right of the others."""
    mine = drawing.snapshot.triangle_leaflet == 0
    centre = across[drawing.triangles[mine]].mean()
    return bool(mine.any() and not mine.all() and centre > width / 2)
