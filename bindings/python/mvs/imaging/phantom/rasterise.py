"""Rasterises solids: signed distances at voxel centres near them, and the covered share of voxels.

The share is that of sub-voxels, each weighted by its own distance as if its surface were plane
(partial volume); with sub-voxels of at most a quarter of the thinnest part the
error of its volume is below 2 %.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Optional, Union

import numpy as np
from numpy.typing import NDArray

from .distance import Cones, Sheet
from .grid import Grid

Solid = Union[Sheet, Cones]
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
    row = np.full(field.distance.size, -1, dtype=np.int32)
    row[cut] = np.arange(len(cut))
    row = row.reshape(grid.shape)
    steps = (np.arange(parts) + 0.5) / parts - 0.5
    offsets = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    offsets = grid.spacing * offsets @ grid.axes.T
    least = np.full((len(cut), len(offsets)), FAR, dtype=np.float32)
    for n, block, at in _blocks(grid, solid, half_diagonal):
        rows = row[block].ravel()
        near = rows >= 0
        # an element that is farther from the centre than the nearest by the diagonal is nowhere nearer
        near[near] = solid.distance(n, at[near]) <= field.distance[block].ravel()[near] + 2 * half_diagonal
        rows, at = rows[near], at[near]
        if len(rows):
            points = (at[:, None] + offsets).reshape(-1, 3)
            new = solid.distance(n, points).reshape(len(rows), -1)
            least[rows] = np.minimum(least[rows], new)
    weight = np.clip(0.5 - least * (parts / grid.spacing), 0, 1)
    share.ravel()[cut] = weight.mean(axis=1)
    return share


def sub_voxels(spacing: float, thinnest: float) -> int:
    """Sub-voxels along a voxel for parts as thin as `thinnest` (mm): at most a quarter of it each."""
    return int(np.clip(np.ceil(4 * spacing / thinnest), 2, 8))


def _blocks(
    grid: Grid, solid: Solid, reach: float
) -> Iterator[tuple[int, tuple[slice, slice, slice], NDArray[np.float64]]]:
    """The voxels within reach of each element: element, block of the array, centres (k, 3) in mm."""
    limit = np.array(grid.size) - 1
    for n in range(len(solid)):
        for low, high in solid.pieces(n, 2 * reach):
            corners = np.array(np.meshgrid(*zip(low - reach, high + reach))).reshape(3, -1).T
            at = grid.to_grid(corners)
            first = np.maximum(np.ceil(at.min(axis=0) - 1e-9), 0).astype(int)
            last = np.minimum(np.floor(at.max(axis=0) + 1e-9), limit).astype(int)
            if (first > last).any():
                continue
            ranges = [np.arange(a, b + 1) for a, b in zip(first, last)]
            k, j, i = np.meshgrid(*ranges[::-1], indexing="ij")
            centres = grid.to_patient(np.stack([i, j, k], axis=-1).reshape(-1, 3).astype(float))
            block = tuple(slice(a, b + 1) for a, b in zip(first[::-1], last[::-1]))
            yield n, block, centres


def thinnest(solids: list[Solid]) -> float:
    """The smallest thickness or diameter (mm) of some solids."""
    found: Optional[float] = None
    for solid in solids:
        if len(solid):
            if isinstance(solid, Sheet):
                radii = solid.half[solid.triangles]
            else:
                radii = np.minimum(solid.first, solid.last)
            least = 2 * float(radii.min())
            found = least if found is None else min(found, least)
    return 1.0 if found is None else found
