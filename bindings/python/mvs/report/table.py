"""The measures of a report in clinical units, as text and as HTML."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from mvs import MMHG, Measures, definition_of
from .cases import Case
from .markup import cells, heads, table


@dataclass(frozen=True)
class Row:
    """One row: a field of Measures in a clinical unit."""

    label: str
    field: str
    unit: str
    scale: float
    digits: int
    literature: str = ""

    @property
    def head(self) -> str:
        """The heading of the row: label and unit."""
        return f"{self.label}, {self.unit}" if self.unit else self.label


ROWS = (
    Row("Regurgitant orifice area", "regurgitant_orifice_area", "mm²", 1e6, 1,
        "graded by EROA: 20 / 30 / 40 mm²"),
    Row("Coaptation area", "coaptation_area", "mm²", 1e6, 1),
    Row("Coaptation length, mean", "coaptation_length_mean", "mm", 1e3, 2),
    Row("Coaptation length, least", "coaptation_length_min", "mm", 1e3, 2),
    Row("Coaptation length, largest", "coaptation_length_max", "mm", 1e3, 2,
        "surgical target 8 mm or more"),
    Row("Coaptation height", "coaptation_height", "mm", 1e3, 2),
    Row("Coaptation depth", "coaptation_depth", "mm", 1e3, 2, "5.0 ± 0.7 mm"),
    Row("Tenting height", "tenting_height", "mm", 1e3, 2),
    Row("Tenting area", "tenting_area", "mm²", 1e6, 1),
    Row("Tenting volume", "tenting_volume", "ml", 1e6, 3),
    Row("Billow height", "billow_height", "mm", 1e3, 2, "above 2 mm: prolapse"),
    Row("Billow volume", "billow_volume", "ml", 1e6, 3),
    Row("Annulus, AP diameter", "annulus_ap", "mm", 1e3, 1, "24 to 29 mm"),
    Row("Annulus, CC diameter", "annulus_cc", "mm", 1e3, 1, "35 to 39 mm"),
    Row("Annulus, perimeter", "annulus_perimeter", "mm", 1e3, 1),
    Row("Annulus, area in space", "annulus_area_3d", "cm²", 1e4, 2),
    Row("Annulus, projected area", "annulus_area", "cm²", 1e4, 2, "7.7 to 9.8 cm²"),
    Row("Annulus, saddle height", "annulus_saddle_height", "mm", 1e3, 1, "5.9 to 6.8 mm"),
    Row("Annulus, nonplanar angle", "annulus_nonplanar_angle", "°", 180 / np.pi, 1),
    Row("Chordal strain, largest", "max_chord_strain", "%", 100, 2, "working strain 4.3 ± 3.4 %"),
    Row("Chordal tension, largest", "max_chord_tension", "N", 1, 3,
        "strut about 1 N, others 0.1 to 0.4 N"),
    Row("Chordae over their working strain", "chords_over_strain", "", 1, 0, "none"),
    Row("Chordae over their working tension", "chords_over_tension", "", 1, 0, "none"),
    Row("Leaflet strain, largest", "max_leaflet_strain", "%", 100, 1),
    Row("Leaflet strain, 99 % of the tissue", "leaflet_strain_p99", "%", 100, 1),
    Row("Leaflet strain, 95 % of the tissue", "leaflet_strain_p95", "%", 100, 1),
    Row("Leaflet strain, 50 % of the tissue", "leaflet_strain_p50", "%", 100, 1),
    Row("Leaflet stress, largest", "max_leaflet_stress", "kPa", 1e-3, 0),
    Row("Leaflet stress, 99 % of the tissue", "leaflet_stress_p99", "kPa", 1e-3, 0),
    Row("Leaflet stress, 95 % of the tissue", "leaflet_stress_p95", "kPa", 1e-3, 0),
    Row("Leaflet stress, 50 % of the tissue", "leaflet_stress_p50", "kPa", 1e-3, 0),
    Row("Leaflet area, closed", "leaflet_area", "cm²", 1e4, 2),
    Row("Crossing triangle pairs", "intersections", "", 1, 0),
)


def value(row: Row, measures: Measures) -> str:
    """The printed value of a row, without its unit."""
    return f"{getattr(measures, row.field) * row.scale:.{row.digits}f}"


def rows_of(fields: Iterable[str]) -> tuple[Row, ...]:
    """The rows of the given fields of Measures, in their order."""
    return tuple(row for field in fields for row in ROWS if row.field == field)


def aligned(lines: Sequence[Sequence[str]]) -> str:
    """Lines of cells as text: first column left-aligned, others right-aligned."""
    widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
    return "\n".join(
        line[0].ljust(widths[0])
        + "".join("  " + text.rjust(width) for text, width in zip(line[1:], widths[1:]))
        for line in lines
    )


def valves_html(first: str, figures: Sequence[Row], last: str,
                valves: Iterable[tuple[str, Measures, str]]) -> str:
    """A table with one line per valve: title, measures, remark.

    `first` and `last` are the headings of the first and the last column.
    """
    lines = [f"<tr>{heads((first, *(row.head for row in figures), last))}</tr>"]
    for title, measures, words in valves:
        lines.append(f"<tr><th>{html.escape(title)}</th>"
                     f"{cells(value(row, measures) for row in figures)}"
                     f"<td class=words>{html.escape(words)}</td></tr>")
    return table(lines)


def solution(case: Case) -> list[tuple[str, str]]:
    """Labels and texts that describe a closure."""
    stats, closed = case.stats, case.closed
    leaflet = np.unique(closed.triangle_nodes)
    return [
        ("Verdict", case.verdict),
        ("Pressure", f"{closed.load_case.pressure / MMHG:.0f} mmHg"),
        ("Leaflet vertices", f"{len(leaflet)}"),
        ("Triangles", f"{len(closed.triangle_nodes)}"),
        ("Chord segments", f"{len(closed.chord_nodes)}"),
        ("Converged", "yes" if stats.converged else "no"),
        ("Iterations", f"{stats.iterations}"),
        ("Largest out-of-balance force", f"{stats.residual:.1e} N"),
        ("Time to close", f"{stats.wall_s:.3f} s"),
    ]


def as_text(cases: list[Case]) -> str:
    """The table, for a terminal."""
    lines = [["", *(case.title for case in cases)]]
    for k, (label, _) in enumerate(solution(cases[0])):
        lines.append([label, *(solution(case)[k][1] for case in cases)])
    for row in ROWS:
        lines.append([row.head, *(value(row, case.closed.measures) for case in cases)])
    return aligned(lines)


def as_html(cases: list[Case]) -> str:
    """The table for the page, with definitions and figures of the literature."""
    titles = (html.escape(case.title) for case in cases)
    rows = [f"<tr>{heads(('', *titles, 'unit', 'definition', 'literature'))}</tr>"]
    for k, (label, _) in enumerate(solution(cases[0])):
        figures = cells(html.escape(solution(case)[k][1]) for case in cases)
        rows.append(f"<tr><th>{label}</th>{figures}<td></td><td></td><td></td></tr>")
    for row in ROWS:
        figures = cells(value(row, case.closed.measures) for case in cases)
        meaning = html.escape(definition_of(Measures, row.field))
        rows.append(
            f"<tr><th>{row.label}</th>{figures}<td>{row.unit}</td>"
            f"<td class=words>{meaning}</td><td class=words>{row.literature}</td></tr>"
        )
    return table(rows)
