"""mvs.imaging: formats of volumes, label maps and landmarks; frames; the command on files."""

import json
import re
import subprocess
import sys

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
pytest.importorskip("slicerio", reason="needs the extra imaging (slicerio)")

from label_images import NAMES, VOXEL, funnel, image_of, write_dicom  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging import requests  # noqa: E402
from mvs.imaging.checks import check_outputs  # noqa: E402
from mvs.imaging.command import main, parser_of  # noqa: E402
from mvs.imaging.console import Console  # noqa: E402
from mvs.imaging.findings import finding, read_known, write_findings  # noqa: E402


def test_spacing_in_metres_or_cm_and_other_files_are_refused(tmp_path):
    labels, _ = funnel()
    for scale, words in ((1e-3, "metres"), (0.1, "cm"), (20, "at most 3 mm")):
        image = image_of(labels, VOXEL * scale)
        with pytest.raises(mvs.ArgumentError, match=words):
            imaging.labels_of(image)
    grey = sitk.GetImageFromArray(np.random.default_rng(0).random((30, 30, 30)))
    with pytest.raises(mvs.FormatError, match="no label map"):
        imaging.labels_of(grey)
    path = tmp_path / "a.nrrd"
    path.write_text("no image")
    with pytest.raises(mvs.FormatError, match="no volume that SimpleITK reads"):
        imaging.read_volume(path)
    with pytest.raises(mvs.IoError, match="no such file"):
        imaging.read_labels(tmp_path / "b.seg.nrrd")


def test_every_volume_format_gives_the_same_positions(tmp_path):
    image = image_of(funnel(2.0)[0], 2.0)
    image.SetDirection([0, -1, 0, 1, 0, 0, 0, 0, 1])
    for ending in ("nrrd", "nii.gz", "mha"):
        sitk.WriteImage(image, str(tmp_path / f"a.{ending}"))
        read = imaging.read_labels(tmp_path / f"a.{ending}", NAMES)
        for index in ((0, 0, 0), (3, 5, 7)):
            # NIfTI holds single precision
            assert read.image.TransformIndexToPhysicalPoint(index) == pytest.approx(
                image.TransformIndexToPhysicalPoint(index), abs=1e-4)
        assert np.array_equal(read.masks["anterior leaflet"],
                              sitk.GetArrayFromImage(image) == 1)


def dicom_series(folder, image):
    """The slices of an image, in files whose names are in no order of them."""
    rows, depth = np.array(image.GetDirection()).reshape(3, 3), range(image.GetDepth())
    write_dicom(folder, [image[:, :, k] for k in depth], [image.TransformIndexToPhysicalPoint((0, 0, k)) for k in depth],
                "\\".join(f"{x:g}" for x in (*rows[:, 0], *rows[:, 1])), [f"{(7 * k) % 100:03d}.dcm" for k in depth],
                **{"0018|0050": f"{image.GetSpacing()[2]:g}"})


def test_a_dicom_series_is_read_in_the_order_of_its_slices(tmp_path):
    image = sitk.Cast(image_of(funnel(2.0)[0], 2.0), sitk.sitkUInt16)
    image.SetDirection([0, -1, 0, 1, 0, 0, 0, 0, 1])
    dicom_series(tmp_path / "a", image)
    assert len(list((tmp_path / "a").iterdir())) == image.GetDepth()
    read = imaging.read_volume(tmp_path / "a")
    assert np.array_equal(sitk.GetArrayFromImage(read), sitk.GetArrayFromImage(image))
    for index in ((0, 0, 0), (3, 5, 7)):
        # positions are written with six digits
        assert read.TransformIndexToPhysicalPoint(index) == pytest.approx(
            image.TransformIndexToPhysicalPoint(index), abs=1e-5)
    labels = imaging.read_labels(tmp_path / "a", NAMES)
    assert np.array_equal(labels.masks["anterior leaflet"], sitk.GetArrayFromImage(image) == 1)
    dicom_series(tmp_path / "b", image)
    for file in (tmp_path / "b").iterdir():
        file.rename(tmp_path / "a" / f"b{file.name}")
    with pytest.raises(mvs.FormatError, match="2 DICOM series .*folder of its own"):
        imaging.read_volume(tmp_path / "a")
    with pytest.raises(mvs.FormatError, match="no DICOM series"):
        imaging.read_volume(tmp_path / "b")


def test_segments_of_slicer_may_overlap_in_layers(tmp_path):
    nrrd = pytest.importorskip("nrrd")
    labels, _ = funnel(2.0)
    header = {"space": "left-posterior-superior", "kinds": ["list", "domain", "domain", "domain"],
              "space directions": np.array([[np.nan] * 3, [2, 0, 0], [0, 2, 0], [0, 0, 2]]),
              "space origin": np.array([1.0, 2, 3])}
    for row, (name, layer) in enumerate((("Anterior leaflet", 0), ("Posterior leaflet", 1))):
        header.update({f"Segment{row}_ID": f"S{row}", f"Segment{row}_Name": name,
                       f"Segment{row}_LabelValue": "1", f"Segment{row}_Layer": str(layer),
                       f"Segment{row}_Extent": "0 1 0 1 0 1", f"Segment{row}_Color": "1 0 0",
                       f"Segment{row}_Tags": "|"})
    layers = np.stack([labels.T == 1, labels.T > 0]).astype(np.uint8)
    path = tmp_path / "a.seg.nrrd"
    nrrd.write(str(path), layers, header)
    read = imaging.read_labels(path)
    assert np.array_equal(read.masks["Anterior leaflet"], labels == 1)
    assert np.array_equal(read.masks["Posterior leaflet"], labels > 0)  # overlaps
    assert read.image.GetOrigin() == (1, 2, 3) and read.image.GetSpacing() == (2, 2, 2)


def markups(path, points, frame):
    rows = [{"id": str(k), "label": f"P{k}", "position": [float(c) for c in p],
             "positionStatus": "defined"} for k, p in enumerate(points)]
    path.write_text(json.dumps({"markups": [{
        "type": "Fiducial", "coordinateSystem": frame, "coordinateUnits": "mm",
        "controlPoints": rows}]}))
    return path


def test_landmarks_of_another_frame_or_patient_are_refused(tmp_path):
    path = markups(tmp_path / "tips.mrk.json", [[30, 30, 0], [30, 20, 0]], "")
    with pytest.raises(mvs.ArgumentError, match="LPS or RAS"):
        imaging.read_part(path, "tips")
    assert imaging.read_part(path, "tips", "RAS")[0] == pytest.approx([-0.03, -0.03, 0])
    tissue = np.array([[0.03, 0.03, 0], [0.04, 0.03, 0.01]])
    from mvs.imaging.landmarks import check_near

    with pytest.raises(mvs.ArgumentError, match="x and y mirrored"):
        check_near({"annulus": -tissue * [1, 1, -1]}, tissue)
    with pytest.raises(mvs.ArgumentError, match="another patient"):
        check_near({"commissures": tissue + 0.2}, tissue)


def test_registration_by_landmarks_recovers_a_rigid_motion():
    random = np.random.default_rng(2)
    start = random.normal(scale=0.02, size=(9, 3))
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    motion, rms = imaging.motion_of_landmarks(start, start @ turn.T + [0.1, 0, -0.2])
    assert motion.turn == pytest.approx(turn, abs=1e-12) and rms < 1e-12


def test_a_missing_package_is_named_in_one_line():
    program = ("import sys; sys.modules['scipy'] = None; from mvs.imaging.command import main; "
               "sys.exit(main(['open.nrrd', '-o', 'valve.h5']))")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("mvs-image: mvs.imaging needs SciPy: pip install 'libmvs[imaging]'")


def test_the_command_makes_a_valve_that_closes(tmp_path, capsys):
    """Two images, one command; findings that are read back give the same valve."""
    labels, _ = funnel()
    sitk.WriteImage(image_of(labels), str(tmp_path / "open.nrrd"))
    tips = markups(tmp_path / "tips.mrk.json", [[12, 0, -20], [-12, 0, -20]], "LPS")
    call = [str(tmp_path / "open.nrrd"), "--anterior-label", "1", "--posterior-label", "2",
            "--tips", str(tips), "--edge", "2.5", "--json"]
    assert main([*call, "-o", str(tmp_path / "a.h5")]) == 0
    output = capsys.readouterr()
    made = json.loads(output.out)
    assert made["converged"] and "mid-surface" in output.err
    assert {"image_thickness", "mesh", "mesh_distance"} <= {row["name"] for row in made["findings"]}
    rows = {row["name"]: row for row in made["findings"]}
    kept = json.loads((tmp_path / "a.import.json").read_text())["findings"]
    assert [row["name"] for row in kept if row["doubtful"]] == ["tall_leaflets"]
    assert rows["tall_leaflets"]["doubtful"] and not rows["thickness"]["doubtful"]
    assert rows["edge_error"]["source"] == rows["edge_lost"]["source"] == "assumed"
    # half a voxel and two voxels of 0.7 mm
    assert "0.35 mm" in rows["edge_error"]["sentence"] and "1.40 mm" in rows["edge_lost"]["sentence"]
    assert "1.8 mm farther out" in rows["leak_interval"]["sentence"]
    # 1.4 mm are two voxels, from which no thickness is concluded
    assert rows["thickness"]["source"] == rows["thickness_error"]["source"] == "assumed"
    assert "0.80 mm everywhere" in rows["thickness"]["sentence"]
    assert re.search(r"(1.9|2.0)\d voxels and less than 2.5", rows["thickness"]["sentence"])
    assert "0.25 mm thicker" in rows["leak_interval"]["sentence"]
    again = [*call, "--with", str(tmp_path / "a.import.json"), "-o", str(tmp_path / "b.h5"), "--quiet"]
    with mvs.Simulator() as sim:
        sim.load(tmp_path / "a.h5")
        sim.apply("annulus_scale", factor=0.9)
        sim.snapshot().save_plan(tmp_path / "plan.json")
    page = tmp_path / "page.html"
    again += ["--plan", str(tmp_path / "plan.json"), "--report", str(page)]
    assert main(again) == 0
    output = capsys.readouterr()
    second = json.loads(output.out)
    assert second["hash"] == made["hash"]
    read_back = {row["name"]: row for row in second["findings"]}
    for name in ("commissures", "anterior", "edge_lost"):  # guesses stay guesses
        assert read_back[name]["source"] == rows[name]["source"] != "given"
        assert read_back[name]["confidence"] == rows[name]["confidence"]
    # these leaflets are as high at the commissures as between them; nothing else is said with --quiet
    assert [line.split(",")[0] for line in output.err.splitlines()] == ["mvs-image: warning: tall_leaflets"]
    assert second["repair"]["operations"] == 1 and second["repair"]["converged"]
    text = page.read_text(encoding="utf-8")
    assert "The repaired valve" in text and "Repaired, closed, from the atrium" in text
    assert "Interval: " in text and "farther out" in text
    assert "Look at these first" in text and "<strong>tall_leaflets</strong>" in text
    assert main([str(tmp_path / "none.nrrd"), "-o", str(tmp_path / "c.h5"), "--quiet"]) == 1
    assert "no such file" in capsys.readouterr().err


def test_the_law_in_a_file_of_findings_is_read(tmp_path):
    path = tmp_path / "a.import.json"
    for number in (5, 2.5, 0, 99):
        path.write_text(json.dumps({"format": "libmvs import", "version": 1, "findings": [
            {"name": "tissue", "source": "guessed", "values": [number]}]}))
        if number == 5:
            assert read_known(path) == {"tissue": mvs.LeafletLaw.PROT}
            continue
        with pytest.raises(mvs.FormatError, match="the number of a law of leaflets, 1 to 6"):
            read_known(path)


@pytest.mark.parametrize("row, words", [
    ({"values": [1.0]}, "a finding without a name"),
    ({"name": "papilary_tips", "source": "given", "values": [1.0, 2.0, 3.0]}, "no input of a build; inputs are annulus"),
    ({"name": "closed_tips", "source": "given", "values": [1.0, 2.0]}, "points need x, y, z each"),
    ({"name": "thickness", "source": "given", "values": ["thick"]}, "needs finite numbers"),
    ({"name": "thickness"}, "needs finite numbers")])
def test_faulty_rows_of_a_file_of_findings_are_named(tmp_path, row, words):
    path = tmp_path / "a.import.json"
    path.write_text(json.dumps({"format": "libmvs import", "version": 1, "findings": [row]}))
    with pytest.raises(mvs.FormatError, match=words):
        read_known(path)


def test_edited_rows_that_are_not_used_are_warned_of(tmp_path):
    path = tmp_path / "a.import.json"
    write_findings(path, "a.nrrd", [finding(name, source, 1, "", [1e-3], "m") for name, source in (
        ("surface", mvs.FindingSource.MEASURED), ("thickness", mvs.FindingSource.MEASURED),
        ("edge_error", mvs.FindingSource.ASSUMED))])
    assert read_known(path) == {"edge_error": 1e-3}
    written = json.loads(path.read_text())
    for row in written["findings"]:
        row["values"] = [2e-3]
    path.write_text(json.dumps(written))
    with pytest.warns(mvs.ValveWarning) as warned:
        assert read_known(path) == {"edge_error": 2e-3}
    assert [str(one.message).split('"')[1] for one in warned] == ["surface", "thickness"]
    assert "change its source" in str(warned[1].message)


def test_an_output_that_is_an_input_is_refused(tmp_path):
    image = tmp_path / "open.obj"  # whatever it holds: it is not read
    image.write_bytes(b"kept")
    chosen = parser_of()[0].parse_args(["build", str(image), "-o", str(image)])
    with pytest.raises(mvs.ArgumentError, match="is an input as well"):
        check_outputs(chosen)
    assert image.read_bytes() == b"kept"
    tips = tmp_path / "valve.import.json"
    tips.write_text("{}")
    chosen = parser_of()[0].parse_args(["build", str(image), "-o", str(tmp_path / "valve.h5"), "--tips", str(tips)])
    with pytest.raises(mvs.ArgumentError, match="valve.import.json: is an input as well"):
        check_outputs(chosen)


def test_loaded_landmarks_are_the_boundary_under_load(tmp_path, monkeypatch):
    """Landmarks of the loaded image, and those of a file of findings, reach the build in the frame of the open image."""
    sitk.WriteImage(image_of(funnel()[0]), str(tmp_path / "open.nrrd"))
    tips, lower = [[12, 0, -20], [-12, 0, -20]], [[12, 0, -18], [-12, 0, -18]]
    ring = [[17 * np.cos(a), 15 * np.sin(a), 9] for a in np.arange(0, 6.2, 0.5)]
    given = {"--tips": tips, "--loaded-tips": lower, "--loaded-annulus": ring}
    call = [str(tmp_path / "open.nrrd"), "--loaded", str(tmp_path / "open.nrrd"), "--anterior-label", "1",
            "--posterior-label", "2", "-o", str(tmp_path / "a.h5")]
    for option, points in given.items():
        call += [option, str(markups(tmp_path / f"{option}.mrk.json", points, "LPS"))]
    seen = {}

    def build(*_args, **options):
        seen.update(options)
        raise mvs.ArgumentError("enough", "test")

    monkeypatch.setattr(requests, "build", build)
    with pytest.raises(mvs.ArgumentError, match="enough"):
        requests.valve_of_request(parser_of()[0].parse_args(["build", *call]), Console(True))
    assert seen["closed_tips"] * 1e3 == pytest.approx(np.array(lower))
    assert seen["closed_annulus"] * 1e3 == pytest.approx(np.array(ring))
    known = tmp_path / "known.import.json"
    known.write_text(json.dumps({"format": "libmvs import", "version": 1, "findings": [
        {"name": "closed_tips", "source": "given", "values": [0.1, 0.2, 0.3]},
        {"name": "closed_annulus", "source": "measured", "values": [0.0, 0.0, 0.0]}]}))
    seen.clear()
    with pytest.raises(mvs.ArgumentError, match="enough"):
        requests.valve_of_request(parser_of()[0].parse_args(["build", *call[:9], "--with", str(known)]), Console(True))
    assert seen["closed_tips"].tolist() == [[0.1, 0.2, 0.3]] and "closed_annulus" not in seen
