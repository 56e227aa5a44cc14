"""Reads volumes and label maps: NRRD, NIfTI, MetaImage, DICOM series, .seg.nrrd.

Volumes are `SimpleITK.Image` in LPS with lengths in mm, as ITK reads every one of these formats.
"""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from mvs import FormatError, IoError
from .needs import need
from .packed import check_packed
from .segments import own_name, read_segments
from .voxels import check_voxels
from .whole_image import check_nifti, check_numbers, check_slices

PathLike = Union[str, "os.PathLike[str]"]
SURFACES = (".stl", ".ply", ".obj", ".off", ".vtp")
ENDINGS = (".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd")


@dataclasses.dataclass(frozen=True, eq=False)
class LabelMap:
    """Segments of one image: `masks` by name, each a bool array (z, y, x) of the voxels of `image`.

    Segments may overlap, as those of .seg.nrrd files in several layers do.
    """

    image: Any
    masks: dict[str, NDArray[np.bool_]]
    values: dict[str, int]

    def __repr__(self) -> str:
        parts = ", ".join(f"{name}: {int(mask.sum())}" for name, mask in self.masks.items())
        return f"<mvs.imaging.LabelMap: {self.image.GetSize()}, voxels {{{parts}}}>"


def read_volume(path: PathLike) -> Any:
    """Reads a grey volume as float32 (SimpleITK.Image); a folder is read as a DICOM series.

    FormatError if the file is no volume of three dimensions or has skewed axes, ArgumentError for a voxel
    size that no image of a heart valve has.
    """
    image = _read(path)
    sitk = need("SimpleITK")
    check_voxels(image, os.fspath(path))
    return sitk.Cast(image, sitk.sitkFloat32)


def read_labels(path: PathLike, names: Optional[dict[int, str]] = None) -> LabelMap:
    """Reads a label map: a .seg.nrrd file with the names of its segments, or whole numbers.

    names: the name of each value; values without a name, except 0, are called by their number.
        A signed label image (negative outside, positive inside) is one segment called "1"
    """
    if os.fspath(path).lower().endswith((".seg.nrrd", ".seg.nhdr")):
        image, segments = read_segments(os.fspath(path))
        return LabelMap(image, {one.name: one.mask for one in segments}, {one.name: one.value for one in segments})
    return labels_of(_read(path), names, os.fspath(path))


def labels_of(image: Any, names: Optional[dict[int, str]] = None, path: str = "image") -> LabelMap:
    """The segments of a label image in memory."""
    check_voxels(image, path)
    sitk = need("SimpleITK")
    values = sitk.GetArrayViewFromImage(image)
    if is_signed(values):
        return LabelMap(image, {"1": np.asarray(values > 0)}, {"1": 1})
    if not np.issubdtype(values.dtype, np.integer) and not (values == np.rint(values)).all():
        raise FormatError(f"{path}: the voxels are no whole numbers: this is a grey volume and no "
                          "label map", "labels")
    found = [int(k) for k in np.unique(values) if k != 0]
    if len(found) > MOST_LABELS:
        raise FormatError(f"{path}: has {len(found)} different values: this is a grey volume and no "
                          f"label map (at most {MOST_LABELS} labels)", "labels")
    masks: dict[str, NDArray[np.bool_]] = {}
    numbers: dict[str, int] = {}
    for k in found:
        name = own_name((names or {}).get(k, str(k)), masks)
        masks[name], numbers[name] = np.asarray(values == k), k
    return LabelMap(image, masks, numbers)


MOST_LABELS = 64
"""Labels of a label map beside the background; grey volumes have more values"""


def is_label_map(image: Any) -> bool:
    """Whether a volume holds at most MOST_LABELS whole numbers beside 0, or signs of inside and outside."""
    values = need("SimpleITK").GetArrayViewFromImage(image)
    if is_signed(values):
        return True
    sample = np.unique(values.ravel()[:: max(1, values.size // 200_000)])
    if len(sample) > MOST_LABELS + 1 or (sample != np.rint(sample)).any():
        return False
    found = np.unique(values)
    return int((found != 0).sum()) <= MOST_LABELS and bool((found == np.rint(found)).all())


BEYOND, AT_0, LEAST_AT_0 = 0.02, 0.005, 0.7
"""By how much interpolation may leave 0 to 1, how near to 0 the background of a map of probabilities is, and its least
share. Grey volumes scaled to 0 to 1 have noise there; leaflets, thin and blurred, need not reach 1"""


def is_probability(values: NDArray[Any]) -> bool:
    """Whether the voxels are all about within 0 and 1, most at 0 and some above a half, as those of a network before a
    threshold."""
    if not np.issubdtype(values.dtype, np.floating) or values.min() < -BEYOND or not 0.5 < values.max() < 1 + BEYOND:
        return False
    return bool((np.abs(values) < AT_0).mean() > LEAST_AT_0)


SIGNED_MOST = 10.0
"""The largest value of signed label images: grey values are larger."""


def is_signed(values: NDArray[Any]) -> bool:
    """Whether the voxels are negative outside and positive inside of a segment: from -a to a, most of them
    near one of the two."""
    sample = values.ravel()[:: max(1, values.size // 200_000)]
    if not np.issubdtype(values.dtype, np.floating):
        return False
    low, high = float(sample.min()), float(sample.max())
    if not low < 0 < high <= SIGNED_MOST or abs(low + high) > 0.05 * high:
        return False
    return bool((np.abs(sample) > 0.9 * high).mean() > 0.5)


def _read(path: PathLike) -> Any:
    sitk = need("SimpleITK")
    name = os.fspath(path)
    if Path(name).is_dir():
        return _read_dicom(name)
    if not Path(name).exists():
        raise IoError(f"{name}: there is no such file", "path")
    check_nifti(name)
    check_packed(name)
    try:
        image = sitk.ReadImage(name)
    except RuntimeError as error:
        reason = str(error).strip().splitlines()[-1]
        if "No such file" in reason:
            reason = "it is cut short, or a file that its header names is missing"
        surface = name.lower().endswith(SURFACES)
        hint = "a surface: give it to `mvs import`" if surface else (
            f"is no volume that SimpleITK reads ({reason}): give {', '.join(ENDINGS)} or a folder of DICOM "
            "files")
        raise FormatError(f"{name}: {hint}", "path") from error
    check_numbers(image, name)
    return image


def _read_dicom(folder: str) -> Any:
    sitk = need("SimpleITK")
    series = sitk.ImageSeriesReader.GetGDCMSeriesIDs(folder)
    if not series:
        raise FormatError(f"{folder}: has no DICOM series: give a folder with the files of one, or an image file",
                          "path")
    if len(series) > 1:
        sizes = [f"{one}: {len(sitk.ImageSeriesReader.GetGDCMSeriesFileNames(folder, one))} files"
                 for one in series]
        raise FormatError(f"{folder}: has {len(series)} DICOM series ({'; '.join(sizes)}): put one "
                          "of them in a folder of its own", "path")
    reader = sitk.ImageSeriesReader()
    files = sitk.ImageSeriesReader.GetGDCMSeriesFileNames(folder, series[0])
    check_slices(folder, files)
    reader.SetFileNames(files)
    image = reader.Execute()
    check_numbers(image, folder)
    return image
