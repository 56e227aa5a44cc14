"""The pictures of a valve: rendered scenes with labels, legends and scale bars."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional

import matplotlib
import matplotlib.image
import matplotlib.patheffects as effects
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from mvs import PartKind
from .geometry import Drawing
from .scene import HEAD_LENGTH, ORIFICE_PARTS, Colours, Scene, View, orifice_colour

if TYPE_CHECKING:
    from matplotlib.typing import RcKeyType

INK = "#222222"
DPI = 110
LABEL_STEP = 5.5
"""mm of the picture between labels of parts of the orifice."""
MARGIN = 4.0
"""mm around a whole valve: half the width of a papillary muscle, and a millimetre."""
STYLE: dict[RcKeyType, Any] = {"font.family": "DejaVu Sans", "font.size": 11, "text.color": INK}
"""Settings of matplotlib within a drawing function; those of the user stay as they are."""


def new_figure(width: float, height: float) -> Any:
    """An empty figure of a size in inches, outside of pyplot: needs no display or backend."""
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def to_png(figure: Any) -> bytes:
    """The bytes of a figure as a PNG file."""
    memory = io.BytesIO()
    figure.savefig(memory, format="png", dpi=DPI, facecolor="white")
    return memory.getvalue()


def side_by_side(pictures: list[bytes]) -> bytes:
    """Pictures of equal height, joined side by side."""
    images = [matplotlib.image.imread(io.BytesIO(png)) for png in pictures]
    memory = io.BytesIO()
    matplotlib.image.imsave(memory, np.ascontiguousarray(np.hstack(images)), format="png")
    return memory.getvalue()


def view_from_atrium(width: float) -> View:
    """The surgeon's view: the anterior leaflet up, P2 down."""
    return View(towards=(0, 0, 1), up=(0, 1, 0), width=width, centre=(0, -1.5, 0))


def view_oblique(width: float) -> View:
    """From the posterior side and above, with the papillary muscles."""
    return View(towards=(0.45, -1.0, 0.62), up=(0, 0, 1), width=width, centre=(0, 0, -14))


def view_from_ventricle(width: float) -> View:
    """From the posterior side and below: chordae and papillary muscles."""
    return View(towards=(0.35, -1.0, -0.28), up=(0, 0, 1), width=width, centre=(0, 0, -14))


def whole_valve(drawing: Drawing) -> NDArray[np.float64]:
    """Nodes and the lower ends of the papillary muscles as drawn, mm."""
    return np.concatenate([drawing.nodes, drawing.heads - [0, 0, HEAD_LENGTH]])


def place_image(ax: Any, image: NDArray[np.uint8], view: View) -> None:
    """Shows a rendered picture on axes in mm from its centre."""
    high, wide = image.shape[0] / image.shape[1] * view.width / 2, view.width / 2
    ax.imshow(image, extent=(-wide, wide, -high, high), interpolation="lanczos")
    ax.set_axis_off()


def scale_bar(ax: Any, length: float = 10.0) -> None:
    """Draws a bar of a length in mm at the lower left; the projection is parallel."""
    left, bottom = ax.get_xlim()[0], ax.get_ylim()[0]
    x, y = left + 2.5, bottom + 2.2
    ax.plot([x, x + length], [y, y], color=INK, linewidth=2.5, solid_capstyle="butt")
    ax.text(x + length / 2, y + 0.7, f"{length:g} mm", ha="center", va="bottom", fontsize=10)


def _label(ax: Any, at: NDArray[np.float64], text: str, **style: Any) -> None:
    halo = [effects.withStroke(linewidth=3, foreground="white")]
    ax.text(*at, text, ha="center", va="center", path_effects=halo, **style)


def label_scallops(ax: Any, drawing: Drawing, view: View) -> None:
    """Writes the name of each scallop on it."""
    for row, name in enumerate(drawing.names(PartKind.SCALLOP)):
        anchor = drawing.scallop_anchor(row, view.axes[2])
        _label(ax, view.project(anchor), name, fontsize=14, fontweight="bold")


def label_sides(ax: Any, drawing: Drawing, view: View) -> None:
    """Writes "anterior" and "posterior" on the strip of wall, for a view from the atrium."""
    ring = drawing.annulus
    for y, text in ((ring[:, 1].max() + 2.6, "anterior"), (ring[:, 1].min() - 2.6, "posterior")):
        ax.text(*view.project(np.array([0.0, y, 0.0])), text, ha="center", va="center",
                fontsize=11, style="italic", color="#5a3d34")


def label_heads(ax: Any, drawing: Drawing, view: View) -> None:
    """Writes the names of the papillary heads beside their tips."""
    heads = drawing.names(PartKind.HEAD)
    if len(heads) > 4:
        return
    for name, tip in zip(heads, view.project(drawing.heads)):
        side = 1 if tip[0] > 0 else -1
        ax.text(tip[0] + 4.2 * side, tip[1] - 3, name, va="center", fontsize=12,
                ha="left" if side > 0 else "right", fontweight="bold")


def colour_bar(figure: Any, ax: Any, colours: Colours, text: str, extend: str = "neither") -> None:
    """Draws the legend of a colour map with quantity and unit."""
    norm = matplotlib.colors.Normalize(colours.low, colours.high)
    shades = matplotlib.cm.ScalarMappable(norm, colours.map)
    bar = figure.colorbar(shades, cax=ax, orientation="horizontal", extend=extend)
    bar.set_label(text, fontsize=11)
    bar.outline.set_visible(False)


@matplotlib.rc_context(STYLE)
def picture(
    drawing: Drawing,
    view: View,
    *,
    closed: bool,
    tension: Optional[float] = None,
    labels: bool = True,
) -> bytes:
    """One view of a valve; `tension`: N, upper end of the colour scale of the chordae. A view from elsewhere than the atrium
    is moved and widened where leaflets or papillary muscles would be cut off."""
    scene = Scene(drawing)
    from_atrium = view.towards == (0, 0, 1)
    if not from_atrium:
        view = view.around(whole_valve(drawing), MARGIN)
    scene.add_leaflets(opacity=0.55 if tension else 1.0)
    scene.add_rim()
    scene.add_annulus()
    if from_atrium:
        scene.add_wall()
    scene.add_chords(drawing.snapshot.chord_tension if tension else None, tension or 1.0)
    scene.add_heads()
    scene.add_rings()
    if closed:
        scene.add_orifice()
    image = scene.render(view)

    figure = new_figure(8, 7.0 if tension else 6.4)
    ax = figure.add_axes((0, 0.1 if tension else 0, 1, 0.9 if tension else 1))
    place_image(ax, image, view)
    if from_atrium:
        label_sides(ax, drawing, view)
        if labels:
            label_scallops(ax, drawing, view)
    else:
        label_heads(ax, drawing, view)
    if closed and len(drawing.snapshot.orifice_triangles) and from_atrium:
        _label_orifice(ax, drawing, view)
    scale_bar(ax)
    if tension:
        bar = figure.add_axes((0.25, 0.085, 0.5, 0.022))
        colour_bar(figure, bar, Colours(np.zeros(0), 0, tension, "viridis"),
                   "chordal tension, N (grey: slack)")
    return to_png(figure)


def _label_orifice(ax: Any, drawing: Drawing, view: View) -> None:
    """A label for each of the largest parts of the orifice, in its colour: place and area."""
    snapshot = drawing.snapshot
    (left, right), top = ax.get_xlim(), ax.get_ylim()[1]
    points = drawing.place(snapshot.orifice_vertices)
    rows = {"left": 0, "right": 0}
    for part, row in enumerate(list(snapshot.orifice_parts())[: len(ORIFICE_PARTS) - 1]):
        corners = points[snapshot.orifice_triangles[snapshot.orifice_part == part]]
        spots = view.project(corners.mean(axis=1))
        # well to the left of the middle, so that an opening in the middle has its label on the right
        side = "left" if spots[:, 0].mean() < 0.6 * left + 0.4 * right else "right"
        at = np.array([left + 1 if side == "left" else right - 1, top - 1.5 - LABEL_STEP * rows[side]])
        rows[side] += 1
        spot = spots[np.argmin(np.linalg.norm(spots - at, axis=1))]
        colour = orifice_colour(part)
        ax.annotate(
            opening_words(row, first=part == 0), xy=spot, xytext=at, ha=side, va="top",
            fontsize=12, color=colour, fontweight="bold",
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 1.5},
        )


def opening_words(part: Mapping[str, Any], first: bool) -> str:
    """Place and area of a part of the orifice: "A2 / P2\n48.8 mm²"."""
    sides = " / ".join(side for side in (part["anterior"], part["posterior"]) if side)
    title = "regurgitant orifice\n" if first else ""
    return f"{title}{sides}\n{part['area'] * 1e6:.1f} mm²"
