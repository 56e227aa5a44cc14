"""From leaflets in an image to a valve that closes, with mvs.Simulator.build_valve."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from numpy.typing import NDArray

import mvs
from .findings import finding
from .grid import Floats, Grid, Points, crop, isotropic
from .labels import Leaflets
from .landmarks import PARTS, check_counts, check_near
from .loaded import Motion
from .mesh import Sheet
from .needs import need
from .reading import LabelMap

if TYPE_CHECKING:
    from .repair import Repair

Progress = Optional[Callable[[float, float], object]]


@dataclasses.dataclass(frozen=True, eq=False)
class ScannedImage:
    """A volume to draw, and the rigid motion from its frame to that of the open image."""

    grid: Grid
    values: NDArray[Any]
    motion: Motion

    def sample(self, points: Points) -> Points:
        """Values at points (..., 3) in m in the frame of the open image."""
        own = (points.reshape(-1, 3) - self.motion.shift) @ self.motion.turn
        return self.grid.sample(self.values, own).reshape(points.shape[:-1])


def scanned(image: Any, motion: Optional[Motion] = None) -> ScannedImage:
    """A volume, or the segments of a label map, for pictures; at most some 10 million voxels."""
    sitk = need("SimpleITK")
    if isinstance(image, LabelMap):
        none = np.zeros(image.image.GetSize()[::-1], np.uint8)
        mask = sum(((k + 1) * m.astype(np.uint8) for k, m in enumerate(image.masks.values())), none)
        drawn = sitk.GetImageFromArray(mask)
        drawn.CopyInformation(image.image)
        image = crop(drawn, mask > 0, 10e-3)
    extent = np.prod(np.array(image.GetSize()) * np.array(image.GetSpacing()) * 1e-3)
    step = max(min(image.GetSpacing()) * 1e-3, float(extent / 1e7) ** (1 / 3))
    values = sitk.GetArrayViewFromImage(image)
    grid, volume = isotropic(image, step, float(values.min()))
    return ScannedImage(grid, volume, motion or Motion.none())


@dataclasses.dataclass(eq=False)
class ImageValve:
    """A valve from images, open and closed under 120 mmHg, with the findings on the way.

    stages: name, CPU seconds and result of each stage of a segmentation
    repair: the valve after the operations of a plan
    """

    opened: mvs.Snapshot
    closed: mvs.Snapshot
    converged: bool
    leaflets: Leaflets
    loaded: Optional[Sheet]
    findings: tuple[mvs.Finding, ...]
    landmarks: dict[str, Any]
    image: Optional[ScannedImage] = None
    loaded_image: Optional[ScannedImage] = None
    stages: tuple[tuple[str, float, str], ...] = ()
    repair: Optional["Repair"] = None


def build(leaflets: Leaflets, landmarks: Mapping[str, Any], loaded: Optional[Sheet] = None,
          name: str = "valve", progress: Progress = None, pressure: float = mvs.SYSTOLE_PA,
          findings: tuple[mvs.Finding, ...] = (), **options: Any) -> ImageValve:
    """Builds and closes the valve.

    landmarks: positions (n, 3) in m by part: annulus, commissures, anterior, papillary_tips; those
        that are None are guessed
    loaded: the closed leaflets; chords get the lengths with which the valve closes to them
    progress: called with the share that is done, of the build and then of the closure
    options: edge, chords, leaflet, ... of mvs.Simulator.build_valve
    """
    sheet = leaflets.sheet
    given = {part: np.ascontiguousarray(landmarks[part]) for part in PARTS
             if landmarks.get(part) is not None}
    check_counts(given)
    check_near(given, sheet.points, "the leaflets in the image")
    arguments: dict[str, Any] = {**options, **given}
    arguments.setdefault("thickness", np.ascontiguousarray(sheet.values["thickness"]))
    if leaflets.leaflet.any():
        arguments["triangle_leaflet"] = np.ascontiguousarray(leaflets.leaflet)
    if loaded is not None:
        check_closed(loaded, sheet)
        arguments["closed_points"] = np.ascontiguousarray(loaded.points)
        arguments["closed_triangles"] = np.ascontiguousarray(loaded.triangles, dtype=np.uint32)
    with mvs.Simulator(workers=usable_cores()) as sim:
        found = sim.build_valve(np.ascontiguousarray(sheet.points),
                                np.ascontiguousarray(sheet.triangles, dtype=np.uint32),
                                kind="mid", name=name, progress=progress, **arguments)
        opened = sim.snapshot()
        sim.set_load(pressure)
        stats = sim.settle(progress=progress)
        closed = sim.snapshot()
    every = [*leaflets.findings, *findings, *found, _distance_of_meshes(opened, sheet)]
    if loaded is not None:
        every.append(distance_from_image(closed, loaded))
    return ImageValve(opened, closed, stats.converged, leaflets, loaded, tuple(every), dict(given))


def usable_cores() -> int:
    """Cores on which closures of a build run at the same time, at most 8."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(cores, 8)


LEAST_MOTION = 1e-3
"""m, median: leaflets of phantoms and real valves move by 3 to 5 mm as they close."""


def check_closed(loaded: Sheet, opened: Sheet) -> None:
    """ArgumentError if the leaflets in the loaded image lie where the open ones do."""
    away = float(np.median(distances(loaded.points, opened.points, opened.triangles)))
    if away < LEAST_MOTION:
        raise mvs.ArgumentError(
            f"the leaflets in the loaded image lie {away * 1e3:.1f} mm (median) from the open ones: the "
            "image of the open valve was given as the loaded one. Give that of the closed valve", "loaded")


def leaflet_mesh(snapshot: mvs.Snapshot) -> tuple[Points, NDArray[np.int64]]:
    """Points (n, 3) in m and triangles (m, 3) of the leaflets."""
    return (np.asarray(snapshot.node_position), np.asarray(snapshot.triangle_nodes, np.int64))


def nearest_on(points: Points, surface_points: Points, triangles: NDArray[np.int64]) -> Points:
    """The nearest points (n, 3) of a triangle surface."""
    surface = need("pyvista").PolyData.from_regular_faces(surface_points * 1e3, triangles)
    _, closest = surface.find_closest_cell(np.atleast_2d(points) * 1e3, return_closest_point=True)
    return np.atleast_2d(closest) * 1e-3


def distances(points: Points, surface_points: Points, triangles: NDArray[np.int64]) -> Points:
    """The distance (n,) of points from a triangle surface."""
    return np.asarray(np.linalg.norm(points - nearest_on(points, surface_points, triangles), axis=1))


def _distance_of_meshes(opened: mvs.Snapshot, sheet: Sheet) -> mvs.Finding:
    """How far the mid-surface in the image lies from the built mesh."""
    away = distances(sheet.points, *leaflet_mesh(opened))
    rms, high = float(np.sqrt((away ** 2).mean())), float(away.max())
    return finding("mesh_distance", mvs.FindingSource.MEASURED, 1.0,
                   f"the mid-surface in the image lies {rms * 1e3:.2f} mm RMS, at most "
                   f"{high * 1e3:.2f} mm, from the mesh", [rms, high], "m")


def distances_from_image(closed: mvs.Snapshot, loaded: Sheet) -> tuple[Points, Points]:
    """Distances, m, between the simulated closed leaflets and those in the loaded image, from the points
    of both, and their weights: each surface has a half."""
    points, triangles = leaflet_mesh(closed)
    back = distances(loaded.points, points, triangles)
    there = distances(points[np.unique(triangles)], loaded.points, loaded.triangles)
    weights = [np.full(len(one), 0.5 / len(one)) for one in (back, there)]
    return np.concatenate([back, there]), np.concatenate(weights)


def weighted_percentile(values: Floats, weights: Floats, percent: float) -> float:
    """The least of `values` (n,) below or at which `percent` of the sum of the weights (n,) lies."""
    order = np.argsort(values, kind="stable")
    reached = np.cumsum(weights[order])
    # sums of rounded weights may end short of the whole
    at = int(np.searchsorted(reached, percent / 100 * reached[-1] * (1 - 1e-12)))
    return float(values[order[min(at, len(values) - 1)]])


def distance_from_image(closed: mvs.Snapshot, loaded: Sheet) -> mvs.Finding:
    """How far the simulated closed valve lies from the leaflets in the loaded image, both ways."""
    away, weights = distances_from_image(closed, loaded)
    rms = float(np.sqrt((weights * away ** 2).sum()))
    high = weighted_percentile(away, weights, 95)
    return finding("closed_distance", mvs.FindingSource.MEASURED, 1.0,
                   f"under load the simulated valve lies {rms * 1e3:.2f} mm RMS from the leaflets in the "
                   f"loaded image, 95 % of both within {high * 1e3:.2f} mm (each surface counts for a half)", [rms, high], "m")
