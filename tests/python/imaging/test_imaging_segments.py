"""mvs.imaging: broken headers of .seg.nrrd files, equal names of segments, several values at a voxel."""

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
nrrd = pytest.importorskip("nrrd", reason="needs the extra imaging (slicerio)")

from label_images import funnel, image_of  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging.reading import MOST_LABELS, is_label_map  # noqa: E402


def written(path, names=("anterior", "posterior"), **more):
    """A .seg.nrrd file with keys of its header replaced; None: left out."""
    header = {"space": "left-posterior-superior", "space directions": np.diag([2.0, 2, 2]), "space origin": np.zeros(3),
              "kinds": ["domain"] * 3}
    for k, name in enumerate(names):
        header.update({f"Segment{k}_ID": f"S{k}", f"Segment{k}_Name": name, f"Segment{k}_LabelValue": str(k + 1),
                       f"Segment{k}_Layer": "0", f"Segment{k}_Extent": "0 1 0 1 0 1"})
    for key, value in more.items():
        header[key.replace("__", " ")] = value
    nrrd.write(str(path), funnel(2.0)[0].T, {key: value for key, value in header.items() if value is not None})
    return path


@pytest.mark.parametrize("change, words", [
    ({"Segment1_Layer": "7"}, 'the segment "posterior" is said to be in layer 7, and the file has 1'),
    ({"Segment1_LabelValue": None}, 'the segment "posterior" has no labelValue'),
    ({"Segment1_LabelValue": "two"}, "no segmentation of 3D Slicer.*two"),
    ({"space__directions": np.array([[2.0, 0, 0], [2, 0, 0], [0, 0, 2]])}, "no three axes"),
    ({"space__directions": np.zeros((3, 3))}, "no three axes"),
    ({"space": None, "space__directions": None, "space__origin": None, "kinds": None}, 'lacks "space"'),
    ({"names": ()}, "declares no segments: save it in 3D Slicer as a segmentation")])
def test_broken_headers_of_segmentations_are_refused_with_a_sentence(tmp_path, change, words):
    assert set(imaging.read_labels(written(tmp_path / "whole.seg.nrrd")).masks) == {"anterior", "posterior"}
    with pytest.raises(mvs.Error, match=words):
        imaging.read_labels(written(tmp_path / "a.seg.nrrd", **change))


@pytest.mark.parametrize("damage", [lambda b: b[:len(b) * 6 // 10], lambda b: b[:200],
                                    lambda b: b[:-60] + bytes(20) + b[-40:]])
def test_segmentations_that_are_cut_short_or_damaged_are_refused(tmp_path, damage):
    path = written(tmp_path / "a.seg.nrrd")
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(mvs.FormatError, match="cut short or damaged"):
        imaging.read_labels(path)


@pytest.mark.parametrize("code", ["utf-8", "latin-1"])
@pytest.mark.parametrize("detached", [False, True])
def test_names_of_segments_keep_letters_that_are_not_ascii(tmp_path, detached, code):
    """pynrrd drops such letters: "Feuillet ant\u00e9rieur" was "Feuillet antrieur", which means no leaflet."""
    path = written(tmp_path / ("a.seg.nhdr" if detached else "a.seg.nrrd"), ("first", "second"))
    names = ["Feuillet ant\u00e9rieur", "Feuillet post\u00e9rieur" if code == "latin-1" else "\u540e\u53f6"]
    data = path.read_bytes()
    for old, new in zip((b"first", b"second"), names):
        data = data.replace(b"_Name:=" + old, b"_Name:=" + new.encode(code))
    path.write_bytes(data)
    assert list(imaging.read_labels(path).masks) == names


def test_segments_with_one_name_are_numbered(tmp_path):
    read = imaging.read_labels(written(tmp_path / "a.seg.nrrd", ("leaflet", "leaflet")))
    assert read.values == {"leaflet": 1, "leaflet 2": 2}
    labels = funnel(2.0)[0]
    of_image = imaging.labels_of(image_of(labels, 2.0), {1: "leaflet", 2: "leaflet"})
    assert of_image.values == {"leaflet": 1, "leaflet 2": 2}
    assert sum(int(mask.sum()) for mask in of_image.masks.values()) == (labels > 0).sum()


def test_several_values_at_each_voxel_are_refused(tmp_path):
    image = image_of(funnel(2.0)[0], 2.0)
    many = sitk.Compose([image, image, image])
    sitk.WriteImage(many, str(tmp_path / "a.nrrd"))
    for read in (lambda: imaging.read_labels(tmp_path / "a.nrrd"), lambda: imaging.read_volume(tmp_path / "a.nrrd"),
                 lambda: imaging.labels_of(many)):
        with pytest.raises(mvs.FormatError, match="3 values at each voxel"):
            read()


def test_one_number_of_labels_parts_label_maps_and_grey_volumes():
    """Maps of a whole heart have more than 16 labels: they were segmented as grey volumes."""
    values = np.zeros((30, 30, 30), np.int16)
    for count, is_map in ((20, True), (MOST_LABELS, True), (MOST_LABELS + 1, False)):
        values[0, :3] = 0
        values.reshape(-1)[:count] = 10 + np.arange(count)
        image = image_of(values, 1.0)
        assert is_label_map(image) == is_map
        if is_map:
            assert len(imaging.labels_of(image).masks) == count
        else:
            with pytest.raises(mvs.FormatError, match=f"at most {MOST_LABELS} labels"):
                imaging.labels_of(image)
