"""Errors of segmentation networks, put into the labels of leaflets; each kind can be switched off.

displacement: boundaries moved by a smooth random vector field and thickened or thinned by another
spurs: fingers that stick out of a leaflet; holes: balls cut out of it
eaten: stretches of the free edge that are missing; swapped: commissures in the other leaflet's label

The amplitude of the displacement and one factor on the sizes of all others are searched (bisection in
turn) until mean surface distance and 95 % Hausdorff distance are those that are asked for. All places
and directions are drawn first, so that the same seed gives the same errors at any size.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .distance import Cones
from .grid import Grid
from .label_statistics import LabelStatistics, statistics_of
from .labels import Labels, leaflet_labels
from .rasterise import Field, distance_field
from .settings import LabelErrors
from .smooth_noise import SmoothNoise

Points = NDArray[np.float64]
LARGEST_FACTOR, LARGEST_AMPLITUDE = 4.0, 2.0
HOLES_APART, LARGEST_HOLE_FACTOR = 8.0, 1.7
"""mm between holes, which reach 4 mm: larger ones would be seen and mended by an observer."""
GROSS = ("spurs", "holes", "eaten", "swapped")


@dataclasses.dataclass(frozen=True)
class LeafletPlaces:
    """Places in mm at which errors are made: points of the leaflets, of their rims and commissures.

    inner: (n, 3) points away from the rims, their unit normals and leaflets 0, 1, ...
    free_edge: (e, 3) points along the free edge; commissures: (c, 3)
    """

    inner: Points
    normals: Points
    leaflet: NDArray[np.int64]
    free_edge: Points
    commissures: Points


@dataclasses.dataclass(frozen=True)
class FlawedLabels:
    """Labels with errors, their statistics, and the amplitude (mm) and factor that were found."""

    labels: Labels
    statistics: list[LabelStatistics]
    amplitude: float
    factor: float

    def reached(self, wanted: LabelErrors) -> bool:
        """Whether mean and 95 % Hausdorff distance are within a tenth of those that were wanted.

        Voxels make both figures jump, so that they cannot be met exactly.
        """
        found = self.statistics[-1]
        return (abs(found.mean - wanted.mean) <= 0.1 * wanted.mean
                and abs(found.hd95 - wanted.hd95) <= 0.1 * wanted.hd95)


def with_errors(
    grid: Grid, fields: list[Field], names: tuple[str, ...], places: LeafletPlaces,
    errors: LabelErrors, random: np.random.Generator,
) -> FlawedLabels:
    """Puts errors of the wanted statistics into the labels of leaflets."""
    truth = leaflet_labels(fields)
    maker = _Maker(grid, fields, truth, places, errors, random)

    def at(amplitude: float, factor: float) -> FlawedLabels:
        labels = maker.labels(amplitude, factor)
        found = statistics_of(labels, truth, names, grid.spacing)
        return FlawedLabels(labels, found, amplitude, factor)

    amplitude, factor = 0.0, 0.0
    moved = "displacement" in errors.kinds
    gross = any(kind in errors.kinds for kind in GROSS)
    for _ in range(2 if moved and gross else 1):
        if gross:
            factor = _bisect(
                lambda f: at(amplitude, f).statistics[-1].hd95, errors.hd95, LARGEST_FACTOR
            )
        if moved:
            amplitude = _bisect(
                lambda a: at(a, factor).statistics[-1].mean, errors.mean, LARGEST_AMPLITUDE
            )
    return at(amplitude, factor)


def _bisect(figure: Callable[[float], float], wanted: float, largest: float) -> float:
    """Where a figure that grows reaches a value, in [0, largest]; the nearer end of a small bracket."""
    low, high = 0.0, largest
    for _ in range(8):
        middle = (low + high) / 2
        low, high = (middle, high) if figure(middle) < wanted else (low, middle)
    near = min((low, high), key=lambda x: abs(figure(x) - wanted))
    return near


class _Maker:
    """Draws the places of errors once, and makes labels with errors of any size."""

    def __init__(
        self, grid: Grid, fields: list[Field], truth: Labels, places: LeafletPlaces,
        errors: LabelErrors, random: np.random.Generator,
    ) -> None:
        from scipy.ndimage import distance_transform_edt

        self.grid, self.kinds, self.truth = grid, errors.kinds, truth
        self.fields = [np.minimum(f.distance, f.reach) for f in fields]
        self.places = places
        near = distance_transform_edt(truth == 0) * grid.spacing < 2 * LARGEST_AMPLITUDE
        self.voxels = np.argwhere(near)
        self.points = grid.to_patient(self.voxels[:, ::-1].astype(float))
        displacement = SmoothNoise(random, 3, errors.wavelength)
        thickening = SmoothNoise(random, 1, errors.wavelength)
        self.shift = displacement.at(self.points)
        self.growth = thickening.at(self.points)[:, 0]
        self.spurs = _draw_spurs(places, random)
        self.holes = self._balls(_draw_holes(places, random))
        self.eaten = self._balls(_draw_eaten(places, random))
        self.swaps = [
            (c, random.uniform(1.5, 2.5), int(random.integers(2))) for c in places.commissures
        ]

    def labels(self, amplitude: float, factor: float) -> Labels:
        """Labels with displacements of an amplitude (mm), the other errors scaled by a factor."""
        found = np.zeros_like(self.truth)
        found[tuple(self.voxels.T)] = self._displaced(amplitude)
        if factor > 0:
            if "spurs" in self.kinds:
                self._add_spurs(found, factor)
            if "holes" in self.kinds:
                self._remove(found, self.holes, min(factor, LARGEST_HOLE_FACTOR))
            if "eaten" in self.kinds:
                self._remove(found, self.eaten, factor)
            if "swapped" in self.kinds:
                self._swap(found, factor)
        return found

    def _displaced(self, amplitude: float) -> Labels:
        from scipy.ndimage import map_coordinates

        at = self.voxels.T.astype(float)
        growth: Points = np.zeros(len(self.voxels))
        if "displacement" in self.kinds:
            at = self.grid.to_grid(self.points + amplitude * self.shift).T[::-1]
            growth = 0.3 * amplitude * self.growth
        # outside of the volume there is no tissue
        distance = np.stack([
            map_coordinates(f, at, order=1, mode="constant", cval=float(f.max())) for f in self.fields
        ])
        inside = distance.min(axis=0) + growth < 0
        return np.where(inside, distance.argmin(axis=0) + 1, 0).astype(np.uint8)

    def _add_spurs(self, labels: Labels, factor: float) -> None:
        start, direction, length, leaflet = self.spurs
        for which in np.unique(leaflet):
            own = leaflet == which
            wide = np.full(own.sum(), 1.5 * self.grid.spacing)
            end = start[own] + factor * length[own, None] * direction[own]
            cones = Cones(start[own], end, wide, 0.5 * wide)
            inside = distance_field(self.grid, cones, 0.0).distance < 0
            labels[inside & (labels == 0)] = which + 1

    def _balls(self, balls: list[tuple[Points, float]]) -> Points:
        """For each voxel the factor on the radii of balls at which the first of them reaches it."""
        least = np.full(len(self.points), np.inf)
        for centre, radius in balls:
            if radius > 0:
                away = np.sqrt(((self.points - centre) ** 2).sum(axis=1))
                least = np.minimum(least, away / radius)
        return least

    def _remove(self, labels: Labels, reached: Points, factor: float) -> None:
        labels[tuple(self.voxels[reached < factor].T)] = 0

    def _swap(self, labels: Labels, factor: float) -> None:
        values = labels[tuple(self.voxels.T)]
        for centre, radius, side in self.swaps:
            d2 = ((self.points - centre) ** 2).sum(axis=1)
            inside = (d2 < (factor * radius) ** 2) & (values > 0)
            # the two leaflets that meet here: the two most frequent labels within 6 mm
            near = values[(d2 < 36.0) & (values > 0)]
            meeting = np.argsort(-np.bincount(near, minlength=3)[1:], kind="stable")[:2] + 1
            values[inside] = meeting[side]
        labels[tuple(self.voxels.T)] = values


def _draw_spurs(
    places: LeafletPlaces, random: np.random.Generator
) -> tuple[Points, Points, Points, NDArray[np.int64]]:
    """Eight fingers: where they start, their direction, length (mm) and leaflet."""
    chosen = random.choice(len(places.inner), 8)
    side = random.choice([-1.0, 1.0], 8)[:, None]
    direction = side * places.normals[chosen] + 0.5 * random.normal(size=(8, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return places.inner[chosen], direction, random.uniform(4.0, 8.0, 8), places.leaflet[chosen]


def _draw_holes(places: LeafletPlaces, random: np.random.Generator) -> list[tuple[Points, float]]:
    """Up to four balls on the leaflets, 8 mm apart or more, their radii in mm."""
    chosen: list[Points] = []
    for n in random.choice(len(places.inner), 40):
        centre = places.inner[n]
        if len(chosen) < 4 and all(np.linalg.norm(centre - c) >= HOLES_APART for c in chosen):
            chosen.append(centre)
    return list(zip(chosen, random.uniform(0.5, 1.2, len(chosen))))


def _draw_eaten(places: LeafletPlaces, random: np.random.Generator) -> list[tuple[Points, float]]:
    """Balls along four stretches of the free edge of 4 to 9 mm, smaller towards their ends."""
    balls = []
    for _ in range(4):
        centre = places.free_edge[random.integers(len(places.free_edge))]
        half, depth = random.uniform(2.0, 4.5), random.uniform(0.8, 1.8)
        away = np.linalg.norm(places.free_edge - centre, axis=1)
        for n in np.flatnonzero(away < half):
            balls.append((places.free_edge[n], depth * float(np.sqrt(1 - (away[n] / half) ** 2))))
    return balls
