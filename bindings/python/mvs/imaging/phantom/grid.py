"""A regular grid of cubic voxels: positions in mm (LPS), and arrays [k, j, i] as images."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ArgumentError

Points = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Grid:
    """Voxel (i, j, k) has its centre at origin + spacing * axes @ (i, j, k).

    size: voxels along i, j, k; axes: (3, 3), its columns are the directions of i, j, k
    """

    size: tuple[int, int, int]
    spacing: float
    origin: Points
    axes: Points

    @property
    def shape(self) -> tuple[int, int, int]:
        """The shape of arrays, [k, j, i]."""
        return self.size[::-1]

    def to_grid(self, points: Points) -> Points:
        """Continuous indices (i, j, k) of positions (n, 3) in mm."""
        return (points - self.origin) @ self.axes / self.spacing

    def to_patient(self, indices: Points) -> Points:
        """Positions (n, 3) in mm of continuous indices (i, j, k)."""
        return self.origin + (indices * self.spacing) @ self.axes.T

    def image(self, array: NDArray[Any]) -> Any:
        """The SimpleITK.Image of an array [k, j, i]."""
        import SimpleITK as sitk

        image = sitk.GetImageFromArray(array)
        image.SetSpacing([float(self.spacing)] * 3)
        image.SetOrigin([float(v) for v in self.origin])
        image.SetDirection([float(v) for v in self.axes.ravel()])
        return image


def around(points: Points, spacing: float, margin: float, axes: Points, max_voxels: int) -> Grid:
    """The grid along `axes` that holds all points and a margin (mm).

    Refuses more than max_voxels, with the spacing that would be allowed.
    """
    along = points @ axes
    low, high = along.min(axis=0) - margin, along.max(axis=0) + margin
    size = np.ceil((high - low) / spacing).astype(int) + 1
    count = int(np.prod(size, dtype=np.int64))
    if count > max_voxels:
        least = spacing * (count / max_voxels) ** (1 / 3)
        text = " x ".join(str(n) for n in size)
        raise ArgumentError(
            f"spacing: {spacing:g} mm gives {text} = {count:,} voxels, more than {max_voxels:,}; "
            f"take {np.ceil(least * 100) / 100:g} mm or more, or a smaller margin", "spacing",
        )
    middle = (low + high) / 2 - spacing * (size - 1) / 2
    i, j, k = (int(n) for n in size)
    return Grid((i, j, k), float(spacing), axes @ middle, axes.copy())
