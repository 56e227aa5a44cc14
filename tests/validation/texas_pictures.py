"""Pictures of the Texas valve: the signed distance from Abaqus, and its histogram."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import mvs  # noqa: E402
import numpy as np  # noqa: E402
from texas import LEAFLETS, MM, AbaqusFrame, Errors, Result, kept_nodes  # noqa: E402

LIMIT = 1.0
"""mm: the end of the colour scale"""

INK = "#222222"


def draw(result: Result, frame: AbaqusFrame, folder: Path) -> list[Path]:
    """Writes the map from the atrium, each leaflet by itself, and the histogram."""
    folder.mkdir(parents=True, exist_ok=True)
    signed = signed_distance(result.closed, frame) * MM
    title = (f"{result.errors.nodes:,} nodes, RMS {result.errors.rms * MM:.2f} mm, "
             f"largest {result.errors.max * MM:.2f} mm")
    paths = [folder / name for name in ("texas-map.png", "texas-leaflets.png", "texas-histogram.png")]
    for path, figure in zip(paths, (
        atrium_map(result.closed, signed, title),
        leaflet_maps(result.closed, signed, title),
        histogram(result.errors, frame, title),
    )):
        figure.savefig(path, dpi=110, facecolor="white")
        plt.close(figure)
    return paths


def signed_distance(closed: mvs.Snapshot, frame: AbaqusFrame) -> np.ndarray:
    """(n,) m at the nodes of the snapshot: node to node, positive where ours lies to the atrium.

    The sign is that of the difference along our normal; nan at nodes that the file has not.
    """
    rows, origin = kept_nodes(closed, len(frame.points))
    off = closed.node_position[rows] - frame.points[origin]
    side = np.sum(off * node_normals(closed)[rows], axis=1)
    signed = np.full(len(closed.node_position), np.nan)
    signed[rows] = np.copysign(np.linalg.norm(off, axis=1), side)
    return signed


def node_normals(snapshot: mvs.Snapshot) -> np.ndarray:
    """(n, 3): sums of the normals of the triangles around, by area; into the atrium."""
    corner = snapshot.triangle_nodes
    a, b, c = (snapshot.node_position[corner[:, k]] for k in range(3))
    normals = np.zeros_like(snapshot.node_position)
    for k in range(3):
        np.add.at(normals, corner[:, k], np.cross(b - a, c - a))
    return normals


def atrium_map(closed: mvs.Snapshot, signed: np.ndarray, title: str) -> Any:
    """The whole closed valve as seen along its axis from the atrium."""
    figure, ax = plt.subplots(figsize=(8.2, 7.6))
    rows = np.arange(len(closed.triangle_nodes))
    to_eye = closed.frame.axes[2]
    _paint(ax, closed, rows, signed, to_eye, closed.frame.axes[0])
    for name, mine in triangles_of_leaflets(closed):
        _name(ax, closed, mine, name, to_eye, closed.frame.axes[0])
    ax.set_title(f"closed, from the atrium: {title}", fontsize=11, pad=22)
    _finish(figure, [ax])
    return figure


def leaflet_maps(closed: mvs.Snapshot, signed: np.ndarray, title: str) -> Any:
    """Each leaflet by itself, from its own ventricular side, where coaptation hides nothing."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 5))
    for ax, (name, mine) in zip(axes, triangles_of_leaflets(closed)):
        centre = closed.node_position[closed.triangle_nodes[mine]].mean(axis=(0, 1))
        radial = closed.frame.origin - centre
        axis = closed.frame.axes[2]
        radial -= axis * (radial @ axis)
        # from inside the orifice and below, where the face that coapts is seen
        _paint(ax, closed, mine, signed, radial / np.linalg.norm(radial) - 0.3 * axis, axis)
        ax.set_title(name, fontsize=12)
    figure.suptitle(f"each leaflet alone, seen from the middle of the valve: {title}", fontsize=11)
    _finish(figure, axes)
    return figure


def triangles_of_leaflets(closed: mvs.Snapshot) -> list[tuple[str, np.ndarray]]:
    """Name and rows of the triangles of each leaflet."""
    names = [part.name for part in closed.parts if part.kind == mvs.PartKind.LEAFLET]
    return [(name, np.flatnonzero(closed.triangle_leaflet == k)) for k, name in enumerate(names)]


def _plane(points: np.ndarray, to_eye: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, ...]:
    """Points as seen with parallel rays: across, up and towards the eye, mm."""
    eye = to_eye / np.linalg.norm(to_eye)
    right = np.cross(up, eye)
    right /= np.linalg.norm(right)
    return tuple(points @ axis * MM for axis in (right, np.cross(eye, right), eye))


def _paint(ax: Any, closed: mvs.Snapshot, rows: np.ndarray, signed: np.ndarray,
           to_eye: np.ndarray, up: np.ndarray) -> None:
    """Triangles from the farthest to the nearest, coloured by the mean of their corners."""
    from matplotlib.collections import PolyCollection

    corner = closed.triangle_nodes[rows]
    x, y, near = _plane(closed.node_position - closed.frame.origin, to_eye, up)
    order = np.argsort(near[corner].mean(axis=1))
    corner = corner[order]
    with np.errstate(invalid="ignore"):
        value = np.nanmean(signed[corner], axis=1)
    patches = PolyCollection(np.stack([x[corner], y[corner]], axis=2), array=value, cmap="RdBu_r",
                             edgecolors="face", linewidths=0.2)
    patches.set_clim(-LIMIT, LIMIT)
    ax.add_collection(patches)
    ring = np.append(closed.annulus_nodes, closed.annulus_nodes[0])
    if len(rows) == len(closed.triangle_nodes):
        ax.plot(x[ring], y[ring], color=INK, linewidth=1.5)
    ax.set_aspect("equal")
    ax.autoscale_view()
    left, bottom = x[corner].min(), y[corner].min() - 3
    ax.plot([left, left + 5], [bottom, bottom], color=INK, linewidth=2.5)
    ax.text(left + 5.5, bottom, "5 mm", va="center", fontsize=9)
    ax.set_axis_off()


def _name(ax: Any, closed: mvs.Snapshot, rows: np.ndarray, name: str, to_eye: np.ndarray,
          up: np.ndarray) -> None:
    """A leaflet's name outside the annulus, on the side of the leaflet."""
    ring = closed.node_position[closed.annulus_nodes] - closed.frame.origin
    mine = np.isin(closed.annulus_nodes, closed.triangle_nodes[rows])
    across, above, _ = _plane(ring, to_eye, up)
    flat = np.column_stack([across, above])
    towards = flat[mine].mean(axis=0)
    towards /= np.linalg.norm(towards)
    x, y = towards * ((flat @ towards).max() + 2)
    ax.text(x, y, name, ha="left" if x > 6 else "right" if x < -6 else "center", va="center",
            fontsize=12, fontweight="bold")


def _finish(figure: Any, axes: Any) -> None:
    shades = plt.cm.ScalarMappable(plt.Normalize(-LIMIT, LIMIT), "RdBu_r")
    bar = figure.colorbar(shades, ax=axes, orientation="horizontal", extend="both", shrink=0.6,
                          pad=0.04, ticks=np.linspace(-LIMIT, LIMIT, 5))
    bar.set_label("distance from Abaqus, node to node, mm (red: ours nearer to the atrium)")


def histogram(errors: Errors, frame: AbaqusFrame, title: str) -> Any:
    """How many nodes are how far, by leaflet."""
    figure, ax = plt.subplots(figsize=(8, 4.2), layout="constrained")
    edges = np.linspace(0, 2.5, 51)
    parts = [errors.distance[frame.leaflet == k] * MM for k in range(len(LEAFLETS))]
    parts = [part[np.isfinite(part)] for part in parts]
    beyond = sum(int((part > edges[-1]).sum()) for part in parts)
    ax.hist(parts, edges, stacked=True, label=LEAFLETS, color=("#4477aa", "#ddaa33", "#aa3377"))
    for value, style, label in ((errors.rms, "-", "RMS"), (errors.p95, "--", "95 % are nearer")):
        ax.axvline(value * MM, color=INK, linestyle=style, label=f"{label} {value * MM:.2f} mm")
    ax.set_xlabel(f"distance from Abaqus, node to node, mm ({beyond} nodes beyond)")
    ax.set_ylabel("nodes")
    ax.set_title(title, fontsize=11)
    ax.legend(frameon=False)
    ax.spines[["top", "right"]].set_visible(False)
    return figure
