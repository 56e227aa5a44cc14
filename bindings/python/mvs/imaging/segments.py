"""Segments of 3D Slicer (.seg.nrrd): masks by name, each of its own layer, placed by the header of the file."""

from __future__ import annotations

import dataclasses
import re
import zlib
from collections.abc import Container, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mvs import FormatError, IoError
from .needs import need
from .voxels import check_voxels


@dataclasses.dataclass(frozen=True, eq=False)
class Segment:
    """mask: bool (z, y, x), value: its number in its layer."""

    name: str
    value: int
    mask: NDArray[np.bool_]


def own_name(name: str, taken: Container[str]) -> str:
    """The name, with a number from 2 on if it is taken."""
    own, copy = name, 2
    while own in taken:
        own, copy = f"{name} {copy}", copy + 1
    return own


def read_segments(name: str) -> tuple[Any, list[Segment]]:
    """An image (SimpleITK.Image, mm, LPS) with the geometry of a file, and its segments.

    FormatError for a file that 3D Slicer would not have written.
    """
    if not Path(name).exists():
        raise IoError(f"{name}: there is no such file", "path")
    slicerio, nrrd = need("slicerio"), need("nrrd")
    try:
        header = nrrd.read_header(name)
        read = slicerio.read_segmentation(name)
        names = header_names(name)
    except (nrrd.NRRDError, zlib.error, EOFError, OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise FormatError(f"{name}: is no segmentation of 3D Slicer, is cut short or damaged "
                          f"({_reason(error)}): export it again", "path") from error
    missing = [key for key in ("space", "space directions", "space origin") if header.get(key) is None]
    if missing:
        raise FormatError(f'{name}: its header lacks "{missing[0]}": save the segmentation again with 3D Slicer', "axes")
    voxels, rows = np.asarray(read.get("voxels")), read.get("segments") or []
    if voxels.ndim not in (3, 4):
        raise FormatError(f"{name}: has {voxels.ndim} dimensions: segments have three, or four with layers", "image")
    if not rows:
        raise FormatError(f"{name}: declares no segments: save it in 3D Slicer as a segmentation, or, if it is a label "
                          "map, name it .nrrd", "labels")
    image = _image_of(name, voxels[0] if voxels.ndim == 4 else voxels, np.array(read["ijkToLPS"], float))
    layers = voxels if voxels.ndim == 4 else voxels[None]
    found: dict[str, Segment] = {}
    for k, row in enumerate(rows):
        title = own_name(names[k] or str(row.get("id") or f"Segment {k}"), found)
        value, layer = _number(name, title, row, "labelValue", None), _number(name, title, row, "layer", 0)
        if not 0 <= layer < len(layers):
            raise FormatError(f'{name}: the segment "{title}" is said to be in layer {layer}, and the file has '
                              f"{len(layers)}: save the segmentation again", "labels")
        found[title] = Segment(title, value, np.ascontiguousarray((layers[layer] == value).T))
    return image, list(found.values())


def header_names(path: str) -> list[str]:
    """The names of the segments in the header of a file, in the order of their numbers; "" for none.

    3D Slicer writes UTF-8; pynrrd reads ASCII and drops other letters.
    """
    names: dict[int, str] = {}
    with open(path, "rb") as file:
        for raw in file:
            line = _text(raw).strip()
            if not line:  # the data follow
                break
            row = re.match(r"Segment(\d+)_([^:]+):=?(.*)", line)
            if row:
                names.setdefault(int(row[1]), "")
            if row and row[2].strip() == "Name":
                names[int(row[1])] = row[3].strip()
    return [names[k] for k in sorted(names)]


def _text(raw: bytes) -> str:
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:  # of other programs
        return raw.decode("latin-1")


def _image_of(name: str, layer: NDArray[Any], to_lps: NDArray[np.float64]) -> Any:
    """to_lps: (4, 4), from indices to mm in LPS."""
    spacing = np.linalg.norm(to_lps[:3, :3], axis=0)
    if not np.isfinite(to_lps).all() or not (spacing > 0).all() or abs(np.linalg.det(to_lps[:3, :3] / spacing)) < 1e-6:
        raise FormatError(f"{name}: its space directions are no three axes: save it again with 3D Slicer", "axes")
    image = need("SimpleITK").GetImageFromArray(np.ascontiguousarray(layer.T))
    image.SetSpacing(spacing.tolist())
    image.SetOrigin(to_lps[:3, 3].tolist())
    image.SetDirection((to_lps[:3, :3] / spacing).ravel().tolist())
    check_voxels(image, name)
    return image


def _number(name: str, title: str, row: Mapping[str, Any], key: str, default: Any) -> int:
    given = row.get(key, default)
    try:
        return int(given)
    except (TypeError, ValueError):
        what = "no" if given is None else f'"{given}" as its'
        raise FormatError(f'{name}: the segment "{title}" has {what} {key}: save the segmentation again', "labels") from None


def _reason(error: Exception) -> str:
    return str(error).strip().splitlines()[-1] if str(error).strip() else type(error).__name__
