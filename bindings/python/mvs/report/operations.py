"""Every surgical operation on the shipped valve, closed, as a chapter of the report."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import mvs
from mvs import Simulator, Snapshot

from mvs.drawing.geometry import Drawing
from .cases import strut_chord, verdict
from .markup import figure
from .table import rows_of, valves_html


@dataclass(frozen=True)
class Shown:
    """One operation and the closed valve after it."""

    kind: str
    title: str
    closed: Snapshot
    verdict: str


_CHORDAE = ("chord_length", "chord_remove", "chord_add", "chord_transfer", "neochord", "head_move")
"""Shown from below with the tension of the chordae; other operations are shown from the atrium."""


def _examples(valve: Snapshot) -> dict[str, dict[str, Any]]:
    strut = strut_chord(valve)[1]
    return {
        "chord_length": {"chord": strut, "factor": 0.8},
        "chord_remove": {"chord": strut},
        "chord_add": {"head": "PM1", "site": ("P2", 0.5, 0.8)},
        "chord_transfer": {"chord": strut, "end": "leaflet", "site": ("A2", 0.5, 0.9)},
        "neochord": {"head": "AL1", "site": ("A2", 0.4, 1.0)},
        "head_move": {"head": "PM1", "by": (0.0, 0.0, -0.004), "frame": "valve"},
        "annulus_scale": {"factor": 0.9},
        "ring": {"size": 0.030},
        "band": {"factor": 0.8},
        "clip": {},
        "resect": {"base_width": 0.006},
        "patch": {"site": ("A2", 0.5, 0.5)},
    }


def run(pressure_pa: float = mvs.SYSTOLE_PA) -> Iterator[Shown]:
    """Applies each operation of the library to the open valve, and closes it."""
    with Simulator() as sim:
        sim.generate()
        opened = sim.snapshot()
        for kind, fields in _examples(opened).items():
            if kind not in mvs.ops.KINDS:
                continue
            sim.restore(opened)
            sim.apply(kind, **fields)
            sim.set_load(pressure_pa)
            stats = sim.settle()
            closed = sim.snapshot()
            yield Shown(kind, closed.history[-1].title, closed, verdict(closed, stats))


def picture_of(shown: Shown) -> bytes:
    """The closed valve with its implants, as PNG."""
    from mvs.drawing.pictures import picture, view_from_atrium, view_from_ventricle

    drawing = Drawing(shown.closed)
    if shown.kind in _CHORDAE:
        return picture(drawing, view_from_ventricle(58.0), closed=True, tension=0.8)
    return picture(drawing, view_from_atrium(54.0), closed=True)


_COLUMNS = rows_of((
    "regurgitant_orifice_area", "coaptation_area", "coaptation_height", "annulus_ap",
    "max_chord_strain", "max_chord_tension", "intersections"))


def as_html(shown: list[Shown], pictures: dict[str, bytes]) -> str:
    """The chapter: a table, and a picture of each."""
    table = valves_html("operation", _COLUMNS, "verdict",
                        ((each.title, each.closed.measures, each.verdict) for each in shown))
    figures = "".join(figure(pictures[each.kind], each.title)
                      for each in shown if each.kind in pictures)
    return ("<h2>Every operation</h2>\n<p>Each is applied to the open shipped valve, which is then "
            f"closed. Rings, bands and sutures are blue.</p>\n{table}\n"
            f'<div class="row">{figures}</div>')
