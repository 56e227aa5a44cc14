"""mvs.imaging: what the command refuses before the work: ranges in mm, outputs, options that contradict one another."""

import json
import re
import subprocess
import sys
from pathlib import Path

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
pytest.importorskip("slicerio", reason="needs the extra imaging (slicerio)")

from label_images import NAMES, funnel, image_of  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging import requests  # noqa: E402
from mvs.imaging.command import main, parser_of  # noqa: E402
from mvs.imaging.findings import RANGES, finding, read_known, with_limits  # noqa: E402
from mvs.imaging.leaflet_segments import choose_segments  # noqa: E402
from mvs.imaging.landmarks import anterior_on_label  # noqa: E402


@pytest.fixture(autouse=True)
def no_work(monkeypatch):
    """Nothing here may begin a segmentation or a build."""
    for name in ("leaflets_in", "build"):
        monkeypatch.setattr(requests, name, lambda *_a, **_o: pytest.fail("the work began"))


@pytest.fixture
def open_image(tmp_path):
    path = tmp_path / "open.nrrd"
    sitk.WriteImage(image_of(funnel(2.0)[0], 2.0), str(path))
    return path


def parsed(*more):
    return parser_of()[0].parse_args(["build", "a.nrrd", "-o", "a.h5", *more])


@pytest.mark.parametrize("option, value, words", [
    ("--thickness", "0", "0.1 to 5 mm"), ("--thickness", "nan", "0.1 to 5 mm"), ("--hole", "nan", "0 to 30 mm"),
    ("--hole", "-3", "0 to 30 mm"), ("--edge", "-1", "0.2 to 5 mm"), ("--coaptation-length", "99", "1 to 20 mm"),
    ("--chords", "5", "20 to 400"), ("--chords", "30.5", "whole number"), ("--edge-error", "1000", "0 to 5 mm"),
    ("--edge-lost", "-0.1", "0 to 5 mm"), ("--thickness-error", "2.5", "0 to 2 mm"), ("--closed-error", "6", "0 to 5 mm"), ("--edge", "wide", "0.2 to 5 mm"),
    ("--leaflet", "rubber", "known ones are spring, bilinear")])
def test_values_out_of_range_are_refused_in_mm(capsys, option, value, words):
    with pytest.raises(SystemExit) as ended:
        parsed(option, value)
    assert ended.value.code == 2
    said = capsys.readouterr().err
    assert f"argument {option}: {value}: " in said and words in said


def test_an_error_of_0_is_the_least_one_of_a_build():
    chosen = parsed("--edge-error", "0", "--edge-lost", "0", "--thickness-error", "0", "--closed-error", "0", "--thickness", "0.1",
                    "--chords", "400", "--leaflet", "prot")
    assert requests._options(chosen) == {"edge_error": 1e-6, "edge_lost": 1e-6, "thickness_error": 1e-6, "closed_error": 1e-6,
                                         "thickness": 1e-4, "chords": 400, "leaflet": "prot"}


def test_the_ranges_are_those_of_mvs_import():
    text = (Path(__file__).parents[3] / "bindings/cli/commands/import.cpp").read_text(encoding="utf-8")
    there = {}
    for chunk in text.split("add_option(")[1:]:
        name = re.search(r'"(?:-o,)?--([a-z-]+)"', chunk)
        ends = re.search(r'between\(([0-9.]+), ([0-9.]+)(, "mm")?\)', chunk)
        if name and ends and name[1] != "chord-slack":
            there[name[1].replace("-", "_")] = [float(end) * (1e-3 if ends[3] else 1) for end in ends.groups()[:2]]
    assert set(there) == set(RANGES)
    for name, ends in there.items():
        assert list(RANGES[name]) == pytest.approx(ends), name


def test_values_of_a_file_of_findings_are_refused_in_mm(tmp_path):
    path = tmp_path / "a.import.json"
    path.write_text('{"format": "libmvs import", "version": 1, "findings": [{"name": "edge_lost", "values": [0.5]}]}')
    with pytest.raises(mvs.FormatError, match="0.5 m: it has to be 0.001 to 5 mm"):
        read_known(path)


@pytest.mark.parametrize("outputs", [
    ["-o", "a.h5", "--report", "a.h5"], ["-o", "a.obj", "--findings", "a.obj"],
    ["-o", "a.h5", "--report", "a.import.json"], ["-o", "a.h5", "--findings", "b", "--report", "folder/../b"]])
def test_outputs_that_are_one_file_are_refused(tmp_path, capsys, open_image, outputs):
    (tmp_path / "folder").mkdir()
    placed = [one if one.startswith("-") else f"{tmp_path}/{one}" for one in outputs]
    before = sorted(tmp_path.iterdir())
    assert main([str(open_image), "--anterior-label", "1", "--posterior-label", "2", *placed, "--quiet"]) == 1
    assert "would be the same file, and one of them lost" in capsys.readouterr().err
    assert sorted(tmp_path.iterdir()) == before


def test_only_the_findings_may_replace_the_file_of_with(tmp_path, capsys, open_image):
    known = tmp_path / "a.import.json"
    known.write_text("{}")
    call = [str(open_image), "--with", str(known), "--quiet", "-o", str(tmp_path / "a.h5")]
    assert main(call) == 1
    assert "is no file of findings" in capsys.readouterr().err  # it went on, and read it
    assert main([*call[:-1], str(tmp_path / "b.h5"), "--report", str(known)]) == 1
    assert "is an input as well" in capsys.readouterr().err


@pytest.mark.parametrize("more, words", [
    (["--tips", "none.mrk.json"], "none.mrk.json: there is no such file"),
    (["--loaded", "none.nrrd"], "none.nrrd: there is no such file"),
    (["--with", "none.json"], "none.json: there is no such file"),
    (["--loaded-tips", "open.nrrd"], "--loaded-tips is about the loaded image"),
    (["--loaded-annulus", "open.nrrd"], "--loaded-annulus is about the loaded image"),
    (["--register", "landmarks"], "--register is about the loaded image"),
    (["--anterior-label", "1", "--posterior-label", "1"], 'are both "1"'),
    (["--anterior-label", "1", "--leaflet-label", "2"], "without --anterior-label"),
    (["--anterior-label", "1"], "--posterior-label as well"),
    (["--loaded", "open.nrrd", "--register", "image", "--anterior-label", "1", "--posterior-label", "2"],
     "needs grey volumes")])
def test_faulty_calls_are_refused_before_the_work(tmp_path, capsys, monkeypatch, open_image, more, words):
    monkeypatch.chdir(tmp_path)
    if words != "--posterior-label as well":
        monkeypatch.setattr(requests, "choose_segments", lambda *_: None)
    else:
        monkeypatch.setattr(requests, "leaflets_in", lambda labels, chosen, *_: choose_segments(labels, chosen))
    assert main([open_image.name, "-o", "a.h5", "--quiet", *more]) == 1
    assert words in capsys.readouterr().err


def test_the_other_leaflet_is_found_by_its_name():
    image = image_of(funnel(2.0)[0], 2.0)
    labels = imaging.labels_of(image, {1: "Segel 1", 2: "posterior leaflet"})
    assert choose_segments(labels, {"Segel 1": 1}) == {"Segel 1": 1, "posterior leaflet": 2}
    with pytest.raises(mvs.ArgumentError, match='the posterior leaflet alone is given, .*"Segel 1".*--anterior-label'):
        choose_segments(labels, {"posterior leaflet": 2})
    assert choose_segments(imaging.labels_of(image, NAMES), {NAMES[1]: 1}) == {NAMES[1]: 1, NAMES[2]: 2}


@pytest.mark.parametrize("more, words", [
    (["--anterior-label", "1"], "is a grey volume, and --anterior-label names a segment"),
    (["--hole", "5"], "--hole is about holes in labels"),
    (["--loaded", "open.nrrd"], "the loaded one a label map")])
def test_options_of_labels_are_refused_for_a_grey_volume(tmp_path, capsys, monkeypatch, open_image, more, words):
    pytest.importorskip("mvs.imaging.microct.valve")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("mvs.imaging.microct.valve.valve_of_volumes", lambda *_a, **_o: pytest.fail("the work began"))
    sitk.WriteImage(image_of(np.random.default_rng(0).random((30, 30, 30)).astype(np.float32), 1.0), "grey.nrrd")
    assert main(["grey.nrrd", "-o", "a.h5", "--quiet", *more]) == 1
    assert words in capsys.readouterr().err


def test_labels_of_many_organs_are_no_grey_volume(tmp_path, monkeypatch):
    """18 other parts in the corner: the map was segmented as a micro-CT, and --anterior-label was not used."""
    labels, _ = funnel(2.0)
    labels[0, 0, :18] = 10 + np.arange(18)
    sitk.WriteImage(image_of(labels, 2.0), str(tmp_path / "many.nrrd"))
    seen = []
    monkeypatch.setattr(requests, "leaflets_in", lambda image, chosen, *_: seen.append((len(image.masks), chosen)) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main([str(tmp_path / "many.nrrd"), "--anterior-label", "1", "--posterior-label", "2", "--quiet",
              "-o", str(tmp_path / "a.h5")])
    assert seen == [(20, {"1": 1, "2": 2})]


def points_file(path, points):
    rows = [{"id": str(k), "position": [float(c) for c in p], "positionStatus": "defined"} for k, p in enumerate(points)]
    path.write_text(json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "coordinateUnits": "mm",
                                             "controlPoints": rows}]}))
    return str(path)


@pytest.mark.parametrize("given, words", [
    ({"--tips": [[12, 0, -20], [12, 0, -20]]}, "points 1 and 2 lie at one place"),
    ({"--commissures": [[12, 0, 0]]}, "commissures: 1 point given: a mitral valve has two"),
    ({"--anterior": [[0, 12, 0], [0, 11, 0]]}, "anterior: 2 points given"),
    ({"--tips": [[12, 0, -20], [-12, 0, -20]], "--loaded-tips": [[12, 0, -20]]}, "--loaded-tips has 1")])
def test_numbers_of_landmarks_are_checked_before_images_are_read(tmp_path, capsys, open_image, given, words):
    call = [str(open_image), "--loaded", str(open_image), "-o", str(tmp_path / "a.h5"), "--quiet"]
    for option, points in given.items():
        call += [option, points_file(tmp_path / f"{option[2:]}.mrk.json", points)]
    assert main(call) == 1
    assert words in capsys.readouterr().err


def test_an_anterior_point_on_the_posterior_label_is_a_doubtful_finding():
    centres, leaflet = np.array([[0, 0.01, 0], [0, -0.01, 0]]), np.array([1, 2], np.uint32)
    assert anterior_on_label(np.array([[0, 0.012, 0]]), centres, leaflet) == ()
    (found,) = anterior_on_label(np.array([[0, -0.012, 0]]), centres, leaflet)
    assert found.doubtful and "exchange --anterior-label and --posterior-label" in found.sentence
    assert anterior_on_label(np.array([[0, -0.012, 0]]), centres, 0 * leaflet) == ()


def test_libraries_below_write_nothing_before_the_sentence(tmp_path):
    """GDCM and ITK warned of files that are not theirs."""
    for k in range(3):
        (tmp_path / f"{k}.dcm").write_bytes(bytes(128) + b"DICM" + bytes(range(200)))
    (tmp_path / "a.nrrd").write_bytes(b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 30 30 30\nencoding: raw\n\nshort")
    for image in (tmp_path, tmp_path / "a.nrrd"):
        done = subprocess.run([sys.executable, "-m", "mvs.imaging", str(image), "-o", str(tmp_path / "a.h5"), "--quiet"],
                              capture_output=True, text=True)
        assert done.returncode == 1
        assert done.stderr.startswith("mvs-image: ") and done.stderr.count("\n") == 1


def test_guessed_landmarks_are_named_as_left_out_of_the_interval_of_leaks():
    """Also those of an earlier run, which a build takes for given."""
    def findings(tips, said=""):
        return [finding("papillary_tips", tips, 0.2, ""), finding("leak_interval", mvs.FindingSource.MEASURED, 1, said, [0, 1]),
                finding("leak_limits", mvs.FindingSource.ASSUMED, 1, "")]

    _, interval, limits = with_limits(findings(mvs.FindingSource.ASSUMED))
    assert "errors of the papillary heads, which were not given" in interval.sentence
    assert "errors of the guessed papillary heads are not in it" in limits.sentence
    assert [one.sentence for one in with_limits(findings(mvs.FindingSource.GIVEN))] == ["", "", ""]
    again = with_limits(with_limits(findings(mvs.FindingSource.GUESSED)))
    assert again[1].sentence.count("not given") == again[2].sentence.count("errors of") == 1


def test_options_without_effect_beside_chordae_of_an_image_are_named():
    from mvs.imaging.microct.valve import _unused

    assert _unused({"thickness_error": 1e-4, "edge": 2e-3}) == ()
    (one,) = _unused({"edge_error": 1e-4, "chords": 50})
    assert one.doubtful and one.sentence.startswith("--edge-error, --chords have no effect here")


def test_maps_of_probabilities_are_refused_and_grey_volumes_are_not(tmp_path):
    """A map of 0 to 1 was taken for a micro-CT."""
    image = image_of((funnel(0.7)[0] > 0).astype(np.float32), 0.7)
    map_of = sitk.DiscreteGaussian(image, 0.2)
    noise = np.random.default_rng(0).normal(scale=0.05, size=image.GetSize()[::-1]).astype(np.float32)
    grey = sitk.GetImageFromArray(np.clip(0.6 * sitk.GetArrayFromImage(map_of) + noise, 0, 1))
    grey.CopyInformation(image)
    for volume, refused in ((map_of, True), (grey, False), (map_of * 900 + 100, False)):
        sitk.WriteImage(volume, str(tmp_path / "a.nii.gz"))
        if refused:
            with pytest.raises(mvs.ArgumentError, match="a map of probabilities, 0 to 1.*threshold it at 0.5 to labels"):
                requests._image(tmp_path / "a.nii.gz", parsed())
        else:
            assert not isinstance(requests._image(tmp_path / "a.nii.gz", parsed()), imaging.LabelMap)
