"""The tissue law with which a valve, its chordae fitted, closes nearest to the leaflets in loaded labels.

Open labels do not show it, and fitted lengths make up for a wrong law in part only: a law that is too stiff
leaves the belly and the free edge a millimetre and more from the loaded leaflets. Micro-CT shows the chordae, so
that microct/tissue.py compares closures without a fit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple, Optional

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


class LawFit(NamedTuple):
    """A coarse fit with one law: RMS distance of the loaded leaflets from it, m, and its leak, m2."""

    distance: float
    leak: float


def search_edge(sheet: Sheet) -> float:
    """The side, m, of equilateral triangles with which the sheet has SEARCH_VERTICES, two triangles for each."""
    area = float(areas(sheet.points, sheet.triangles).sum())
    return float(np.sqrt(area / (SEARCH_VERTICES * 0.5 * np.sqrt(3))))


def law_fit(build: Callable[[], ImageValve]) -> Optional[LawFit]:
    """The distance and the leak of a fitted valve; None without a clean closure.

    The distance is that of the loaded leaflets from the valve, not the other way round: where the labels lack
    tissue, as along the free edge, a valve without error is far from them whatever its tissue.
    """
    try:
        made = build()
    except mvs.Error:
        return None
    if made.loaded is None or not made.converged or made.closed.measures.intersections:
        return None
    away = distances(made.loaded.points, *leaflet_mesh(made.closed))
    return LawFit(float(np.sqrt((away**2).mean())), made.closed.measures.regurgitant_orifice_area)


def chosen_tissue(fits: Mapping[str, LawFit]) -> tuple[str, mvs.Finding]:
    """The law and the finding `tissue` from the fits of the laws that came to rest."""
    default = CANDIDATES[0]
    if not fits:
        return default, finding("tissue", mvs.FindingSource.ASSUMED, 0.2,
                                f"{default}: the fitted leaflets came to rest under load with none of the tissues; give "
                                "--leaflet if the tissue is known")
    away = {law: fit.distance for law, fit in fits.items()}
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


def with_other_fits(found: Iterable[mvs.Finding], fits: Mapping[str, LawFit]) -> tuple[mvs.Finding, ...]:
    """Findings whose `leak_interval` also holds the leaks of the coarse fits with all plausible laws.

    Labels hardly determine the tissue, and a valve leaks more or less with another one. The fit with the law
    that is taken counts as well: a coarser mesh that lies as near to the labels may leak where the finer closes.
    """
    found = tuple(found)
    limits = next((one.values for one in found if one.name == "leak_limits"), None)
    least = min((fit.distance for fit in fits.values()), default=0.0)
    leaks = {law: fit.leak for law, fit in fits.items() if fit.distance <= PLAUSIBLE * least}
    if limits is None or not leaks:
        return found
    return tuple(_wider(one, leaks, *limits) if one.name == "leak_interval" and len(one.values) else one
                 for one in found)


def _wider(interval: mvs.Finding, leaks: Mapping[str, float], alike: float, unknown: float) -> mvs.Finding:
    """The interval with leaks, m2, that meshes change by `alike`; one that is `unknown` wide says nothing."""
    (low, high), other = interval.values, leaks.values()
    wide_low, wide_high = max(0.0, min(low, min(other) - alike)), max(high, max(other) + alike)
    if wide_low == low and wide_high == high:
        return interval
    said = max(0.0, 1 - (wide_high - wide_low) / unknown)
    sure = interval.confidence * said / (1 - (high - low) / unknown) if said else 0.0
    words = ", ".join(f"{law}, {leak * 1e6:.1f} mm2" for law, leak in leaks.items())
    return finding("leak_interval", mvs.FindingSource(interval.source), sure,
                   f"{wide_low * 1e6:.1f} to {wide_high * 1e6:.1f} mm2 with fits on a coarse mesh that lie hardly "
                   f"farther from the labels ({words}); of the valve itself: {interval.sentence}",
                   [wide_low, wide_high], interval.unit)
