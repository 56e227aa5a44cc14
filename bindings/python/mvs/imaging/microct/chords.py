"""Chords from paths along a skeleton: heads, branch points, segments with length and diameter."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ..mesh import Sheet
from ..needs import need
from .graph import Paths
from .segment import Tissue

Points = NDArray[np.float64]
TRUNK = 3e-3
"""m: chords that run together for less than this near a papillary muscle are taken to begin there"""
SAME_HEAD = 0.8e-3
"""m: chords of one muscle that begin nearer than this to each other, a diameter, have one head. Chordae
spread over several mm of a muscle: one head for all of them would move their ends by as much."""

EXTENSION = 4e-3
"""m: the end of a chord is continued at most so far to its insertion"""


@dataclasses.dataclass(frozen=True, eq=False)
class ChordNetwork:
    """Chords in an image. Nodes: heads, then branch points, then insertions on the leaflets.

    nodes: (n, 3) m; segments: (s, 2) from the head towards the leaflet
    lines: the axis of each segment, (k, 3) m; length, diameter: (s,) m
    """

    nodes: Points
    heads: int
    branches: int
    segments: NDArray[np.int64]
    lines: tuple[Points, ...]
    length: Points
    diameter: Points

    def __str__(self) -> str:
        ends = len(self.nodes) - self.heads - self.branches
        return (f"{len(self.segments)} segments, {self.heads} heads, {self.branches} branch points, "
                f"{ends} insertions; diameters {1e3 * np.median(self.diameter):.2f} mm"
                if len(self.segments) else "none")


def chords_of(results: Mapping[str, Any]) -> ChordNetwork:
    """Paths that run together are one segment; ends go to the heads and to the mid-surface."""
    tissue: Tissue = results["tissue"]
    paths: Paths = results["paths"]
    if not paths.paths:
        empty = np.zeros(0)
        return ChordNetwork(np.zeros((0, 3)), 0, 0, np.zeros((0, 2), np.int64), (), empty, empty)
    at = tissue.grid.place(paths.voxels[:, ::-1])
    head_at, head_of = heads_of(at, paths, results.get("tips"))
    cuts = [_cut(path, use, at) for use in [_uses(paths, len(at))] for path in paths.paths]
    nodes: list[Points] = list(head_at)
    branch: dict[int, int] = {}
    for cut in cuts:
        for voxel in cut[1:-1]:
            if voxel not in branch:
                branch[voxel] = len(nodes)
                nodes.append(at[voxel])
    sheet: Sheet = results["sheet"]
    surface = need("pyvista").PolyData.from_regular_faces(sheet.points * 1e3, sheet.triangles)
    segments: dict[tuple[int, int], Points] = {}
    for k, (path, cut) in enumerate(zip(paths.paths, cuts)):
        places = np.flatnonzero(np.isin(path, cut))
        end = len(nodes)
        nodes.append(_insertion(at[path], surface))
        names = [int(head_of[k]), *(branch[int(path[i])] for i in places[1:-1]), end]
        for a, b, i, j in zip(names, names[1:], places, places[1:]):
            if (a, b) not in segments:
                segments[a, b] = smooth_line(np.vstack([nodes[a], at[path[i:j + 1]], nodes[b]]),
                                             tissue.grid.step)
    pairs = np.array(list(segments), np.int64)
    lines = tuple(segments.values())
    length = np.array([np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines])
    return ChordNetwork(np.array(nodes), len(head_at), len(branch), pairs, lines, length,
                        diameters(tissue, paths.mask, lines))


def heads_of(at: Points, paths: Paths, tips: Optional[Points]) -> tuple[Points, NDArray[np.int64]]:
    """The heads, and that of each path: given tips, else groups of beginnings on one muscle."""
    begin = np.array([at[path[0]] for path in paths.paths])
    muscle = np.array(paths.muscle)
    if tips is not None and len(tips):
        nearest = np.linalg.norm(begin[:, None] - np.asarray(tips)[None], axis=2).argmin(axis=1)
        used, number = np.unique(nearest, return_inverse=True)
        return np.asarray(tips, float)[used], number
    hierarchy = need("scipy.cluster.hierarchy")
    number = np.zeros(len(begin), np.int64)
    places: list[Points] = []
    for label in np.unique(muscle):
        rows = np.flatnonzero(muscle == label)
        group = (hierarchy.fcluster(hierarchy.linkage(begin[rows], "average"), SAME_HEAD, "distance")
                 if len(rows) > 1 else np.ones(1, int))
        for name in np.unique(group):
            number[rows[group == name]] = len(places)
            places.append(begin[rows[group == name]].mean(axis=0))
    return np.array(places), number


def _uses(paths: Paths, count: int) -> NDArray[np.int64]:
    use = np.zeros(count, np.int64)
    for path in paths.paths:
        use[path] += 1
    return use


def _cut(path: NDArray[np.int64], use: NDArray[np.int64], at: Points) -> list[int]:
    """First voxel, branch points and last voxel of a path."""
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(at[path], axis=0), axis=1))])
    change = np.flatnonzero(use[path[1:]] != use[path[:-1]])
    inner = [int(path[k]) for k in change if along[k] > TRUNK and along[-1] - along[k] > 1e-3]
    return [int(path[0]), *inner, int(path[-1])]


def _insertion(line: Points, surface: Any) -> Points:
    """Where the end of a line, continued straight, first comes within 0.3 mm of the mid-surface; else
    the nearest point of the mid-surface to that continuation.

    Where a chord comes near to a leaflet its tissue is joined to it, the sooner the flatter it lies, and
    the skeleton bends: the direction is that of the last 2.5 mm without the last 0.8 mm.
    """
    left = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line[::-1], axis=0), axis=1))])[::-1]
    straight = line[(left > 0.8e-3) & (left < 3.3e-3)]
    places = line[-1:]
    if len(straight) >= 4:
        middle = straight.mean(axis=0)
        along = np.linalg.svd(straight - middle, full_matrices=False)[2][0]
        along *= np.sign(along @ (straight[-1] - straight[0])) or 1.0
        start = (line[-1] - middle) @ along - 0.8e-3
        places = middle + (start + np.arange(0, EXTENSION, 0.1e-3))[:, None] * along
    _, closest = surface.find_closest_cell(places * 1e3, return_closest_point=True)
    closest = np.atleast_2d(closest) * 1e-3
    away = np.linalg.norm(closest - places, axis=1)
    near = np.flatnonzero(away < 0.3e-3)
    return np.asarray(closest[near[0] if len(near) else away.argmin()], float)


def smooth_line(line: Points, step: float) -> Points:
    """A line of voxels at equal distances, smoothed by a Gaussian along it; its ends stay.

    The steps of a skeleton make a line up to 8 % longer than the cable in it.
    """
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    kept = np.concatenate([[True], np.diff(along) > 0])
    line, along = line[kept], along[kept]
    if len(line) < 3:
        return line
    count = max(3, int(along[-1] / step) + 1)
    equal = np.linspace(0, along[-1], count)
    line = np.column_stack([np.interp(equal, along, line[:, k]) for k in range(3)])
    first, last = line[0].copy(), line[-1].copy()
    straight = first + np.linspace(0, 1, count)[:, None] * (last - first)
    # odd about both ends, which therefore stay
    away = line - straight
    odd = np.vstack([-away[:0:-1], away, -away[-2::-1]])
    sigma = min(1.2e-3 / step, count / 4)
    away = need("scipy.ndimage").gaussian_filter1d(odd, sigma, axis=0)[count - 1:2 * count - 1]
    return np.asarray(straight + away)


def diameters(tissue: Tissue, mask: NDArray[np.bool_], lines: tuple[Points, ...]) -> Points:
    """The diameter of the cylinder that has the volume of the tissue nearest to each line."""
    image = need("scipy.ndimage")
    near = image.binary_dilation(mask, np.ones((3, 3, 3)))
    voxels = np.argwhere(near & (tissue.share > 0))
    # the middle of a segment: its ends are in leaflets, muscles and branch points
    inner = [line[int(0.2 * len(line)):max(int(0.8 * len(line)), int(0.2 * len(line)) + 2)]
             for line in lines]
    points = np.vstack(lines)
    owner = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    middle = np.concatenate([np.isin(np.arange(len(line)), np.arange(
        int(0.2 * len(line)), max(int(0.8 * len(line)), int(0.2 * len(line)) + 2))) for line in lines])
    away, nearest = need("scipy.spatial").cKDTree(points).query(
        tissue.grid.place(voxels[:, ::-1]), distance_upper_bound=1.5e-3)
    found = np.flatnonzero(np.isfinite(away))
    found = found[middle[nearest[found]]]
    volume = np.bincount(owner[nearest[found]], tissue.share[tuple(voxels[found].T)],
                         len(lines)) * tissue.grid.step ** 3
    length = np.array([np.linalg.norm(np.diff(line, axis=0), axis=1).sum() + tissue.grid.step
                       for line in inner])
    return np.sqrt(4 * volume / (np.pi * length))
