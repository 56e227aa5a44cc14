"""What makes each valve leak and what repairs it, as data."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from .anatomy import Site


@dataclass(frozen=True)
class Disease:
    """What makes a healthy valve leak: factors on the loaded annulus and on one chord."""

    annulus: float
    chord: float
    site: Site
    """of the chord"""


class Treatment(Enum):
    """What the surgeon does with the diseased chord."""

    LEAVE = "left as it is"
    RESTORE = "given its length back"
    REPLACE = "removed, and a new one tied to each vertex that it held"


@dataclass(frozen=True)
class Repair:
    """What the surgeon does. `annulus` is a share of the healthy one; `add` are new chordae."""

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
    """In the rough zone, one from each papillary muscle."""
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
"""For the parametric valve: an anterior strut, and the rough-zone chord next to the middle of A2."""


def _moved(plan: Plan, site: Site) -> Plan:
    return replace(plan, disease=replace(plan.disease, site=site))


KAISER = (
    PARAMETRIC[0],
    _moved(PARAMETRIC[1], Site("P", 0.7, 1.0)),
    _moved(PARAMETRIC[2], Site("P", 0.5, 1.0)),
)
"""For the valve of Kaiser et al.: its anterior leaflet hangs on two trees of chordae that hold half
of it each, and reaches so far behind the posterior one that no shorter tree of them opens it. The
chordae next to the anterolateral commissure, of the posterior leaflet, do."""
