"""The tissue law with which a valve closes most like the leaflets in the loaded image.

Leaflets under load are a third larger in area than open ones, or hardly larger, by their tissue. The open
image does not show it; the loaded one does, as the chordae and the boundary are known from it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Optional

import mvs
from ..console import Console
from ..findings import finding
from ..mesh import Sheet
from ..valve import distance_from_image
from .loaded import Closure, settled

if TYPE_CHECKING:
    from mvs.editing import _FilledValve

CANDIDATES = (mvs.LeafletLaw.BILINEAR, mvs.LeafletLaw.FUNG, mvs.LeafletLaw.MAY_NEWMAN_YIN,
              mvs.LeafletLaw.PROT)
"""Membranes of mitral tissue, each with the published constants of the library"""


def with_tissue_of_image(valve: _FilledValve, loaded: Sheet, console: Console
                         ) -> tuple[mvs.Finding, Closure, list[mvs.LeafletLaw]]:
    """Sets the law of all leaflets of a valve to that whose closure is nearest to the loaded image, and
    closes the valve. Returns the laws as well, nearest first.

    Laws whose closure does not come to rest are left out; without any the valve keeps its law.
    """
    given = valve.leaflets
    away: dict[mvs.LeafletLaw, float] = {}
    nearest: Optional[Closure] = None
    for law in CANDIDATES:
        valve.leaflets = with_law(given, law)
        console.stage(f"closing the valve with the tissue {law.name.lower()}")
        try:
            closure = settled(valve, console)
        except mvs.Error:
            continue
        _, closed, stats = closure
        if stats.converged and not closed.measures.intersections:
            distance = float(distance_from_image(closed, loaded).values[0])
            if nearest is None or distance < min(away.values()):
                nearest = closure
            away[law] = distance
    if nearest is None:
        valve.leaflets = given
        return (finding("tissue", mvs.FindingSource.ASSUMED, 0.2,
                        "with no tissue did the leaflets come to rest under load; theirs was kept"),
                settled(valve, console), [])
    order = sorted(away, key=lambda law: away[law])
    valve.leaflets = with_law(given, order[0])
    return tissue_finding(away), nearest, order


def tissue_finding(away: dict[mvs.LeafletLaw, float]) -> mvs.Finding:
    """The nearest of laws, from the RMS distance in m of the closure with each."""
    order = sorted(away, key=lambda law: away[law])
    words = ", ".join(f"{law.name.lower()} {away[law] * 1e3:.2f} mm" for law in order)
    return finding(
        "tissue", mvs.FindingSource.MEASURED, 0.6,
        f"{order[0].name.lower()}: closed with it the leaflets are nearest to those in the loaded image (RMS: "
        f"{words}); give --leaflet if the tissue is known", [away[law] for law in order], "m")


def with_law(leaflets: Sequence[mvs.Leaflet], law: mvs.LeafletLaw) -> list[mvs.Leaflet]:
    """Leaflets with the published constants of a law."""
    return [dataclasses.replace(one, law=law, constants=()) for one in leaflets]
