"""The tissue law with which a valve, its chordae fitted, closes nearest to the leaflets in loaded labels.

Open labels do not show it, and fitted lengths make up for a wrong law in part only: a law that is too stiff
leaves the belly and the free edge a millimetre and more from the loaded leaflets. Micro-CT shows the chordae, so
that microct/tissue.py compares closures without a fit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Optional

import numpy as np

import mvs
from .findings import finding
from .mesh import Sheet, areas
from .valve import ImageValve, distances, leaflet_mesh

CANDIDATES = ("bilinear", "prot", "may_newman_yin")
"""The default first. Fung-type leaflets are left out: their fits take several times as long."""

SEARCH_VERTICES = 500
"""Vertices of the leaflets while laws are compared: half of the default, for a third of the time."""

CLEARLY_NEARER = 0.9
"""Another law takes the place of the default if its distance is at most this share: two segmentations of one
valve, or two folds of one closure, differ by a tenth."""

PLAUSIBLE = 1.25
"""A law may be that of the patient if its distance is at most this many times the least: distances contain the
errors of the labels, and a law whose own error is three quarters of theirs has 1.25 times their distance."""

MESH_LEAK, UNKNOWN_LEAK = 0.5e-6, 20e-6
"""m2: by which the leaks of meshes of one valve differ; width of an interval that says nothing (leak_interval.cpp)"""


def search_edge(sheet: Sheet) -> float:
    """The side, m, of equilateral triangles with which the sheet has SEARCH_VERTICES, two triangles for each."""
    area = float(areas(sheet.points, sheet.triangles).sum())
    return float(np.sqrt(area / (SEARCH_VERTICES * 0.5 * np.sqrt(3))))


def fitted_distance(build: Callable[[], ImageValve]) -> Optional[float]:
    """The RMS distance, m, of the loaded leaflets from a fitted valve; None without a clean closure.

    Not the other way round: where the labels lack tissue, as along the free edge, a valve without error is far
    from them whatever its tissue.
    """
    try:
        made = build()
    except mvs.Error:
        return None
    if made.loaded is None or not made.converged or made.closed.measures.intersections:
        return None
    away = distances(made.loaded.points, *leaflet_mesh(made.closed))
    return float(np.sqrt((away**2).mean()))


def chosen_tissue(away: Mapping[str, float]) -> tuple[str, mvs.Finding]:
    """The law and the finding `tissue` from the distances, m, of the laws that came to rest."""
    default = CANDIDATES[0]
    if not away:
        return default, finding("tissue", mvs.FindingSource.ASSUMED, 0.2,
                                f"{default}: the fitted leaflets came to rest under load with none of the tissues; give "
                                "--leaflet if the tissue is known")
    order = sorted(away, key=lambda law: away[law])
    best = order[0]
    if default in away and away[best] > CLEARLY_NEARER * away[default]:
        best = default
    words = ", ".join(f"{law} {away[law] * 1e3:.2f} mm" for law in order)
    clear = all(away[law] * CLEARLY_NEARER >= away[best] for law in order if law != best)
    return best, finding(
        "tissue", mvs.FindingSource.MEASURED, 0.6 if clear else 0.4,
        f"{best}: distances of the leaflets in the loaded image from a coarse valve with fitted chordae (RMS: {words}; "
        "the default stays unless another tissue is a tenth nearer); give --leaflet if the tissue is known",
        [away[law] for law in order], "m")


def with_other_tissues(found: Iterable[mvs.Finding], chosen: str, away: Mapping[str, float],
                       leaks: Mapping[str, float]) -> tuple[mvs.Finding, ...]:
    """Findings whose `leak_interval` also holds the leaks, m2, of the fits with the other plausible laws.

    Labels hardly determine the tissue, and a valve leaks more or less with another one.
    """
    least = min(away.values(), default=0.0)
    others = [law for law in away if law != chosen and away[law] <= PLAUSIBLE * least]
    return tuple(_wider(one, {law: leaks[law] for law in others})
                 if one.name == "leak_interval" and len(one.values) and others else one for one in found)


def _wider(interval: mvs.Finding, leaks: Mapping[str, float]) -> mvs.Finding:
    low = max(0.0, min(interval.values[0], min(leaks.values()) - MESH_LEAK))
    high = max(interval.values[1], max(leaks.values()) + MESH_LEAK)
    sure = 0.8 * (1 - min(1.0, (high - low) / UNKNOWN_LEAK))
    words = ", ".join(f"{law}, {leak * 1e6:.1f} mm2" for law, leak in leaks.items())
    return finding("leak_interval", mvs.FindingSource(interval.source), min(interval.confidence, sure),
                   f"{low * 1e6:.1f} to {high * 1e6:.1f} mm2 with other tissues that fit hardly worse ({words}, on a "
                   f"coarse mesh); with the tissue taken: {interval.sentence}", [low, high], interval.unit)
