"""Chordae: skeleton of the thin tissue, a graph of its voxels, paths from papillary muscles to leaflets."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import Sheet
from ..needs import need
from ..orientation import neighbour_pairs
from .bridges import bridges
from .segment import EVERYWHERE, Mask, Thick, Tissue, nearest_voxels

Points = NDArray[np.float64]
REACH = 1.5e-3
"""m: an end of the skeleton this near to a leaflet or a muscle is attached to it"""
SAME_END = 1.2e-3
"""m: ends on one leaflet nearer than this to each other belong to one chord, which flares there"""


@dataclasses.dataclass(frozen=True, eq=False)
class Muscles:
    """The papillary muscles among the thick parts: their labels, and their voxels; the wall, too."""

    labels: tuple[int, ...]
    mask: Mask
    wall: Mask

    def __str__(self) -> str:
        return f"{len(self.labels)} papillary muscles"


@dataclasses.dataclass(frozen=True, eq=False)
class Paths:
    """Skeleton voxels as a graph, and for each insertion the voxels from its muscle to the leaflet.

    voxels: (n, 3) z, y, x; paths: rows of voxels, from the muscle on; muscle: label of each path
    """

    voxels: NDArray[np.int64]
    paths: tuple[NDArray[np.int64], ...]
    muscle: tuple[int, ...]
    mask: Mask

    def __str__(self) -> str:
        return f"{len(self.paths)} insertions from {len(set(self.muscle))} papillary muscles"


def muscles_of(results: Mapping[str, Any]) -> Muscles:
    """Thick parts that touch leaflets over less than 15 mm2: the others are wall.

    The wall touches along the annulus (100 mm of a leaflet 0.8 mm thick), a muscle nowhere or at its tip.
    """
    image = need("scipy.ndimage")
    thick: Thick = results["thick"]
    near = image.binary_dilation(results["leaflets"].mask, EVERYWHERE, iterations=2)
    contact = np.bincount(thick.label[near], minlength=thick.count + 1)[1:]
    area = contact * results["tissue"].grid.step ** 2 / 2
    wall = [k + 1 for k in range(thick.count) if area[k] > 15e-6]
    muscles = tuple(k + 1 for k in range(thick.count) if k + 1 not in wall)
    return Muscles(muscles, np.isin(thick.label, muscles), np.isin(thick.label, wall))


def paths_of(results: Mapping[str, Any]) -> Paths:
    """The shortest path along the skeleton from the muscles to each end on a leaflet (Dijkstra)."""
    sparse, search = need("scipy.sparse"), need("scipy.sparse.csgraph")
    tissue: Tissue = results["tissue"]
    muscles: Muscles = results["muscles"]
    leaflets = near_sheet(tissue, results["sheet"])
    chords = tissue.mask & ~leaflets & ~muscles.mask & ~muscles.wall
    step = tissue.grid.step
    # with the muscles, so that the skeleton of chordae that merge above a muscle goes on into it
    skeleton = need("skimage.morphology").skeletonize(chords | muscles.mask)
    voxels = np.argwhere(skeleton)
    none = Paths(voxels, (), (), chords)
    if not len(voxels) or not muscles.labels:
        return none
    rows = tuple(voxels.T)
    pairs = neighbour_pairs(skeleton.shape, voxels)
    to_leaflet = np.where(leaflets[rows], 0, nearest_voxels(leaflets, voxels)[0]) * step
    in_muscle = muscles.mask[rows]
    pairs = np.vstack([pairs, bridges(voxels, pairs, (to_leaflet < REACH) & ~in_muscle, tissue.mask, step)])
    length = np.linalg.norm(voxels[pairs[:, 0]] - voxels[pairs[:, 1]], axis=1) * step
    links = sparse.coo_matrix((length, pairs.T), (len(voxels),) * 2).tocsr()
    degree = np.bincount(pairs.ravel(), minlength=len(voxels))
    nearest = np.where(in_muscle[:, None], voxels, nearest_voxels(muscles.mask, voxels)[1])
    own = results["thick"].label[tuple(nearest.T)]
    starts = np.flatnonzero(in_muscle)
    ends = np.flatnonzero((to_leaflet < REACH) & ~in_muscle & (degree == 1))
    if not len(starts) or not len(ends):
        return none
    distance, before, source = search.dijkstra(
        links, directed=False, indices=starts, min_only=True, return_predecessors=True)
    ends = ends[np.isfinite(distance[ends])]
    ends = _one_of_each_flare(ends, voxels, to_leaflet, before, step)
    paths = tuple(_trace(before, int(end)) for end in ends)
    return Paths(voxels, paths, tuple(int(own[path[0]]) for path in paths), chords)


def near_sheet(tissue: Tissue, sheet: Sheet) -> Mask:
    """The tissue within half of the thickness and one voxel of a mid-surface."""
    voxels = np.argwhere(tissue.mask)
    reach = 0.75 * float(sheet.values["thickness"].max()) + tissue.grid.step
    away, nearest = need("scipy.spatial").cKDTree(sheet.points).query(
        tissue.grid.place(voxels[:, ::-1]), distance_upper_bound=reach)
    found = np.isfinite(away)
    found[found] = (away[found] < sheet.values["thickness"][nearest[found]] / 2 + tissue.grid.step)
    mask = np.zeros(tissue.mask.shape, bool)
    mask[tuple(voxels[found].T)] = True
    return mask


def _trace(before: NDArray[np.int64], end: int) -> NDArray[np.int64]:
    path = [int(end)]
    while before[path[-1]] >= 0:
        path.append(int(before[path[-1]]))
    return np.array(path[::-1])


def _one_of_each_flare(ends: NDArray[np.int64], voxels: NDArray[np.int64], away: Points,
                       before: NDArray[np.int64], step: float) -> NDArray[np.int64]:
    """Keeps one end, the nearest to the leaflet, of those near to each other whose paths join soon."""
    order = ends[np.argsort(away[ends], kind="stable")]
    kept: list[int] = []
    reach = int(np.ceil(2 * SAME_END / step))
    tails: list[set[int]] = []
    for end in order:
        tail = set(_trace(before, int(end))[-reach:].tolist())
        near = [k for k, other in enumerate(kept)
                if np.linalg.norm(voxels[end] - voxels[other]) * step < SAME_END]
        if any(tail & tails[k] for k in near):
            continue
        kept.append(int(end))
        tails.append(tail)
    return np.array(sorted(kept), dtype=np.int64)
