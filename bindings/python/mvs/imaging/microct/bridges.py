"""Links between the ends of a skeleton that are one chord, which passes so near a leaflet that its tissue
was taken for that of the leaflet.

Two ends are linked if they lie within GAP, if the chord continues straight from one to the other, and if
there is tissue in between. Each end is linked once, best pairs first.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..needs import need
from .segment import Mask

Points = NDArray[np.float64]
Rows = NDArray[np.int64]
GAP = 8e-3
"""m: open leaflets hang beside the chordae of the middle of the leaflet over some millimetres"""
BEND = 0.82
"""Cosine of the largest angle, 35 degrees, between the direction of an end and the way to the other."""
TAIL = 3e-3
"""m: of a chord before its end, whose direction counts; the last NEAR bends towards the leaflet"""
NEAR = 0.8e-3


def bridges(voxels: Rows, pairs: Rows, possible: NDArray[np.bool_], tissue: Mask, step: float) -> Rows:
    """Pairs (k, 2) of rows of voxels to link.

    voxels: (n, 3) of a skeleton; pairs: neighbours among them; possible: ends that may be linked
    """
    degree = np.bincount(pairs.ravel(), minlength=len(voxels))
    ends = np.flatnonzero(possible & (degree == 1))
    if len(ends) < 2:
        return np.zeros((0, 2), np.int64)
    direction, label = _directions(voxels, pairs, ends, step)
    candidates = need("scipy.spatial").cKDTree(voxels[ends]).query_pairs(GAP / step, output_type="ndarray")
    a, b = candidates.T
    # ends of one piece of skeleton make no way to a muscle that was not there
    a, b = a[label[a] != label[b]], b[label[a] != label[b]]
    way = (voxels[ends[b]] - voxels[ends[a]]).astype(float)
    length = np.linalg.norm(way, axis=1)
    way /= np.maximum(length, 1e-9)[:, None]
    bend = np.minimum((direction[a] * way).sum(axis=1), -(direction[b] * way).sum(axis=1))
    fits = (bend > BEND) & _in_tissue(voxels[ends[a]], voxels[ends[b]], tissue)
    cost = length * (1 + 4 * (1 - bend))
    free = np.ones(len(ends), bool)
    found = []
    for k in np.argsort(cost, kind="stable"):
        if fits[k] and free[a[k]] and free[b[k]]:
            free[a[k]] = free[b[k]] = False
            found.append((ends[a[k]], ends[b[k]]))
    return np.array(found, np.int64).reshape(-1, 2)


def _directions(voxels: Rows, pairs: Rows, ends: Rows, step: float) -> tuple[Points, Rows]:
    """The direction (e, 3) in which each end points, 0 where its tail is too short, and its piece of
    skeleton (e,)."""
    sparse, search = need("scipy.sparse"), need("scipy.sparse.csgraph")
    length = np.linalg.norm(voxels[pairs[:, 0]] - voxels[pairs[:, 1]], axis=1) * step
    links = sparse.coo_matrix((length, pairs.T), (len(voxels),) * 2).tocsr()
    _, piece = search.connected_components(links, directed=False)
    found = np.zeros((len(ends), 3))
    for k, away in enumerate(search.dijkstra(links, directed=False, indices=ends, limit=TAIL)):
        tail = np.flatnonzero((away > NEAR) & (away < TAIL))
        if len(tail) < 4:
            tail = np.flatnonzero(np.isfinite(away))
        place = voxels[tail].astype(float)
        vector = voxels[ends[k]] - place.mean(axis=0)
        if len(tail) >= 4:
            along = np.linalg.svd(place - place.mean(axis=0), full_matrices=False)[2][0]
            vector = along * np.sign(along @ vector)
        found[k] = vector / max(float(np.linalg.norm(vector)), 1e-9)
    return found, np.asarray(piece[ends], np.int64)


def _in_tissue(start: Rows, end: Rows, tissue: Mask) -> NDArray[np.bool_]:
    """Whether nine tenths of the straight line between each pair of voxels is tissue."""
    share = np.linspace(0, 1, 33)[:, None, None]
    at = np.rint(start + share * (end - start)).astype(int)
    return np.asarray(tissue[at[..., 0], at[..., 1], at[..., 2]].mean(axis=0) >= 0.9)
