"""Phantom volumes: grey values, label errors against those asked for, places, files, refusals."""

import dataclasses
import json

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK")
cKDTree = pytest.importorskip("scipy.spatial").cKDTree

from mvs.imaging import phantom  # noqa: E402
from mvs.imaging.phantom import __main__ as program  # noqa: E402
from mvs.imaging.phantom import images, label_errors, label_statistics, labels  # noqa: E402
from mvs.imaging.phantom import rasterise, volumes as make  # noqa: E402

BARE = {"noise": 0.0, "bias": 0.0, "blur": (0.0, 0.0)}
QUICK = {"vertices": 0, "spacing": 0.8}


@pytest.fixture(scope="module")
def valve():
    with mvs.Simulator() as sim:
        sim.generate(vertices=200)
        return sim.snapshot()


@pytest.fixture(scope="module")
def echo(valve):
    """An ultrasound-like phantom with every error of labels, turned and moved."""
    return phantom.make(valve, phantom.ultrasound(vertices=0, seed=3, pose=True), loaded=False)


@pytest.fixture(scope="module")
def scanned(valve):
    """A coarse micro-CT-like phantom, open and loaded."""
    return phantom.make(valve, phantom.micro_ct(**QUICK, seed=1))


def test_grey_values_hold_the_volume_of_the_tissue(valve):
    settings = phantom.micro_ct(**QUICK, **BARE, thickness_variation=0.0)
    made = phantom.make(valve, settings, loaded=False).opened
    values = sitk.GetArrayFromImage(made.image).astype(float) - images.BACKGROUND
    labels = sitk.GetArrayFromImage(made.labels)
    # without noise and blur no voxel holds more than full tissue; voxels are as wide as a leaflet
    assert values.min() == 0 and values.max() <= images.ATTENUATION["chordae"]
    assert np.median(values[labels == 1]) > 0.75 * images.ATTENUATION["leaflet"]
    grid, shares = _grid(made.image), images.Shares(_grid(made.image))
    for sheet in made.anatomy.leaflets:
        field = rasterise.distance_field(grid, sheet, 1.0)
        shares.add("leaflet", rasterise.coverage(grid, sheet, field, 3))
    found = sum(float(part.share.sum(dtype=float)) for part in shares.parts) * 0.8**3
    area, rim = made.snapshot.measures.leaflet_area * 1e6, _rim_length(made.snapshot)
    # tissue overlaps inside of folds: the more, the coarser the mesh; 3 % on this one
    assert found == pytest.approx(0.8 * area + np.pi * 0.4**2 / 2 * rim, rel=0.03)


def _rim_length(snapshot):
    triangles = np.asarray(snapshot.triangle_nodes).astype(int)
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), 1)
    edges, used = np.unique(edges, axis=0, return_counts=True)
    nodes = 1e3 * np.asarray(snapshot.node_position)
    rim = edges[used == 1]
    return np.linalg.norm(nodes[rim[:, 0]] - nodes[rim[:, 1]], axis=1).sum()


def _grid(image):
    from mvs.imaging.phantom.grid import Grid

    axes = np.array(image.GetDirection()).reshape(3, 3)
    return Grid(image.GetSize(), image.GetSpacing()[0], np.array(image.GetOrigin()), axes)


def test_the_same_seed_gives_the_same_bits(valve, echo):
    again = phantom.make(valve, echo.settings, loaded=False).opened
    for kind in ("image", "labels"):
        first, second = (sitk.GetArrayFromImage(getattr(v, kind)) for v in (echo.opened, again))
        assert np.array_equal(first, second)
    assert np.array_equal(echo.opened.landmarks["tips"].points, again.landmarks["tips"].points)


def test_another_seed_gives_another_volume(valve, scanned):
    settings = dataclasses.replace(scanned.settings, seed=2)
    first = sitk.GetArrayFromImage(scanned.opened.image)
    other = sitk.GetArrayFromImage(phantom.make(valve, settings, loaded=False).opened.image)
    assert first.shape == other.shape and (first != other).mean() > 0.9


def test_labels_have_the_errors_that_were_asked_for(echo):
    wanted, flaws = echo.settings.labels, echo.opened.flaws
    assert flaws.reached(wanted)
    measured = label_statistics.statistics_of(
        sitk.GetArrayFromImage(echo.opened.labels),
        sitk.GetArrayFromImage(echo.opened.true_labels), ("A", "P"), echo.settings.spacing,
    )
    # measured again on the images; "reached" allows a tenth, as voxels make both figures jump
    assert measured[-1].mean == pytest.approx(wanted.mean, rel=0.1)
    assert measured[-1].hd95 == pytest.approx(wanted.hd95, rel=0.1)


@pytest.fixture(scope="module")
def fields(echo):
    """The grid of the ultrasound-like phantom, distances to its leaflets, and places of errors."""
    grid = make.grid_of(echo.opened, echo.settings)
    places = make.places_of(echo.opened.snapshot)
    return grid, labels.leaflet_fields(grid, echo.opened.anatomy, echo.settings), places


@pytest.mark.parametrize("kind", phantom.LABEL_ERRORS)
def test_each_kind_of_error_does_what_it_says(fields, kind):
    grid, distances, places = fields
    wanted = phantom.LabelErrors(kinds=(kind,), mean=0.4, hd95=2.5)
    found = label_errors.with_errors(
        grid, distances, ("A", "P"), places, wanted, np.random.default_rng(5)
    )
    exact, flawed = labels.leaflet_labels(distances), found.labels
    added, gone = (exact == 0) & (flawed > 0), (exact > 0) & (flawed == 0)
    changed = (exact > 0) & (flawed > 0) & (exact != flawed)
    expected = {
        "displacement": (True, True), "spurs": (True, False), "holes": (False, True),
        "eaten": (False, True), "swapped": (False, False),
    }[kind]
    assert (added.any(), gone.any()) == expected
    if kind != "displacement":
        assert changed.any() == (kind == "swapped")
    if kind == "eaten":
        where = grid.to_patient(np.argwhere(gone)[:, ::-1].astype(float))
        near = np.linalg.norm(where[:, None] - places.free_edge, axis=2).min(axis=1)
        # the largest ball has a radius of 1.8 mm times the factor that was found
        assert near.max() <= 1.8 * found.factor + 1e-9


def test_volumes_lie_where_the_valve_is(echo, scanned):
    for made in (echo.opened, scanned.opened, scanned.loaded):
        nodes = 1e3 * np.asarray(made.snapshot.node_position)
        inside = np.unique(np.asarray(made.snapshot.triangle_nodes))
        placed = nodes[inside] @ made.placement[:3, :3].T + made.placement[:3, 3]
        voxels = np.argwhere(sitk.GetArrayFromImage(made.true_labels) > 0)
        grid = _grid(made.true_labels)
        away = cKDTree(grid.to_patient(voxels[:, ::-1].astype(float))).query(placed)[0]
        # a mid-surface lies in tissue, its nearest voxel 0.48 spacings away on average
        # (that of random points); 0.9 if the volume were moved by a voxel
        assert away.max() < np.sqrt(3) * grid.spacing and away.mean() < 0.6 * grid.spacing


def test_landmarks_are_files_that_libmvs_reads(scanned, tmp_path):
    phantom.save(scanned, tmp_path)
    ring = mvs.read_landmarks(tmp_path / "open_annulus.mrk.json")
    assert ring.frame == "LPS" and ring.unit == "mm" and len(ring) == 24
    nodes = np.asarray(scanned.opened.snapshot.node_position)
    annulus = nodes[scanned.opened.snapshot.annulus_nodes]
    away = np.linalg.norm(ring.points[:, None] - annulus, axis=2).min(axis=1)
    # between the annulus' own nodes, which are up to 3 mm apart here
    assert away.max() < 1.6e-3
    ends = mvs.read_landmarks(tmp_path / "loaded_commissures.mrk.json")
    assert ends.names == ("posteromedial", "anterolateral")
    tips = mvs.read_landmarks(tmp_path / "open_tips.mrk.json")
    assert len(tips) == 2


def test_files_are_read_by_slicerio_and_hide_the_truth(scanned, tmp_path):
    slicerio = pytest.importorskip("slicerio")
    written = phantom.save(scanned, tmp_path)
    assert all(path.is_file() for path in written)
    found = slicerio.read_segmentation(str(tmp_path / "open.seg.nrrd"))
    names = [segment["name"] for segment in found["segments"]]
    assert names == list(scanned.opened.label_names)
    assert names[:2] == ["anterior leaflet", "posterior leaflet"]
    truth = json.loads((tmp_path / "truth" / "truth.json").read_text())
    assert len(truth["open"]["chords"]) == len(scanned.truth.opened.chord_nodes)
    with mvs.Simulator() as sim:
        sim.load(tmp_path / "truth" / "loaded.h5")
        assert sim.snapshot().at_rest
    outside = [path.name for path in tmp_path.iterdir() if path.is_file()]
    assert not any(name.endswith((".h5", ".obj")) or "truth" in name for name in outside)


@pytest.mark.parametrize("arguments, sentence", [
    (["--spacing", "0"], "spacing is 0 mm; it must be between"),
    (["--spacing", "0.03"], "voxels, more than 150,000,000; take"),
    (["--spacing", "nan"], "spacing is nan mm"),
    (["--noise", "-1"], "noise is -1"),
    (["--label-errors", "spurs,worms"], "'worms' is no error of labels"),
    (["--blur", "1", "2", "3"], "one or two widths"),
    (["--seed", "-1"], "seed must be 0 or more"),
    (["--valve", "missing.obj"], "missing.obj"),
    (["--valve", "missing.obj", "--annulus-ap", "30"], "for a parametric valve"),
])
def test_absurd_requests_are_refused_with_a_sentence(monkeypatch, capsys, tmp_path, arguments, sentence):
    out = tmp_path / "out"
    monkeypatch.setattr("sys.argv", ["phantom", "-o", str(out), "--quiet", *arguments])
    assert program.main() == 1
    error = capsys.readouterr().err
    assert error.startswith("phantom: ") and sentence in error
    assert not out.exists()


def test_the_command_prints_the_measured_errors(monkeypatch, capsys, tmp_path):
    given = ["--kind", "ultrasound", "--spacing", "1", "--vertices", "0", "--open-only",
             "--annulus-ap", "24", "--label-errors", "spurs,holes"]
    monkeypatch.setattr("sys.argv", ["phantom", "-o", str(tmp_path), "--json", *given])
    assert program.main() == 0
    output = capsys.readouterr()
    facts = json.loads(output.out)
    assert [row["leaflet"] for row in facts["open"]["label_errors"]] == ["A", "P", "mean"]
    assert facts["open"]["label_errors"][-1]["hd95_mm"] == pytest.approx(3.6, rel=0.1)
    assert "open volume" in output.err
    assert (tmp_path / "open.nrrd").is_file() and not (tmp_path / "loaded.nrrd").exists()
