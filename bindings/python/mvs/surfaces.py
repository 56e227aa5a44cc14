"""Surfaces and landmarks in files of other programs."""

from __future__ import annotations

import dataclasses
import os
from typing import Annotated, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from .describe import with_field_help
from .errors import ArgumentError
from .words import did_you_mean

Unit = Literal["m", "mm", "cm"]
PatientFrame = Literal["LPS", "RAS"]
Path = Union[str, "os.PathLike[str]"]
Arrays = dict[str, NDArray[np.float64]]


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Surface:
    """A triangle surface in a file (read_surface). Arrays are read-only."""

    points: Annotated[NDArray[np.float64], "(n, 3) float64, m", "the points"]
    triangles: Annotated[NDArray[np.uint32], "(m, 3) uint32", "the points of each triangle"]
    point_arrays: Annotated[
        Arrays, "1", "arrays by name, (n,) or (n, c) float64: values of the file, never converted"
    ]
    triangle_arrays: Annotated[Arrays, "1", "the same with a row for each triangle, (m,) or (m, c)"]
    frame: Annotated[Optional[str], "1", '"LPS", "RAS", or None: the file does not state it']
    file_frame: Annotated[Optional[str], "1", "the frame in the file, before conversion"]
    unit: Annotated[str, "1", 'unit of the file, "m", "mm" or "cm"']
    format: Annotated[str, "1", '"STL", "PLY", "OBJ", "OFF", "VTK" or "VTP"']

    def __repr__(self) -> str:
        size = f"{len(self.points)} points, {len(self.triangles)} triangles"
        frame = self.frame or "unknown frame"
        return f"<mvs.Surface: {size}, {frame}, from {self.format} in {self.unit}>"


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Landmarks:
    """Points in a file, with names (read_landmarks). ``landmarks["AL"]`` is a position in m."""

    points: Annotated[
        NDArray[np.float64], "(k, 3) float64, m", "the points, those of a curve in its order"
    ]
    names: Annotated[tuple[str, ...], "1", "names of the points; empty for a file without names"]
    point_arrays: Annotated[
        Arrays, "1", "arrays by name, (k,) or (k, c) float64: values of the file"
    ]
    frame: Annotated[Optional[str], "1", '"LPS", "RAS", or None: the file does not state it']
    file_frame: Annotated[Optional[str], "1", "the frame in the file, before conversion"]
    unit: Annotated[str, "1", 'unit of the file, "m", "mm" or "cm"']
    format: Annotated[str, "1", '"markups", "FCSV", "CSV", "VTK", "VTP", "PLY" or "OBJ"']

    def __len__(self) -> int:
        return len(self.points)

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """The position (3,) in m of the first point of this name; KeyError for another name."""
        if name not in self.names:
            raise KeyError(f'there is no point "{name}"{did_you_mean(name, self.names)}')
        return np.asarray(self.points[self.names.index(name)])

    def __repr__(self) -> str:
        size = f"{len(self)} points, {self.frame or 'unknown frame'}"
        return f"<mvs.Landmarks: {size}, from {self.format} in {self.unit}>"


def read_surface(
    path: Path, unit: Optional[Unit] = "mm", frame: Optional[PatientFrame] = None
) -> Surface:
    """Reads a surface from a .stl, .ply, .obj, .off, .vtk or .vtp file (mvs.Surface).

    unit: of the file, "m", "mm" or "cm"; None: as the file states (few do). Points are then in m
    frame: "LPS" or "RAS": points of a file that states the other frame are converted; None: the
        frame of the file. Points of a file that states no frame stay as they are, with frame None
    """
    file = _core.SurfaceFile(path, unit, frame)
    if not len(file.triangles):
        raise ArgumentError(
            f"path: {os.fspath(path)} has points but no triangles: read it with mvs.read_landmarks",
            "path",
        )
    return Surface(
        file.points,
        file.triangles,
        file.point_arrays,
        file.triangle_arrays,
        file.frame,
        file.file_frame,
        file.unit,
        file.format,
    )


def read_landmarks(
    path: Path, unit: Optional[Unit] = "mm", frame: Optional[PatientFrame] = None
) -> Landmarks:
    """Reads landmarks or a curve (mvs.Landmarks).

    path: a .mrk.json or .fcsv file of 3D Slicer, a .csv table with the columns label, x, y, z, or
        a .vtk, .vtp, .ply or .obj file without triangles

    unit: of the file, "m", "mm" or "cm"; None: as the file states, as newer .mrk.json files do.
        Points are then in m
    frame: as for read_surface
    """
    file = _core.SurfaceFile(path, unit, frame)
    if len(file.triangles):
        raise ArgumentError(
            f"path: {os.fspath(path)} has {len(file.triangles)} triangles: "
            "read it with mvs.read_surface",
            "path",
        )
    return Landmarks(
        file.points,
        file.names,
        file.point_arrays,
        file.frame,
        file.file_frame,
        file.unit,
        file.format,
    )
