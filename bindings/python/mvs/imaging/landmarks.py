"""Landmarks and curves of a patient, in m and LPS, by their part: annulus, commissures, tips."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

import mvs
from mvs.surfaces import PatientFrame
from .findings import finding
from .names import POSTERIOR

Points = NDArray[np.float64]
PARTS = ("annulus", "commissures", "anterior", "papillary_tips")


def read_part(path: Union[str, "os.PathLike[str]"], part: str,
              frame: Optional[str] = None) -> Points:
    """Points of a file (.mrk.json, .fcsv, .csv, .vtp, .vtk) in LPS, m.

    frame: of a file that does not state its own, "LPS" or "RAS". ArgumentError without it: a frame
        that is taken for the other one mirrors the valve, and no check of the points would show it
    """
    return named_part(path, part, frame)[0]


def named_part(path: Union[str, "os.PathLike[str]"], part: str,
               frame: Optional[str] = None) -> tuple[Points, tuple[str, ...]]:
    """The points of read_part and their names; no names for a file without."""
    read = landmarks_in(path, "LPS")
    if read.file_frame is None and frame is None:
        raise mvs.ArgumentError(
            f"{os.fspath(path)}: does not state whether its points are in LPS or RAS: say so with "
            "--frame LPS or --frame RAS (3D Slicer writes LPS to .mrk.json)", part)
    points = np.array(read.points)
    if read.file_frame is None and frame == "RAS":
        points = points * [-1, -1, 1]
    if not len(points):
        raise mvs.ArgumentError(f"{os.fspath(path)}: has no points", part)
    return points, read.names


def landmarks_in(path: Union[str, "os.PathLike[str]"], frame: Optional[PatientFrame] = None) -> mvs.Landmarks:
    """Landmarks in the unit that the file states; mm where it states none, as of medical images and 3D Slicer."""
    try:
        return mvs.read_landmarks(path, None, frame)
    except mvs.ArgumentError:
        return mvs.read_landmarks(path, "mm", frame)


COUNTS = {"commissures": (2, 2, "a mitral valve has two"), "anterior": (1, 1, "give one point of that leaflet"),
          "papillary_tips": (1, 64, "give at most 64")}
SAME = 1e-4
"""m: tips of papillary muscles that are nearer to one another are one point twice"""


def check_counts(points: Mapping[str, Any], words: str = "") -> None:
    """Refuses too few or too many points of a part, and one tip twice.

    points: (n, 3) m by part; words: before the name of a part in a sentence, such as "loaded "
    """
    for part, (least, most, hint) in COUNTS.items():
        if points.get(part) is None:
            continue
        given = np.atleast_2d(points[part])
        if not least <= len(given) <= most:
            raise mvs.ArgumentError(f"{words}{part}: {len(given)} point{'s' if len(given) > 1 else ''} given: {hint}", part)
        for k in range(1, len(given)) if part == "papillary_tips" else ():
            twin = np.linalg.norm(given[:k] - given[k], axis=1)
            if twin.min() < SAME:
                raise mvs.ArgumentError(f"{words}{part}: points {int(twin.argmin()) + 1} and {k + 1} lie at one place: give "
                                        "each tip once, at least one of each papillary muscle", part)


def anterior_on_label(point: Points, centres: Points, leaflet: NDArray[np.uint32]) -> tuple[mvs.Finding, ...]:
    """A doubtful finding if the point of the anterior leaflet lies on the label of the posterior one.

    point: (1, 3) m; centres: (m, 3) m, of triangles; leaflet: (m,) 0 unknown, 1 anterior, 2 posterior
    """
    if leaflet[int(nearest_tree(centres).query(np.atleast_2d(point))[1][0])] != POSTERIOR:
        return ()
    return (dataclasses.replace(finding(
        "anterior_label", mvs.FindingSource.MEASURED, 0.2,
        "the point of the anterior leaflet lies on the segment of the posterior one; the point was taken, not the names "
        "of the segments: if they are right, correct the point, else exchange --anterior-label and --posterior-label"),
        doubtful=True),)


def check_near(points: Mapping[str, Any], tissue: Points, name: str = "the tissue") -> None:
    """Refuses landmarks of another frame or of another patient, by their distance from the tissue.

    tissue: (n, 3) m, points of the leaflets. Annulus, commissures and the point of the anterior
        leaflet lie within 8 mm of the leaflets; papillary tips within 60 mm of their middle
    """
    tree = nearest_tree(tissue)
    centre = tissue.mean(axis=0)
    for part in PARTS:
        if points.get(part) is None:
            continue
        given = np.atleast_2d(points[part])
        if part == "papillary_tips":
            away, most = np.linalg.norm(given - centre, axis=1).max(), 60e-3
        else:
            away, most = float(np.median(tree.query(given)[0])), 8e-3
        if away <= most:
            continue
        turned = given * [-1, -1, 1]
        again = (np.linalg.norm(turned - centre, axis=1).max() if part == "papillary_tips"
                 else float(np.median(tree.query(turned)[0])))
        reason = ("they fit with x and y mirrored: the file is in the other frame of LPS and RAS; "
                  "say so with --frame" if again <= most else
                  "they belong to another patient, image or unit")
        raise mvs.ArgumentError(
            f"{part}: the points lie {away * 1e3:.0f} mm from {name} (at most {most * 1e3:.0f} mm "
            f"are expected): {reason}", part)


def nearest_tree(points: Points) -> Any:
    from .needs import need

    return need("scipy.spatial").cKDTree(points)
