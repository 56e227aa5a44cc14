"""Mid-surface of a thin sheet of tissue in a volume, sub-voxel, with the thickness at each point.

1. Height ridge (Eberly 1996) of the tissue after a Gaussian: the points where the derivative across
   the sheet is 0, by marching cubes. Holes and spurs smaller than the Gaussian do not appear.
2. The sheet ends where the blurred tissue falls to half of its value inside: at a straight rim, and 0.4
   thicknesses beyond the centre of a round one. The label of a real leaflet ends as a straight one does.
3. Lines across the sheet meet its two sides; each point moves to the middle of the two distances,
   whose sum is the thickness. Both are averaged over the surface within `smoothing`.

The core's mid-surface of a skin (libmvs/patient/skin/mid_surface.h) cannot take its place: it needs a skin with
two rims, which a closed leaflet by itself and most labels of networks do not have; see README.md.
"""

from __future__ import annotations

import dataclasses
from typing import Union

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError
from .grid import Grid, Points, Volume
from .mesh import Sheet, Smoothing, manifold, normals, smooth_rims, two_sided, unique_edges
from .needs import need
from .orientation import directions, neighbour_pairs, orient


@dataclasses.dataclass(frozen=True)
class SheetSettings:
    """Lengths in m.

    blur: standard deviation of the Gaussian of the ridge; less than half of the gap to other tissue
    smoothing: length over which thickness and middle are averaged along the surface
    rim: share of the blurred tissue at which the sheet ends
    most_thickness: lines that find no side within this distance count for nothing
    """

    blur: float
    smoothing: float
    rim: float = 0.5
    most_thickness: float = 5e-3


def mid_surface(grid: Grid, tissue: Volume, settings: SheetSettings) -> Sheet:
    """The mid-surface of all tissue (0 to 1, z, y, x); values "thickness" (m) and "measured" (0, 1).

    Pieces, holes and handles are left as they are. ArgumentError if there is no tissue.
    """
    ridge = ridge_of(grid, tissue, settings.blur, settings.rim)
    return between_sides(grid, tissue, ridge, settings)


def ridge_of(grid: Grid, tissue: Volume, blur: float, rim: float) -> Sheet:
    """The height ridge of the blurred tissue, ending at its rims."""
    if np.count_nonzero(tissue > 0.5) < 20:
        raise ArgumentError("the image has no sheet of tissue in it", "image")
    sigma = blur / grid.step
    # beyond three deviations of the tissue all fields are 0
    grid, tissue = grid.part(tissue, int(np.ceil(3 * sigma)) + 2)
    voxels = np.argwhere(tissue > 0.5)
    across = orient(directions(tissue, voxels, sigma), neighbour_pairs(tissue.shape, voxels))
    weight = gaussian(tissue, sigma)
    slope = np.zeros_like(weight)
    strength = np.zeros_like(weight)
    for axis in range(3):
        field = np.zeros_like(weight)
        field[tuple(voxels.T)] = across[:, axis]
        field = gaussian(field, sigma)
        order = [0, 0, 0]
        order[2 - axis] = 1
        slope += field * gaussian(tissue, sigma, order)
        strength += field * field
    strength = np.sqrt(strength)
    share = weight / _inner_weight(weight, sigma)
    # a little beyond the rim, at which the surface is cut afterwards; where opposite normals meet,
    # tissue of two sheets touches
    inside = (share > 0.5 * rim) & (strength > 0.3 * weight)
    height = slope / np.maximum(strength * weight, 1e-12)
    return _cut_at_rim(grid, _marching(grid, height, inside), share, rim)


def gaussian(field: Volume, sigma: float, order: Union[int, list[int]] = 0) -> Volume:
    """A Gaussian, or its derivatives, of a field that is 0 outside of its grid."""
    return np.asarray(need("scipy.ndimage").gaussian_filter(
        field, sigma, order=order, mode="constant", truncate=3))


def _inner_weight(weight: Volume, sigma: float) -> Volume:
    """The blurred tissue inside of the sheet: the largest value within three deviations, averaged."""
    size = 2 * int(np.ceil(3 * sigma)) + 1
    largest = need("scipy.ndimage").maximum_filter(weight, size)
    mean = gaussian(largest * weight, 2 * sigma)
    return np.maximum(mean / np.maximum(gaussian(weight, 2 * sigma), 1e-6), 1e-6)


def _marching(grid: Grid, height: Volume, inside: NDArray[np.bool_]) -> Sheet:
    if not (inside & (height > 0)).any() or not (inside & (height < 0)).any():
        raise ArgumentError("the image has no sheet of tissue in it", "image")
    measure = need("skimage.measure")
    points, triangles, _, _ = measure.marching_cubes(height, 0.0, mask=inside,
                                                     allow_degenerate=False)
    return Sheet(grid.place(points[:, ::-1]), triangles.astype(np.int64))


def _cut_at_rim(grid: Grid, sheet: Sheet, share: Volume, rim: float) -> Sheet:
    """The part of a sheet where `share` is at least `rim`, cut through triangles."""
    pyvista = need("pyvista")
    mesh = pyvista.PolyData.from_regular_faces(sheet.points * 1e3, sheet.triangles)
    mesh.point_data["share"] = grid.sample(share, sheet.points)
    mesh = mesh.clip_scalar(scalars="share", invert=False, value=rim).triangulate()
    # slivers of the cut and of marching cubes collapse
    mesh = mesh.clean(tolerance=0.25 * grid.step * 1e3, absolute=True, lines_to_points=False,
                      polys_to_lines=False, strips_to_polys=False)
    if not mesh.n_cells:
        raise ArgumentError("the image has no sheet of tissue in it", "image")
    triangles = mesh.regular_faces.astype(np.int64)
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    order = np.lexsort(np.sort(triangles, axis=1).T[::-1])
    corners = np.sort(triangles[order], axis=1)
    first = order[np.r_[True, (corners[1:] != corners[:-1]).any(axis=1)]]
    points = np.asarray(mesh.points, float) * 1e-3
    return Sheet(points, two_sided(manifold(triangles[np.sort(first)], points), points))


def between_sides(grid: Grid, tissue: Volume, sheet: Sheet, settings: SheetSettings) -> Sheet:
    """The sheet moved to the middle between the two sides of the tissue, with its thickness."""
    edges, _ = unique_edges(sheet.triangles)
    edge = np.linalg.norm(sheet.points[edges[:, 0]] - sheet.points[edges[:, 1]], axis=1).mean()
    passes = max(2, int(np.ceil(2 * (settings.smoothing / edge) ** 2)))
    smooth = Smoothing(sheet.triangles, len(sheet.points))
    points = sheet.points
    for _ in range(2):
        across = smooth(normals(points, sheet.triangles), max(2, passes // 4))
        across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
        sides = np.stack([side_distance(grid, tissue, points, sign * across,
                                        settings.most_thickness) for sign in (1, -1)])
        valid = _plausible(sides)
        valid &= _usual_there(sides, valid, smooth, 6 * passes)
        shift = np.zeros(len(points))
        shift[valid] = (sides[0][valid] - sides[1][valid]) / 2
        points = points + smooth(shift, passes, valid)[:, None] * across
    thickness = smooth(np.where(valid, sides.sum(axis=0), 0), passes, valid)
    # smoothing does not reach the middle of wide parts without a valid thickness
    unknown = thickness <= 0
    if unknown.any() and not unknown.all():
        near = need("scipy.spatial").cKDTree(points[~unknown]).query(points[unknown])[1]
        thickness[unknown] = thickness[~unknown][near]
    found = Sheet(points, sheet.triangles,
                  {**sheet.values, "thickness": thickness, "measured": valid.astype(float)})
    smooth_rims(found, max(2, passes // 2))
    return found


def _plausible(sides: Points) -> NDArray[np.bool_]:
    """False where a side was not found or is more than 2.5 times as far as usual: spurs, contact."""
    found = np.isfinite(sides).all(axis=0)
    total = np.where(found, sides.sum(axis=0), 0)
    if not found.any():
        raise ArgumentError("the image has no thin sheet of tissue: no two sides face each other",
                            "image")
    return np.asarray(found & (total < 2.5 * np.median(total[found])) & (total > 0))


def _usual_there(sides: Points, valid: NDArray[np.bool_], smooth: Smoothing,
                 passes: int) -> NDArray[np.bool_]:
    """False where the tissue is 1.4 times as thick as around: a chord or a spur stands on the sheet."""
    total = np.where(valid, sides.sum(axis=0), 0)
    around = np.minimum(smooth(total, passes, valid), 1.5 * np.median(total[valid]))
    around = smooth(total, passes, valid & (total < 1.25 * around))
    return np.asarray((total < 1.4 * around) | (around <= 0))


def side_distance(grid: Grid, tissue: Volume, points: Points, along: Points,
                  most: float) -> Points:
    """The distance (n,) in m from points inside the tissue to its side along unit vectors.

    Where the tissue falls to a half, interpolated; inf: not within `most`, or the point is outside.
    """
    step = 0.25 * grid.step
    reach = np.arange(0, most / 2 + step, step)
    distance = np.full(len(points), np.inf)
    before = grid.sample(tissue, points)
    open_rows = np.flatnonzero(before >= 0.5)
    before = before[open_rows]
    for far in reach[1:]:
        if not len(open_rows):
            break
        now = grid.sample(tissue, points[open_rows] + far * along[open_rows])
        left = now < 0.5
        share = (before[left] - 0.5) / np.maximum(before[left] - now[left], 1e-9)
        distance[open_rows[left]] = far - step + share * step
        open_rows, before = open_rows[~left], now[~left]
    return distance

