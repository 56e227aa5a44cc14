"""Leaflets in a label map: one mid-surface with thickness and leaflet of each triangle.

Labels of real networks have spurs, holes, eaten rims, islands and swapped parts near the commissures:
what is mended is a finding, and what no rule mends is refused with a sentence.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError, Finding, FindingSource
from .findings import finding
from .grid import Grid, Volume, spacing_of
from .leaflet_segments import choose_segments, in_quotes, other_leaflet, report_segments
from .mesh import Sheet, areas, handles, in_largest_piece, is_crumpled, largest_piece, loop_length, loops_by_length
from .names import ANTERIOR, POSTERIOR, UNKNOWN
from .needs import need
from .reading import LabelMap
from .thick_tissue import report_thick
from .tissue_sheet import LabelSettings, Tell, check_sheet, fitted_sheet, grid_step, silent, tissue_on_grid

@dataclasses.dataclass(eq=False)
class Leaflets:
    """Leaflets in an image: the sheet and the leaflet of each triangle (0 unknown, 1 A, 2 P)."""

    sheet: Sheet
    leaflet: NDArray[np.uint32]
    findings: list[Finding]


def leaflets_in(labels: LabelMap, chosen: Optional[Mapping[str, int]] = None,
                settings: LabelSettings = LabelSettings(), tell: Tell = silent) -> Leaflets:
    """The mid-surface of the leaflets in a label map."""
    segments = choose_segments(labels, chosen)
    findings: list[Finding] = []
    mask = np.zeros(next(iter(labels.masks.values())).shape, bool)
    for name in segments:
        mask |= labels.masks[name]
    if mask.mean() > MOST_FILLED:
        raise ArgumentError(f"the segments {in_quotes(segments)} fill {100 * mask.mean():.0f} % of the image: these are "
                            "no leaflets. Name the right segments", "labels")
    findings += report_segments(labels, segments, bool(chosen))
    mask = _without_islands(mask, settings.island, findings)
    _report_cut(mask, findings)
    spacing = np.array(labels.image.GetSpacing()) * 1e-3
    check_sheet(mask, spacing)
    sheet, grid = _sheet_of(labels.image, mask, settings, findings, tell)
    report_thick(mask, _places(labels.image, mask), spacing, sheet, findings)
    tell("leaflet of each triangle")
    leaflet = _leaflet_of_triangles(labels, segments, grid, sheet, findings)
    return Leaflets(sheet, leaflet, findings)


def _places(image: Any, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Centres (n, 3) of the voxels of a mask, m, LPS."""
    index = np.argwhere(mask)[:, ::-1] * np.array(image.GetSpacing())
    return np.asarray((index @ np.array(image.GetDirection()).reshape(3, 3).T + np.array(image.GetOrigin())) * 1e-3)


MOST_FILLED = 0.5
"""Leaflets fill less of an image: 1 mm of tissue in a cavity of 30 mm is a tenth, in a tight crop"""


def _report_cut(mask: NDArray[np.bool_], findings: list[Finding]) -> None:
    """Says where tissue touches the faces of the volume, at which it may go on."""
    sides = [("first", 0), ("last", -1)]
    touched = [f"{word} {plane}" for axis, plane in ((2, "column"), (1, "row"), (0, "slice")) for word, at in sides
               if mask.take(at, axis).any()]
    if touched:
        findings.append(dataclasses.replace(finding(
            "cut_by_border", FindingSource.MEASURED, 0.9,
            f"the leaflets touch the border of the image ({', '.join(touched)}): what lies outside is missing. Give "
            "an image with a margin, or fill in what is cut off"), doubtful=True))


def _without_islands(mask: NDArray[np.bool_], least: float,
                     findings: list[Finding]) -> NDArray[np.bool_]:
    """The largest piece of the tissue; refuses several large ones."""
    image = need("scipy.ndimage")
    label, count = image.label(mask, np.ones((3, 3, 3)))
    if count <= 1:
        return mask
    size = np.bincount(label.ravel())[1:]
    order = np.argsort(-size, kind="stable")
    share = size[order] / size.sum()
    large = int((share >= least).sum())
    if share[0] < 0.5:
        raise ArgumentError(
            f"the tissue consists of {count} disconnected pieces, the largest of which has {100 * share[0]:.2g} % of "
            "the voxels: this is no segmentation of leaflets. Name the right segments, or smooth the labels",
            "labels")
    if large > 1:
        words = ", ".join(f"{100 * s:.0f} %" for s in share[:large])
        raise ArgumentError(
            f"the tissue consists of {large} disconnected pieces ({words} of the voxels): leaflets "
            "meet at both commissures. Join the pieces in the segmentation, or name the right segments",
            "labels")
    findings.append(finding(
        "islands", FindingSource.MEASURED, 0.9,
        f"{count - 1} pieces beside the leaflets, {100 * share[1:].sum():.2g} % of the voxels, were "
        "dropped"))
    return np.asarray(label == order[0] + 1)


def _sheet_of(image: Any, mask: NDArray[np.bool_], settings: LabelSettings,
              findings: list[Finding], tell: Tell) -> tuple[Sheet, Grid]:
    """The mid-surface; tissue is closed step by step until the sheet has no tunnel and is a whole ring."""
    voxel = spacing_of(image)
    grid, tissue = tissue_on_grid(image, mask, grid_step(image, mask))
    # the first sheet without tunnels, or a later one without tears and ragged holes too
    chosen: Optional[tuple[Sheet, list[float], float]] = None
    for attempt in range(4):
        radius = attempt * voxel
        if radius:
            tell(f"gaps up to {2e3 * radius:.1f} mm closed, because of tunnels, ragged holes or a ring that is torn")
        sheet, smaller = largest_piece(
            fitted_sheet(grid, _closed(grid, tissue, radius), voxel, settings, tell))
        tunnels = handles(sheet)
        if tunnels:
            continue
        chosen = chosen or (sheet, smaller, radius)
        loops = loops_by_length(sheet)
        if not _is_torn(sheet, loops) and not _has_ragged_hole(sheet, loops, settings.hole):
            chosen = (sheet, smaller, radius)
            break
    if chosen is None:
        raise ArgumentError(
            f"the leaflets have {tunnels} tunnels, bridges between two parts of the tissue, even after "
            f"gaps of {2e3 * radius:.1f} mm are closed: mend the segmentation there; where the leaflets touch all along, "
            "the valve is closed in this image: give the open one", "labels")
    sheet, smaller, radius = chosen
    if radius:
        findings.append(finding("closed_gaps", FindingSource.GUESSED, 0.6,
                                f"gaps in the labels up to {2e3 * radius:.1f} mm were closed, because "
                                "tunnels, ragged holes or a tear ran through the tissue", [2 * radius], "m"))
    whole = areas(sheet.points, sheet.triangles).sum()
    if smaller:
        findings.append(finding(
            "dropped", FindingSource.MEASURED, 0.9,
            f"{len(smaller)} pieces beside the sheet, {100 * sum(smaller) / whole:.2g} % of its area, "
            "were dropped"))
    report_thickness(sheet, findings)
    return sheet, grid


LEAST_EDGE = 0.3
"""The free edge is at least so long, as a share of the annulus: half as long and more in valves that were seen"""


def _is_torn(sheet: Sheet, loops: list[NDArray[np.int64]]) -> bool:
    """Whether tissue is missing from the annulus to the free edge, so that both are one rim."""
    length = [loop_length(sheet.points, loop) for loop in loops[:2]]
    return len(length) < 2 or length[1] < LEAST_EDGE * length[0]


def _has_ragged_hole(sheet: Sheet, loops: list[NDArray[np.int64]], hole: float) -> bool:
    """Whether a rim beside the two longest is long or crumpled: labels with shreds, or a strand of tissue
    below an eaten free edge."""
    for loop in loops[2:]:
        length = loop_length(sheet.points, loop)
        if length > np.pi * hole or length > hole and is_crumpled(sheet.points, loop, length):
            return True
    return False


def _closed(grid: Grid, tissue: Volume, radius: float) -> Volume:
    """The tissue, of which the part above a half is closed with a ball, by distances; grey values stay elsewhere."""
    if radius <= 0:
        return tissue
    image = need("scipy.ndimage")
    voxels = radius / grid.step
    wide = image.distance_transform_edt(tissue < 0.5) <= voxels
    closed = image.distance_transform_edt(wide) > voxels
    return np.asarray(np.maximum(tissue, closed.astype(np.float32)))


def report_thickness(sheet: Sheet, findings: list[Finding]) -> None:
    thickness, known = sheet.values["thickness"], sheet.values["measured"] > 0
    low, middle, high = np.percentile(thickness, [5, 50, 95])
    findings.append(finding(
        "image_thickness", FindingSource.MEASURED, 0.8 if known.mean() > 0.8 else 0.5,
        f"the tissue is {middle * 1e3:.2f} mm thick in the middle of its range, {low * 1e3:.2f} to "
        f"{high * 1e3:.2f} mm between the 5th and 95th percentile; measured at "
        f"{100 * known.mean():.0f} % of the points, averaged elsewhere", [low, middle, high], "m"))


def _leaflet_of_triangles(labels: LabelMap, segments: Mapping[str, int], grid: Grid, sheet: Sheet,
                          findings: list[Finding]) -> NDArray[np.uint32]:
    """The leaflet of each triangle: the larger share of labels near it, in one piece per leaflet."""
    both = set(segments.values()) >= {ANTERIOR, POSTERIOR}
    if not both:
        return np.zeros(len(sheet.triangles), np.uint32)
    share = np.zeros(len(sheet.triangles))
    centres = sheet.points[sheet.triangles].mean(axis=1)
    blur = max(1.5e-3, 2 * spacing_of(labels.image))
    for name, label in segments.items():
        if label == UNKNOWN:
            continue
        box, tissue = tissue_on_grid(labels.image, labels.masks[name], spacing_of(labels.image))
        spread = need("scipy.ndimage").gaussian_filter(tissue, blur / box.step, truncate=3)
        share += (1 if label == ANTERIOR else -1) * box.sample(spread, centres)
    leaflet = np.where(share > 0, ANTERIOR, POSTERIOR).astype(np.uint32)
    swapped = _one_piece_each(sheet, leaflet)
    if swapped:
        whole = areas(sheet.points, sheet.triangles).sum()
        findings.append(finding(
            "swapped_labels", FindingSource.MEASURED, 0.7,
            f"{100 * swapped / whole:.2g} % of the area had the label of the other leaflet, away from "
            "the rest of that leaflet, and was given back. Give the two commissures if the leaflets "
            "should be parted elsewhere", [swapped], "m2"))
    return leaflet


def _one_piece_each(sheet: Sheet, leaflet: NDArray[np.uint32]) -> float:
    """Keeps the largest piece of each label and turns the others over; returns their area, m2."""
    size = areas(sheet.points, sheet.triangles)
    turned = 0.0
    for _ in range(4):
        before = turned
        for label in (ANTERIOR, POSTERIOR):
            rows = np.flatnonzero(leaflet == label)
            if not len(rows):
                continue
            others = rows[~in_largest_piece(sheet, rows, size[rows])]
            leaflet[others] = other_leaflet(label)
            turned += float(size[others].sum())
        if turned == before:
            break
    return turned
