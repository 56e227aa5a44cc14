"""mvs.imaging: grids as fine as the tissue needs, distances without a transform of the volume, progress."""

import io

import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
pytest.importorskip("slicerio", reason="needs the extra imaging (slicerio)")

from mvs import imaging  # noqa: E402
from mvs.imaging.console import Console  # noqa: E402
from mvs.imaging.mesh import edges_with_triangles, two_sided, unique_edges  # noqa: E402
from mvs.imaging.microct.segment import nearest_voxels  # noqa: E402
from mvs.imaging.tissue_sheet import fitted_sheet, grid_step, tissue_on_grid, width_of  # noqa: E402


def shell(voxel, thickness=1.4, radius=12.0):
    """Half a spherical shell (mm) around the origin, and its image."""
    n = int(30 / voxel)
    z, y, x = np.meshgrid(*[(np.arange(n) - n / 2 + 0.5) * voxel] * 3, indexing="ij")
    mask = (np.abs(np.sqrt(x * x + y * y + z * z) - radius) < thickness / 2) & (z > 0)
    image = sitk.GetImageFromArray(mask.astype(np.uint8))
    image.SetSpacing([voxel] * 3)
    image.SetOrigin([(0.5 - n / 2) * voxel] * 3)
    return mask, image


@pytest.mark.parametrize("voxel", [0.25, 0.7])
def test_the_width_of_tissue_is_seen_in_its_voxels(voxel):
    mask, _ = shell(voxel)
    # the rim of the half shell adds 6 % of faces, voxels of half the width some more
    assert width_of(mask, np.full(3, voxel * 1e-3)) == pytest.approx(1.4e-3, rel=0.12)


def test_wide_tissue_gets_a_coarser_grid_with_the_same_mid_surface():
    found = {}
    for voxel in (0.25, 0.7):
        mask, image = shell(voxel)
        step = grid_step(image, mask)
        # 1.4 mm are 5.6 and 2 voxels
        assert step == pytest.approx(voxel * (1e-3 if voxel == 0.25 else 0.5e-3))
        grid, tissue = tissue_on_grid(image, mask, step)
        sheet = fitted_sheet(grid, tissue, voxel * 1e-3)
        inner = sheet.points[:, 2] > 1e-3
        away = np.linalg.norm(sheet.points[inner], axis=1) - 12e-3
        found[voxel] = np.sqrt((away**2).mean())
        # a sixth of a voxel, as with the half voxels that were used for all labels
        assert found[voxel] < voxel * 1e-3 / 6
        assert np.median(sheet.values["thickness"]) == pytest.approx(1.4e-3, abs=voxel * 1e-3 / 6)


def test_nearest_voxels_are_those_of_a_distance_transform():
    image = pytest.importorskip("scipy.ndimage")
    random = np.random.default_rng(3)
    mask = image.gaussian_filter(random.normal(size=(30, 25, 20)), 2) > 0.05
    voxels = np.argwhere(~mask)
    away, nearest = nearest_voxels(mask, voxels)
    assert away == pytest.approx(image.distance_transform_edt(~mask)[~mask], abs=1e-9)
    assert mask[tuple(nearest.T)].all()
    assert np.linalg.norm(nearest - voxels, axis=1) == pytest.approx(away, abs=1e-9)
    near, _ = nearest_voxels(mask, voxels, 2)
    assert (np.isfinite(near) == (away <= 2)).all()


def test_numbered_edges_are_those_of_pairs():
    triangles = np.random.default_rng(1).integers(0, 40, (200, 3))
    expected, count = np.unique(np.sort(edges_with_triangles(triangles)[0], axis=1), axis=0,
                                return_counts=True)
    found, uses = unique_edges(triangles)
    assert (found == expected).all() and (uses == count).all()


def test_a_signed_label_image_is_one_segment():
    mask, _ = shell(0.7)
    image = sitk.SmoothingRecursiveGaussian(
        sitk.GetImageFromArray(np.where(mask, 1, -1).astype(np.float32)), 0.3)
    image.SetSpacing([0.7] * 3)
    labels = imaging.reading.labels_of(image)
    assert imaging.reading.is_label_map(image)
    assert list(labels.masks) == ["1"] and (labels.masks["1"] == mask).mean() > 0.99
    grey = sitk.GetImageFromArray(np.random.default_rng(0).normal(size=(40, 40, 40)).astype(np.float32))
    assert not imaging.reading.is_label_map(grey)


def test_progress_is_shown_where_no_terminal_is():
    stream = io.StringIO()
    console = Console(stream=stream)
    console.stage("closing")
    for done in np.linspace(0, 1, 101):
        console.share(done)
    console.done()
    lines = [line.split("]")[1].strip() for line in stream.getvalue().splitlines()]
    assert lines[0] == "closing" and len(lines) == 6 and lines[-1] == "100 %"
    console = Console(quiet=True, stream=(silent := io.StringIO()))
    console.stage("closing")
    console.share(0.5)
    assert silent.getvalue() == ""


def test_strips_with_half_a_turn_are_opened_and_nothing_else():
    """A sheet from labels had one: it was refused as a Moebius band."""
    row, column = np.meshgrid(np.arange(9), np.arange(9), indexing="ij")
    points = np.stack([row, column, 0 * row], -1).reshape(-1, 3).astype(float)
    number = np.arange(81).reshape(9, 9)
    cells = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1).reshape(-1, 4)
    # a band from one side of the square to the other, joined there the wrong way round
    beyond = 81 + np.arange(40).reshape(20, 2)
    places = np.stack([np.full(40, 4.5), np.repeat(np.linspace(8, 0, 22)[1:-1], 2), np.tile([3.0, 4.0], 20)], -1)
    ladder = np.vstack([number[4:6, 8], beyond, number[4:6, 0][::-1]])
    band = np.column_stack([ladder[:-1, 0], ladder[1:, 0], ladder[1:, 1], ladder[:-1, 1]])
    points = np.vstack([points, places])

    def halved(quads):
        return np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int64)

    square, twisted = halved(cells), np.vstack([halved(cells), halved(band)])
    assert np.array_equal(two_sided(square, points), square)
    mended = two_sided(twisted, points)
    assert 0 < len(twisted) - len(mended) <= 2
    assert np.array_equal(mended[: len(square)], square)  # the band is opened, where the walks meet
    assert np.array_equal(two_sided(mended, points), mended)
    # a wide band is twisted as a whole: it is left to be refused
    wide = np.arange(20 * 12).reshape(20, 12)
    ring = np.vstack([wide, wide[0, ::-1][None]])
    quads = np.stack([ring[:-1, :-1], ring[1:, :-1], ring[1:, 1:], ring[:-1, 1:]], -1).reshape(-1, 4)
    moebius = halved(quads)
    assert np.array_equal(two_sided(moebius, np.random.default_rng(3).normal(size=(240, 3))), moebius)
