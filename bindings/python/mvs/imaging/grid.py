"""A scalar volume on an isotropic grid: NumPy array in the axes of the image, positions in m.

The only link between `SimpleITK.Image` (mm, LPS) and the algorithms of this package.
"""

from __future__ import annotations

import dataclasses
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError
from .needs import need

Points = NDArray[np.float64]
Floats = NDArray[np.float64]
"""Numbers that are no points: areas, lengths, matrices."""
Volume = NDArray[np.float32]


@dataclasses.dataclass(frozen=True, eq=False)
class Grid:
    """Voxel centres origin + axes @ (step * index), index in the order x, y, z.

    step: m, edge of the cubic voxels
    origin: (3,) m, LPS, centre of voxel (0, 0, 0)
    axes: (3, 3), columns are the directions of the image axes
    shape: voxels along x, y, z; arrays of the grid have the shape (z, y, x), as SimpleITK has
    """

    step: float
    origin: Points
    axes: Points
    shape: tuple[int, int, int]

    def place(self, index: NDArray[Any]) -> Points:
        """Positions (n, 3) in m of indices (n, 3) in the order x, y, z; fractions are allowed."""
        return np.asarray(self.origin + (np.asarray(index) * self.step) @ self.axes.T)

    def index(self, points: Points) -> Points:
        """The inverse of `place`."""
        return np.asarray((np.asarray(points) - self.origin) @ self.axes / self.step)

    def turn(self, vectors: NDArray[Any]) -> Points:
        """Directions (n, 3) in the axes of the image, turned into LPS."""
        return np.asarray(np.asarray(vectors, float) @ self.axes.T)

    def sample(self, volume: NDArray[Any], points: Points, outside: float = 0.0) -> Points:
        """Trilinear interpolation of a volume (z, y, x) at points (..., 3) in m."""
        index = self.index(points.reshape(-1, 3))[:, ::-1].T
        values = need("scipy.ndimage").map_coordinates(
            volume, index, order=1, mode="constant", cval=outside
        )
        return np.asarray(values, float).reshape(points.shape[:-1])

    def part(self, volume: Volume, margin: int) -> tuple["Grid", Volume]:
        """The box of a volume (z, y, x) around its voxels above 0, `margin` voxels wider where the grid
        has them."""
        box = box_of(volume > 0)
        if box is None:
            return self, volume
        first = np.maximum(box[0] - margin, 0)
        last = np.minimum(box[1] + margin + 1, np.array(self.shape))
        x, y, z = (slice(int(a), int(b)) for a, b in zip(first, last))
        size = (x.stop - x.start, y.stop - y.start, z.stop - z.start)
        return (Grid(self.step, self.place(first[None])[0], self.axes, size),
                np.ascontiguousarray(volume[z, y, x]))


def spacing_of(image: Any) -> float:
    """The geometric mean of the voxel's edges, m."""
    return float(np.prod(image.GetSpacing()) ** (1 / 3)) * 1e-3


def box_of(mask: NDArray[np.bool_]) -> Optional[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """First and last index (x, y, z) of the true voxels of (z, y, x); None without any."""
    ends = []
    for axis in range(3):
        others = tuple(k for k in range(3) if k != axis)
        hit = np.flatnonzero(mask.any(axis=others))
        if not len(hit):
            return None
        ends.append((hit[0], hit[-1]))
    ends.reverse()
    return np.array([a for a, _ in ends]), np.array([b for _, b in ends])


def cut_out(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The box (z, y, x) of the true voxels, with one voxel of background around it; all of a mask without any."""
    low, high = box_of(mask) or (np.zeros(3, np.int64), np.array(mask.shape[::-1]) - 1)
    return np.pad(mask[tuple(slice(a, b + 1) for a, b in zip(low[::-1], high[::-1]))], 1)


def crop(image: Any, mask: NDArray[np.bool_], margin: float) -> Any:
    """The part of an image that holds the mask and a margin (m) around it."""
    box = box_of(mask)
    if box is None:
        raise ArgumentError("the image has no voxel of tissue in it", "image")
    spacing = np.array(image.GetSpacing()) * 1e-3
    wide = np.ceil(margin / spacing).astype(int)
    size = np.array(image.GetSize())
    first = np.maximum(box[0] - wide, 0)
    last = np.minimum(box[1] + wide + 1, size)
    x, y, z = (slice(int(a), int(b)) for a, b in zip(first, last))
    return image[x, y, z]


def isotropic(image: Any, step: float, outside: float, linear: bool = True) -> tuple[Grid, Volume]:
    """Resamples an image to cubic voxels of `step` m over its extent and two voxels around it."""
    sitk = need("SimpleITK")
    spacing, size = np.array(image.GetSpacing()), np.array(image.GetSize())
    edge = step * 1e3
    count = np.ceil((size - 1) * spacing / edge).astype(int) + 5
    axes = np.array(image.GetDirection()).reshape(3, 3)
    start = ((size - 1) * spacing - (count - 1) * edge) / 2
    origin = np.array(image.GetOrigin()) + axes @ start
    filter_ = sitk.ResampleImageFilter()
    filter_.SetOutputSpacing([edge] * 3)
    filter_.SetSize([int(k) for k in count])
    filter_.SetOutputOrigin(origin.tolist())
    filter_.SetOutputDirection(image.GetDirection())
    filter_.SetDefaultPixelValue(outside)
    filter_.SetInterpolator(sitk.sitkLinear if linear else sitk.sitkNearestNeighbor)
    filter_.SetOutputPixelType(sitk.sitkFloat32)
    grid = Grid(step, origin * 1e-3, axes, (int(count[0]), int(count[1]), int(count[2])))
    return grid, sitk.GetArrayFromImage(filter_.Execute(image))
