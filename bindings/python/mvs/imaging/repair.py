"""A plan of operations on a valve from images: the repaired valve under load, beside the one before."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Union

import mvs
from mvs.report.markup import cells, figure, heads, table
from mvs.report.table import rows_of, value
from .needs import need

MEASURES = ("regurgitant_orifice_area", "coaptation_area", "coaptation_length_mean",
            "coaptation_height", "annulus_ap", "max_chord_tension", "intersections")


@dataclasses.dataclass(frozen=True, eq=False)
class Repair:
    """A repaired valve: closed under load, whether it is at rest, and the number of operations."""

    closed: mvs.Snapshot
    converged: bool
    operations: int


def repaired(opened: mvs.Snapshot, plan: Union[str, "os.PathLike[str]"],
             pressure: float = mvs.SYSTOLE_PA) -> Repair:
    """Replays a plan (its parts by name) on an open valve and closes it."""
    with mvs.Simulator(log=lambda *_: None) as sim:
        sim.set_valve(mvs.valve_of(opened))
        done = sim.replay_plan(plan)
        sim.set_load(pressure)
        stats = sim.settle()
        return Repair(sim.snapshot(), stats.converged, done.operations)


def chapter(before: mvs.Snapshot, repair: Repair) -> str:
    """Pictures of the closed valve before and after, and their measures, as HTML."""
    drawing = need("mvs.drawing.geometry").Drawing
    rows = [heads(["", "as in the image", "repaired"])]
    rows += [cells([row.head, value(row, before.measures), value(row, repair.closed.measures)])
             for row in rows_of(MEASURES)]
    rest = "at rest" if repair.converged else "NOT at rest"
    pictures = "".join(
        _picture(drawing(snapshot), view, words)
        for view, place in (("view_from_atrium", "the atrium"), ("view_from_ventricle", "the ventricle"))
        for snapshot, words in ((before, f"As in the image, closed, from {place}"),
                                (repair.closed, f"Repaired, closed, from {place}")))
    return (f"<h2>The repaired valve</h2><p>{repair.operations} operations; closed under 120 mmHg, "
            f'{rest}.</p><div class="row">{pictures}</div>'
            + table(f"<tr>{row}</tr>" for row in rows))


def _picture(drawn: Any, view: str, words: str) -> str:
    pictures = need("mvs.drawing.pictures")
    wide = max(abs(float(drawn.annulus[:, 0].max())), abs(float(drawn.annulus[:, 0].min()))) * 2 + 14
    return figure(pictures.picture(drawn, getattr(pictures, view)(wide), closed=True), words)
