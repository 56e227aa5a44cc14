"""Whether the voxels of an image are those of a heart valve in mm: one value each, size, axes at right angles."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError, FormatError

MOST_SKEW = 2e-3
"""Sine of the angle by which axes may miss a right angle, and error of their lengths. Over the 60 mm of a valve it
moves points by 0.12 mm, a quarter of a fine voxel of ultrasound; headers with four digits are within it."""

RESAMPLE = ('resample it to axes at right angles, for example with "Acquisition geometry regularization" of the DICOM '
            "module or with Crop Volume of 3D Slicer (label maps with nearest-neighbour interpolation)")


def check_voxels(image: Any, path: str) -> None:
    """Refuses voxels that no image of a heart valve has: several values each, skewed axes, sizes other than 0.005
    to 3 mm.

    image: SimpleITK.Image, lengths in mm
    """
    if image.GetDimension() != 3:
        raise FormatError(f"{path}: has {image.GetDimension()} dimensions: give one volume of 3", "image")
    if image.GetNumberOfComponentsPerPixel() != 1:
        raise FormatError(f"{path}: has {image.GetNumberOfComponentsPerPixel()} values at each voxel: give a volume "
                          "with one, or a .seg.nrrd file", "image")
    check_axes(np.array(image.GetDirection()).reshape(3, 3), path)
    _check_size(np.array(image.GetSpacing()), np.array(image.GetSize()), path)


def check_axes(axes: NDArray[Any], path: str) -> None:
    """Refuses axes that are not at right angles: the columns of (3, 3), without unit, LPS.

    The inverse of such axes would be taken for their transpose, and the tissue for another shape.
    """
    if not np.isfinite(axes).all():
        raise FormatError(f"{path}: the directions of the axes are no numbers: correct the header", "axes")
    products = axes.T @ axes - np.eye(3)
    if np.abs(np.diag(products)).max() > 2 * MOST_SKEW:
        raise FormatError(f"{path}: the directions of the axes are no unit vectors: correct the header", "axes")
    pairs = ((0, 1), (0, 2), (1, 2))
    skew = max(pairs, key=lambda pair: abs(products[pair]))
    if abs(products[skew]) > MOST_SKEW:
        angle = np.degrees(np.arcsin(min(1.0, abs(float(products[skew])))))
        names = " and ".join("ijk"[axis] for axis in skew)
        raise FormatError(f"{path}: the axes {names} of the voxels miss a right angle by {angle:.1f} degrees (sheared "
                          f"axes, as of a tilted gantry): {RESAMPLE}", "axes")


def _check_size(spacing: NDArray[Any], size: NDArray[Any], path: str) -> None:
    extent = spacing * size
    words = " x ".join(f"{s:.3g}" for s in spacing)
    if (spacing < 0.005).any() and extent.max() < 1:
        raise ArgumentError(
            f"{path}: the voxels measure {words} mm and the whole image {extent.max():.3g} mm: the "
            "spacing looks like metres. Multiply it by 1000 in the header", "spacing")
    if extent.max() < 20:
        raise ArgumentError(
            f"{path}: the whole image measures {extent.max():.3g} mm, less than a mitral valve: the "
            "spacing looks like cm or an image of a part. Give spacing in mm and the whole valve",
            "spacing")
    if (spacing > 3).any() or (spacing < 0.005).any():
        raise ArgumentError(
            f"{path}: the voxels measure {words} mm: leaflets are 1 mm thick and need voxels of at "
            "most 3 mm on each side. Check the spacing in the header", "spacing")
