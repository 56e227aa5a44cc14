"""Images that lack a part: files that are cut short, slices that are missing, voxels that are no numbers.

ITK reads such files: it fills what is missing with zeros, or draws the other slices apart.
"""

from __future__ import annotations

import gzip
import struct
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from mvs import FormatError
from .needs import need

NIFTI = (".nii", ".nii.gz")
CHUNK = 1 << 24


def check_nifti(name: str) -> None:
    """Refuses a NIfTI file with fewer bytes than its header says (nifti1.h, nifti2.h; Cox et al. 2004)."""
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
    wanted = nifti_length(header)
    if there < wanted:
        raise FormatError(f"{name}: has {there} bytes, and its header says {wanted}: it is cut short. Copy or "
                          "export it again", "path")


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
    return int(offset) + voxels * bits // 8


def check_slices(folder: str, files: Sequence[str]) -> None:
    """Refuses a DICOM series whose slices are not at equal distances."""
    sitk = need("SimpleITK")
    places = []
    reader = sitk.ImageFileReader()
    for name in files:
        reader.SetFileName(name)
        try:
            reader.ReadImageInformation()
        except RuntimeError as error:
            raise FormatError(f"{name}: is no slice that can be read: copy or export it again", "path") from error
        across = np.array(reader.GetDirection()).reshape(reader.GetDimension(), -1)[:3, 2]
        places.append(float(across @ np.array(reader.GetOrigin())[:3]))
    if len(places) < 3:
        return
    at = np.sort(places)
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


def check_numbers(image: Any, name: str) -> None:
    """Refuses voxels that are NaN or infinite."""
    values = need("SimpleITK").GetArrayViewFromImage(image)
    if not np.issubdtype(values.dtype, np.floating):
        return
    bad = int(values.size - np.isfinite(values).sum())
    if bad:
        raise FormatError(f"{name}: {bad} of {values.size} voxels are no numbers (NaN or infinite): replace them, for "
                          "example by the value of the background", "image")
