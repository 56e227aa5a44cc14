"""Colour maps of the leaflets, from the atrium and unrolled, and the central cross-section."""

from __future__ import annotations

from typing import Any

import matplotlib
import matplotlib.tri
import numpy as np
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from mvs import PartKind
from .geometry import Drawing, Points, Unrolled, unroll
from .pictures import (
    INK,
    STYLE,
    colour_bar,
    label_scallops,
    label_sides,
    new_figure,
    place_image,
    scale_bar,
    to_png,
    view_from_atrium,
)
from .scene import ORIFICE, Colours, Scene

GAP_LIMIT = 3.0
"""mm: upper end of the colour scale of gaps"""

FAR = "#e4e4e4"


def coaptation_map(drawing: Drawing, width: float) -> bytes:
    """The gap to the facing leaflet in mm, with the outline of the coapted zone."""
    gap = drawing.snapshot.node_coaptation * 1e3
    gap = np.where(np.isfinite(gap), gap, 1.5 * GAP_LIMIT)
    shades = matplotlib.colormaps["viridis"].with_extremes(over=FAR)
    colours = Colours(gap, 0.0, GAP_LIMIT, shades, above=FAR)
    text = "gap to the facing leaflet, mm (grey: nothing within 3 mm; black line: coapted zone)"
    return _map(drawing, colours, text, width, extend="max", outline=True)


def strain_map(drawing: Drawing, width: float, high: float) -> bytes:
    """The largest principal strain of the leaflets, in percent."""
    strain = (drawing.snapshot.triangle_stretch[:, 0] - 1) * 100
    colours = Colours(drawing.to_nodes(strain), 0.0, high, matplotlib.colormaps["plasma"])
    return _map(drawing, colours, "largest principal strain, %", width, faces=strain)


DEVIATION_LIMIT = 0.5
"""mm: upper end of the colour scale of the deviation"""


def deviation_map(drawing: Drawing, deviation: NDArray[np.float64], width: float) -> bytes:
    """RMS distance of each node from its mean position over an ensemble, in mm."""
    shades = matplotlib.colormaps["YlOrRd"].with_extremes(over="#3d0014")
    colours = Colours(deviation, 0.0, DEVIATION_LIMIT, shades, above="#3d0014")
    text = "RMS distance of a node from its mean position over the members, mm"
    return _map(drawing, colours, text, width, extend="max")


@matplotlib.rc_context(STYLE)
def _map(
    drawing: Drawing,
    colours: Colours,
    text: str,
    width: float,
    *,
    extend: str = "neither",
    outline: bool = False,
    faces: Any = None,
) -> bytes:
    scene = Scene(drawing)
    scene.add_leaflets(colours)
    scene.add_annulus()
    scene.add_wall()
    scene.add_orifice()
    view = view_from_atrium(width)
    image = scene.render(view)

    figure = new_figure(8, 9.7)
    top = figure.add_axes((0, 0.34, 1, 0.66))
    place_image(top, image, view)
    label_sides(top, drawing, view)
    label_scallops(top, drawing, view)
    scale_bar(top)
    flat = figure.add_axes((0.09, 0.135, 0.88, 0.22))
    _draw_flat(flat, drawing, unroll(drawing), colours, outline, faces)
    bar = figure.add_axes((0.2, 0.06, 0.6, 0.016))
    colour_bar(figure, bar, colours, text, extend)
    return to_png(figure)


def _draw_flat(
    ax: Any, drawing: Drawing, flat: Unrolled, colours: Colours, outline: bool, faces: Any
) -> None:
    grid = matplotlib.tri.Triangulation(flat.across, flat.down, flat.triangles)
    style = {"cmap": colours.map, "vmin": colours.low, "vmax": colours.high}
    if faces is not None:
        ax.tripcolor(grid, facecolors=faces[flat.rows], **style)
    else:
        levels = np.linspace(colours.low, colours.high, 31)
        ax.tricontourf(grid, colours.values, levels=levels, extend="max", cmap=colours.map)
    if outline:
        share = drawing.to_nodes(drawing.snapshot.triangle_coapted)
        if share.max() > 0.5 > share.min():
            ax.tricontour(grid, share, levels=[0.5], colors=INK, linewidths=1.4)
    _draw_borders(ax, drawing, flat)
    ax.set_aspect("equal")
    ax.set_xlim(0, flat.width)
    ax.set_ylim(flat.down.max() + 0.5, -3)
    ax.set_xlabel("along the annulus, mm (cut at the left commissure)")
    ax.set_ylabel("from the annulus, mm")
    ax.spines[["top", "right"]].set_visible(False)


def _draw_borders(ax: Any, drawing: Drawing, flat: Unrolled) -> None:
    """Draws lines between scallops, and their names above the annulus."""
    scallop = drawing.snapshot.triangle_scallop[flat.rows]
    points = np.column_stack([flat.across, flat.down])
    owner: dict[tuple[int, int], int] = {}
    lines = []
    for row, triangle in enumerate(flat.triangles.tolist()):
        for k in range(3):
            side = (min(triangle[k], triangle[k - 1]), max(triangle[k], triangle[k - 1]))
            other = owner.setdefault(side, row)
            if scallop[other] != scallop[row]:
                lines.append(points[list(side)])
    ax.add_collection(LineCollection(lines, colors="white", linewidths=1.6))
    for index, name in enumerate(drawing.names(PartKind.SCALLOP)):
        mine = flat.triangles[scallop == index]
        if len(mine):
            ax.text(points[mine, 0].mean(), -1.5, name, ha="center", va="center",
                    fontsize=12, fontweight="bold")


@matplotlib.rc_context(STYLE)
def section_plot(other: Drawing, closed: Drawing, name: str = "open") -> bytes:
    """The central anteroposterior cross-section of a closed valve, its sheets as thick as the
    contact thickness, and that of another shape of the valve as a line."""
    figure = new_figure(8, 6.4)
    ax = figure.subplots()
    figure.subplots_adjust(left=0.09, right=0.98, top=0.97, bottom=0.1)
    _draw_chords(ax, closed)
    other_cut, _ = _cut(other, closed)
    closed_cut, leaflet = _cut(closed, closed)
    ax.add_collection(LineCollection(list(other_cut), colors="#8a8a8a", linewidths=1.3,
                                     label=name))
    ring = closed.annulus
    ax.axhline(0, color="#9bb3c6", linewidth=1, linestyle=(0, (6, 4)))
    ax.set_aspect("equal")
    ax.set_xlim(ring[:, 1].max() + 6, ring[:, 1].min() - 6)
    depth = min(closed.nodes[:, 2].min(), -20.0)
    ax.set_ylim(depth - 2, 9)
    figure.canvas.draw()
    points_per_mm = 72 * _inches_per_mm(figure, ax)
    for which, colour, leaflet_name in ((0, "#c8553d", "anterior"), (1, "#3d6fa3", "posterior")):
        mine = leaflet == which if which == 0 else leaflet > 0
        ax.add_collection(LineCollection(
            list(closed_cut[mine]), colors=colour, capstyle="round", alpha=0.9,
            linewidths=closed.contact_thickness * points_per_mm,
            label=f"closed, {leaflet_name} leaflet"))
    _finish_section(ax, closed)
    return to_png(figure)


def _inches_per_mm(figure: Any, ax: Any) -> float:
    box = ax.get_window_extent()
    low, high = sorted(ax.get_xlim())
    return float(box.width / figure.dpi / (high - low))


def _cut(drawing: Drawing, plane: Drawing) -> tuple[Points, NDArray[np.int64]]:
    """Segments of the sheets in the plane X = 0 of a drawing, in (Y, Z), and the leaflet of each,
    which Snapshot.section does not return."""
    corners = plane.place(drawing.snapshot.node_position)[drawing.triangles]
    following = np.roll(corners, -1, axis=1)
    x, x_next = corners[:, :, 0], following[:, :, 0]
    crosses = (x >= 0) != (x_next >= 0)
    share = x / np.where(crosses, x - x_next, 1)
    points = corners + share[:, :, None] * (following - corners)
    leaflet = drawing.snapshot.triangle_leaflet[crosses.any(axis=1)]
    return points[crosses].reshape(-1, 2, 3)[:, :, 1:], leaflet.astype(np.int64)


def _draw_chords(ax: Any, drawing: Drawing) -> None:
    """Draws chordae and the tips of the heads, projected on the plane."""
    ends = drawing.nodes[drawing.snapshot.chord_nodes]
    ax.add_collection(LineCollection(list(ends[:, :, 1:]), colors="#d8cdb4", linewidths=0.9,
                                     label="chordae (projected)"))
    heads = drawing.heads
    ax.plot(heads[:, 1], heads[:, 2], "o", color="#9e4a41", markersize=7, linestyle="none",
            label="papillary heads (projected)")


def _finish_section(ax: Any, drawing: Drawing) -> None:
    right = ax.get_xlim()[1]
    ax.text(right + 0.4, 0.4, "annulus plane", ha="right", va="bottom", fontsize=9,
            color="#5b7c96")
    ax.text(0, 7.4, "left atrium", ha="center", fontsize=12, style="italic", color="#777777")
    ax.text(right + 1, ax.get_ylim()[0] + 1, "left ventricle", ha="right", fontsize=12,
            style="italic", color="#777777")
    ax.set_xlabel("anterior  ←   position along the AP axis, mm   →  posterior")
    ax.set_ylabel("height above the annulus plane, mm")
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(loc="lower left", frameon=False, fontsize=10)
    area = drawing.snapshot.measure("orifice").regurgitant_orifice_area * 1e6
    if area > 0:
        ax.text(right + 0.4, 7.4, f"leaks: {area:.1f} mm²", ha="right", color=ORIFICE,
                fontweight="bold")
