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
from .labels import Leaflets
from .mesh import Points, Sheet, areas, loops_by_length, pieces, unique_edges

SPUR_WIDTH = 1.5
"""Widths of the tissue: narrower ribbons of mid-surface are spurs. Fingers of labels are about as wide as
thick, their mid-surface is narrower, and leaflets are ten times as wide."""

FIN_WIDTH = 2.5
"""Widths of the tissue, of ribbons between holes: around a hole in a leaflet tissue is wider, or it is part of the rim too"""

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
    widths, spurs = [], np.zeros(0)
    for width, first in ((FIN_WIDTH, 2), (SPUR_WIDTH, 0)):
        half = _half(found.sheet, width)
        loops = loops_by_length(found.sheet)
        ribbons, piece, area = _ribbons(found.sheet, loops[first:], half)
        touched = _touched(found.sheet.triangles[ribbons], piece, loops)
        single = np.isin(piece, [one for one, rims in touched.items() if len(rims) == 1])
        kept, cut = _without(found.sheet, ribbons[single], piece[single], area)
        if len(cut):
            found.sheet, found.leaflet = found.sheet.part(kept), found.leaflet[kept]
            widths.append(2e3 * half)
            spurs = np.append(spurs, cut)
    if len(spurs):
        found.findings.append(finding(
            "spurs", FindingSource.GUESSED, 0.7,
            f"{len(spurs)} ribbons of tissue narrower than {max(widths):.1f} mm that stand on the leaflets or out of their rims, "
            f"{1e6 * spurs.sum():.0f} mm2, were cut off as spurs of the labels", spurs.tolist(), "m2"))


def cut_bridges(found: Leaflets, orifice: NDArray[np.int64], other: NDArray[np.int64]) -> bool:
    """Cuts ribbons that join the leaflets between two rims, which are parts of one orifice; whether there was one."""
    sheet = found.sheet
    half = _half(sheet, BRIDGE_WIDTH)
    ribbons, piece, area = _ribbons(sheet, [orifice, other], half)
    touched = _touched(sheet.triangles[ribbons], piece, [orifice, other])
    joins = np.isin(piece, [one for one, rims in touched.items() if len(rims) == 2])
    kept, cut = _without(sheet, ribbons[joins], piece[joins], area)
    if not len(cut):
        return False
    place = np.round(sheet.points[sheet.triangles[~kept]].mean(axis=(0, 1)) * 1e3) + 0.0
    found.sheet, found.leaflet = sheet.part(kept), found.leaflet[kept]
    found.findings.append(finding(
        "bridges", FindingSource.GUESSED, 0.5,
        f"the leaflets were joined across the orifice by tissue narrower than {2e3 * half:.1f} mm, {1e6 * cut.sum():.0f} mm2 "
        f"near ({place[0]:.0f}, {place[1]:.0f}, {place[2]:.0f}) mm in LPS. It was cut, "
        "as labels of open leaflets touch by mistake; if a clip or a suture joins the leaflets there, apply it to the valve "
        "as a repair", cut.tolist(), "m2"))
    return True


def without_spurs(sheet: Sheet, name: str, findings: list[Finding]) -> Sheet:
    """A closed leaflet without the ribbons at any of its rims; a target of a fit needs no whole rim."""
    half = _half(sheet, SPUR_WIDTH)
    kept, cut = _without(sheet, *_ribbons(sheet, loops_by_length(sheet), half))
    if not len(cut):
        return sheet
    findings.append(finding(
        "closed_spurs", FindingSource.GUESSED, 0.7,
        f"loaded image, {name}: {len(cut)} ribbons narrower than {2e3 * half:.1f} mm, "
        f"{1e6 * cut.sum():.0f} mm2, were cut off as spurs of the labels", cut.tolist(), "m2"))
    return sheet.part(kept)


def _half(sheet: Sheet, widths: float) -> float:
    """Half of the width of the widest ribbon, m, from widths of the tissue."""
    return 0.5 * widths * float(np.median(sheet.values["thickness"]))


def _ribbons(sheet: Sheet, rims: list[NDArray[np.int64]],
             half: float) -> tuple[NDArray[np.int64], NDArray[np.int64], Points]:
    """The triangles of ribbons between some rims, the piece of each, and the areas of the pieces, m2."""
    none = np.zeros(0, np.int64)
    if not rims:
        return none, none, np.zeros(0)
    edges, _ = unique_edges(sheet.triangles)
    size = areas(sheet.points, sheet.triangles)
    core = _far_from(sheet.points, edges, np.unique(np.concatenate(rims)), half)
    inner = _large_pieces(sheet, core[sheet.triangles].all(axis=1), size)
    if not inner.any():
        return none, none, np.zeros(0)
    # paths along edges are up to a sixth longer than straight ones (in regular triangles), and the first points
    # beyond a distance lie an edge beyond it
    edge = np.percentile(np.linalg.norm(sheet.points[edges[:, 0]] - sheet.points[edges[:, 1]], axis=1), 99)
    lost = _far_from(sheet.points, edges, np.unique(sheet.triangles[inner]), 7 / 6 * half + float(edge))
    ribbons = np.flatnonzero(~_large_pieces(sheet, ~lost[sheet.triangles].any(axis=1), size))
    piece = pieces(sheet.triangles[ribbons], len(sheet.points))
    area = np.bincount(piece, size[ribbons])
    large = area[piece] >= half**2  # others are corners of a rim
    return ribbons[large], piece[large], area


def _touched(triangles: NDArray[np.int64], piece: NDArray[np.int64],
             rims: list[NDArray[np.int64]]) -> dict[int, set[int]]:
    """The numbers of the rims that each piece of some triangles touches."""
    found: dict[int, set[int]] = {}
    for k, rim in enumerate(rims):
        for one in np.unique(piece[np.isin(triangles, rim).any(axis=1)]).tolist():
            found.setdefault(one, set()).add(k)
    return found


def _without(sheet: Sheet, ribbons: NDArray[np.int64], piece: NDArray[np.int64],
             area: Points) -> tuple[NDArray[np.bool_], Points]:
    """The triangles that stay without ribbons, and the areas of these, m2."""
    kept = np.ones(len(sheet.triangles), bool)
    kept[ribbons] = False
    return kept, area[np.unique(piece)]


def _large_pieces(sheet: Sheet, chosen: NDArray[np.bool_], size: Points) -> NDArray[np.bool_]:
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
