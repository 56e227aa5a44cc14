"""Segmentation of a micro-CT-like volume: tissue, thick parts, leaflets; then what remains is chordae."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError
from ..grid import Grid, Volume, crop, isotropic
from ..needs import need

Mask = NDArray[np.bool_]
EVERYWHERE = np.ones((3, 3, 3), bool)


@dataclasses.dataclass(frozen=True, eq=False)
class Tissue:
    """Share of tissue (0 to 1) on cubic voxels around the valve, and the mask of the largest component."""

    grid: Grid
    share: Volume
    mask: Mask
    background: float
    foreground: float

    def __str__(self) -> str:
        volume = self.mask.sum() * (self.grid.step * 1e3) ** 3
        return (f"{volume:.0f} mm3 of tissue on {self.grid.shape} voxels of {self.grid.step * 1e3:.3g} "
                f"mm; grey values {self.background:.3g} and {self.foreground:.3g}")


@dataclasses.dataclass(frozen=True, eq=False)
class Thick:
    """Parts thicker than leaflets and chordae: label 1, 2, ... of each; the radius that parts them, m; the
    usual thickness of the tissue, m.
    """

    label: NDArray[np.int32]
    count: int
    radius: float
    usual: float = 0.8e-3

    def __str__(self) -> str:
        return f"{self.count} parts thicker than {2e3 * self.radius:.1f} mm"


@dataclasses.dataclass(frozen=True, eq=False)
class LeafletMask:
    """The voxels of the leaflets."""

    mask: Mask
    pieces: int

    def __str__(self) -> str:
        return f"{int(self.mask.sum())} voxels, largest of {self.pieces} flat pieces"


def tissue_of(results: Mapping[str, Any]) -> Tissue:
    """Otsu's threshold (1979), hysteresis between 0.4 and 0.7 of the contrast, largest component."""
    sitk = need("SimpleITK")
    image = results["image"]
    values = sitk.GetArrayFromImage(sitk.DiscreteGaussian(image, (0.7 * min(image.GetSpacing())) ** 2))
    background, foreground = levels(values)
    contrast = foreground - background
    hysteresis = need("skimage.filters").apply_hysteresis_threshold
    mask = hysteresis(values, background + 0.4 * contrast, background + 0.7 * contrast)
    label, count = need("scipy.ndimage").label(mask, EVERYWHERE)
    size = np.bincount(label.ravel())
    size[0] = 0
    mask = label == size.argmax()
    del values, label
    marked = sitk.GetImageFromArray(mask.astype(np.uint8))
    marked.CopyInformation(image)
    step = min(image.GetSpacing()) * 1e-3
    margin = 1.5e-3
    grid, share = isotropic(crop(image, mask, margin), step, background)
    _, whole = isotropic(crop(marked, mask, margin), step, 0.0, linear=False)
    np.clip((share - background) / contrast, 0, 1, out=share)
    near = need("scipy.ndimage").binary_dilation(whole > 0.5, EVERYWHERE)
    share[~near] = 0
    return Tissue(grid, share, whole > 0.5, background, foreground)


def levels(values: Volume) -> tuple[float, float]:
    """The grey values of background and tissue; ArgumentError where there are no two."""
    sample = values.ravel()[:: max(1, values.size // 2_000_000)]
    threshold = need("skimage.filters").threshold_otsu(sample)
    low, high = sample[sample <= threshold], sample[sample > threshold]
    background, spread = float(np.median(low)), float(np.median(np.abs(low - np.median(low))))
    share = len(high) / len(sample)
    # partial voxels lie in between: the upper half of the tissue is inside
    foreground = float(np.percentile(high, 60))
    if foreground - background < 6 * spread or not 1e-4 < share < 0.6:
        raise ArgumentError(
            f"no valve is seen in the image: {100 * share:.2g} % of it is brighter than the rest, by "
            f"{(foreground - background) / max(spread, 1e-30):.1f} times the noise. Give a volume in "
            "which tissue is bright and background dark, or a label map", "image")
    return background, foreground


def thick_parts(results: Mapping[str, Any]) -> Thick:
    """Opening with a ball: papillary muscles and the wall around the annulus."""
    image = need("scipy.ndimage")
    tissue: Tissue = results["tissue"]
    step = tissue.grid.step
    depth = image.distance_transform_edt(tissue.mask).astype(np.float32) * step
    ridge = tissue.mask & (depth == image.maximum_filter(depth, 3)) & (depth < 1.5e-3)
    usual = float(np.median(depth[ridge])) if ridge.any() else 0.4e-3
    radius = max(1.1e-3, 1.7 * usual)
    core = depth > radius
    label, count = image.label(core, EVERYWHERE)
    if not count:
        return Thick(np.zeros(core.shape, np.int32), 0, radius, 2 * usual - step)
    grown = label.copy()
    around = np.argwhere(tissue.mask & ~core)
    away, nearest = nearest_voxels(core, around, radius / step + 1)
    found = np.isfinite(away)
    grown[tuple(around[found].T)] = label[tuple(nearest[found].T)]
    size = np.bincount(grown.ravel(), minlength=count + 1) * step**3
    kept = np.flatnonzero(size[1:] > 15e-9) + 1
    number = np.zeros(count + 1, np.int32)
    number[kept] = np.arange(1, len(kept) + 1)
    return Thick(number[grown], len(kept), radius, 2 * usual - step)


def nearest_voxels(mask: Mask, voxels: NDArray[np.int64],
                   reach: float = np.inf) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """For voxels (n, 3) outside of a mask the distance of its nearest voxel, in voxels, and that voxel;
    inf: not within `reach`. By the voxels on its border: a distance transform of the whole takes longer.
    """
    image = need("scipy.ndimage")
    border = np.argwhere(mask & ~image.binary_erosion(mask))
    away, row = need("scipy.spatial").cKDTree(border).query(voxels, distance_upper_bound=reach + 1e-6)
    return away, border[np.where(np.isfinite(away), row, 0)]


def leaflets_of(results: Mapping[str, Any]) -> LeafletMask:
    """Flat tissue by second moments in a Gaussian window; webs of chordae, narrower than 3 mm, removed
    by an opening within the sheet; the largest piece, grown to its rims. Under load ("loaded") all large pieces:
    where both leaflets touch tissue is thick and may part them.
    """
    image = need("scipy.ndimage")
    tissue: Tissue = results["tissue"]
    step = tissue.grid.step
    thin = tissue.mask & (results["thick"].label == 0)
    factor = max(1, int(round(0.25e-3 / step)))
    coarse = blocks(thin, factor)
    cell = factor * step
    # a plate of thickness h has flatness 1 - h^2 / (12 sigma^2): 0.77 in this window, so that thick and
    # blurred leaflets are as flat as those of 1 mm
    sigma = max(0.6e-3, 0.6 * results["thick"].usual)
    flat = (flatness(coarse, sigma / cell) > 0.58) & (coarse > 0.25)
    wide = opened(flat, 1.6e-3 / cell)
    label, count = image.label(wide, EVERYWHERE)
    if not count:
        raise ArgumentError("no leaflet is seen in the image: no tissue is flat", "image")
    size = np.bincount(label.ravel())
    size[0] = 0
    inner = np.isin(label, large_pieces(size) if results.get("loaded") else size.argmax())
    # back to what the opening took at the rims, and to the rims themselves
    inner = image.binary_dilation(inner, EVERYWHERE, iterations=int(np.ceil(1.2e-3 / cell)), mask=flat)
    seeds = thin & blown_up(inner, factor, thin.shape)
    grown = image.binary_dilation(seeds, EVERYWHERE, iterations=int(round(0.8e-3 / step)), mask=thin)
    return LeafletMask(grown, int((size > 0.05 * size.max()).sum()))


LARGE_PIECE = 0.15
"""A piece of the loaded leaflets has at least this share of the largest: a posterior leaflet that only its coaptation
joins to the anterior one has a third of its area and more."""


def large_pieces(size: NDArray[Any]) -> NDArray[np.int64]:
    """The numbers of the pieces that have at least LARGE_PIECE of the size of the largest."""
    return np.flatnonzero(size >= LARGE_PIECE * size.max())


def opened(flat: Mask, radius: float) -> Mask:
    """Opening of a sheet of voxels within itself: points with little of the sheet around them go.

    A plane of one voxel fills pi r^2 voxels of a ball, a half plane half of it, and a web of the width
    r a third: those below 0.6 of the usual go first, then what is within r of the rest comes back.
    """
    image = need("scipy.ndimage")
    amount = image.gaussian_filter(flat.astype(np.float32), radius, truncate=3)
    usual = float(np.median(amount[flat])) if flat.any() else 0.0
    return np.asarray(flat & (amount > 0.6 * usual))


def blown_up(mask: Mask, factor: int, shape: tuple[int, ...]) -> Mask:
    """Each voxel of a coarse mask as factor^3 voxels, cut to a shape."""
    for axis in range(3):
        mask = np.repeat(mask, factor, axis)
    return mask[tuple(slice(0, n) for n in shape)]


def blocks(mask: Mask, factor: int) -> Volume:
    """Means over blocks of factor^3 voxels."""
    pad = [(0, -n % factor) for n in mask.shape]
    whole = np.pad(mask, pad)
    a, b, c = (n // factor for n in whole.shape)
    return np.asarray(whole.reshape(a, factor, b, factor, c, factor).mean(axis=(1, 3, 5), dtype=np.float32))


def flatness(share: Volume, sigma: float) -> Volume:
    """(Second - third) / first eigenvalue of the covariance of the tissue in a Gaussian window.

    Near 1 in a plane, some 0.2 at a straight rim, 0 in a cable.
    """
    image = need("scipy.ndimage")
    weight = image.gaussian_filter(share, sigma, truncate=3)
    at = np.argwhere(share > 0)
    rows = tuple(at.T)
    inverse = 1 / np.maximum(weight[rows], 1e-6)
    # moments about the voxel itself, by derivatives of the Gaussian (y - x turns into sigma^2 d/dx)
    first = [sigma**2 * _derivative(share, sigma, [axis])[rows] * inverse
             for axis in range(3)]
    moment = np.empty((len(at), 3, 3), np.float32)
    for a in range(3):
        for b in range(a, 3):
            second = sigma**4 * _derivative(share, sigma, [a, b])[rows] * inverse
            if a == b:
                second = second + sigma**2
            moment[:, a, b] = moment[:, b, a] = second - first[a] * first[b]
    values = np.linalg.eigvalsh(moment)
    result = np.zeros_like(share)
    result[rows] = (values[:, 1] - values[:, 0]) / np.maximum(values[:, 2], 1e-6)
    return result


def _derivative(share: Volume, sigma: float, axes: list[int]) -> Volume:
    order = [0, 0, 0]
    for axis in axes:
        order[axis] += 1
    return np.asarray(need("scipy.ndimage").gaussian_filter(share, sigma, order=order, truncate=4))
