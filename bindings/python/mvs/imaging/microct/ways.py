"""Ways through a skeleton of chordae that touch: where chordae cross or run together, each goes straight on.

The skeleton becomes a graph of edges between junctions. Chordae that touch over less than FUSED are one junction.
Edges are lower or upper at a junction by where they lie between muscles and leaflets. Lower and upper edges are
paired so that the sum of their bends is least. Upper edges that are left over fork from the straightest lower
one; lower edges that are left over near a leaflet end there by themselves. A shortest path would take the other
chord wherever that is shorter: to another head, with whole chordae left out.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..needs import need

Points = NDArray[np.float64]
Rows = NDArray[np.int64]
FUSED = 1.5e-3
"""m: junctions nearer than this along the skeleton are one, in which chordae touch or cross"""
SPUR = 1.5e-3
"""m: shorter edges to an end at neither muscle nor leaflet are roughness of the surface"""
FLARE = 2.4e-3
"""m: shorter edges from one junction to ends at the leaflet are one chord, which flares there"""
SHARED_END = 4e-3
"""m: chordae that run into one edge this short before the leaflet end by themselves"""
SKIPPED, TAIL = 0.4e-3, 3.5e-3
"""m: the part of an edge whose direction counts at a junction, from its end on"""


@dataclasses.dataclass(eq=False)
class Edge:
    """Rows of voxels from the lower end to the upper end, and the junctions there; -1: none."""

    rows: list[int]
    lower: int
    upper: int


@dataclasses.dataclass(frozen=True, eq=False)
class Skeleton:
    """Voxels at places (n, 3) m; neighbours (m, 2); which are in a muscle, which near a leaflet.

    to_leaflet: (n,) m
    height: (n,) 0 at muscles to 1 at leaflets
    """

    at: Points
    pairs: Rows
    in_muscle: NDArray[np.bool_]
    near_leaflet: NDArray[np.bool_]
    to_leaflet: Points
    height: Points


def ways_through(skeleton: Skeleton) -> tuple[list[Rows], Rows]:
    """Ways from a muscle to a leaflet as numbers of points, and the row of the voxel of each point.

    Ways of a fork begin with the same points; chordae that cross have points of their own in one voxel.
    """
    edges, junction = edges_of(skeleton)
    edges, junction = _without_spurs(skeleton, edges, junction)
    edges, junction = _fused(skeleton, edges, junction)
    _turn_upwards(skeleton, edges)
    return _Joined(skeleton, edges, junction).ways()


def edges_of(s: Skeleton) -> tuple[list[Edge], dict[int, list[int]]]:
    """Chains of voxels between junctions, and the voxels of each junction.

    Junctions are clusters of voxels with three neighbours or more; the voxels of muscles are their own.
    """
    sparse, search = need("scipy.sparse"), need("scipy.sparse.csgraph")
    n = len(s.at)
    kept = s.pairs[~s.in_muscle[s.pairs].all(axis=1)]
    degree = np.bincount(kept.ravel(), minlength=n)
    knot = (degree > 2) & ~s.in_muscle
    both = kept[knot[kept].all(axis=1)]
    _, label = search.connected_components(
        sparse.coo_matrix((np.ones(len(both)), both.T), (n, n)), directed=False)
    junction: dict[int, list[int]] = {}
    for row in np.flatnonzero(knot):
        junction.setdefault(int(label[row]), []).append(int(row))
    beside: dict[int, list[int]] = {}
    for a, b in kept.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    edges, seen = [], np.zeros(n, bool)
    stops = knot | s.in_muscle | (degree == 1)
    for start in np.flatnonzero(stops & (degree > 0)).tolist():
        for second in beside[start]:
            if knot[start] and knot[second] or (seen[second] and not stops[second]):
                continue
            chain = [start, second]
            while not stops[chain[-1]]:
                seen[chain[-1]] = True
                onward = [k for k in beside[chain[-1]] if k != chain[-2]]
                if not onward:
                    break
                chain.append(onward[0])
            if stops[second] and start > second:
                continue  # found from the other end
            ends = [int(label[k]) if knot[k] else -1 for k in (chain[0], chain[-1])]
            edges.append(Edge(chain, ends[0], ends[1]))
    return edges, junction


def _length(s: Skeleton, edge: Edge) -> float:
    return float(np.linalg.norm(np.diff(s.at[edge.rows], axis=0), axis=1).sum())


def _is_end(s: Skeleton, edge: Edge, side: int) -> bool:
    """Whether an edge ends at a muscle or a leaflet there."""
    row = edge.rows[side]
    return bool(s.in_muscle[row] or s.near_leaflet[row])


def _without_spurs(s: Skeleton, edges: list[Edge], junction: dict[int, list[int]]
                   ) -> tuple[list[Edge], dict[int, list[int]]]:
    """Drops short dead ends and all but the longest of the short edges of a flare."""
    kept: list[Edge] = []
    flares: dict[int, list[Edge]] = {}
    for edge in edges:
        free = [side for side, at in ((0, edge.lower), (-1, edge.upper)) if at < 0]
        if len(free) == 1 and _length(s, edge) < FLARE:
            row = edge.rows[free[0]]
            other = edge.upper if free[0] == 0 else edge.lower
            if s.near_leaflet[row] and not s.in_muscle[row]:
                flares.setdefault(other, []).append(edge)
                continue
            if not _is_end(s, edge, free[0]) and _length(s, edge) < SPUR:
                continue
        if edge.lower >= 0 and edge.lower == edge.upper:
            continue
        kept.append(edge)
    kept += [max(group, key=lambda edge: _length(s, edge)) for group in flares.values()]
    return _spliced(kept, junction)


def _spliced(edges: list[Edge], junction: dict[int, list[int]]) -> tuple[list[Edge], dict[int, list[int]]]:
    """Joins the two edges of each junction that has no others."""
    edges = list(edges)
    for name in list(junction):
        here = [edge for edge in edges if name in (edge.lower, edge.upper)]
        if len(here) != 2 or any(edge.lower == edge.upper for edge in here):
            continue
        first, second = (edge if edge.upper == name else Edge(edge.rows[::-1], edge.upper, edge.lower)
                         for edge in here)
        edges = [edge for edge in edges if edge is not here[0] and edge is not here[1]]
        edges.append(Edge(first.rows + second.rows[::-1], first.lower, second.lower))
    return edges, junction


def _fused(s: Skeleton, edges: list[Edge], junction: dict[int, list[int]]
           ) -> tuple[list[Edge], dict[int, list[int]]]:
    """Makes junctions that a short edge joins one; the edge goes into it."""
    name = {key: key for key in junction}
    for edge in sorted(edges, key=lambda edge: _length(s, edge)):
        a, b = name.get(edge.lower, -1), name.get(edge.upper, -1)
        if a >= 0 and b >= 0 and a != b and _length(s, edge) < FUSED:
            name = {key: a if value == b else value for key, value in name.items()}
    joined: dict[int, list[int]] = {}
    for key, rows in junction.items():
        joined.setdefault(name[key], []).extend(rows)
    kept = []
    for edge in edges:
        edge = Edge(edge.rows, name.get(edge.lower, -1), name.get(edge.upper, -1))
        if edge.lower >= 0 and edge.lower == edge.upper:
            joined[edge.lower].extend(edge.rows)
            continue
        kept.append(edge)
    return _spliced(kept, joined)


def _turn_upwards(s: Skeleton, edges: list[Edge]) -> None:
    """Turns edges so that their upper end is nearer to the leaflets; an end in a muscle is a lower one."""
    for edge in edges:
        low, high = (float(s.height[rows].mean()) for rows in (edge.rows[:3], edge.rows[-3:]))
        if s.in_muscle[edge.rows[0]]:
            low = -1.0
        if s.in_muscle[edge.rows[-1]]:
            high = -1.0
        if low > high:
            edge.rows, edge.lower, edge.upper = edge.rows[::-1], edge.upper, edge.lower


class _Joined:
    """Edges with the one below each of them."""

    def __init__(self, s: Skeleton, edges: list[Edge], junction: dict[int, list[int]]) -> None:
        self._s, self._edges, self._junction = s, edges, junction
        self._alone: set[int] = set()  # edges that end at the leaflet in tissue that they share
        self._below: dict[int, int] = {}
        for name in junction:
            self._pair(name)

    def ways(self) -> tuple[list[Rows], Rows]:
        first = np.cumsum([0, *(len(edge.rows) for edge in self._edges)])
        found = []
        for k, edge in enumerate(self._edges):
            if k in self._alone or self._s.near_leaflet[edge.rows[-1]] and edge.upper < 0:
                chain = [k]
                while chain[-1] in self._below and len(chain) <= len(self._edges):
                    chain.append(self._below[chain[-1]])
                if self._s.in_muscle[self._edges[chain[-1]].rows[0]]:
                    found.append(np.concatenate([np.arange(first[part], first[part + 1])
                                                 for part in chain[::-1]]))
        return found, np.array([row for edge in self._edges for row in edge.rows], np.int64)

    def _pair(self, name: int) -> None:
        lower = [k for k, edge in enumerate(self._edges) if edge.upper == name]
        upper = [k for k, edge in enumerate(self._edges) if edge.lower == name]
        if not lower:
            return
        away = self._s.to_leaflet[self._junction[name]].min()
        if len(lower) > len(upper) and away < SHARED_END and all(self._ends_soon(k) for k in upper):
            self._alone.update(lower)  # chordae that share their last stretch
            return
        if not upper:
            return
        bend = np.array([[self._bend(a, b) for b in upper] for a in lower])
        rows, columns = need("scipy.optimize").linear_sum_assignment(bend)
        for a, b in zip(rows, columns):
            self._below[upper[b]] = lower[a]
        for b in set(range(len(upper))) - set(columns.tolist()):
            self._below[upper[b]] = lower[int(bend[:, b].argmin())]
        if away < SHARED_END:
            self._alone.update(lower[a] for a in set(range(len(lower))) - set(rows.tolist()))

    def _ends_soon(self, k: int) -> bool:
        edge = self._edges[k]
        return edge.upper < 0 and bool(self._s.near_leaflet[edge.rows[-1]]) and (
            _length(self._s, edge) < SHARED_END)

    def _bend(self, below: int, above: int) -> float:
        """How far, m, each of two edges lies in the mean from the straight continuation of the other."""
        lines = [self._tail(self._edges[above].rows), self._tail(self._edges[below].rows[::-1])]
        away = []
        for line, other in (lines, lines[::-1]):
            middle = line.mean(axis=0)
            along = np.linalg.svd(line - middle, full_matrices=False)[2][0] if len(line) > 1 else np.zeros(3)
            off = other - middle
            if (line[0] - line[-1]) @ off.mean(axis=0) < 0:
                away.append(np.linalg.norm(off, axis=1).mean())  # backwards
            else:
                away.append(np.linalg.norm(off - (off @ along)[:, None] * along, axis=1).mean())
        return float(sum(away))

    def _tail(self, rows: list[int]) -> Points:
        """The part of an edge whose direction counts, from its first row on."""
        line = self._s.at[rows]
        away = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
        part = line[(away >= SKIPPED) & (away <= TAIL)]
        return part if len(part) >= 4 else line
