"""Tissue that is much thicker than its measured thickness, such as a calcified annulus.

The mid-surface measures sheets: points in a lump count as a spur and get the thickness around them.
"""

from __future__ import annotations

import dataclasses
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from mvs import Finding, FindingSource
from .findings import finding
from .grid import Floats, Points, cut_out
from .mesh import Sheet
from .needs import need

THICKER, LEAST_SHARE = 1.5, 0.05
"""Tissue counts as thick from this factor of the measured thickness on, and is reported from this share of the labels on:
ragged labels and junctions with chordae have up to 3 %."""
CONFIDENCE = 0.3

NORMAL_THICKNESS = 0.8e-3
"""m: of leaflets whose thickness is not known (the default of a build)"""

RESOLVED = 2.5
"""Voxels: labels that are narrower do not show how thick the tissue is. One voxel and a half is the least
that keeps a slanted sheet in one piece, and networks draw it whatever the tissue is."""


def assumed_thickness(width: float, voxel: float) -> Optional[float]:
    """The thickness, m, that a build assumes everywhere for labels too narrow to measure it; None: they show it.

    width: the median of the labels, m
    """
    return min(NORMAL_THICKNESS, width) if width < RESOLVED * voxel else None


def report_thick(mask: NDArray[np.bool_], places: Points, spacing: Floats, sheet: Sheet, findings: list[Finding]) -> None:
    """Adds a doubtful finding where labels are thicker than the sheet says, and lowers the confidence of its thickness.

    Compares the largest ball in the tissue at each voxel, by the Euclidean distance transform, with the thickness at
    the nearest point of the sheet. Narrow labels get one assumed thickness: there with the median at most, as the
    sheet averages thick parts with what lies around them.

    mask: (z, y, x) bool; places: (n, 3) m, of its voxels in the order of np.argwhere; spacing: (3,) m, of x, y, z
    """
    image = need("scipy.ndimage")
    voxel = float(np.max(spacing))
    padded = cut_out(mask)
    radius = image.distance_transform_edt(padded, spacing[::-1])
    nearest = need("scipy.spatial").cKDTree(sheet.points).query(places)[1]
    taken = sheet.values["thickness"][nearest]
    median = float(np.median(sheet.values["thickness"]))
    assumed = assumed_thickness(median, float(np.prod(spacing) ** (1 / 3)))
    if assumed is not None:
        taken = np.minimum(taken, median)
    width = 2 * radius[padded]
    # between centres of voxels: a flat sheet is up to a voxel narrower, round lumps are as wide
    thick = width - voxel > np.maximum(THICKER * taken, taken + voxel)
    if not thick.any():
        return
    core = np.zeros_like(padded)
    core[padded] = thick
    away, at = image.distance_transform_edt(~core, spacing[::-1], return_indices=True)
    share = float((away < radius[tuple(at)])[padded].mean())
    if share < LEAST_SHARE:
        return
    most = int(np.where(thick, width, 0).argmax())
    built = float(taken[most]) if assumed is None else assumed
    found = finding(
        "thick_tissue", FindingSource.MEASURED, CONFIDENCE,
        f"{100 * share:.0f} % of the tissue is thicker than what was measured there: up to about {width[most] * 1e3:.1f} mm, where "
        f"{built * 1e3:.1f} mm is taken; such lumps, as of a calcified annulus, are taken for normal tissue: leave "
        "them out of the labels, or give --thickness", [share, float(width[most]), built])
    findings[:] = [dataclasses.replace(one, confidence=min(one.confidence, CONFIDENCE)) if one.name == "image_thickness" else one
                   for one in findings]
    findings.append(dataclasses.replace(found, doubtful=True))
