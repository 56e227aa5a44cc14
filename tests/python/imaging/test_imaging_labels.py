"""mvs.imaging: label maps become mid-surfaces of leaflets; faults are refused with a sentence."""

import re
import types
from pathlib import Path

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
pytest.importorskip("slicerio", reason="needs the extra imaging (slicerio)")

from label_images import NAMES, VOXEL, funnel, image_of  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging import mesh, open_valve  # noqa: E402
from mvs.imaging.page import distance_histogram  # noqa: E402
from mvs.imaging.requests import edge_of_labels, thickness_of_labels  # noqa: E402
from mvs.imaging.tissue_sheet import fitted_sheet, grid_step, tissue_on_grid  # noqa: E402
from mvs.imaging.valve import check_closed, distance_from_image, distances_from_image, weighted_percentile  # noqa: E402

def away_from_cone(points):
    """Distance (mm) of points from the cone's mid-surface."""
    x, y, z = 1e3 * points.T
    along = np.array([-8, -16]) / np.hypot(8, 16)
    return (np.hypot(x, y) - 16) * along[1] - (z - 8) * along[0]


def found_in(labels, **more):
    return imaging.leaflets_in(imaging.labels_of(image_of(labels), NAMES), **more)


def test_the_mid_surface_of_labels_is_sub_voxel_and_has_its_thickness():
    found = found_in(funnel()[0])
    away = away_from_cone(found.sheet.points)
    # voxels are 0.7 mm: a tenth of one
    assert np.sqrt((away**2).mean()) < 0.07
    thickness = found.sheet.values["thickness"] * 1e3
    assert np.percentile(np.abs(thickness - 1.4), 95) < 0.15 * 1.4
    imaging.check_open_valve(found)
    loops = mesh.boundary_loops(found.sheet.triangles)
    lengths = sorted(mesh.loop_length(found.sheet.points, loop) * 1e3 for loop in loops)
    # both rims are circles of radius 8 and 16 mm
    assert lengths == pytest.approx([2 * np.pi * 8, 2 * np.pi * 16], rel=0.06)
    share = np.bincount(found.leaflet) / len(found.leaflet)
    assert share[1:] == pytest.approx([0.5, 0.5], abs=0.03)


@pytest.mark.parametrize("ends, beyond", [("flat", 0.0), ("round", 0.4)])
def test_the_sheet_ends_with_flat_tissue_and_beyond_the_middle_of_round_ends(ends, beyond):
    """In thicknesses, where blurred tissue falls to a half: from the end of a slab that is cut flat, from the
    centre of a half circle at its end. Both rims of labels 2.8 mm thick in voxels of 0.7 mm."""
    thickness = 2.8
    found = found_in(funnel(thickness=thickness, ends=ends)[0])
    along = np.array([-8, -16]) / np.hypot(8, 16)
    for loop in mesh.boundary_loops(found.sheet.triangles):
        x, y, z = 1e3 * found.sheet.points[loop].T
        share = ((np.hypot(x, y) - 16) * along[0] + (z - 8) * along[1]).mean()
        away = max(-share, share - np.hypot(8, 16))
        # a fifth of a voxel
        assert away == pytest.approx(beyond * thickness, abs=0.14)


def test_noise_holes_spurs_and_islands_move_the_surface_less_than_half_a_voxel():
    labels, at = funnel(seed=1)
    hole = np.linalg.norm(at - [0, 12, 0], axis=-1) < 1.5
    labels[hole] = 0
    spur = (np.hypot(at[..., 1], at[..., 2]) < 1) & (at[..., 0] > 12) & (at[..., 0] < 15.5)
    labels[spur] = 1
    labels[:3, :3, :3] = 2
    found = found_in(labels)
    imaging.check_open_valve(found)
    away = away_from_cone(found.sheet.points)
    assert np.sqrt((away**2).mean()) < 0.35
    assert "islands" in {one.name for one in found.findings}


def test_labels_swapped_near_a_commissure_are_given_back():
    labels, at = funnel()
    swapped = (np.linalg.norm(at - [10, 6, -2], axis=-1) < 2.5) & (labels > 0)
    labels[swapped] = 2
    found = found_in(labels)
    assert "swapped_labels" in {one.name for one in found.findings}
    for label in (1, 2):
        rows = found.sheet.triangles[found.leaflet == label]
        assert len(np.unique(mesh.pieces(rows, len(found.sheet.points)))) == 1


def slit(labels, at, row):
    """Labels without tissue 2.1 mm high and 14 mm wide in the anterior leaflet, `row` mm down it."""
    along = np.array([-8, -16]) / np.hypot(8, 16)
    share = (np.hypot(at[..., 0], at[..., 1]) - 16) * along[0] + (at[..., 2] - 8) * along[1]
    found = labels.copy()
    found[(np.abs(share - row) < 1.05) & (np.abs(at[..., 0]) < 7) & (at[..., 1] > 0)] = 0
    return found


def test_slits_above_the_free_edge_are_closed_in_the_labels():
    """The leaflets are 17.9 mm high: two voxels of tissue are left below the slit."""
    labels, at = funnel()
    found = found_in(slit(labels, at, 15.2))
    closed = {one.name: one for one in found.findings}["closed_gaps"]
    assert closed.source == mvs.FindingSource.GUESSED and "ragged holes" in closed.sentence
    imaging.check_open_valve(found)  # no long hole is left
    assert len(mesh.boundary_loops(found.sheet.triangles)) == 2
    away = away_from_cone(found.sheet.points)
    assert np.sqrt((away**2).mean()) < 0.35  # half a voxel


def test_a_ring_that_is_torn_from_annulus_to_free_edge_is_closed():
    """Labels that lack a stretch at a commissure: the sheet had one rim, and the image was refused as a closed valve."""
    labels, at = funnel()
    labels[(np.abs(at[..., 0]) < 0.8) & (at[..., 1] < 0)] = 0  # two voxels
    found = found_in(labels)
    imaging.check_open_valve(found)
    (gap,) = [one for one in found.findings if one.name == "closed_gaps"]
    assert gap.source == mvs.FindingSource.GUESSED and "a tear" in gap.sentence
    assert np.sqrt((away_from_cone(found.sheet.points) ** 2).mean()) < 0.35  # half a voxel
    assert len(mesh.boundary_loops(found.sheet.triangles)) == 2


def without_strip(found, leaflets):
    """The sheet without a strip 9 mm wide in the middle of one leaflet, or across a commissure."""
    x, y, z = 1e3 * found.sheet.points[found.sheet.triangles].mean(axis=1).T
    across = np.abs(x if leaflets == 1 else y) < 4.5
    side = (y if leaflets == 1 else x) > 0
    kept = ~(across & side & (np.abs(z + 5) < 1))
    found.sheet, found.leaflet = found.sheet.part(kept), found.leaflet[kept]
    return found


def test_long_holes_in_one_leaflet_are_left_to_the_build_which_fills_them():
    labels, _ = funnel()
    found = without_strip(found_in(labels), 1)
    imaging.check_open_valve(found)
    tips = np.array([[12e-3, 0, -20e-3], [-12e-3, 0, -20e-3]])
    made = imaging.build(found, {"papillary_tips": tips}, edge=3.2e-3)
    filled = {one.name: one for one in made.findings}["filled_holes"]
    assert filled.source == mvs.FindingSource.GUESSED and filled.confidence == 0.5
    assert len(filled.values) == 1 and filled.values[0] > 22e-3  # the rim of a hole of 7 mm
    with pytest.raises(mvs.ArgumentError, match="3 rims.*joins the leaflets"):
        imaging.check_open_valve(without_strip(found_in(labels), 2))


def test_limits_of_long_holes_are_those_of_the_build():
    """A hole that the image leaves to the build and the build refuses would be refused with the wrong sentence."""
    surface = Path(__file__).parents[3] / "libmvs" / "patient" / "surface"
    text = "".join((surface / name).read_text(encoding="utf-8") for name in ("holes.cpp", "holes.h"))
    there = dict(re.findall(r"\b(long_hole_share|long_hole_area|other_leaflet) = ([0-9.e-]+)", text))
    assert {name: float(value) for name, value in there.items()} == {
        "long_hole_share": open_valve.LONG_HOLE_SHARE, "long_hole_area": open_valve.LONG_HOLE_AREA,
        "other_leaflet": open_valve.OTHER_LEAFLET}


def refused(labels, words, **more):
    with pytest.raises(mvs.Error, match=words) as caught:
        found = found_in(labels, **more)
        imaging.check_open_valve(found)
    assert len(str(caught.value)) > 40


def test_faults_of_label_maps_are_refused_with_a_sentence():
    labels, at = funnel()
    refused(np.zeros_like(labels), "no valve in it")
    refused(np.where(labels == 1, 1, 0).astype(np.uint8), "one leaflet is missing")
    one = imaging.labels_of(image_of(np.where(labels == 1, 1, 0).astype(np.uint8)), NAMES)
    one.masks[NAMES[2]] = np.zeros_like(one.masks[NAMES[1]])
    with pytest.raises(mvs.ArgumentError, match='the segment "posterior leaflet" has no voxels'):
        imaging.leaflets_in(one)
    apart = labels.copy()
    apart[np.abs(at[..., 0]) < 1.5] = 0
    refused(apart, "2 disconnected pieces")
    closed = labels.copy()
    closed[(np.abs(at[..., 2] + 7) < 0.8) & (np.hypot(at[..., 0], at[..., 1]) < 9)] = 1
    refused(closed, "closed in this image")
    torn = labels.copy()
    torn[np.linalg.norm(at - [0, 12, 0], axis=-1) < 5] = 0
    refused(torn, "rims")
    numbers = imaging.labels_of(image_of(labels))
    with pytest.raises(mvs.ArgumentError, match='say which ones.*--anterior-label'):
        imaging.leaflets_in(numbers)
    with pytest.raises(mvs.ArgumentError, match='no segment "x".*"1", "2"'):
        imaging.leaflets_in(numbers, {"x": 1})


@pytest.mark.parametrize("share, words", [(0.3, "surface of a sheet of .* cm2.*noise"),
                                          (0.02, "disconnected pieces, the largest of which has .*no segmentation")])
def test_noise_is_refused_before_work_on_its_surface(share, words, monkeypatch):
    """Noise of 120^3 voxels took minutes: its surface has a thousand times the triangles of a valve's."""
    random = np.random.default_rng(2)
    noise = np.where(random.random((120, 120, 120)) < share, random.integers(1, 3, (120, 120, 120)), 0)
    monkeypatch.setattr("mvs.imaging.tissue_sheet.mid_surface", lambda *_: pytest.fail("the surface was made"))
    with pytest.raises(mvs.ArgumentError, match=words):
        found_in(noise.astype(np.uint8))


def test_the_open_image_given_as_the_loaded_one_is_refused():
    """No lengths of chordae follow from it; half a voxel of another phase is no closure either."""
    labels, _ = funnel()
    leaflets = imaging.leaflets_in(imaging.labels_of(image_of(labels)), {"1": 1, "2": 2})
    same = leaflets.sheet
    with pytest.raises(mvs.ArgumentError, match="open valve was given as the loaded one"):
        imaging.build(leaflets, {}, same)
    moved = mesh.Sheet(same.points + [0, 0, 3e-3], same.triangles)
    check_closed(moved, same)


def test_the_histogram_of_the_page_shows_the_distance_of_the_table(monkeypatch):
    """Both count the points of both surfaces, each surface by a half."""
    axes = pytest.importorskip("matplotlib.axes")
    with mvs.Simulator() as sim:
        sim.generate()
        closed = sim.snapshot()
    part = np.asarray(closed.triangle_nodes)[::7]  # the other way leads to the gaps as well
    loaded = mesh.Sheet(np.asarray(closed.node_position) + [0, 0, 1e-3], part)
    drawn, axvline = [], axes.Axes.axvline
    shown, hist = [], axes.Axes.hist
    monkeypatch.setattr(axes.Axes, "hist", lambda self, *given, **how: shown.append(hist(self, *given, **how)[:2]))
    monkeypatch.setattr(axes.Axes, "axvline",
                        lambda self, x, **how: (drawn.append(x), axvline(self, x, **how)))
    distance_histogram(types.SimpleNamespace(closed=closed, loaded=loaded))
    assert drawn == [pytest.approx(1e3 * distance_from_image(closed, loaded).values[0])]
    ((counts, bins),) = shown
    away, weights = distances_from_image(closed, loaded)
    assert counts.sum() == pytest.approx(100)  # nothing is cut off
    assert bins[-1] == pytest.approx(max(2, 1e3 * away.max()))
    within = distance_from_image(closed, loaded).values[1]
    assert weights[away <= within].sum() >= 0.95 > weights[away < within].sum()


def test_a_percentile_of_two_surfaces_does_not_depend_on_their_numbers_of_points():
    """Of 1,000 points at 1 mm and 10 at 3 mm, each group with a half of the weight, half lie within 1 mm."""
    values = np.repeat([1e-3, 3e-3], [1000, 10])
    weights = np.repeat([0.5 / 1000, 0.5 / 10], [1000, 10])
    assert weighted_percentile(values, weights, 50) == 1e-3
    assert weighted_percentile(values, weights, 95) == weighted_percentile(values, weights, 100) == 3e-3
    assert weighted_percentile(np.arange(20.0), np.ones(20), 95) == 18


@pytest.mark.parametrize(("voxel", "lost"), [(0.2e-3, 1.4e-3), (0.7e-3, 1.4e-3), (1e-3, 2e-3), (4e-3, 5e-3)])
def test_fine_labels_may_lack_as_much_of_the_free_edge_as_coarse_ones(voxel, lost):
    """The errors of networks are lengths, not voxels; above 5 mm a build refuses the value."""
    found = edge_of_labels(voxel)
    assert found["edge_lost"].values[0] == pytest.approx(lost)
    assert f"{1e3 * lost:.2f} mm" in found["edge_lost"].sentence
    assert found["edge_error"].values[0] == pytest.approx(voxel / 2)


def test_a_real_closed_leaflet_agrees_with_the_medial_surface_of_another_program(real_valves):
    """Half a voxel RMS, from each point of the other surface (cm-rep) that is not on its rim.

    Its label image is signed; its medial surface has the frame RAS of NIfTI files.
    """
    pyvista = pytest.importorskip("pyvista")
    folder = real_valves / "real_mitral"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    found, voxel = imaging.sheet_of_image(imaging.read_volume(folder / "closed_anterior_label.nii.gz"))
    other = pyvista.read(folder / "closed_anterior_medial.vtk").triangulate()
    points = np.asarray(other.points, float) * [-1, -1, 1]
    ours = pyvista.PolyData.from_regular_faces(found.points * 1e3, found.triangles)
    _, closest = ours.find_closest_cell(points, return_closest_point=True)
    away = np.linalg.norm(points - closest, axis=1)
    assert np.sqrt((away**2).mean()) < 0.5 * voxel * 1e3
    rim = np.concatenate(mesh.boundary_loops(other.regular_faces.astype(np.int64)))
    inner = ~np.isin(np.arange(len(points)), rim)
    # away from the rims, where the two programs end the sheet differently, a third of a voxel
    assert np.sqrt((away[inner] ** 2).mean()) < voxel * 1e3 / 3
    # the real label ends as a slab that is cut flat: with round ends ours would be 0.4 thicknesses
    # (1 mm) longer on all sides. Measured: rims of 97 and 94 mm, 6 % more area
    longest = max(mesh.boundary_loops(found.triangles), key=len)
    area = mesh.areas(points, other.regular_faces.astype(np.int64)).sum()
    assert mesh.loop_length(1e3 * found.points, longest) == pytest.approx(mesh.loop_length(points, rim), rel=0.04)
    assert 1e6 * mesh.areas(found.points, found.triangles).sum() == pytest.approx(area, rel=0.08)


def test_the_thickness_of_wide_labels_is_measured_that_of_narrow_ones_assumed():
    def widths(width):
        points = np.random.default_rng(0).normal(size=(50, 3))
        return mesh.Sheet(points, np.zeros((0, 3), np.int64), {"thickness": np.full(50, width)})

    wide = thickness_of_labels(widths(2.45e-3), VOXEL * 1e-3)
    assert set(wide) == {"thickness_error"}
    assert wide["thickness_error"].values[0] == pytest.approx(VOXEL * 0.5e-3)
    narrow = thickness_of_labels(widths(1.4e-3), VOXEL * 1e-3)
    assert narrow["thickness"].values[0] == 0.8e-3
    assert narrow["thickness_error"].values[0] == 0.25e-3
    # tissue is not thicker than its label
    assert thickness_of_labels(widths(0.6e-3), VOXEL * 1e-3)["thickness"].values[0] == 0.6e-3


@pytest.mark.parametrize("radius", [None, 8.0])
@pytest.mark.parametrize("polar, azimuth", [(0.3, 0.2), (0.785, 0.0), (0.955, 0.785)])
def test_the_thickness_of_a_slab_does_not_depend_on_its_angle(radius, polar, azimuth):
    """Flat and spherical slabs 2 mm thick in voxels of 0.7 mm; at 45 degrees and along the diagonal the
    sides are stairs of one voxel."""
    n = 20
    z, y, x = np.meshgrid(*[(np.arange(n) - n / 2 + 0.5) * VOXEL] * 3, indexing="ij")
    normal = np.array([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])
    place = np.stack([x, y, z], -1)
    if radius is None:
        height = place @ normal
    else:
        height = np.linalg.norm(place + radius * normal, axis=-1) - radius
    mask = (np.abs(height - 0.2 * VOXEL) < 1.0) & (np.linalg.norm(place, axis=-1) < 6.5)
    image = sitk.GetImageFromArray(mask.astype(np.uint8))
    image.SetSpacing([VOXEL] * 3)
    image.SetOrigin([float(-n / 2 + 0.5) * VOXEL] * 3)
    grid, tissue = tissue_on_grid(image, mask, grid_step(image, mask))
    sheet = fitted_sheet(grid, tissue, VOXEL * 1e-3)
    inner = np.linalg.norm(sheet.points, axis=1) < 3e-3
    # a sixth of a voxel: the sides of a slab that small meet few phases of the grid
    assert np.median(sheet.values["thickness"][inner]) * 1e3 == pytest.approx(2.0, abs=VOXEL / 6)
