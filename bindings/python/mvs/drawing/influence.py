"""Influence map: chordae coloured by the effect of their rest length on a quantity."""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np
from numpy.typing import NDArray

from .geometry import Drawing
from .pictures import (
    STYLE,
    colour_bar,
    label_heads,
    new_figure,
    place_image,
    scale_bar,
    to_png,
    view_from_ventricle,
)
from .scene import Colours, Scene

NAMED = 5
"""Chordae of the largest influence that get their names."""


@matplotlib.rc_context(STYLE)
def influence_map(
    drawing: Drawing, change: NDArray[np.float64], names: list[str], text: str
) -> bytes:
    """A view from below: `change` of each chord in shown units, `text` for the legend."""
    high = float(np.abs(change).max()) or 1.0
    width = float(np.ptp(drawing.annulus[:, 0])) + 24
    view = view_from_ventricle(width)
    scene = Scene(drawing)
    scene.add_leaflets(opacity=0.4)
    scene.add_rim()
    scene.add_annulus()
    scene.add_chords(change, high, -high, "coolwarm")
    scene.add_heads()
    scene.add_rings()
    figure = new_figure(8, 7.0)
    ax = figure.add_axes((0, 0.1, 1, 0.9))
    place_image(ax, scene.render(view), view)
    label_heads(ax, drawing, view)
    _name_largest(ax, drawing, view, change, names)
    scale_bar(ax)
    bar = figure.add_axes((0.2, 0.085, 0.6, 0.022))
    colour_bar(figure, bar, Colours(np.zeros(0), -high, high, "coolwarm"), text)
    return to_png(figure)


def _name_largest(
    ax: Any, drawing: Drawing, view: Any, change: NDArray[np.float64], names: list[str]
) -> None:
    ends = drawing.nodes[drawing.snapshot.chord_nodes]
    for row in np.argsort(-np.abs(change), kind="stable")[:NAMED]:
        if change[row] == 0:
            continue
        spot = view.project(0.4 * ends[row, 0] + 0.6 * ends[row, 1])
        ax.text(*spot, names[row], ha="center", va="center", fontsize=9, fontweight="bold",
                bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 1})
