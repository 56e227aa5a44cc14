"""Normals of a thin sheet of tissue in a volume, oriented alike over the whole sheet.

Direction: first eigenvector of the structure tensor (Bigun and Granlund 1987). Sign: spread along a
maximum spanning tree of neighbouring voxels (Hoppe et al. 1992), then majority among neighbours.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .needs import need

Voxels = NDArray[np.int64]


def directions(tissue: NDArray[np.float32], voxels: Voxels, scale: float) -> NDArray[np.float32]:
    """Unit normals (n, 3) in the order x, y, z at voxels (n, 3) in the order z, y, x.

    scale: voxels, standard deviation of the Gaussian over which products of gradients are averaged
    """
    image = need("scipy.ndimage")
    smooth = image.gaussian_filter(tissue, 0.8, mode="nearest", truncate=3)
    gradient = [np.gradient(smooth, axis=axis) for axis in (2, 1, 0)]
    tensor = np.empty((len(voxels), 3, 3), np.float32)
    at = tuple(voxels.T)
    for a in range(3):
        for b in range(a, 3):
            product = image.gaussian_filter(gradient[a] * gradient[b], scale, truncate=3)
            tensor[:, a, b] = tensor[:, b, a] = product[at]
    return np.asarray(np.linalg.eigh(tensor)[1][:, :, 2])


def neighbour_pairs(shape: tuple[int, ...], voxels: Voxels) -> NDArray[np.int64]:
    """Pairs (k, 2) of rows of `voxels` that share a face, an edge or a corner."""
    number = np.full(shape, -1, np.int32)
    number[tuple(voxels.T)] = np.arange(len(voxels))
    pairs = []
    steps = [(dz, dy, dx) for dz in (0, 1) for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
    limits = np.array(shape)
    for step in steps:
        if step <= (0, 0, 0):
            continue
        other = voxels + step
        inside = ((other >= 0) & (other < limits)).all(axis=1)
        rows = np.flatnonzero(inside)
        found = number[tuple(other[rows].T)]
        pairs.append(np.column_stack([rows[found >= 0], found[found >= 0]]))
    return np.concatenate(pairs)


def orient(normals: NDArray[np.float32], pairs: NDArray[np.int64]) -> NDArray[np.float32]:
    """The same normals with signs that agree between neighbours; each piece has a sign of its own."""
    sparse, graph = need("scipy.sparse"), need("scipy.sparse.csgraph")
    count = len(normals)
    dot = np.einsum("ij,ij->i", normals[pairs[:, 0]], normals[pairs[:, 1]])
    # least cost first; never 0, which a sparse matrix would take for no edge
    links = sparse.coo_matrix((1.0001 - np.abs(dot), pairs.T), (count, count)).tocsr()
    sign = _signs(graph.minimum_spanning_tree(links), normals)
    both = np.concatenate([pairs, pairs[:, ::-1]])
    agree = sparse.coo_matrix((np.tile(dot, 2), both.T), (count, count)).tocsr()
    for _ in range(20):
        vote = agree @ sign
        changed = np.where(vote * sign < 0, -sign, sign)
        if (changed == sign).all():
            break
        sign = changed
    return normals * sign[:, None].astype(np.float32)


def _signs(tree: Any, normals: NDArray[np.float32]) -> NDArray[np.float64]:
    """Signs along the edges of a forest, by pointer jumping from each voxel towards its root."""
    sparse, graph = need("scipy.sparse"), need("scipy.sparse.csgraph")
    count = len(normals)
    pieces, label = graph.connected_components(tree, directed=False)
    first = np.full(pieces, count)
    np.minimum.at(first, label, np.arange(count))
    # one more node joins the roots of all pieces, so that one traversal reaches every voxel
    tree = tree.tocoo()
    rows = np.concatenate([tree.row, np.full(pieces, count)])
    columns = np.concatenate([tree.col, first])
    joined = sparse.coo_matrix((np.ones(len(rows)), (rows, columns)), (count + 1, count + 1))
    _, before = graph.breadth_first_order(joined.tocsr(), count, directed=False)
    parent = np.asarray(before[:count], dtype=np.int64)
    parent[first] = first
    sign = np.where(np.einsum("ij,ij->i", normals, normals[parent]) < 0, -1.0, 1.0)
    while not (parent[parent] == parent).all():
        sign = sign * sign[parent]
        parent = parent[parent]
    return sign
