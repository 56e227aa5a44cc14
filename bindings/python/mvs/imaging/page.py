"""The page of a valve from images: slices with the mesh drawn over them, thickness, valve, findings."""

from __future__ import annotations

import html
import io
import os
from string import Template
from typing import Optional, Union

import numpy as np
from numpy.typing import NDArray

import mvs
from mvs.report.markup import cells, figure, heads, table
from .mesh import Sheet
from .needs import need
from .repair import chapter
from .result import doubts_in, verdict_of
from .valve import ImageValve, ScannedImage, leaflet_mesh

PAGE = Template("""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>$title</title>
<style>
  body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 78rem; margin: 2rem auto; padding: 0 1rem }
  .warning { border-left: 5px solid #c8553d; background: #fbf1ee; padding: .7rem 1rem }
  .row { display: grid; gap: 1rem; grid-template-columns: repeat(2, 1fr) }
  figure { margin: 0 } figure img { width: 100%; height: auto } figcaption { color: #444 }
  table { border-collapse: collapse; font-size: .92rem; width: 100% }
  th, td { padding: .25rem .6rem; border-bottom: 1px solid #e5e5e5; text-align: left; vertical-align: top }
</style></head><body>
<h1>A valve from an image</h1>
<p>$source; libmvs $version</p>
<p class="warning"><strong>Planning and research tool, not a cleared medical device.</strong>
Nothing here may be used to decide on the treatment of a patient.</p>
<p>$verdict</p>
$warnings
<h2>Image and mesh</h2>$slices
<h2>The valve</h2><div class="row">$pictures</div>
<h2>Thickness</h2><div class="row">$thickness</div>
<h2>How well it closes on the loaded image</h2>$loaded
$repair
<h2>Measured, given, guessed and assumed</h2>$findings
<h2>Stages</h2>$stages
</body></html>
""")
COLOURS = {"mesh": "#e8590c", "image": "#1c7ed6"}


def write_page(path: Union[str, "os.PathLike[str]"], made: ImageValve, source: str) -> None:
    """Writes one self-contained HTML file, beside and then renamed."""
    text = page_of(made, source)
    beside = f"{os.fspath(path)}.part"
    with open(beside, "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(beside, path)


def page_of(made: ImageValve, source: str) -> str:
    verdict = f"Closed under 120 mmHg: {verdict_of(made)}{doubts_in(made.findings)}."
    said = {one.name: one.sentence for one in made.findings}
    interval = " ".join(f"{words}." for words in (
        said.get("leak"), "Interval: " + said["leak_interval"] if "leak_interval" in said else None)
        if words)
    return PAGE.substitute(
        title=html.escape(source), source=html.escape(source), version=mvs.__version__,
        verdict=html.escape(f"{verdict} {interval}"), warnings=_warnings(made), slices=_slices(made), pictures=_pictures(made),
        thickness=figure(thickness_histogram(made),
                         "Thickness of the tissue at the points of its mid-surface"),
        loaded=_loaded(made), repair=chapter(made.closed, made.repair) if made.repair else "",
        findings=_findings(made), stages=_stages(made))


def _warnings(made: ImageValve) -> str:
    """The doubtful findings, as the command prints them."""
    rows = [f"<li><strong>{html.escape(one.name)}</strong> ({100 * one.confidence:.0f} % sure): {html.escape(one.sentence)}</li>"
            for one in made.findings if one.doubtful]
    return f'<div class="warning"><strong>Look at these first:</strong><ul>{"".join(rows)}</ul></div>' if rows else ""


def _findings(made: ImageValve) -> str:
    rows = [heads(["", "from", "sure", "what was seen, and what to give if it is wrong"])]
    for one in made.findings:
        source = mvs.FindingSource(one.source).name.lower()
        rows.append(cells([html.escape(one.name), source, f"{100 * one.confidence:.0f} %",
                           html.escape(one.sentence)]))
    return table(f"<tr>{row}</tr>" for row in rows)


def _stages(made: ImageValve) -> str:
    if not made.stages:
        return "<p>Labels were given: nothing was segmented.</p>"
    rows = [heads(["stage", "CPU, s", "result"])]
    rows += [cells([html.escape(name), f"{seconds:.1f}", html.escape(words)])
             for name, seconds, words in made.stages]
    return table(f"<tr>{row}</tr>" for row in rows)


def _pictures(made: ImageValve) -> str:
    pictures = need("mvs.drawing.pictures")
    drawing = need("mvs.drawing.geometry").Drawing
    opened, closed = drawing(made.opened), drawing(made.closed)
    wide = float(np.ptp(opened.annulus[:, 0])) + 14
    return "".join([
        figure(pictures.picture(opened, pictures.view_from_atrium(wide), closed=False),
               "Open, from the atrium, with the names of the scallops"),
        figure(pictures.picture(closed, pictures.view_from_atrium(wide), closed=True),
               "Closed under 120 mmHg"),
        figure(pictures.picture(opened, pictures.view_oblique(wide + 10), closed=False),
               "Open, with chordae and papillary heads"),
        figure(pictures.picture(closed, pictures.view_from_ventricle(wide + 10), closed=True),
               "Closed, from the ventricle")])


def thickness_histogram(made: ImageValve) -> bytes:
    """The thickness at the points of the mid-surface, of each leaflet if they are labelled."""
    drawing = need("mvs.drawing.pictures")
    sheet, leaflet = made.leaflets.sheet, made.leaflets.leaflet
    shown = drawing.new_figure(8, 4)
    ax = shown.add_axes((0.1, 0.16, 0.86, 0.8))
    thickness = sheet.values["thickness"] * 1e3
    bins = np.linspace(0, max(2.0, float(thickness.max())), 41)
    names = {0: "leaflets", 1: "anterior", 2: "posterior"}
    for label in np.unique(leaflet):
        points = np.unique(sheet.triangles[leaflet == label])
        ax.hist(thickness[points], bins, alpha=0.6, label=names[int(label)])
    ax.set_xlabel("thickness, mm")
    ax.set_ylabel("points of the mid-surface")
    ax.legend(frameon=False)
    return bytes(drawing.to_png(shown))


def _loaded(made: ImageValve) -> str:
    if made.loaded is None:
        return "<p>No loaded image was given: chordae have the lengths of the open image or of normal "\
               "anatomy, and nothing here says how well the valve closes.</p>"
    names = ("registration", "closed_surface", "closed_annulus", "closed_tips", "annulus_motion", "head_motion",
             "closed_fit", "closed_distance", "shown_gaps", "loaded_chordae")
    sentences = [one.sentence for one in made.findings if one.name in names]
    return (f"<ul>{''.join(f'<li>{html.escape(one)}</li>' for one in sentences)}</ul>"
            '<div class="row">'
            + figure(distance_histogram(made), "Distance between the leaflets in the loaded image and "
                     "the simulated closed valve") + "</div>")


def distance_histogram(made: ImageValve) -> bytes:
    """Distances between the loaded surface and the simulated closed valve, from the points of both."""
    from .valve import distances_from_image

    assert made.loaded is not None
    drawing = need("mvs.drawing.pictures")
    away, weights = distances_from_image(made.closed, made.loaded)
    away = away * 1e3
    shown = drawing.new_figure(8, 4)
    ax = shown.add_axes((0.1, 0.16, 0.86, 0.8))
    ax.hist(away, np.linspace(0, max(2.0, float(away.max())), 41), weights=100 * weights, color="#8d99ae")
    ax.axvline(float(np.sqrt((weights * away ** 2).sum())), color=COLOURS["mesh"], label="RMS")
    ax.set_xlabel("distance, mm")
    ax.set_ylabel("share of both surfaces, %")
    ax.legend(frameon=False)
    return bytes(drawing.to_png(shown))


def _slices(made: ImageValve) -> str:
    rows = []
    if made.image is not None:
        rows.append(figure(slice_picture(made.image, made.opened, made.leaflets.sheet),
                           "The open image with the mesh of the open valve (orange) and the mid-surface "
                           "found in the image (blue): long axis with the posterior side (P) on the left "
                           "and the anterior one (A) on the right, long axis from commissure to "
                           "commissure, short axis; the bar is 10 mm long"))
    if made.loaded_image is not None:
        rows.append(figure(slice_picture(made.loaded_image, made.closed, made.loaded),
                           "The loaded image with the simulated closed valve (orange) and the surface "
                           "found in the image (blue)"))
    return "".join(rows)


def slice_picture(image: ScannedImage, snapshot: mvs.Snapshot, surface: Optional[Sheet]) -> bytes:
    """Three slices through a volume with the cuts of the mesh and of the surface in the image."""
    drawing = need("mvs.drawing.pictures")
    points, triangles = leaflet_mesh(snapshot)
    frame = snapshot.frame
    local = frame.to_local(points[np.unique(triangles)])
    centre = frame.origin + frame.axes[2] * float(local[:, 2].mean())
    half = 1.25 * float(np.abs(local - [0, 0, local[:, 2].mean()]).max())
    shown = drawing.new_figure(15, 5.2)
    letters: tuple[dict[tuple[float, float], str], ...] = (
        {(0.03, 0.5): "P", (0.97, 0.5): "A"}, {}, {(0.5, 0.03): "P", (0.5, 0.97): "A"})
    for k, (across, up) in enumerate(((0, 2), (1, 2), (1, 0))):
        right, high = frame.axes[across], frame.axes[up]
        ax = shown.add_axes((0.005 + k / 3, 0.01, 0.325, 0.98))
        side = np.linspace(-half, half, 360)
        plane = centre + side[None, :, None] * right + side[:, None, None] * high
        values = image.sample(plane)
        ax.imshow(values, cmap="gray", origin="lower", extent=[-half * 1e3, half * 1e3] * 2,
                  vmin=float(np.percentile(values, 1)), vmax=max(float(values.max()), 1e-6))
        normal = np.cross(right, high)
        for name, mesh in (("image", surface), ("mesh", Sheet(points, triangles))):
            if mesh is None:
                continue
            for line in cut_lines(mesh.points, mesh.triangles, centre, normal):
                flat = (line - centre) * 1e3
                ax.plot(flat @ right, flat @ high, color=COLOURS[name],
                        linewidth=1.2 if name == "mesh" else 2.2, alpha=0.95)
        ax.set_xlim(-half * 1e3, half * 1e3)
        ax.set_ylim(-half * 1e3, half * 1e3)
        ax.plot([-0.95e3 * half, -0.95e3 * half + 10], [-0.95e3 * half] * 2, color="white", linewidth=3)
        for place, letter in letters[k].items():
            ax.text(*place, letter, color="white", fontsize=14, ha="center", va="center", transform=ax.transAxes)
        ax.set_axis_off()
    memory = io.BytesIO()
    shown.savefig(memory, format="png", dpi=100, facecolor="white")
    return memory.getvalue()


def cut_lines(points: NDArray[np.float64], triangles: NDArray[np.int64],
              origin: NDArray[np.float64], normal: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """The segments (2, 3) in which a plane cuts triangles."""
    height = (points - origin) @ normal
    lines = []
    corners = height[triangles]
    for row in np.flatnonzero((corners.min(axis=1) < 0) & (corners.max(axis=1) >= 0)):
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            i, j = triangles[row, a], triangles[row, b]
            if (height[i] < 0) != (height[j] < 0):
                share = height[i] / (height[i] - height[j])
                ends.append(points[i] + share * (points[j] - points[i]))
        lines.append(np.array(ends[:2]))
    return lines
