"""How much of the figures is fold: valves closed along several paths, as a chapter of the report."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

import mvs
from mvs import Simulator, Snapshot, Spread, SpreadOrder

from .cases import Case
from .geometry import Drawing
from .table import ROWS, Row, value

THIN = 0.5e-3
"""m: half the thickness of the shipped valve's leaflets; an eighth of their bending stiffness"""


@dataclass(frozen=True)
class Spreading:
    """A valve and what it closes to."""

    key: str
    title: str
    spread: Spread


def _thin() -> Snapshot:
    with Simulator() as sim:
        sim.generate(thickness=THIN)
        return sim.snapshot()


def run(cases: list[Case], paths: int, pressure_pa: float) -> Iterator[Spreading]:
    """The valves of the report, each under its pressure there, and one more under ``pressure_pa``.

    That is the shipped valve with thinner leaflets, which fold more.
    """
    for case in cases:
        own = case.closed.load_case.pressure
        yield Spreading(case.key, case.title, case.opened.spread(own, paths=paths))
    title = f"Shipped valve, leaflets {THIN * 1e3:g} mm thick"
    yield Spreading("thin", title, _thin().spread(pressure_pa, paths=paths))


def verdict(each: Spreading) -> str:
    """Paths at rest and how far their shapes are apart, in a sentence."""
    all_paths = each.spread.summary
    lost = [str(k) for k, path in enumerate(each.spread.paths) if not path.converged]
    named = f" (not at rest: path {', '.join(lost)})" if lost else ""
    shapes = "equilibrium" if all_paths.equilibria == 1 else "equilibria"
    return (
        f"{all_paths.converged} of {all_paths.paths} paths at rest{named}, {all_paths.equilibria} "
        f"{shapes}; nodes apart by {all_paths.node_rms * 1e3:.3f} mm RMS, "
        f"{all_paths.node_max * 1e3:.2f} mm at most"
    )


def picture_of(each: Spreading, width_mm: float) -> bytes:
    """The closed valve of path 0, coloured by how far its nodes spread, as PNG."""
    from .maps import spread_map

    return spread_map(Drawing(each.spread.snapshot(0)), each.spread.node_spread * 1e3, width_mm)


def _cells(row: Row, spread: Spread) -> list[str]:
    """Value of the plain closure, and the range over the paths with the deviation."""
    figures = [value(row, m) for m in (spread.min, spread.max, spread.deviation)]
    return [value(row, spread.snapshot(0).measures), f"{figures[0]} to {figures[1]}", figures[2]]


def as_text(spreadings: list[Spreading]) -> str:
    """For a terminal: a sentence a valve, and the figures that a surgeon reads first."""
    lines = []
    for each in spreadings:
        lines.append(f"{each.title}: {verdict(each)}")
        for row in ROWS[:2]:
            plain, over, deviation = _cells(row, each.spread)
            lines.append(f"  {row.label}, {row.unit}: {plain} ({over}; deviation {deviation})")
    return "\n".join(lines)


def as_html(spreadings: list[Spreading], pictures: dict[str, bytes]) -> str:
    """The chapter: what it is, a picture and the paths of each valve, and a table of all figures."""
    figures = "".join(_figure(each, pictures[each.key]) for each in spreadings
                      if each.key in pictures)
    return (
        "<h2>How much of it is fold</h2>\n<p>Slack tissue can fold in several ways, all of them at "
        "rest. Each valve is closed along several paths: the pressure in 1 to 8 increments or in "
        "time, with inertia, the annulus moved before, with or after it, from starts moved by up to 0.5 mm. Path 0 is the "
        "plain closure, whose figures stand everywhere else on this page; beside them here the "
        "least and the most over the paths at rest, and the standard deviation. It is the spread "
        "over these paths, not the error of the model (libmvs/ensemble/README.md).</p>\n"
        f'<div class="row">{figures}</div>\n{_table(spreadings)}\n'
        + "".join(_paths(each) for each in spreadings)
    )


def _table(spreadings: list[Spreading]) -> str:
    head = "".join(f"<th colspan=3>{html.escape(each.title)}</th>" for each in spreadings)
    names = "<th>path 0</th><th>all paths</th><th>deviation</th>" * len(spreadings)
    rows = [f"<tr><th></th>{head}<th>unit</th></tr>", f"<tr><th></th>{names}<th></th></tr>"]
    for row in ROWS:
        cells = "".join(f"<td>{text}</td>" for each in spreadings
                        for text in _cells(row, each.spread))
        rows.append(f"<tr><th>{row.label}</th>{cells}<td>{row.unit}</td></tr>")
    return "<table>\n" + "\n".join(rows) + "\n</table>"


_ORDERS = {SpreadOrder.TOGETHER: "with the pressure", SpreadOrder.BOUNDARY_FIRST: "before it",
           SpreadOrder.PRESSURE_FIRST: "after it"}


def _paths(each: Spreading) -> str:
    rows = ["<tr><th>path</th><th>increments</th><th>annulus moves</th><th>start moved, mm</th>"
            "<th>iterations</th><th>equilibrium</th><th>energy, mJ</th>"
            "<th>nodes from path 0, RMS / largest, mm</th></tr>"]
    for k, path in enumerate(each.spread.paths):
        shape = "not at rest" if path.equilibrium is None else str(path.equilibrium)
        came = f"in {path.ramp * 1e3:.0f} ms" if path.ramp else str(path.increments)
        rows.append(
            f"<tr><th>{k}</th><td>{came}</td><td>{_ORDERS[path.order]}</td>"
            f"<td>{path.perturbation * 1e3:.2f}</td><td>{path.stats.iterations}</td>"
            f"<td>{shape}</td><td>{path.stats.energy * 1e3:.3f}</td>"
            f"<td>{path.node_rms * 1e3:.3f} / {path.node_max * 1e3:.2f}</td></tr>"
        )
    return (f"<h3>{html.escape(each.title)}</h3>\n<p>{html.escape(verdict(each))}.</p>\n<table>\n"
            + "\n".join(rows) + "\n</table>\n")


def _figure(each: Spreading, png: bytes) -> str:
    data = base64.b64encode(png).decode()
    most = float(np.max(each.spread.node_spread)) * 1e3
    words = html.escape(f"{each.title}: largest spread of a node {most:.2f} mm", quote=True)
    return (f'<figure><img alt="{words}" src="data:image/png;base64,{data}">'
            f"<figcaption>{words}</figcaption></figure>\n")
