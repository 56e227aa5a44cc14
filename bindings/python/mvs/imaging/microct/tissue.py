"""The tissue law with which a valve closes most like the leaflets in the loaded image.

Leaflets under load are a third larger in area than open ones, or hardly larger, by their tissue. The open
image does not show it; the loaded one does, as the chordae and the boundary are known from it.
"""

from __future__ import annotations

import dataclasses

import mvs
from ..findings import finding
from ..mesh import Sheet
from ..valve import distance_from_image
from .loaded import settled

CANDIDATES = (mvs.LeafletLaw.BILINEAR, mvs.LeafletLaw.FUNG, mvs.LeafletLaw.MAY_NEWMAN_YIN,
              mvs.LeafletLaw.PROT)
"""Membranes of mitral tissue, each with the published constants of the library"""


def with_tissue_of_image(valve: mvs.Valve, loaded: Sheet) -> mvs.Finding:
    """Sets the law of all leaflets of a valve to that whose closure is nearest to the loaded image.

    Laws whose closure does not come to rest are left out; without any the valve keeps its law.
    """
    given = valve.leaflets
    away: dict[mvs.LeafletLaw, float] = {}
    for law in CANDIDATES:
        valve.leaflets = _with_law(given, law)
        try:
            _, closed, stats = settled(valve)
        except mvs.Error:
            continue
        if stats.converged and not closed.measures.intersections:
            away[law] = float(distance_from_image(closed, loaded).values[0])
    if not away:
        valve.leaflets = given
        return finding("tissue", mvs.FindingSource.ASSUMED, 0.2,
                       "with no tissue did the leaflets come to rest under load; theirs was kept")
    order = sorted(away, key=lambda law: away[law])
    best = order[0]
    valve.leaflets = _with_law(given, best)
    words = ", ".join(f"{law.name.lower()} {away[law] * 1e3:.2f} mm" for law in order)
    return finding(
        "tissue", mvs.FindingSource.MEASURED, 0.6,
        f"{best.name.lower()}: closed with it the leaflets are nearest to those in the loaded image (RMS: "
        f"{words}); give --leaflet if the tissue is known", [away[law] for law in order], "m")


def _with_law(leaflets: list[mvs.Leaflet], law: mvs.LeafletLaw) -> list[mvs.Leaflet]:
    return [dataclasses.replace(one, law=law, constants=()) for one in leaflets]
