"""Tissue in an image as a sheet: its share on cubic voxels, its width, its mid-surface.

The step of the voxels and the Gaussian of the mid-surface follow from the width of the tissue; a mask that is
no sheet of the size of a valve is refused with a sentence.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError
from .grid import Floats, Grid, Volume, box_of, crop, isotropic, spacing_of
from .mesh import Sheet, largest_piece
from .needs import need
from .sheet import SheetSettings, mid_surface

Tell = Callable[[str], object]
"""Called with the name of each step as it begins."""


def silent(_: str) -> None:
    """No progress is shown."""


@dataclasses.dataclass(frozen=True)
class LabelSettings:
    """Lengths in m.

    hole: the diameter of the largest hole that is filled
    island: pieces of tissue below this share of the whole are dropped
    blur, smoothing: of the mid-surface (SheetSettings); None: from voxels and thickness
    """

    hole: float = 7e-3
    island: float = 0.05
    blur: Optional[float] = None
    smoothing: Optional[float] = None


MOST_AREA = 100e-4
"""m2: twice the area of the largest valve that `check_open_valve` accepts, as faces of voxels give it roughly"""


def check_sheet(mask: NDArray[np.bool_], spacing: Floats) -> None:
    """ArgumentError where tissue has more surface than any valve: noise, foam, a whole heart.

    A count of faces of voxels, before hours of work on the surface between them.
    """
    width = width_of(mask, spacing)
    area = float(np.count_nonzero(mask) * np.prod(spacing)) / width if width else 0.0
    if area > MOST_AREA:
        raise ArgumentError(
            f"the tissue has the surface of a sheet of {area * 1e4:.0f} cm2, {1e3 * width:.2f} mm thick; the leaflets of "
            "a mitral valve have 6 to 30 cm2: the labels are noise or more than the leaflets, or the spacing is "
            "wrong", "labels")


def sheet_of_image(image: Any, level: float = 0.0) -> tuple[Sheet, float]:
    """The mid-surface of a signed image, tissue above `level`, and the size of its voxels, m.

    The largest piece. Values are scaled so that the level stays where interpolation puts it.
    """
    sitk = need("SimpleITK")
    values = sitk.GetArrayFromImage(image)
    inside = values > level
    if not inside.any() or inside.all():
        raise ArgumentError(f"the image has no tissue: no surface at the level {level:g}", "image")
    voxel = spacing_of(image)
    part = crop(image, inside, 4e-3)
    grid, signed = isotropic(part, grid_step(image, inside), float(values.min()))
    high, low = np.percentile(values[inside], 90) - level, level - np.percentile(values[~inside], 10)
    above = signed - level
    tissue = np.clip(0.5 + 0.5 * np.where(above > 0, above / high, above / low), 0, 1)
    sheet = fitted_sheet(grid, tissue.astype(np.float32), voxel)
    return largest_piece(sheet)[0], voxel


def tissue_on_grid(image: Any, mask: NDArray[np.bool_], step: float,
                   margin: float = 4e-3) -> tuple[Grid, Volume]:
    """The share of tissue (0 to 1) on cubic voxels around a mask."""
    sitk = need("SimpleITK")
    marked = sitk.GetImageFromArray(mask.astype(np.uint8))
    marked.CopyInformation(image)
    part = sitk.Cast(crop(marked, mask, margin), sitk.sitkFloat32)
    return isotropic(part, step, 0.0)


SHARE_OF_WIDTH = 0.2
"""Edge of a grid's voxel over the width of the tissue: finer ones move the mid-surface of a phantom by less
than a fiftieth of a voxel."""


def grid_step(image: Any, mask: NDArray[np.bool_], most: int = 30_000_000) -> float:
    """Half of the smallest edge of a voxel; up to a whole one where the tissue is wide, and more where the
    grid would have more than `most` voxels."""
    spacing = np.array(image.GetSpacing()) * 1e-3
    first, last = box_of(mask) or (np.zeros(3), np.zeros(3))
    extent = (last - first + 1) * spacing + 8e-3
    least = spacing.min()
    step = np.clip(SHARE_OF_WIDTH * width_of(mask, spacing), least / 2, least)
    return float(max(step, (np.prod(extent) / most) ** (1 / 3)))


def width_of(mask: NDArray[np.bool_], spacing: Floats) -> float:
    """About how wide tissue is, m, in voxels of a size (x, y, z): twice its volume over its surface.

    The faces of voxels have 1.5 times the area of a surface that looks in all directions alike.
    """
    faces = 0.0
    for axis, across in enumerate(spacing[::-1]):
        other = np.prod(spacing) / across
        faces += other * float(np.count_nonzero(np.diff(mask, axis=axis)))
    volume = float(np.count_nonzero(mask) * np.prod(spacing))
    return 1.5 * 2 * volume / faces if faces else 0.0


def fitted_sheet(grid: Grid, tissue: Volume, voxel: float,
                 settings: LabelSettings = LabelSettings(), tell: Tell = silent) -> Sheet:
    """The mid-surface with a Gaussian that fits the thickness found with a narrow one."""
    smoothing = settings.smoothing or 2 * voxel
    narrow = settings.blur or max(0.9 * voxel, 1.5 * grid.step)
    tell(f"mid-surface on voxels of {grid.step * 1e3:.2f} mm")
    sheet = mid_surface(grid, tissue, SheetSettings(narrow, smoothing))
    wide = 0.5 * float(np.median(sheet.values["thickness"]))
    if settings.blur or wide <= 1.1 * narrow:
        return sheet
    tell(f"mid-surface of tissue that is {2e3 * wide:.2f} mm thick")
    return mid_surface(grid, tissue, SheetSettings(wide, smoothing))
