"""Spurs of labels: ribbons of mid-surface that are narrower than any part of a leaflet, cut off.

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

LEAST_PIECE = 0.05
"""Share of the area: a smaller part that only a ribbon joins to the rest goes with the ribbon."""


def cut_spurs(found: Leaflets) -> None:
    """Cuts ribbons off whose outline is a hole: a spur stands on the leaflet, and its mid-surface is a fin that
    opens the sheet at its root. Its filling would lie on the fin and cross it.

    Rims of holes without spurs stay as they are.
    """
    loops = loops_by_length(found.sheet)
    if len(loops) < 3:
        return
    kept, cut = _without_ribbons(found.sheet, loops[2:])
    if not len(cut):
        return
    found.sheet, found.leaflet = found.sheet.part(kept), found.leaflet[kept]
    found.findings.append(finding(
        "spurs", FindingSource.GUESSED, 0.7,
        f"{len(cut)} ribbons of tissue narrower than {2e3 * _half(found.sheet):.1f} mm that stand on the leaflets "
        f"beside a hole, {1e6 * cut.sum():.0f} mm2, were cut off as spurs of the labels", cut.tolist(), "m2"))


def without_spurs(sheet: Sheet, name: str, findings: list[Finding]) -> Sheet:
    """A closed leaflet without the ribbons at any of its rims; a target of a fit needs no whole rim."""
    loops = loops_by_length(sheet)
    if not loops:
        return sheet
    kept, cut = _without_ribbons(sheet, loops)
    if not len(cut):
        return sheet
    findings.append(finding(
        "closed_spurs", FindingSource.GUESSED, 0.7,
        f"loaded image, {name}: {len(cut)} ribbons narrower than {2e3 * _half(sheet):.1f} mm, "
        f"{1e6 * cut.sum():.0f} mm2, were cut off as spurs of the labels", cut.tolist(), "m2"))
    return sheet.part(kept)


def _half(sheet: Sheet) -> float:
    """Half of the width of the widest ribbon, m."""
    return 0.5 * SPUR_WIDTH * float(np.median(sheet.values["thickness"]))


def _without_ribbons(sheet: Sheet, rims: list[NDArray[np.int64]]) -> tuple[NDArray[np.bool_], Points]:
    """The triangles that stay where ribbons between some rims are cut off, and the areas of these, m2."""
    half = _half(sheet)
    edges, _ = unique_edges(sheet.triangles)
    size = areas(sheet.points, sheet.triangles)
    every = np.ones(len(size), bool)
    core = _far_from(sheet.points, edges, np.unique(np.concatenate(rims)), half)
    inner = _large_pieces(sheet, core[sheet.triangles].all(axis=1), size)
    if not inner.any():
        return every, np.zeros(0)
    # paths along edges are up to a sixth longer than straight ones (in regular triangles), and the first points
    # beyond a distance lie an edge beyond it
    edge = np.percentile(np.linalg.norm(sheet.points[edges[:, 0]] - sheet.points[edges[:, 1]], axis=1), 99)
    lost = _far_from(sheet.points, edges, np.unique(sheet.triangles[inner]), 7 / 6 * half + float(edge))
    kept = _large_pieces(sheet, ~lost[sheet.triangles].any(axis=1), size)
    ribbons = np.flatnonzero(~kept)
    piece = pieces(sheet.triangles[ribbons], len(sheet.points))
    area = np.bincount(piece, size[ribbons])
    kept[ribbons[area[piece] < half**2]] = True  # corners of a rim
    return kept, area[area >= half**2]


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
