"""Images that lack a part: files that are cut short, slices that are missing, voxels that are no numbers.

ITK reads such files: it fills what is missing with zeros, or draws the other slices apart.
"""

from __future__ import annotations

import gzip
import struct
import zlib
from collections.abc import Sequence
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from mvs import FormatError
from .needs import need
from .voxels import MOST_SKEW, RESAMPLE, check_axes

NIFTI = (".nii", ".nii.gz")
CHUNK = 1 << 24


def check_nifti(name: str) -> None:
    """Refuses a NIfTI file with fewer bytes than its header says, or with sheared axes (nifti1.h, nifti2.h; Cox et
    al. 2004), such as those of dcm2niix for a tilted gantry: ITK takes the qform in their place, which has no shear."""
    if not name.lower().endswith(NIFTI):
        return
    with open(name, "rb") as file:
        packed = file.read(2) == b"\x1f\x8b"
    try:
        with (gzip.open if packed else open)(name, "rb") as file:
            header = file.read(544)
            there = len(header) + sum(map(len, iter(lambda: file.read(CHUNK), b"")))
    except (EOFError, OSError, zlib.error) as error:
        raise FormatError(f"{name}: is cut short or damaged ({error}): copy or export it again", "path") from error
    axes = nifti_axes(header)
    if axes is not None and (lengths := np.linalg.norm(axes, axis=0)).min() > 0:
        check_axes(axes / lengths, name)
    wanted = nifti_length(header)
    if there < wanted:
        raise FormatError(f"{name}: has {there} bytes, and its header says {wanted}: it is cut short. Copy or "
                          "export it again", "path")


def nifti_axes(header: bytes) -> Optional[NDArray[np.float64]]:
    """The columns (3, 3) of the sform of a NIfTI file, mm in RAS; None without one."""
    for order in "<>":
        for size, code_at, code, rows_at, row in ((348, 254, "h", 280, "4f"), (540, 348, "i", 400, "4d")):
            if len(header) < size or struct.unpack(order + "i", header[:4])[0] != size:
                continue
            if struct.unpack_from(order + code, header, code_at)[0] <= 0:
                return None
            wide = struct.calcsize(order + row)
            return np.array([struct.unpack_from(order + row, header, rows_at + k * wide)[:3] for k in range(3)])
    return None


def nifti_length(header: bytes) -> int:
    """The bytes of a NIfTI file by its header; 0 if it has none, which the reader of the image says."""
    for order in "<>":
        if len(header) >= 348 and struct.unpack(order + "i", header[:4])[0] == 348:
            dim = struct.unpack(order + "8h", header[40:56])
            bits, = struct.unpack(order + "h", header[72:74])
            offset, = struct.unpack(order + "f", header[108:112])
            break
        if len(header) >= 540 and struct.unpack(order + "i", header[:4])[0] == 540:
            bits, = struct.unpack(order + "h", header[14:16])
            dim = struct.unpack(order + "8q", header[16:80])
            offset, = struct.unpack(order + "q", header[168:176])
            break
    else:
        return 0
    if not 1 <= dim[0] <= 7 or not np.isfinite(offset):
        return 0
    voxels = 1
    for size in dim[1:dim[0] + 1]:
        voxels *= max(1, int(size))
    return int(offset) + voxels * int(bits) // 8


MOST_SHIFT = 0.25
"""Voxels: by which the slices of a whole series may shift sideways, as coordinates are rounded"""


def check_slices(folder: str, files: Sequence[str]) -> None:
    """Refuses a DICOM series whose slices do not lie behind one another at equal distances.

    ITK puts them there: a series of a tilted gantry, whose slices shift sideways, would be sheared.
    """
    sitk = need("SimpleITK")
    places, axes, spacing = [], [], 1.0
    reader = sitk.ImageFileReader()
    for name in files:
        reader.SetFileName(name)
        try:
            reader.ReadImageInformation()
        except RuntimeError as error:
            raise FormatError(f"{name}: is no slice that can be read: copy or export it again", "path") from error
        axes.append(np.array(reader.GetDirection()).reshape(reader.GetDimension(), -1)[:3, :3])
        places.append(np.array(reader.GetOrigin())[:3])
        spacing = min(reader.GetSpacing()[:2])
    if len(places) < 2:
        return
    if max(float(np.abs(one - axes[0]).max()) for one in axes) > MOST_SKEW:
        raise FormatError(f"{folder}: the slices are not parallel to one another: give a series of parallel slices, or "
                          "resample it", "axes")
    across = axes[0][:, 2]
    order = np.argsort(np.array(places) @ across, kind="stable")
    placed = np.array(places)[order]
    _check_gaps(folder, placed @ across)
    _check_tilt(folder, placed, across, spacing)


def _check_gaps(folder: str, at: NDArray[np.float64]) -> None:
    """Refuses positions (n,) of slices along their normal, mm, in order, with gaps or several at one place."""
    if len(at) < 3:
        return
    gaps = np.diff(at)
    usual = float(np.median(gaps))
    widest = int(gaps.argmax())
    if gaps[widest] > 1.5 * usual:
        raise FormatError(
            f"{folder}: slices are missing or cannot be read: they lie {usual:.2f} mm apart, and {gaps[widest]:.2f} mm "
            f"after slice {widest + 1} of {len(at)}. Give the whole series", "path")
    if gaps.min() < 0.01 * usual or usual <= 0:
        raise FormatError(f"{folder}: several slices lie in one place: this is a series of several volumes. Give one "
                          "of them", "path")


def _check_tilt(folder: str, places: NDArray[np.float64], across: NDArray[np.float64], spacing: float) -> None:
    """Refuses slices that shift sideways.

    places: (n, 3) mm, LPS, first voxels of the slices in order
    across: (3,), the normal of the slices
    spacing: mm, of the voxels within a slice
    """
    steps = places - places[0]
    aside = steps - np.outer(steps @ across, across)
    shift = np.linalg.norm(aside, axis=1)
    widest = int(shift.argmax())
    if shift[widest] <= MOST_SHIFT * spacing:
        return
    angle = np.degrees(np.arctan2(shift[widest], abs(float(steps[widest] @ across))))
    raise FormatError(
        f"{folder}: the slices shift sideways by {shift[widest]:.1f} mm, {angle:.1f} degrees, as those of a tilted gantry: "
        f"read as a straight stack the valve would be sheared. Before use, {RESAMPLE}", "axes")


def check_numbers(image: Any, name: str) -> None:
    """Refuses voxels that are NaN or infinite."""
    values = need("SimpleITK").GetArrayViewFromImage(image)
    if not np.issubdtype(values.dtype, np.floating):
        return
    bad = int(values.size - np.isfinite(values).sum())
    if bad:
        raise FormatError(f"{name}: {bad} of {values.size} voxels are no numbers (NaN or infinite): replace them, for "
                          "example by the value of the background", "image")
