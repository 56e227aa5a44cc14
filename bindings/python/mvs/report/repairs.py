"""The founding paper's study as a chapter: table, cross-sections, distances between the shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mvs import Snapshot
from mvs.study import Stage
from mvs.drawing.geometry import Drawing
from .markup import cells, figure, heads, table
from .table import aligned, rows_of, value, valves_html

Segments = NDArray[np.float64]

COLUMNS = rows_of((
    "regurgitant_orifice_area",
    "coaptation_height",
    "coaptation_length_mean",
    "max_chord_strain",
    "max_chord_tension",
    "annulus_ap",
    "intersections",
))

PAPER_MM = {3: (1.3, 0.5, 1.7)}
"""RMS of valve 3 of the founding paper in cross-section, pairs in the order of `Distances`."""

COLOURS = {"healthy": "#8a8a8a", "diseased": "#b3261e", "repaired": "#1b6f5a"}

SAMPLE_MM = 0.1
"""Distance between samples of a section: a tenth of the sheet's thickness."""


@dataclass(frozen=True)
class Distances:
    """RMS in mm: healthy to diseased, healthy to repaired, repaired to diseased."""

    number: int
    section: tuple[float, float, float]
    surface: tuple[float, float, float]


def triples(stages: Sequence[Stage]) -> list[tuple[Stage, Stage, Stage]]:
    """The healthy, the diseased and the repaired stage of each plan."""
    return [(stages[0], stages[k], stages[k + 1]) for k in range(1, len(stages), 2)]


def distances(stages: Sequence[Stage]) -> list[Distances]:
    """Distances between the shapes of each valve, without registration."""
    found = []
    for healthy, diseased, repaired in triples(stages):
        plane = Drawing(healthy.closed)
        pairs = ((healthy, diseased), (healthy, repaired), (repaired, diseased))
        section = [
            section_rms(central_section(a.closed, plane), central_section(b.closed, plane))
            for a, b in pairs
        ]
        surface = [a.closed.compare(b.closed).surface_rms * 1e3 for a, b in pairs]
        found.append(Distances(diseased.number, _triple(section), _triple(surface)))
    return found


def _triple(values: Sequence[float]) -> tuple[float, float, float]:
    first, second, third = values
    return first, second, third


def central_section(snapshot: Snapshot, plane: Drawing) -> Segments:
    """Section of the sheets by the central AP plane of a drawing: segments (n, 2, 2), in mm."""
    frame = plane.snapshot.frame
    return np.asarray(plane.place(snapshot.section(frame.origin, frame.axes[1]))[..., 1:])


def section_rms(a: Segments, b: Segments) -> float:
    """Symmetric RMS distance of two sections in one plane, weighted by length."""
    squares = np.concatenate([_to_nearest(_samples(a), b), _to_nearest(_samples(b), a)])
    return float(np.sqrt(squares.mean()))


def _samples(segments: Segments) -> Segments:
    points = []
    for start, end in segments:
        count = max(1, int(np.ceil(np.linalg.norm(end - start) / SAMPLE_MM)))
        share = (np.arange(count) + 0.5) / count
        points.append(start + share[:, None] * (end - start))
    return np.concatenate(points)


def _to_nearest(points: Segments, segments: Segments) -> NDArray[np.float64]:
    """Squared distances of points from the nearest segment."""
    start, way = segments[:, 0], segments[:, 1] - segments[:, 0]
    offset = points[:, None] - start
    share = (offset * way).sum(axis=2) / np.maximum((way**2).sum(axis=1), 1e-30)
    gap = offset - np.clip(share, 0, 1)[..., None] * way
    return np.asarray((gap**2).sum(axis=2).min(axis=1))


def as_text(stages: Sequence[Stage]) -> str:
    """Both tables, for a terminal."""
    lines = [["", *(row.head for row in COLUMNS)]]
    for stage in stages:
        measures = stage.closed.measures
        lines.append([stage.title, *(value(row, measures) for row in COLUMNS)])
    return "\n".join([aligned(lines), "", *(_sentence(found) for found in distances(stages))])


def _sentence(found: Distances) -> str:
    section, surface = (" / ".join(f"{rms:.2f}" for rms in each)
                        for each in (found.section, found.surface))
    paper = PAPER_MM.get(found.number)
    words = f"; founding paper {' / '.join(map(str, paper))}" if paper else ""
    return (
        f"Valve {found.number}, RMS in mm, healthy-diseased / healthy-repaired / "
        f"repaired-diseased: section {section}; surface {surface}{words}"
    )


def sections(stages: Sequence[Stage]) -> bytes:
    """Central cross-sections, the three states of each valve superposed, as PNG."""
    from mvs.drawing.pictures import new_figure, to_png

    rows = triples(stages)
    figure = new_figure(5 * len(rows), 3.9)
    axes = figure.subplots(1, len(rows), sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.055, right=0.99, top=0.93, bottom=0.13, wspace=0.05)
    for ax, valve in zip(axes[0], rows):
        _draw_sections(ax, valve)
    axes[0, 0].set_ylabel("height above the annulus plane, mm")
    return bytes(to_png(figure))


def _draw_sections(ax: Any, valve: tuple[Stage, Stage, Stage]) -> None:
    from matplotlib.collections import LineCollection

    plane = Drawing(valve[0].closed)
    for stage in valve:
        cut = central_section(stage.closed, plane)
        ax.add_collection(LineCollection(list(cut), colors=COLOURS[stage.state], linewidths=1.8,
                                         label=_legend(stage)))
    ax.axhline(0, color="#9bb3c6", linewidth=1, linestyle=(0, (6, 4)))
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_xlim(plane.annulus[:, 1].max() + 4, plane.annulus[:, 1].min() - 4)
    ax.set_title(f"Valve {valve[1].number}")
    ax.set_xlabel("anterior  ←  along the AP axis, mm  →  posterior")
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(loc="lower left", frameon=False, fontsize=10)


def _legend(stage: Stage) -> str:
    measures = stage.closed.measures
    if measures.intersections:
        return f"{stage.state}, leaflets cross"
    area = measures.regurgitant_orifice_area * 1e6
    return f"{stage.state}, {area:.1f} mm²" if area > 0 else f"{stage.state}, sealed"


def as_html(stages: Sequence[Stage], png: bytes) -> str:
    """The chapter for the page; `png` is from `sections`, or empty."""
    picture = ""
    if png:
        picture = figure(png, "Central cross-sections: healthy, diseased and repaired, superposed.")
    return (
        "<h2>Three leaking valves and their repair</h2>\n"
        "<p>The study of Tenenholtz et al. (IROS 2011): the same factors on annulus and chordae, "
        "on the parametric valve with a posterior leaflet of 12 mm. The paper does not name the "
        "chordae; they are chosen here by position. Each valve is closed from the one before it."
        f"</p>\n{picture}{_stage_table(stages)}\n{_distance_table(distances(stages))}"
    )


def _stage_table(stages: Sequence[Stage]) -> str:
    return valves_html("valve", COLUMNS, "how it was made",
                       ((stage.title, stage.closed.measures, stage.note) for stage in stages))


def _distance_table(found: list[Distances]) -> str:
    rows = ["<tr>" + heads(("RMS distance, mm", "healthy to diseased", "healthy to repaired",
                            "repaired to diseased")) + "</tr>"]
    for each in found:
        lines = [("central section", each.section), ("surface", each.surface)]
        if each.number in PAPER_MM:
            lines.append(("section, founding paper", PAPER_MM[each.number]))
        for label, figures in lines:
            row = cells(f"{rms:.2f}" for rms in figures)
            rows.append(f"<tr><th>Valve {each.number}, {label}</th>{row}</tr>")
    return table(rows)
