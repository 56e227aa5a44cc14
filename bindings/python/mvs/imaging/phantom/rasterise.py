"""Rasterises solids: signed distances at voxel centres near them, and the covered share of voxels.

The share is that of sub-voxels, each weighted by its own distance as if its surface were plane
(partial volume); with sub-voxels of at most half the thickness of a sheet and a quarter of the diameter
of a tube the error of its volume is below 2.5 %.

The nearest triangle of a sheet is that of the nearest of many samples, found with a k-d tree; the
distance to that triangle is exact. Samples are at most 0.4 median half thicknesses apart, every point within
0.23 of one: where another triangle is nearer, a distance at the surface of the solid is too large by
up to 3 % of the half thickness (sqrt(1 + 0.23^2)).
Cones are compared one by one, within their boxes.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Union

import numpy as np
from numpy.typing import NDArray

from .distance import Cones, Sheet, distance_to_sheet, sheet_samples
from .grid import Grid

Solid = Union[Sheet, Cones]
Floats = NDArray[np.float64]
FAR = 1e3
"""mm: the distance of voxels beyond reach"""


@dataclasses.dataclass(frozen=True)
class Field:
    """Signed distances (mm) of voxel centres to a solid, and its nearest element; [k, j, i].

    Voxels farther than `reach` from the solid have the distance FAR and the element -1.
    """

    distance: NDArray[np.float32]
    element: NDArray[np.int32]
    reach: float


def distance_field(grid: Grid, solid: Solid, reach: float) -> Field:
    """Distances up to `reach` (mm) outside of the solid."""
    distance = np.full(grid.shape, FAR, dtype=np.float32)
    element = np.full(grid.shape, -1, dtype=np.int32)
    if isinstance(solid, Sheet):
        nearest = _NearestTriangle(solid)
        voxels = np.flatnonzero(_near(grid, nearest.samples, float(nearest.thickest) + reach))
        for part in np.array_split(voxels, len(voxels) // 500_000 + 1):
            found, owner = nearest.distance(_centres(grid, part), reach)
            inside = found <= reach
            distance.ravel()[part[inside]] = found[inside]
            element.ravel()[part[inside]] = owner[inside]
        return Field(distance, element, reach)
    for n, block, at in _blocks(grid, solid, reach):
        new = solid.distance(n, at).reshape(distance[block].shape)
        nearer = (new < distance[block]) & (new <= reach)
        distance[block][nearer] = new[nearer]
        element[block][nearer] = n
    return Field(distance, element, reach)


def coverage(grid: Grid, solid: Solid, field: Field, parts: int) -> NDArray[np.float32]:
    """The share of each voxel that the solid covers, from parts^3 sub-voxels where it is cut.

    field: distances to the solid with a reach of at least a voxel's half diagonal
    """
    half_diagonal = 0.5 * np.sqrt(3) * grid.spacing
    share = (field.distance < 0).astype(np.float32)
    cut = np.flatnonzero(np.abs(field.distance.ravel()) <= half_diagonal)
    steps = (np.arange(parts) + 0.5) / parts - 0.5
    offsets = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    offsets = grid.spacing * offsets @ grid.axes.T
    if isinstance(solid, Sheet):
        least = _sheet_parts(grid, solid, cut, offsets)
    else:
        least = _cone_parts(grid, solid, field, cut, offsets)
    weight = np.clip(0.5 - least * (parts / grid.spacing), 0, 1)
    share.ravel()[cut] = weight.mean(axis=1)
    return share


def sub_voxels(spacing: float, solid: Solid) -> int:
    """Sub-voxels along a voxel: each at most half as wide as a sheet, a quarter as a tube; 2 to 8."""
    if not len(solid):
        return 2
    if isinstance(solid, Sheet):
        least = float(solid.half[solid.triangles].min())
    else:
        least = float(np.minimum(solid.first, solid.last).min()) / 2
    return int(np.clip(np.ceil(spacing / least), 2, 8))


class _NearestTriangle:
    """The nearest triangle of a sheet, and the signed distance to its solid."""

    def __init__(self, sheet: Sheet) -> None:
        from scipy.spatial import cKDTree

        used = sheet.half[sheet.triangles]
        self.sheet, self.thickest = sheet, used.max()
        self.samples, self._owner = sheet_samples(sheet, max(0.4 * float(np.median(used)), 0.05))
        self._tree = cKDTree(self.samples, leafsize=32)

    def distance(self, at: Floats, reach: float) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """Distances of points (n, 3) and the triangles; FAR and -1 beyond reach of all samples."""
        away, sample = self._tree.query(at, distance_upper_bound=self.thickest + reach, workers=-1)
        found = np.full(len(at), FAR, dtype=np.float32)
        owner = np.full(len(at), -1, dtype=np.int32)
        near = np.isfinite(away)
        owner[near] = self._owner[sample[near]]
        found[near] = distance_to_sheet(self.sheet, owner[near], at[near])
        return found, owner


def _sheet_parts(
    grid: Grid, sheet: Sheet, cut: NDArray[np.int64], offsets: Floats
) -> NDArray[np.float32]:
    """Distances of the sub-voxels of cut voxels to a sheet, (voxels, sub-voxels)."""
    nearest = _NearestTriangle(sheet)
    least = np.full((len(cut), len(offsets)), FAR, dtype=np.float32)
    rows = max(1, 500_000 // len(offsets))
    for first in range(0, len(cut), rows):
        at = _centres(grid, cut[first : first + rows])[:, None] + offsets
        found, _ = nearest.distance(at.reshape(-1, 3), 2 * grid.spacing)
        least[first : first + rows] = found.reshape(-1, len(offsets))
    return least


def _cone_parts(
    grid: Grid, cones: Cones, field: Field, cut: NDArray[np.int64], offsets: Floats
) -> NDArray[np.float32]:
    """Distances of the sub-voxels of cut voxels to cones, (voxels, sub-voxels)."""
    diagonal = np.sqrt(3) * grid.spacing
    row = np.full(field.distance.size, -1, dtype=np.int32)
    row[cut] = np.arange(len(cut))
    row = row.reshape(grid.shape)
    least = np.full((len(cut), len(offsets)), FAR, dtype=np.float32)
    for n, block, at in _blocks(grid, cones, diagonal / 2):
        rows, known = row[block].ravel(), field.distance[block].ravel()
        near = rows >= 0
        # an element that is farther from the centre than the nearest by the diagonal is nowhere nearer
        near[near] = cones.distance(n, at[near]) <= known[near] + diagonal
        rows = rows[near]
        if len(rows):
            points = (at[near][:, None] + offsets).reshape(-1, 3)
            least[rows] = np.minimum(least[rows], cones.distance(n, points).reshape(len(rows), -1))
    return least


def _near(grid: Grid, samples: Floats, reach: float) -> NDArray[np.bool_]:
    """Voxels in cubes of half side `reach`, in directions of the grid, around samples."""
    from scipy.ndimage import maximum_filter1d

    at = np.rint(grid.to_grid(samples)).astype(int)
    width = int(np.ceil(reach / grid.spacing)) + 1
    padded = np.zeros(tuple(n + 2 * width for n in grid.shape), dtype=np.uint8)
    at = at[((at >= -width) & (at < np.array(grid.size) + width)).all(axis=1)] + width
    padded[at[:, 2], at[:, 1], at[:, 0]] = 1
    for axis in range(3):
        padded = maximum_filter1d(padded, 2 * width + 1, axis=axis, mode="constant")
    return padded[width:-width, width:-width, width:-width] > 0


def _centres(grid: Grid, voxels: NDArray[np.int64]) -> Floats:
    """Centres (n, 3) in mm of voxels given by their places in the flat array."""
    k, j, i = np.unravel_index(voxels, grid.shape)
    return grid.to_patient(np.stack([i, j, k], axis=1).astype(float))


def _blocks(
    grid: Grid, cones: Cones, reach: float
) -> Iterator[tuple[int, tuple[slice, slice, slice], Floats]]:
    """The voxels within reach of each cone: number, block of the array, centres (k, 3) in mm."""
    limit = np.array(grid.size) - 1
    for n in range(len(cones)):
        for a, b, radius in cones.pieces(n, 2 * reach):
            ends = grid.to_grid(np.stack([a, b]))
            wide = (radius + reach) / grid.spacing
            first = np.maximum(np.ceil(ends.min(axis=0) - wide), 0).astype(int)
            last = np.minimum(np.floor(ends.max(axis=0) + wide), limit).astype(int)
            if (first > last).any():
                continue
            size = last - first + 1
            index = np.indices(size[::-1]).reshape(3, -1).T[:, ::-1] + first
            k, j, i = (slice(p, q + 1) for p, q in zip(first[::-1], last[::-1]))
            yield n, (k, j, i), grid.to_patient(index.astype(float))
