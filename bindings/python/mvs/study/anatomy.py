"""Finds chordae and leaflet vertices by their position, so that one plan fits many valves.

Names of chordae differ between valves, and between meshes of one valve; positions on a leaflet do
not.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .. import IdError, NodeKind, Part, PartKind, Snapshot
from ..mesh import edges_of, shortest_paths


@dataclass(frozen=True)
class Site:
    """A position on a leaflet.

    across: distance from the middle over half the width of the annulus; positive towards the
        anterolateral commissure
    down: 0 at the annulus, 1 at the free edge
    """

    leaflet: str
    across: float
    down: float


@dataclass(frozen=True)
class Chord:
    """A chord from a papillary head with all its branches.

    row: row of its first segment
    vertices: leaflet vertices at its ends
    """

    row: int
    vertices: tuple[int, ...]


class Anatomy:
    """Positions on the rest shape of a valve."""

    def __init__(self, snapshot: Snapshot) -> None:
        self.snapshot = snapshot
        self.rest = snapshot.node_rest
        self._triangles = snapshot.triangle_nodes.astype(np.int64)
        self._x = snapshot.frame.to_local(self.rest)[:, 1]
        self._half_width = float(np.abs(self._x[snapshot.annulus_nodes]).max())

    @cached_property
    def chords(self) -> list[Chord]:
        """The chordae from papillary heads, in the order of the valve."""
        rows = np.flatnonzero(np.isin(self.snapshot.chord_nodes[:, 0], self.snapshot.head_nodes))
        return [self._chord(int(row)) for row in rows]

    def chord_at(self, site: Site) -> Chord:
        """The chord to that leaflet only whose vertices are nearest to the site on average."""
        inside = set(self._vertices(site.leaflet).tolist())
        found = [chord for chord in self.chords if inside.issuperset(chord.vertices)]
        if not found:
            raise IdError(f"no chord ends on leaflet {site.leaflet} only")
        return min(found, key=lambda c: float(self._off(np.array(c.vertices), site).mean()))

    def vertex_at(self, site: Site) -> int:
        """The vertex of the leaflet nearest to the site, among those without a chord."""
        free = np.setdiff1d(self._vertices(site.leaflet), self.snapshot.chord_nodes)
        free = free[self.snapshot.node_kind[free] == NodeKind.LEAFLET]
        if len(free) == 0:
            raise IdError(f"every vertex of leaflet {site.leaflet} has a chord")
        return int(free[np.argmin(self._off(free, site))])

    def nearest_head(self, vertex: int, side: float) -> int:
        """The node of the papillary head nearest to a vertex, on the muscle of that side."""
        heads = self._muscle(side)
        return int(heads[np.argmin(np.linalg.norm(self.rest[heads] - self.rest[vertex], axis=1))])

    def part(self, kind: PartKind, row: int) -> Part:
        """The part of a kind in a row of the arrays."""
        return next(part for part in self.snapshot.parts if (part.kind, part.index) == (kind, row))

    def head_of(self, node: int) -> Part:
        """The papillary head at a node."""
        return self.part(PartKind.HEAD, int(np.flatnonzero(self.snapshot.head_nodes == node)[0]))

    def _chord(self, row: int) -> Chord:
        nodes = self.snapshot.chord_nodes
        held: list[int] = []
        segments = [row]
        while segments:
            end = int(nodes[segments.pop(), 1])
            if self.snapshot.node_kind[end] == NodeKind.BRANCH:
                segments += np.flatnonzero(nodes[:, 0] == end)[::-1].tolist()
            else:
                held.append(end)
        return Chord(row, tuple(held))

    def _vertices(self, leaflet: str) -> NDArray[np.int64]:
        index = self.snapshot.find(PartKind.LEAFLET, leaflet).index
        return np.unique(self._triangles[self.snapshot.triangle_leaflet == index])

    def _muscle(self, side: float) -> NDArray[np.int64]:
        heads = self.snapshot.head_nodes.astype(np.int64)
        return np.asarray(heads[(self._x[heads] > 0) == (side > 0)])

    @cached_property
    def _down(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Position of each node from annulus (0) to free edge (1), and the distance of the two, m."""
        edges = edges_of(self._triangles)
        snapshot = self.snapshot
        above, below = (
            shortest_paths(self.rest, edges, loop.astype(np.int64))[0]
            for loop in (snapshot.annulus_nodes, snapshot.free_edge_nodes)
        )
        return above / np.maximum(above + below, 1e-12), above + below

    def _off(self, vertices: NDArray[np.int64], site: Site) -> NDArray[np.float64]:
        """Squared distances of vertices from a site, m2."""
        share, length = self._down
        across = self._x[vertices] - site.across * self._half_width
        down = (share[vertices] - site.down) * length[vertices]
        return across**2 + down**2
