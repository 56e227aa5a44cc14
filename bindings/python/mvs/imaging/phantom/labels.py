"""True labels of a valve: one number for each leaflet, then chordae, papillary muscles, annulus wall.

A voxel has the label of the solid that holds its centre; of several the first in the order leaflets
(the deeper one), papillary muscles, chordae, wall.
"""

from __future__ import annotations

import dataclasses
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from .anatomy import Anatomy
from .distance import Sheet
from .grid import Grid
from .rasterise import Field, distance_field
from .settings import Settings

Labels = NDArray[np.uint8]
OTHERS = ("chordae", "papillary muscles", "annulus wall")


def label_names(anatomy: Anatomy, settings: Settings) -> tuple[str, ...]:
    """The names of the labels 1, 2, ..."""
    usual = {"A": "anterior leaflet", "P": "posterior leaflet"}
    leaflets = tuple(usual.get(name.upper(), f"{name} leaflet") for name in anatomy.names)
    return leaflets + (OTHERS if settings.chords_seen else ())


def labelled_sheets(anatomy: Anatomy, settings: Settings) -> tuple[Sheet, ...]:
    """The leaflets as they are labelled: at least label_width voxels thick."""
    least = settings.label_width * settings.spacing / 2
    return tuple(
        dataclasses.replace(sheet, half=np.maximum(sheet.half, least)) for sheet in anatomy.leaflets
    )


def leaflet_fields(grid: Grid, anatomy: Anatomy, settings: Settings) -> list[Field]:
    """Distances to the labelled leaflets up to two voxels outside of them."""
    reach = 2 * settings.spacing
    return [distance_field(grid, sheet, reach) for sheet in labelled_sheets(anatomy, settings)]


def leaflet_labels(fields: list[Field]) -> Labels:
    """1, 2, ... inside of the leaflets, 0 elsewhere."""
    distance = np.stack([field.distance for field in fields])
    nearest = distance.argmin(axis=0)
    return np.where(distance.min(axis=0) < 0, nearest + 1, 0).astype(np.uint8)


def with_other_parts(
    labels: Labels, parts: Optional[list[NDArray[np.bool_]]], leaflet_count: int
) -> Labels:
    """The labels of leaflets with those of [chordae, muscles, wall] where there is no leaflet."""
    if parts is None:
        return labels
    found = labels.copy()
    for k in (1, 0, 2):
        found[(found == 0) & parts[k]] = leaflet_count + 1 + k
    return found
