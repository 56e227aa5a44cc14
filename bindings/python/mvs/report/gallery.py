"""The pictures of a report, and the scales that its valves share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np

import mvs

from mvs.drawing.geometry import Drawing
from mvs.drawing.maps import coaptation_map, section_plot, strain_map
from mvs.drawing.pictures import picture, view_from_atrium, view_from_ventricle, view_oblique
from .cases import Case


@dataclass(frozen=True)
class Picture:
    """One picture of one valve."""

    name: str
    case: str
    png: bytes


@dataclass(frozen=True)
class Scales:
    """Sizes and colour scales that all valves of a report share, for comparison."""

    atrium_mm: float
    oblique_mm: float
    tension_n: float
    strain_percent: float


CAPTIONS = {
    "open-atrium": "Open, from the atrium: the surgeon's view, anterior leaflet up, P2 down.",
    "open-oblique": "Open, from the posterior side and above, with chordae and papillary muscles.",
    "closed-atrium": "Closed under systolic pressure, from the atrium; an orifice is red.",
    "closed-chordae": "Closed, from the posterior side and below: tension of the chordae.",
    "coaptation": "Coaptation: distance of each leaflet from the facing one. Below, the leaflets "
    "cut at a commissure and unrolled.",
    "influence": "What a chord does: change of the coaptation area for a rest length 1 mm longer, and "
    "the names of the chordae that matter most. Derivatives hold near this shape only.",
    "strain": "Largest principal strain of the leaflets, from the atrium and unrolled.",
    "section": "Central anteroposterior cross-section: open, and closed with each sheet drawn as "
    "thick as the contact thickness.",
}


def common_scales(cases: list[Case]) -> Scales:
    """Rounded scales that fit every valve of the report."""
    widths, strains, tensions = [], [], []
    for case in cases:
        for snapshot in (case.opened, case.closed):
            widths.append(float(np.ptp(Drawing(snapshot).annulus[:, 0])))
        strains.append(float(np.percentile(case.closed.triangle_stretch[:, 0], 99) - 1) * 100)
        tensions.append(float(np.percentile(case.closed.chord_tension, 98)))
    wide = max(widths)
    return Scales(wide + 14, wide + 24, _round_up(max(tensions), 0.2), _round_up(max(strains), 5))


def _round_up(number: float, step: float) -> float:
    return max(1, int(np.ceil(number / step - 1e-9))) * step


def pictures_of(case: Case, scales: Scales) -> list[Picture]:
    """All pictures of a valve, in the order of CAPTIONS."""
    opened, closed = Drawing(case.opened), Drawing(case.closed)
    atrium = view_from_atrium(scales.atrium_mm)
    made = {
        "open-atrium": picture(opened, atrium, closed=False),
        "open-oblique": picture(opened, view_oblique(scales.oblique_mm), closed=False),
        "closed-atrium": picture(closed, atrium, closed=True),
        "closed-chordae": picture(
            closed, view_from_ventricle(scales.oblique_mm), closed=True, tension=scales.tension_n
        ),
        "coaptation": coaptation_map(closed, scales.atrium_mm),
        "strain": strain_map(closed, scales.atrium_mm, scales.strain_percent),
        "section": section_plot(opened, closed),
    }
    influence = _influence(case)
    if influence is not None:
        made["influence"] = influence
    return [Picture(name, case.key, made[name]) for name in CAPTIONS if name in made]


def _influence(case: Case) -> Optional[bytes]:
    """Chordae coloured by their influence; None for a valve that has no derivatives: not at rest, without
    chordae, or about to snap."""
    try:
        found = case.closed.sensitivity("coaptation", "chords")
    except (mvs.StateError, mvs.DivergedError, mvs.ArgumentError):
        return None
    return found.plot("coaptation").png
