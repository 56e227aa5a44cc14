"""mvs.imaging: images that lack a part, names of segments, outputs that cannot be written."""

import gzip

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")

from label_images import NAMES, funnel, image_of, write_dicom  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging.command import main  # noqa: E402
from mvs.imaging.leaflet_segments import choose_segments  # noqa: E402
from mvs.imaging.names import ANTERIOR, POSTERIOR, UNKNOWN, leaflet_of  # noqa: E402


@pytest.mark.parametrize("ending", [".nii", ".nii.gz"])
def test_a_nifti_file_that_is_cut_short_is_refused(tmp_path, ending):
    path = tmp_path / f"a{ending}"
    sitk.WriteImage(image_of(funnel(2.0)[0], 2.0), str(path))
    assert imaging.read_labels(path).values == {"1": 1, "2": 2}
    whole = path.read_bytes()
    for share in (0.5, 0.9, 0.999):
        path.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(mvs.FormatError, match="cut short"):
            imaging.read_labels(path)
    if ending == ".nii.gz":  # a whole stream of too few voxels
        path.write_bytes(gzip.compress(gzip.decompress(whole)[:-100]))
        with pytest.raises(mvs.FormatError, match="its header says"):
            imaging.read_labels(path)


@pytest.mark.parametrize("ending", [".nrrd", ".nhdr", ".mha", ".mhd"])
def test_damage_in_compressed_voxels_is_found_by_their_checksum(tmp_path, ending):
    """ITK reads what zlib unpacked before the damage, and says nothing."""
    path = tmp_path / f"a{ending}"
    values = np.random.default_rng(0).integers(0, 3, (30, 30, 30)).astype(np.uint8)
    image = sitk.GetImageFromArray(values)
    sitk.WriteImage(image, str(path), True)
    assert np.array_equal(sitk.GetArrayFromImage(imaging.read_labels(path).image), values)
    (voxels,) = [one for one in tmp_path.iterdir() if one != path] or [path]
    whole = voxels.read_bytes()
    for damaged in (whole[:-8] + bytes([whole[-8] ^ 1]) + whole[-7:], whole[:-2000] + bytes(40) + whole[-1960:]):
        voxels.write_bytes(damaged)
        with pytest.raises(mvs.FormatError, match="voxels are (damaged|cut short)|SimpleITK"):
            imaging.read_labels(path)
    sitk.WriteImage(image, str(path), False)  # not compressed: no checksum
    assert imaging.read_labels(path).image.GetSize() == (30, 30, 30)


def write_series(folder, at):
    """Slices of 30 x 30 voxels of 1 mm at places along z, mm."""
    write_dicom(folder, [sitk.GetImageFromArray(np.full((30, 30), k, np.int16)) for k in range(len(at))],
                [(0, 0, place) for place in at])


def test_a_dicom_series_without_some_of_its_slices_is_refused(tmp_path):
    write_series(tmp_path / "whole", range(30))
    assert imaging.read_volume(tmp_path / "whole").GetSize() == (30, 30, 30)
    write_series(tmp_path / "gap", [k for k in range(30) if not 11 <= k < 14])
    with pytest.raises(mvs.FormatError, match="1.00 mm apart, and 4.00 mm after slice 11 of 27"):
        imaging.read_volume(tmp_path / "gap")
    write_series(tmp_path / "twice", [*range(30), 4])
    with pytest.raises(mvs.FormatError, match="several slices lie in one place"):
        imaging.read_volume(tmp_path / "twice")


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_voxels_that_are_no_numbers_are_refused(tmp_path, bad):
    values = np.random.default_rng(0).random((30, 30, 30), np.float32)
    values[3, 4, 5] = bad
    path = tmp_path / "a.nrrd"
    sitk.WriteImage(sitk.GetImageFromArray(values), str(path))
    for read in (imaging.read_volume, imaging.read_labels):
        with pytest.raises(mvs.FormatError, match="1 of 27000 voxels are no numbers"):
            read(path)


def test_tissue_at_the_border_of_the_image_is_a_doubtful_finding():
    labels, _ = funnel()
    whole = imaging.labels_of(image_of(labels), NAMES)
    assert not [f for f in imaging.leaflets_in(whole).findings if f.name == "cut_by_border"]
    image = sitk.RegionOfInterest(image_of(labels), [labels.shape[2], labels.shape[1] // 2 + 18, labels.shape[0]])
    cut = imaging.labels_of(image, NAMES)
    found = [f for f in imaging.leaflets_in(cut).findings if f.name == "cut_by_border"]
    assert len(found) == 1 and found[0].doubtful
    assert "(last row)" in found[0].sentence


def test_a_refusal_says_first_that_the_border_of_the_image_cuts_the_leaflets():
    """It said that the valve is closed or a leaflet is missing."""
    labels, _ = funnel()
    first = labels.shape[2] // 2 - 8
    image = sitk.RegionOfInterest(image_of(labels), [labels.shape[2] - first, *labels.shape[1::-1]], [first, 0, 0])
    found = imaging.leaflets_in(imaging.labels_of(image, NAMES))
    with pytest.raises(mvs.ArgumentError, match=r"^the leaflets touch the border of the image \(first column\).*As they are, "
                                                "the leaflets have one rim"):
        imaging.check_open_valve(found)


@pytest.mark.parametrize("name, leaflet", [
    ("Anterior papillary muscle", None), ("mitral annulus", None), ("posterior wall", None), ("aorta", None),
    ("Left anterior descending", None), ("Hinterwand", None), ("commissure antérieure", None), ("LAD", None),
    ("anterior tricuspid leaflet", None), ("AnteriorLeaflet", ANTERIOR), ("posterior_leaflet", POSTERIOR),
    ("PML", POSTERIOR), ("mitral valve", UNKNOWN), ("A2", ANTERIOR), ("P3", POSTERIOR), ("AMVL", ANTERIOR),
    ("PMVL", POSTERIOR), ("MV_ant.", ANTERIOR), ("MV_post.", POSTERIOR), ("Anteriore", ANTERIOR),
    ("Lembo posteriore", POSTERIOR), ("feuillet ant\u00e9rieur", ANTERIOR), ("valve poste\u0301rieure", POSTERIOR),
    ("Vorderes Mitralsegel", ANTERIOR), ("hinteres Segel", POSTERIOR), ("posterior (mitral)", POSTERIOR),
    ("anterior and posterior leaflet", UNKNOWN), ("LeafletP1", POSTERIOR), ("tissue", None),
    ("LV posterior", None), ("Anterior PM", None), ("APM", None), ("TV anterior leaflet", None), ("LA anterior", None),
    ("la_anterior", None), ("valva anterior de la mitral", ANTERIOR), ("Anterior leaflet + septum", ANTERIOR),
    ("septum + anterior leaflet", None), ("Posterior leaflet incl. annulus", POSTERIOR), ("Aortic leaflet", ANTERIOR),
    ("aortic mitral leaflet", ANTERIOR), ("Mural leaflet", POSTERIOR), ("murales Segel", POSTERIOR),
    ("aortic valve leaflet", None), ("left aortic leaflet", None), ("aortic root", None), ("mural thrombus", None)])
def test_names_of_segments_mean_leaflets_or_other_parts(name, leaflet):
    assert leaflet_of(name) == leaflet


def test_segments_that_are_left_out_are_a_finding_and_too_much_tissue_is_refused():
    labels, _ = funnel()
    labels[:3, :3, :3] = 3
    found = imaging.leaflets_in(imaging.labels_of(image_of(labels), {**NAMES, 3: "papillary muscle"})).findings
    said = [f.sentence for f in found if f.name == "segments"]
    assert said == ['the anterior leaflet is "anterior leaflet"; the posterior leaflet is "posterior leaflet"; '
                    '"papillary muscle" is left out']
    merged = imaging.leaflets_in(imaging.labels_of(image_of(funnel()[0]), {1: "leaflet", 2: "leaflet"})).findings
    (one,) = [f for f in merged if f.name == "segments"]
    assert one.doubtful and 'leaflets are "leaflet", "leaflet 2"; their names do not say' in one.sentence
    full = imaging.labels_of(image_of(np.ones_like(labels)), {1: "leaflets"})
    with pytest.raises(mvs.ArgumentError, match='"leaflets" fill 100 % of the image'):
        imaging.leaflets_in(full)
    one = imaging.labels_of(image_of(np.where(labels == 1, 1, 0).astype(np.uint8)), NAMES)
    with pytest.raises(mvs.ArgumentError, match="the loaded image has .* A valve needs both"):
        choose_segments(one, image="loaded image")


def test_outputs_are_checked_before_the_work(tmp_path, capsys):
    image = tmp_path / "open.nrrd"
    sitk.WriteImage(image_of(funnel()[0]), str(image))
    plan = tmp_path / "plan.json"
    plan.write_text("this is no JSON")
    (tmp_path / "folder.h5").mkdir()
    before = sorted(tmp_path.iterdir())
    for arguments, words in (
            (["-o", "a.h5", "--report", "none/r.html"], "there is no folder"),
            (["-o", "none/a.h5"], "there is no folder"),
            (["-o", "a.xyz"], "known endings are"),
            (["-o", "folder.h5"], "is a folder"),
            (["-o", "a.h5", "--plan", str(plan)], "plan.json: is no plan, which is JSON")):
        placed = [str(tmp_path / one) if "/" in one or one[:2] == "a." or one.startswith("folder") else one
                  for one in arguments]
        assert main([str(image), *placed, "--quiet"]) == 1
        assert words in capsys.readouterr().err
        assert sorted(tmp_path.iterdir()) == before
    with pytest.raises(SystemExit) as ended:
        main([str(image), "-o", str(tmp_path / "a.h5"), "--chords", "0"])
    assert ended.value.code == 2
