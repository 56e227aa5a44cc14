"""The diseases of the study and their repairs, as data."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from .anatomy import Site


@dataclass(frozen=True)
class Disease:
    """A disease: factors on the loaded annulus and on the length of one chord."""

    annulus: float
    chord: float
    site: Site
    """position of the chord"""


class Treatment(Enum):
    """Treatment of the diseased chord."""

    LEAVE = "left as it is"
    RESTORE = "restored to its length"
    REPLACE = "removed, and a new one tied to each of its vertices"


@dataclass(frozen=True)
class Repair:
    """A repair: `annulus`, size over the healthy one; `add`, sites of new chordae."""

    annulus: float
    treatment: Treatment
    add: tuple[Site, ...] = ()


@dataclass(frozen=True)
class Plan:
    """One valve of the study."""

    number: int
    disease: Disease
    repair: Repair


def _beside_the_middle(leaflet: str) -> tuple[Site, Site]:
    """Two sites in the rough zone, one for each papillary muscle."""
    return Site(leaflet, 0.15, 0.75), Site(leaflet, -0.15, 0.75)


_STRUT = Site("A", 0.2, 0.4)
_A2_ROUGH_ZONE = Site("A", 0.05, 0.75)

PARAMETRIC = (
    Plan(1, Disease(1.15, 1.25, _STRUT),
         Repair(0.97, Treatment.LEAVE, _beside_the_middle("A"))),
    Plan(2, Disease(1.0, 0.70, _A2_ROUGH_ZONE), Repair(0.95, Treatment.REPLACE)),
    Plan(3, Disease(1.10, 0.67, _A2_ROUGH_ZONE),
         Repair(0.99, Treatment.RESTORE, _beside_the_middle("P"))),
)
"""For the parametric valve: an anterior strut chord, and the rough-zone chord nearest to A2's middle."""


def _moved(plan: Plan, site: Site) -> Plan:
    return replace(plan, disease=replace(plan.disease, site=site))


KAISER = (
    PARAMETRIC[0],
    _moved(PARAMETRIC[1], Site("P", 0.7, 1.0)),
    _moved(PARAMETRIC[2], Site("P", 0.5, 1.0)),
)
"""For the valve of Kaiser et al.: two trees of chordae hold half of its anterior leaflet each, and
it overlaps the posterior leaflet so far that no shorter tree opens the valve. The posterior chordae
next to the anterolateral commissure do."""
