"""Cost of the repairs of a report: open area, leaflet lengths, forces on annulus and chordae."""

from __future__ import annotations

import html
import math

from mvs import DIASTOLE_PA, MMHG, Cost, definition_of

from .cases import Case
from .markup import cells, heads, table

ROWS = (
    ("open_area", "Open area, mm²", 1e6, 0),
    ("anterior_height", "Anterior leaflet height, mm", 1e3, 1),
    ("posterior_height", "Posterior leaflet height, mm", 1e3, 1),
    ("anterior_length", "Anterior length to coaptation, mm", 1e3, 1),
    ("posterior_length", "Posterior length to coaptation, mm", 1e3, 1),
    ("length_ratio", "Ratio of these lengths", 1.0, 2),
    ("annulus_force_max", "Pull on the annulus, largest, N", 1.0, 2),
    ("annulus_force_sum", "Pull on the annulus, sum, N", 1.0, 1),
    ("chords_over_strain", "Chordae over their strain", 1.0, 0),
    ("chords_over_tension", "Chordae over their tension", 1.0, 0),
)
"""Field of mvs.Cost, heading, scale from SI, digits."""

WORDS = """<p>Every valve closes in a ring that is small enough; these figures say what such a ring
costs. The valve is opened again by {pressure:g} mmHg. Risk of systolic anterior motion: not
determined, because no points of the septum are known; a ratio of lengths of 1.3 or less raises it.
The gradient needs a flow: <code>mvs cost FILE --flow ML/S --septum POINTS</code>.</p>"""


def as_html(cases: list[Case], pressure_pa: float = DIASTOLE_PA) -> str:
    """The chapter: a column for each valve."""
    costs = [case.closed.cost(pressure_pa=pressure_pa) for case in cases]
    rows = [f"<tr>{heads(('', *(html.escape(case.title) for case in cases), 'definition'))}</tr>"]
    for field, heading, scale, digits in ROWS:
        figures = cells(_figure(cost, field, scale, digits) for cost in costs)
        words = html.escape(definition_of(Cost, field))
        rows.append(f'<tr><th>{heading}</th>{figures}<td class="words">{words}</td></tr>')
    return WORDS.format(pressure=pressure_pa / MMHG) + table(rows)


def _figure(cost: Cost, field: str, scale: float, digits: int) -> str:
    value = getattr(cost, field) * scale
    return f"{value:.{digits}f}" if math.isfinite(value) else "not known"
