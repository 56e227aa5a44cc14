"""Makes a phantom: the true valve, then an open and a loaded volume with labels and landmarks."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ..._core import Snapshot
from ...arrays import Valve
from .anatomy import Anatomy, anatomy_of
from .grid import Grid, around
from .images import Shares, micro_ct_image, reflection_of, ultrasound_image
from .label_errors import FlawedLabels, LeafletPlaces, with_errors
from .labels import label_names, leaflet_fields, leaflet_labels, with_other_parts
from .landmarks import LandmarkSet, commissure_nodes, landmarks_of
from .rasterise import Solid, coverage, distance_field, sub_voxels
from .settings import Settings
from .truth import MM, Progress, Truth, leaflet_nodes, true_valve

Matrix = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Volume:
    """One volume of a phantom: the input of a recovery, and the truth.

    image, labels: SimpleITK.Image; landmarks: by name, in mm, LPS; label_names: of 1, 2, ...
    true_labels: SimpleITK.Image, without errors; flaws: of the labels, None if they are exact
    placement: (4, 4), from the frame of the truth to that of the image, in mm
    snapshot, anatomy: the true valve and its solids, in the frame of the truth
    """

    image: Any
    labels: Any
    landmarks: dict[str, LandmarkSet]
    label_names: tuple[str, ...]
    true_labels: Any
    flaws: Optional[FlawedLabels]
    placement: Matrix
    snapshot: Snapshot
    anatomy: Anatomy


@dataclasses.dataclass(frozen=True)
class Phantom:
    """A phantom: its settings, the true valve, the open volume and, unless left out, the loaded one."""

    settings: Settings
    truth: Truth
    opened: Volume
    loaded: Optional[Volume]


def make(
    valve: Union[Valve, Snapshot], settings: Settings, *, loaded: bool = True,
    progress: Progress = None,
) -> Phantom:
    """Makes a phantom of a valve; the same valve and settings give the same bits.

    loaded: also the valve closed under the pressure of the settings
    progress: called with a stage and the share of it that is done; may raise to stop
    """
    # refuse a volume that is too large before the valve is closed
    opened = true_valve(valve, dataclasses.replace(settings, vertices=0), loaded=False).opened
    _grid_of(opened, anatomy_of(opened, settings), settings, _placement(settings, 0))
    truth = true_valve(valve, settings, loaded, progress)
    volumes = [_volume(truth.opened, settings, 0, progress)]
    if truth.closed is not None:
        volumes.append(_volume(truth.closed, settings, 1, progress))
    return Phantom(settings, truth, volumes[0], volumes[1] if loaded else None)


def _volume(snapshot: Snapshot, settings: Settings, stage: int, progress: Progress) -> Volume:
    name = ("open", "loaded")[stage]

    def done(share: float) -> None:
        if progress:
            progress(f"{name} volume", share)

    done(0.0)
    anatomy = anatomy_of(snapshot, settings)
    placement = _placement(settings, stage)
    grid = _grid_of(snapshot, anatomy, settings, placement)
    image, parts = _image_and_parts(grid, anatomy, settings, stage, done)
    fields = leaflet_fields(grid, anatomy, settings)
    done(0.85)
    exact, count = leaflet_labels(fields), len(anatomy.leaflets)
    flaws = None
    if settings.labels.kinds:
        random = np.random.default_rng([settings.seed, 6, stage])
        places = places_of(snapshot)
        flaws = with_errors(grid, fields, anatomy.names, places, settings.labels, random)
    placed = _placed(grid, placement)
    labels = with_other_parts(exact if flaws is None else flaws.labels, parts, count)
    landmarks = {
        key: dataclasses.replace(value, points=_apply(placement, value.points))
        for key, value in landmarks_of(snapshot, anatomy, settings, stage).items()
    }
    done(1.0)
    return Volume(
        placed.image(image), placed.image(labels), landmarks, label_names(anatomy, settings),
        placed.image(with_other_parts(exact, parts, count)), flaws, placement, snapshot, anatomy,
    )


def _image_and_parts(
    grid: Grid, anatomy: Anatomy, settings: Settings, stage: int, done: Callable[[float], None]
) -> tuple[NDArray[Any], Optional[list[NDArray[np.bool_]]]]:
    """The grey values, and the voxels of chordae, muscles and wall if labels have them."""
    solids: list[tuple[str, Solid]] = [("leaflet", sheet) for sheet in anatomy.leaflets]
    solids += [("muscles", anatomy.muscles), ("chordae", anatomy.chords), ("wall", anatomy.wall)]
    reach = max(np.sqrt(3) * settings.spacing, 0.3)
    shares, inside = Shares(grid), {}
    elements: list[NDArray[np.int32]] = []
    for n, (name, solid) in enumerate(solids):
        field = distance_field(grid, solid, reach)
        shares.add(name, coverage(grid, solid, field, sub_voxels(settings.spacing, solid)))
        if name == "leaflet":
            if settings.kind == "ultrasound":
                elements.append(field.element)
        else:
            inside[name] = field.distance < 0
        done(0.1 + 0.5 * (n + 1) / len(solids))
    image: NDArray[Any]
    if settings.kind == "ultrasound":
        reflection = reflection_of(grid, anatomy.leaflets, elements, settings)
        image = ultrasound_image(grid, shares, reflection, settings, stage)
    else:
        image = micro_ct_image(grid, shares, settings, stage)
    done(0.75)
    order = ("chordae", "muscles", "wall")
    return image, [inside[name] for name in order] if settings.chords_seen else None


def _placement(settings: Settings, stage: int) -> Matrix:
    """The rigid motion from the frame of the truth to that of an image, in mm; open: none."""
    from .truth import pose_of

    move = np.eye(4)
    if stage and settings.misplaced > 0:
        random = np.random.default_rng([settings.seed, 7])
        move[:3, :3] = _rotation(random.normal(size=3), np.radians(settings.misplaced))
        centre = MM * pose_of(settings)[:3, 3]
        shift = random.normal(size=3)
        shift *= settings.misplaced / np.linalg.norm(shift)
        move[:3, 3] = centre - move[:3, :3] @ centre + shift
    return move


def _grid_of(snapshot: Snapshot, anatomy: Anatomy, settings: Settings, placement: Matrix) -> Grid:
    """The grid in the frame of the truth; its axes after placement are those of the image."""
    axes = np.eye(3)
    if settings.kind == "ultrasound":
        ap, cc, axis = snapshot.frame.axes
        axes = np.stack([cc, np.cross(-axis, cc), -axis], axis=1)
    if settings.tilt > 0:
        random = np.random.default_rng([settings.seed, 8])
        angle = np.radians(settings.tilt) * random.uniform()
        axes = _rotation(random.normal(size=3), angle) @ axes
    points = [anatomy.leaflets[0].points[leaflet_nodes(snapshot)], anatomy.tips]
    turn = placement[:3, :3]
    return around(
        np.concatenate(points), settings.spacing, settings.margin, turn.T @ axes, settings.max_voxels
    )


def grid_of(volume: Volume, settings: Settings) -> Grid:
    """The grid of a volume in the frame of the truth."""
    return _grid_of(volume.snapshot, volume.anatomy, settings, volume.placement)


def _placed(grid: Grid, placement: Matrix) -> Grid:
    return dataclasses.replace(
        grid, origin=_apply(placement, grid.origin[None])[0], axes=placement[:3, :3] @ grid.axes
    )


def _apply(move: Matrix, points: Matrix) -> Matrix:
    return np.asarray(points @ move[:3, :3].T + move[:3, 3])


def _rotation(axis: Matrix, angle: float) -> Matrix:
    """The rotation about an axis (Rodrigues)."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def places_of(snapshot: Snapshot) -> LeafletPlaces:
    """Points of the leaflets at which labels get errors."""
    nodes = MM * np.asarray(snapshot.node_position)
    triangles = np.asarray(snapshot.triangle_nodes).astype(np.int64)
    edges = np.sort(
        np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1
    )
    edges, used = np.unique(edges, axis=0, return_counts=True)
    rim = np.unique(edges[used == 1])
    free = np.setdiff1d(rim, np.asarray(snapshot.annulus_nodes))
    centres = nodes[triangles].mean(axis=1)
    normals = np.cross(
        nodes[triangles[:, 1]] - nodes[triangles[:, 0]], nodes[triangles[:, 2]] - nodes[triangles[:, 0]]
    )
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    inner = ~np.isin(triangles, rim).any(axis=1)
    return LeafletPlaces(
        centres[inner], normals[inner], np.asarray(snapshot.triangle_leaflet).astype(int)[inner],
        nodes[free], nodes[commissure_nodes(snapshot)],
    )
