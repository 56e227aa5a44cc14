"""Where the valves of a report leak: a table of scallops and commissures, and the openings."""

from __future__ import annotations

import html
import math
from collections.abc import Iterator, Mapping
from typing import Any

from .cases import Case
from .markup import cells, heads, table

COLUMNS = (
    ("orifice_area", "orifice, mm²", 1e6, 1),
    ("gap", "gap, mm", 1e3, 2),
    ("coaptation_area", "coaptation area, mm²", 1e6, 1),
    ("coaptation_length_mean", "coaptation length, mean, mm", 1e3, 2),
    ("coaptation_length_min", "coaptation length, least, mm", 1e3, 2),
    ("billow_height", "billow height, mm", 1e3, 2),
    ("billow_volume", "billow volume, ml", 1e6, 3),
    ("tenting_height", "tenting height, mm", 1e3, 2),
    ("tenting_volume", "tenting volume, ml", 1e6, 3),
)
"""Field of Snapshot.regions(), heading, scale from SI, digits."""

WORDS = """<p>A scallop counts the coapted tissue, the part of the orifice, billow and tenting that are
nearest to it; the scallops add up to the valve. A commissure is the tissue of both leaflets near it
and overlaps its scallops. Gap: the widest ball that passes. Definitions:
libmvs/measure/DEFINITIONS.md.</p>"""


def as_html(cases: list[Case]) -> str:
    """The chapter: a table for each valve, under a sentence for each opening."""
    return WORDS + "".join(_valve(case) for case in cases)


def _valve(case: Case) -> str:
    rows = [f"<tr>{heads(('region', *(head for _, head, _, _ in COLUMNS)))}</tr>"]
    for region in case.closed.regions():
        figures = cells(f"{region[field] * scale:.{digits}f}" for field, _, scale, digits in COLUMNS)
        rows.append(f"<tr><th>{html.escape(region['name'])}</th>{figures}</tr>")
    items = "".join(f"<li>{html.escape(words)}</li>" for words in openings(case))
    return (f"<h3>{html.escape(case.title)}</h3>\n"
            f"{f'<ul>{items}</ul>' if items else '<p>No opening.</p>'}\n{table(rows)}\n")


def openings(case: Case) -> Iterator[str]:
    """A sentence for each part of the orifice: size, place, direction of the jet."""
    axes = case.closed.frame.axes
    for part in case.closed.orifice_parts():
        jet = axes @ [part["jet_x"], part["jet_y"], part["jet_z"]]
        yield (f"{part['area'] * 1e6:.1f} mm², {part['gap'] * 1e3:.2f} mm wide, {_place(part)}; "
               f"jet {_lean(jet)}")


def _place(part: Mapping[str, Any]) -> str:
    sides = [side for side in (part["anterior"], part["posterior"]) if side]
    place = f"between {sides[0]} and {sides[1]}" if len(sides) == 2 else f"within {''.join(sides)}"
    return f"{place}, at the commissure {part['commissures']}" if part["commissures"] else place


def _lean(jet: Any) -> str:
    """The direction of a jet in the frame of the valve, as degrees from the axis into the atrium."""
    angle = math.degrees(math.acos(max(-1.0, min(1.0, float(jet[2])))))
    side = "the anterior" if jet[0] > 0 else "the posterior"
    return f"into the atrium, {angle:.0f}° from its axis towards {side} side"
