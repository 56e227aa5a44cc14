"""Ensembles of closures of each valve, as a chapter of the report."""

from __future__ import annotations

import html
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

import mvs
from mvs import Ensemble, EnsembleOrder, Simulator, Snapshot

from mvs.drawing.geometry import Drawing
from .cases import Case
from .markup import cells, figure, heads, table
from .table import ROWS, Row, value

THIN = 0.5e-3
"""m: half the thickness of the founding valve's leaflets; an eighth of their bending stiffness"""


@dataclass(frozen=True)
class Run:
    """A valve and the ensemble of its closures."""

    key: str
    title: str
    ensemble: Ensemble


def _thin() -> Snapshot:
    with Simulator() as sim:
        sim.generate(shape="founding", thickness=THIN)
        return sim.snapshot()


def run(cases: list[Case], members: int, pressure_pa: float) -> Iterator[Run]:
    """The valves of the report under their own pressures, then one more under ``pressure_pa``: the
    founding valve with thinner leaflets, which fold more."""
    for case in cases:
        own = case.closed.load_case.pressure
        yield Run(case.key, case.title, case.opened.ensemble(own, members=members))
    title = f"Founding valve, leaflets {THIN * 1e3:g} mm thick"
    yield Run("thin", title, _thin().ensemble(pressure_pa, members=members))


def verdict(each: Run) -> str:
    """The number of members at rest and the distances between their shapes, in a sentence."""
    summary = each.ensemble.summary
    lost = [str(k) for k, member in enumerate(each.ensemble.members) if not member.converged]
    named = f" (not at rest: member {', '.join(lost)})" if lost else ""
    shapes = "equilibrium" if summary.equilibria == 1 else "equilibria"
    return (
        f"{summary.converged} of {summary.members} members at rest{named}, {summary.equilibria} "
        f"{shapes}; nodes apart by {summary.node_rms * 1e3:.3f} mm RMS, "
        f"{summary.node_max * 1e3:.2f} mm at most"
    )


def picture_of(each: Run, width_mm: float) -> bytes:
    """The closed valve of member 0, coloured by the deviation of its nodes, as PNG."""
    from mvs.drawing.maps import deviation_map

    deviation = each.ensemble.node_deviation * 1e3
    return deviation_map(Drawing(each.ensemble.snapshot(0)), deviation, width_mm)


def _cells(row: Row, ensemble: Ensemble) -> list[str]:
    """The value of member 0, the range over the members, and the deviation."""
    figures = [value(row, m) for m in (ensemble.min, ensemble.max, ensemble.deviation)]
    return [value(row, ensemble.snapshot(0).measures), f"{figures[0]} to {figures[1]}", figures[2]]


def as_text(runs: list[Run]) -> str:
    """For a terminal: one sentence per valve, and its first two measures."""
    lines = []
    for each in runs:
        lines.append(f"{each.title}: {verdict(each)}")
        for row in ROWS[:2]:
            plain, over, deviation = _cells(row, each.ensemble)
            lines.append(f"  {row.label}, {row.unit}: {plain} ({over}; deviation {deviation})")
    return "\n".join(lines)


def as_html(runs: list[Run], pictures: dict[str, bytes]) -> str:
    """The chapter: a picture and the members of each valve, and a table of all measures."""
    figures = "".join(_figure(each, pictures[each.key]) for each in runs
                      if each.key in pictures)
    return (
        "<h2>Several closures of each valve</h2>\n<p>Slack tissue can fold in several ways, each "
        "an equilibrium. Each valve is closed several times: the pressure in 1 to 8 increments or "
        "as a dynamic ramp, the annulus moved before, with or after it, from starts perturbed by up "
        "to 0.5 mm. Member 0 is the plain closure, whose figures stand everywhere else on this "
        "page; beside them stand the minimum and the maximum over the members at rest, and the "
        "standard deviation. The range over these members is not the error of the model "
        "(libmvs/ensemble/README.md).</p>\n"
        f'<div class="row">{figures}</div>\n{_table(runs)}\n'
        + "".join(_members(each) for each in runs)
    )


def _table(runs: list[Run]) -> str:
    titles = "".join(f"<th colspan=3>{html.escape(each.title)}</th>" for each in runs)
    names = heads(("member 0", "all members", "deviation")) * len(runs)
    rows = [f"<tr><th></th>{titles}<th>unit</th></tr>", f"<tr><th></th>{names}<th></th></tr>"]
    for row in ROWS:
        figures = cells(text for each in runs for text in _cells(row, each.ensemble))
        rows.append(f"<tr><th>{row.label}</th>{figures}<td>{row.unit}</td></tr>")
    return table(rows)


_ORDERS = {EnsembleOrder.TOGETHER: "with the pressure", EnsembleOrder.BOUNDARY_FIRST: "before it",
           EnsembleOrder.PRESSURE_FIRST: "after it"}


def _members(each: Run) -> str:
    rows = ["<tr>" + heads(("member", "increments", "annulus moves", "start moved, mm",
                            "iterations", "equilibrium", "energy, mJ",
                            "nodes from member 0, RMS / largest, mm")) + "</tr>"]
    for k, member in enumerate(each.ensemble.members):
        figures = cells((
            f"in {member.ramp * 1e3:.0f} ms" if member.ramp else member.increments,
            _ORDERS[member.order],
            f"{member.perturbation * 1e3:.2f}",
            member.stats.iterations,
            "not at rest" if member.equilibrium is None else member.equilibrium,
            f"{member.stats.energy * 1e3:.3f}",
            f"{member.node_rms * 1e3:.3f} / {member.node_max * 1e3:.2f}",
        ))
        rows.append(f"<tr><th>{k}</th>{figures}</tr>")
    return (f"<h3>{html.escape(each.title)}</h3>\n<p>{html.escape(verdict(each))}.</p>\n"
            f"{table(rows)}\n")


def _figure(each: Run, png: bytes) -> str:
    most = float(np.max(each.ensemble.node_deviation)) * 1e3
    return figure(png, f"{each.title}: largest deviation of a node {most:.2f} mm")
