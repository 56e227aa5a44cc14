"""Landmarks and curves of a patient, in m and LPS, by their part: annulus, commissures, tips."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

import mvs

Points = NDArray[np.float64]
PARTS = ("annulus", "commissures", "anterior", "papillary_tips")


def read_part(path: Union[str, "os.PathLike[str]"], part: str,
              frame: Optional[str] = None) -> Points:
    """Points of a file (.mrk.json, .fcsv, .csv, .vtp, .vtk) in LPS, m.

    frame: of a file that does not state its own, "LPS" or "RAS". ArgumentError without it: a frame
        that is taken for the other one mirrors the valve, and no check of the points would show it
    """
    read = mvs.read_landmarks(path, frame="LPS")
    if read.file_frame is None and frame is None:
        raise mvs.ArgumentError(
            f"{os.fspath(path)}: does not state whether its points are in LPS or RAS: say so with "
            "--frame LPS or --frame RAS (3D Slicer writes LPS to .mrk.json)", part)
    points = np.array(read.points)
    if read.file_frame is None and frame == "RAS":
        points = points * [-1, -1, 1]
    if not len(points):
        raise mvs.ArgumentError(f"{os.fspath(path)}: has no points", part)
    return points


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
