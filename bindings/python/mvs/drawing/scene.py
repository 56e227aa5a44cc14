"""The valve in three dimensions, rendered off-screen by VTK, without labels."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any, Literal, Optional

import numpy as np
from numpy.typing import NDArray

# EGL renders without a display
os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import pyvista  # noqa: E402

from mvs import ChordKind, RingKind  # noqa: E402
from .geometry import Drawing, Points  # noqa: E402

ANTERIOR, POSTERIOR = "#efc4ae", "#dfa491"
CHORD, SLACK, HEAD, ANNULUS, WALL = "#f4ecd8", "#a9a9a9", "#9e4a41", "#4a6d8c", "#d9b3a6"
ORIFICE, SEWN = "#d7191c", "#2f5fa8"
# of the parts of an orifice, the largest first; the last one for all others
ORIFICE_PARTS = (ORIFICE, "#7b3294", "#b35806", "#1b7837", "#525252")
PIXELS = 1100
HEIGHT, HEAD_LENGTH = 0.8, 14.0
"""of a picture over its width; mm, of a papillary muscle as drawn, below its tip"""


@dataclass(frozen=True)
class View:
    """A camera with parallel projection.

    towards: direction from the valve to the eye; up: upward direction in the picture; width: of the
    picture, mm
    """

    towards: tuple[float, float, float]
    up: tuple[float, float, float]
    width: float
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def axes(self) -> NDArray[np.float64]:
        """Unit vectors in rows: right, up, towards the eye."""
        eye = np.asarray(self.towards) / np.linalg.norm(self.towards)
        right = np.cross(self.up, eye)
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(eye, right), eye])

    def project(self, points: Points) -> Points:
        """Points of the drawing in mm to the right of and above the centre of the picture."""
        return np.asarray((points - np.asarray(self.centre)) @ self.axes[:2].T)

    def around(self, points: Points, margin: float) -> View:
        """The same view; if a point lies beyond the picture or within `margin` mm of its border, moved to the
        middle of the points, and wider if they need it."""
        seen = self.project(points)
        low, high = seen.min(axis=0) - margin, seen.max(axis=0) + margin
        half = self.width / 2 * np.array([1, HEIGHT])
        if (low >= -half).all() and (high <= half).all():
            return self
        centre = np.asarray(self.centre) + (low + high) / 2 @ self.axes[:2]
        width = max(self.width, *((high - low) / [1, HEIGHT]))
        return replace(self, width=float(width), centre=(float(centre[0]), float(centre[1]), float(centre[2])))


@dataclass
class Colours:
    """Node values and their colour scale."""

    values: NDArray[np.float64]
    low: float
    high: float
    map: Any
    above: Optional[str] = None


def _surface(points: Points, triangles: NDArray[np.int64]) -> Any:
    faces = np.column_stack([np.full(len(triangles), 3), triangles]).ravel()
    return pyvista.PolyData(np.ascontiguousarray(points), faces)


def _polyline(points: Points, closed: bool) -> Any:
    count = len(points)
    # closed: one extra point, so that the ends of a tube overlap
    order = np.append(np.arange(count), [0, 1]) if closed else np.arange(count)
    return pyvista.PolyData(points, lines=np.concatenate([[len(order)], order]))


class Scene:
    """Collects the parts of a valve and renders them."""

    def __init__(self, drawing: Drawing, height: float = HEIGHT) -> None:
        self.drawing = drawing
        self.plotter = pyvista.Plotter(
            off_screen=True, window_size=[PIXELS, int(PIXELS * height)], lighting="none"
        )
        self.plotter.set_background("white")  # type: ignore[arg-type]  # functools.wraps in pyvista hides self
        for position, strength in (
            ((-0.7, 0.9, 1.0), 0.7),
            ((1.0, 0.1, 0.6), 0.34),
            ((0.0, -0.5, 1.0), 0.3),
        ):
            light = pyvista.Light(position=position, light_type="camera light")
            light.intensity = strength
            self.plotter.add_light(light)

    def add_leaflets(
        self,
        colours: Optional[Colours] = None,
        only: Optional[int] = None,
        opacity: float = 1.0,
    ) -> None:
        """Adds the sheets, as thick as the contact thickness, with smooth shading.

        An interpolating subdivision refines them: every vertex of the mesh keeps its position.
        """
        drawing = self.drawing
        for leaflet in np.unique(drawing.snapshot.triangle_leaflet):
            if only is not None and leaflet != only:
                continue
            self._add_sheet(int(leaflet), colours, opacity)

    def _add_sheet(self, leaflet: int, colours: Optional[Colours], opacity: float) -> None:
        drawing = self.drawing
        mine = drawing.snapshot.triangle_leaflet == leaflet
        whole = _surface(drawing.nodes, drawing.triangles)
        whole.cell_data["mine"] = mine.astype(np.uint8)
        if colours is not None:
            whole.point_data["value"] = colours.values
        fine = whole.clean().subdivide(2, "butterfly") if len(mine) < 20000 else whole
        fine = fine.compute_normals(
            cell_normals=False, split_vertices=False, consistent_normals=False,
            auto_orient_normals=False,
        )
        normals = fine.point_data["Normals"]
        faces = fine.regular_faces[fine.cell_data["mine"] > 0]
        half = drawing.contact_thickness / 2
        style: dict[str, Any] = dict(
            smooth_shading=True, split_sharp_edges=False, opacity=opacity, ambient=0.22,
            diffuse=0.85, specular=0.18, specular_power=18,
        )
        if colours is None:
            style["color"] = ANTERIOR if leaflet == 0 else POSTERIOR
        else:
            # flatter light: shading must not look like a colour of the scale
            style.update(ambient=0.45, diffuse=0.6, specular=0.0)
            style.update(
                scalars="value", cmap=colours.map, clim=(colours.low, colours.high),
                show_scalar_bar=False, above_color=colours.above,
            )
        for side in (1, -1):
            # reversed winding lights the lower side from below
            sheet = _surface(fine.points + side * half * normals, faces[:, ::side])
            sheet.point_data["Normals"] = side * normals
            if colours is not None:
                sheet.point_data["value"] = fine.point_data["value"]
            self.plotter.add_mesh(sheet, **style)

    def add_rim(self) -> None:
        """Adds the free edge as a tube."""
        edge = _polyline(self.drawing.free_edge, closed=True)
        tube = edge.tube(radius=self.drawing.contact_thickness / 2, n_sides=12)
        self.plotter.add_mesh(tube, color="#e8b8a2", smooth_shading=True, ambient=0.2)

    def add_annulus(self) -> None:
        """Adds the annulus as a tube."""
        ring = _smooth_loop(self.drawing.annulus)
        tube = _polyline(ring, closed=True).tube(radius=0.55, n_sides=16)
        self.plotter.add_mesh(tube, color=ANNULUS, smooth_shading=True, ambient=0.25, specular=0.3)

    def add_wall(self) -> None:
        """Adds a strip of atrial wall around the annulus, for orientation."""
        ring = _smooth_loop(self.drawing.annulus)
        centre = ring.mean(axis=0)
        outward = (ring - centre) * np.array([1.0, 1.0, 0.0])
        outward /= np.linalg.norm(outward, axis=1, keepdims=True)
        rows = [ring + s * (4.0 * outward + [0, 0, 1.1 * s]) for s in np.linspace(0, 1, 5)]
        count = len(ring)
        points = np.concatenate(rows)
        index = np.arange(count)
        triangles = []
        for row in range(len(rows) - 1):
            a, b = row * count + index, row * count + (index + 1) % count
            triangles += [np.column_stack([a, a + count, b]),
                          np.column_stack([b, a + count, b + count])]
        wall = _surface(points, np.concatenate(triangles))
        self.plotter.add_mesh(wall, color=WALL, smooth_shading=True, ambient=0.3, specular=0.0)

    def add_chords(
        self,
        values: Optional[NDArray[np.float64]] = None,
        high: float = 1.0,
        low: float = 0.0,
        shades: Literal["viridis", "coolwarm"] = "viridis",
    ) -> None:
        """Adds chordae as tubes of their cross-section that taper towards the leaflet, coloured by
        values, such as the tension in N, if they are given; grey where these are 0 or below `low`."""
        snapshot = self.drawing.snapshot
        radius = np.sqrt(snapshot.chord_area / np.pi) * 1e3
        for row, (a, b) in enumerate(snapshot.chord_nodes):
            tube = _tapered(self.drawing.nodes[a], self.drawing.nodes[b], float(radius[row]))
            if snapshot.chord_kind[row] == ChordKind.SUTURE:
                self.plotter.add_mesh(tube, color=SEWN, smooth_shading=True, ambient=0.25)
                continue
            if values is None or values[row] == 0 or values[row] < low:
                colour: Any = CHORD if values is None else SLACK
                self.plotter.add_mesh(tube, color=colour, smooth_shading=True, ambient=0.25)
                continue
            tube.point_data["value"] = np.full(tube.n_points, values[row])
            self.plotter.add_mesh(
                tube, scalars="value", clim=(low, high), cmap=shades, smooth_shading=True,
                ambient=0.25, show_scalar_bar=False,
            )

    def add_rings(self) -> None:
        """Adds rings and bands as tubes of 2.2 mm diameter."""
        snapshot = self.drawing.snapshot
        points = self.drawing.place(snapshot.ring_points)
        start = snapshot.ring_start
        for first, last, kind in zip(start[:-1], start[1:], snapshot.ring_kind):
            curve = _polyline(points[first:last], closed=kind == RingKind.RIGID)
            self.plotter.add_mesh(curve.tube(radius=1.1, n_sides=16), color=SEWN,
                                  smooth_shading=True, ambient=0.25, specular=0.3)

    def add_heads(self) -> None:
        """Adds one papillary muscle under each cluster of heads, and a tip at each head."""
        for cluster in _clusters(self.drawing.heads, 9.0):
            tip = cluster.mean(axis=0)
            length, width = HEAD_LENGTH, max(3.0, 1.5 + np.linalg.norm(cluster - tip, axis=1).max())
            body = pyvista.ParametricEllipsoid(width, width, length / 2)
            body = body.translate(tip - [0, 0, length / 2 - 0.4])
            self.plotter.add_mesh(body, color=HEAD, smooth_shading=True, ambient=0.2, specular=0.25)
            for point in cluster:
                self.plotter.add_mesh(
                    pyvista.Sphere(radius=1.1, center=point), color=HEAD, smooth_shading=True
                )

    def add_orifice(self) -> None:
        """Adds each part of the regurgitant orifice in its colour, the largest in red."""
        snapshot = self.drawing.snapshot
        points = self.drawing.place(snapshot.orifice_vertices)
        for part in range(len(snapshot.orifice_parts())):
            triangles = snapshot.orifice_triangles[snapshot.orifice_part == part]
            surface = _surface(points, triangles.astype(np.int64))
            self.plotter.add_mesh(surface, color=orifice_colour(part), lighting=False)

    def render(self, view: View) -> NDArray[np.uint8]:
        """Renders the picture: (height, width, 3)."""
        camera = self.plotter.camera
        centre = np.asarray(view.centre)
        camera.position = tuple(centre + 200 * view.axes[2])
        camera.focal_point = tuple(centre)
        camera.up = tuple(view.axes[1])
        camera.parallel_projection = True
        high, wide = self.plotter.window_size[1], self.plotter.window_size[0]
        camera.parallel_scale = view.width * high / wide / 2
        camera.clipping_range = (20.0, 400.0)
        self.plotter.enable_anti_aliasing("msaa", multi_samples=8)
        picture = self.plotter.screenshot(None, return_img=True)
        self.plotter.close()
        return np.asarray(picture)


def orifice_colour(part: int) -> str:
    """The colour of a part of the orifice; part 0 is the largest."""
    return ORIFICE_PARTS[min(part, len(ORIFICE_PARTS) - 1)]


def _smooth_loop(points: Points, fine: int = 6) -> Points:
    """A closed Catmull-Rom curve through the points."""
    before, after, next_ = (np.roll(points, k, axis=0) for k in (1, -1, -2))
    t = (np.arange(fine) / fine)[None, :, None]
    p0, p1, p2, p3 = (p[:, None, :] for p in (before, points, after, next_))
    curve = p1 + 0.5 * t * (
        p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0))
    )
    return np.asarray(curve.reshape(-1, 3))


def _tapered(start: Points, end: Points, radius: float) -> Any:
    line = pyvista.Line(start, end, resolution=8)
    line.point_data["radius"] = radius * np.linspace(1.0, 0.4, line.n_points)
    tube = line.tube(scalars="radius", absolute=True, n_sides=10)
    tube.clear_data()
    return tube


def _clusters(points: Points, reach: float) -> list[Points]:
    """Groups points: each is within reach of the first point of its group."""
    groups: list[list[Points]] = []
    for point in points:
        for group in groups:
            if np.linalg.norm(point - group[0]) < reach:
                group.append(point)
                break
        else:
            groups.append([point])
    return [np.array(group) for group in groups]
