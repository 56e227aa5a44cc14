"""Motion of papillary muscles between the open and the loaded image, by block matching of the tissue."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..loaded import Motion
from ..needs import need
from .graph import Muscles
from .segment import EVERYWHERE, Tissue

Points = NDArray[np.float64]
SAME_MUSCLE = 8e-3
"""m: heads nearer to each other are on one papillary muscle: the two muscles lie 15 mm or more apart"""
BLOCK = 4e-3
"""m: tissue so far from the middle of the heads is compared: the tip of a muscle, which also turns"""
SEARCH, STEPS = 6e-3, (1.5e-3, 0.75e-3, 0.4e-3, 0.2e-3, 0.1e-3)
"""m: largest motion that is looked for; distances of the positions that are tried, one after the other"""
SAMPLES = 4000
"""Voxels of a block that are compared at most: enough for a tenth of a voxel, and fast"""


def muscle_groups(heads: Points) -> NDArray[np.int64]:
    """The papillary muscle 0, 1, ... of each head: single linkage."""
    if len(heads) < 2:
        return np.zeros(len(heads), np.int64)
    hierarchy = need("scipy.cluster.hierarchy")
    return np.asarray(hierarchy.fcluster(hierarchy.linkage(heads), SAME_MUSCLE, "distance") - 1, np.int64)


def head_shifts(heads: Points, opened: Mapping[str, Any], loaded: Mapping[str, Any],
                motion: Motion) -> Points:
    """The motion (n, 3) of each head, m: that translation of its muscle with the least sum of squared
    differences between the shares of tissue in both images; 0 where that is at the end of the search.

    opened, loaded: the stages "tissue" and "muscles" of both; motion: from the loaded frame to the open one
    """
    shifts = np.zeros((len(heads), 3))
    group = muscle_groups(heads)
    for one in range(int(group.max(initial=-1)) + 1):
        rows = group == one
        shifts[rows] = _block_shift(_block_around(heads[rows].mean(axis=0), opened), opened["tissue"],
                                    loaded["tissue"], motion)
    return shifts


def _block_around(middle: Points, opened: Mapping[str, Any]) -> Points:
    """Voxels of a muscle and around it, near a point; at most SAMPLES of them, evenly chosen."""
    tissue: Tissue = opened["tissue"]
    muscles: Muscles = opened["muscles"]
    wide = need("scipy.ndimage").binary_dilation(muscles.mask, EVERYWHERE, iterations=3)
    at = tissue.grid.place(np.argwhere(wide)[:, ::-1])
    at = at[np.linalg.norm(at - middle, axis=1) < BLOCK]
    return np.asarray(at[:: max(1, len(at) // SAMPLES)])


def _block_shift(at: Points, opened: Tissue, loaded: Tissue, motion: Motion) -> Points:
    if not len(at):
        return np.zeros(3)
    wanted = opened.grid.sample(opened.share, at)

    def difference(shift: Points) -> float:
        own = (at + shift - motion.shift) @ motion.turn
        return float(((loaded.grid.sample(loaded.share, own) - wanted) ** 2).sum())

    best, least = np.zeros(3), difference(np.zeros(3))
    for step in STEPS:
        reach = int(round(SEARCH / step)) if step == STEPS[0] else 1
        side = step * np.arange(-reach, reach + 1)
        for shift in best + np.stack(np.meshgrid(side, side, side), -1).reshape(-1, 3):
            value = difference(shift)
            if value < least:
                best, least = shift, value
    return best if np.abs(best).max() < SEARCH - STEPS[0] / 2 else np.zeros(3)
