"""Spurs and bridges of labels: ribbons of mid-surface that are narrower than any part of a leaflet, cut off.

An opening of the sheet: places farther from the rims than half a ribbon's width stay, and what is within that
width of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mvs import Finding, FindingSource
from mvs.mesh import shortest_paths
from .findings import finding
from .grid import Floats
from .labels import Leaflets
from .mesh import Points, Sheet, areas, loops_by_length, pieces, unique_edges

SPUR_WIDTH = 1.5
"""Widths of the tissue: narrower ribbons of mid-surface are spurs. Fingers of labels are about as wide as
thick, their mid-surface is narrower, and leaflets are ten times as wide."""

FIN_WIDTH = 2.5
"""Widths of the tissue, of ribbons between holes: a narrower strand between a hole and the rim counts as rim, wider ones as leaflet"""

BRIDGE_WIDTH = 3.0
"""Widths of the tissue: narrower ribbons between two parts of the orifice, one leaflet on each side, are places where
the labels of open leaflets touch. Wider ones are left to the reader of the image."""

LEAST_PIECE = 0.05
"""Share of the area: a smaller part that only a ribbon joins to the rest goes with the ribbon."""


def cut_spurs(found: Leaflets) -> None:
    """Cuts ribbons off at all rims. One that stands on a leaflet is a fin whose outline is a hole: the filling would lie
    on the fin and cross it. One at the free edge lies over tissue of the other leaflet, or lengthens the edge.

    A ribbon between two rims is no spur: low tissue at a commissure, or a strand below a hole.
    """
    widths, spurs = [], []
    for width, skipped_rims in ((FIN_WIDTH, 2), (SPUR_WIDTH, 0)):
        half = _half(found.sheet, width)
        rims = loops_by_length(found.sheet)
        cut = [one for one in _ribbons(found.sheet, rims[skipped_rims:], half) if _touched(found.sheet, one, rims) == 1]
        if cut:
            spurs += _cut(found, cut)
            widths.append(2e3 * half)
    if spurs:
        found.findings.append(finding(
            "spurs", FindingSource.GUESSED, 0.7,
            f"{len(spurs)} ribbons of tissue narrower than {max(widths):.1f} mm that stand on the leaflets or out of their rims, "
            f"{1e6 * sum(spurs):.0f} mm2, were cut off as spurs of the labels", spurs, "m2"))


def cut_bridges(found: Leaflets, orifice: NDArray[np.int64], other: NDArray[np.int64]) -> bool:
    """Cuts ribbons that join the leaflets between two rims, which are parts of one orifice; whether there was one."""
    half = _half(found.sheet, BRIDGE_WIDTH)
    rims = [orifice, other]
    cut = [one for one in _ribbons(found.sheet, rims, half) if _touched(found.sheet, one, rims) == 2]
    if not cut:
        return False
    corners = found.sheet.points[found.sheet.triangles[np.sort(np.concatenate(cut))]]
    place = np.round(corners.mean(axis=(0, 1)) * 1e3) + 0.0
    bridges = _cut(found, cut)
    found.findings.append(finding(
        "bridges", FindingSource.GUESSED, 0.5,
        f"the leaflets were joined across the orifice by tissue narrower than {2e3 * half:.1f} mm, {1e6 * sum(bridges):.0f} mm2 "
        f"near ({place[0]:.0f}, {place[1]:.0f}, {place[2]:.0f}) mm in LPS. It was cut, "
        "as labels of open leaflets touch by mistake; if a clip or a suture joins the leaflets there, apply it to the valve "
        "as a repair", bridges, "m2"))
    return True


def without_spurs(sheet: Sheet, name: str, findings: list[Finding]) -> Sheet:
    """A closed leaflet without the ribbons at any of its rims; a target of a fit needs no whole rim."""
    half = _half(sheet, SPUR_WIDTH)
    cut = _ribbons(sheet, loops_by_length(sheet), half)
    if not cut:
        return sheet
    spurs = _areas_of(sheet, cut)
    findings.append(finding(
        "closed_spurs", FindingSource.GUESSED, 0.7,
        f"loaded image, {name}: {len(cut)} ribbons narrower than {2e3 * half:.1f} mm, "
        f"{1e6 * sum(spurs):.0f} mm2, were cut off as spurs of the labels", spurs, "m2"))
    return sheet.part(_left(sheet, cut))


def _half(sheet: Sheet, widths: float) -> float:
    """Half of the width of the widest ribbon, m, from widths of the tissue."""
    return 0.5 * widths * float(np.median(sheet.values["thickness"]))


def _ribbons(sheet: Sheet, rims: list[NDArray[np.int64]], half: float) -> list[NDArray[np.int64]]:
    """The triangles of each ribbon between some rims."""
    if not rims:
        return []
    edges, _ = unique_edges(sheet.triangles)
    size = areas(sheet.points, sheet.triangles)
    core = _far_from(sheet.points, edges, np.unique(np.concatenate(rims)), half)
    inner = _large_pieces(sheet, np.all(core[sheet.triangles], axis=1), size)
    if not inner.any():
        return []
    # paths along edges are up to a sixth longer than straight ones (in regular triangles), and the first points
    # beyond a distance lie an edge beyond it
    edge = np.percentile(np.linalg.norm(sheet.points[edges[:, 0]] - sheet.points[edges[:, 1]], axis=1), 99)
    lost = _far_from(sheet.points, edges, np.unique(sheet.triangles[inner]), 7 / 6 * half + float(edge))
    ribbons = np.flatnonzero(~_large_pieces(sheet, ~np.any(lost[sheet.triangles], axis=1), size))
    piece = pieces(sheet.triangles[ribbons], len(sheet.points))
    area = np.bincount(piece, size[ribbons])
    return [ribbons[piece == k] for k in np.flatnonzero(area >= half**2)]  # smaller ones are corners of a rim


def _touched(sheet: Sheet, ribbon: NDArray[np.int64], rims: list[NDArray[np.int64]]) -> int:
    """How many of the rims a ribbon touches."""
    return sum(bool(np.isin(sheet.triangles[ribbon], rim).any()) for rim in rims)


def _areas_of(sheet: Sheet, ribbons: list[NDArray[np.int64]]) -> list[float]:
    """m2"""
    return [float(areas(sheet.points, sheet.triangles[one]).sum()) for one in ribbons]


def _left(sheet: Sheet, ribbons: list[NDArray[np.int64]]) -> NDArray[np.bool_]:
    """The triangles that stay without the ribbons."""
    kept = np.ones(len(sheet.triangles), bool)
    kept[np.concatenate(ribbons)] = False
    return kept


def _cut(found: Leaflets, ribbons: list[NDArray[np.int64]]) -> list[float]:
    """Takes ribbons off the leaflets; their areas, m2."""
    size, kept = _areas_of(found.sheet, ribbons), _left(found.sheet, ribbons)
    found.sheet, found.leaflet = found.sheet.part(kept), found.leaflet[kept]
    return size


def _large_pieces(sheet: Sheet, chosen: NDArray[np.bool_], size: Floats) -> NDArray[np.bool_]:
    """The chosen triangles in pieces of at least LEAST_PIECE of the area of the sheet."""
    rows = np.flatnonzero(chosen)
    kept = np.zeros(len(chosen), bool)
    if len(rows):
        piece = pieces(sheet.triangles[rows], len(sheet.points))
        kept[rows] = np.bincount(piece, size[rows])[piece] >= LEAST_PIECE * size.sum()
    return kept


def _far_from(points: Points, edges: NDArray[np.int64], sources: NDArray[np.int64],
              distance: float) -> NDArray[np.bool_]:
    """Which points are farther from all sources than a distance, along edges."""
    path, _ = shortest_paths(points, edges, sources)
    return np.asarray(path > distance)
