"""Errors of labels: symmetric surface distances and overlap of each leaflet's label with the true one.

Surfaces are the voxels of a label with a face neighbour outside of it. mean: the mean of the two
directed mean distances; hd95: the larger of the two directed 95th percentiles; dice: of the voxels.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from ...describe import with_field_help


@with_field_help
@dataclasses.dataclass(frozen=True)
class LabelStatistics:
    """Errors of the label of one leaflet, or their means over leaflets."""

    name: Annotated[str, "1", "name of the leaflet"]
    mean: Annotated[float, "mm", "mean symmetric surface distance"]
    hd95: Annotated[float, "mm", "95 % Hausdorff distance"]
    dice: Annotated[float, "1", "overlap of the voxels"]


def statistics_of(
    labels: NDArray[np.uint8], truth: NDArray[np.uint8], names: tuple[str, ...], spacing: float
) -> list[LabelStatistics]:
    """The errors of the labels 1, 2, ... of some names, and last their means, named "mean"."""
    rows = [_of_one(labels == k, truth == k, name, spacing) for k, name in enumerate(names, 1)]
    means = (float(np.mean([getattr(row, field) for row in rows])) for field in ("mean", "hd95", "dice"))
    return [*rows, LabelStatistics("mean", *means)]


def _of_one(
    label: NDArray[np.bool_], truth: NDArray[np.bool_], name: str, spacing: float
) -> LabelStatistics:
    from scipy.spatial import cKDTree

    a, b = surface_voxels(label) * spacing, surface_voxels(truth) * spacing
    if not len(a) or not len(b):
        return LabelStatistics(name, float("inf"), float("inf"), 0.0)
    there, back = cKDTree(b).query(a)[0], cKDTree(a).query(b)[0]
    return LabelStatistics(
        name, float(there.mean() + back.mean()) / 2,
        float(max(np.percentile(there, 95), np.percentile(back, 95))),
        float(2 * np.count_nonzero(label & truth) / (label.sum() + truth.sum())),
    )


def surface_voxels(label: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Indices (n, 3) of the voxels of a label with a face neighbour outside of it."""
    voxels = np.argwhere(label)
    if not len(voxels):
        return voxels.astype(float)
    low: NDArray[np.int64] = voxels.min(axis=0)
    cut = np.pad(label[tuple(slice(a, b + 1) for a, b in zip(low, voxels.max(axis=0)))], 1)
    inner = cut.copy()
    for axis in range(3):
        inner &= np.roll(cut, 1, axis) & np.roll(cut, -1, axis)
    return (np.argwhere(cut & ~inner) - 1 + low).astype(float)
