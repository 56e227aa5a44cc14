"""Edges of a triangle mesh, and shortest paths along them (Dijkstra)."""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray


def edges_of(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """The edges of a mesh, each once, as pairs of nodes."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0)


def shortest_paths(
    points: NDArray[np.float64], edges: NDArray[np.int64], sources: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Lengths of the shortest paths from the sources along edges, and the nearest source per node.

    Nodes without a path get length 0.
    """
    near: list[list[tuple[int, float]]] = [[] for _ in points]
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    for (a, b), length in zip(edges.tolist(), lengths.tolist()):
        near[a].append((b, length))
        near[b].append((a, length))
    path = np.full(len(points), np.inf)
    nearest = np.zeros(len(points), dtype=np.int64)
    queue = [(0.0, int(node), k) for k, node in enumerate(sources)]
    while queue:
        length, node, source = heapq.heappop(queue)
        if length >= path[node]:
            continue
        path[node], nearest[node] = length, source
        for other, side in near[node]:
            if length + side < path[other]:
                heapq.heappush(queue, (length + side, other, source))
    return np.where(np.isfinite(path), path, 0.0), nearest
