"""mvs.imaging: images whose axes are not at right angles, and series of tilted slices, are refused."""

import struct

import mvs
import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")

from label_images import funnel, image_of, write_dicom  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging.whole_image import check_slices  # noqa: E402


def sheared(degrees):
    """Columns (3, 3) in mm of voxels of 2 mm, the axis k leaning towards j."""
    return 2 * np.array([[1, 0, 0], [0, 1, np.tan(np.radians(degrees))], [0, 0, 1.0]])


def header_of(axes):
    return {"space": "left-posterior-superior", "space directions": axes.T, "space origin": np.zeros(3),
            "kinds": ["domain"] * 3}


def write_tilted(folder, axes, orientation="1\\0\\0\\0\\1\\0", count=12):
    """Slices of 16 x 16 voxels whose first voxels lie along the third column of `axes` (mm)."""
    slices = [sitk.GetImageFromArray(np.full((16, 16), k, np.int16)) for k in range(count)]
    for image in slices:
        image.SetSpacing([2, 2])
    write_dicom(folder, slices, [k * axes[:, 2] for k in range(count)], orientation)


def test_a_series_of_a_tilted_gantry_is_refused(tmp_path):
    write_tilted(tmp_path / "straight", sheared(0))
    assert imaging.read_volume(tmp_path / "straight").GetSize() == (16, 16, 12)
    # rounded coordinates of a series that is oblique as a whole
    turned = np.array([[1, 0, 0], [0, np.cos(0.3), -np.sin(0.3)], [0, np.sin(0.3), np.cos(0.3)]])
    write_tilted(tmp_path / "oblique", 2 * turned.round(3),
                 "\\".join(f"{x:.4f}" for x in (*turned[:, 0], *turned[:, 1])))
    assert imaging.read_volume(tmp_path / "oblique").GetSize() == (16, 16, 12)
    write_tilted(tmp_path / "tilted", sheared(5))
    for read in (imaging.read_volume, imaging.read_labels):
        with pytest.raises(mvs.FormatError, match=r"shift sideways by 1.9 mm, 5.0 degrees, .*tilted gantry.*resample"):
            read(tmp_path / "tilted")


def test_slices_that_are_turned_against_each_other_are_refused(tmp_path):
    write_tilted(tmp_path / "a", sheared(0))
    write_tilted(tmp_path / "b", sheared(0), "1\\0\\0\\0\\0.98\\0.199")
    files = [str(tmp_path / folder / f"{k:03d}.dcm") for k, folder in enumerate("aaaabbbb")]
    check_slices("a", files[:4])
    with pytest.raises(mvs.FormatError, match="not parallel"):
        check_slices("a", files)


@pytest.mark.parametrize("ending", [".nrrd", ".seg.nrrd"])
def test_sheared_directions_of_a_file_are_refused(tmp_path, ending):
    nrrd = pytest.importorskip("nrrd")
    labels = funnel(2.0)[0].T
    segments = {f"Segment{k}_{key}": value for k, name in enumerate(("anterior", "posterior")) for key, value in (
        ("ID", f"S{k}"), ("Name", name), ("LabelValue", str(k + 1)), ("Layer", "0"), ("Extent", "0 1 0 1 0 1"))}
    for degrees, words in ((0, ""), (0.05, ""), (5, "axes j and k .* by 5.0 degrees"), (8, "by 8.0 degrees")):
        path = tmp_path / f"a{ending}"
        nrrd.write(str(path), labels, {**header_of(sheared(degrees)), **(segments if "seg" in ending else {})})
        if not words:
            assert len(imaging.read_labels(path).masks) == 2
            continue
        with pytest.raises(mvs.FormatError, match=words + ".*resample it"):
            imaging.read_labels(path)


@pytest.mark.parametrize("qform", [0, 1])
def test_a_sheared_sform_of_a_nifti_file_is_refused_also_beside_a_qform(tmp_path, qform):
    """ITK reads the qform then, which cannot hold a shear."""
    path = tmp_path / "a.nii"
    sitk.WriteImage(image_of(funnel(2.0)[0], 2.0), str(path))
    written = bytearray(path.read_bytes())
    for degrees in (0, 5):
        struct.pack_into("<hh", written, 252, qform, 1)
        for row, values in enumerate(sheared(degrees)):
            struct.pack_into("<4f", written, 280 + 16 * row, *values, 0)
        path.write_bytes(written)
        if not degrees:
            assert len(imaging.read_labels(path).masks) == 2
    with pytest.raises(mvs.FormatError, match="miss a right angle by 5.0 degrees"):
        imaging.read_labels(path)


def test_axes_in_memory_may_be_turned_and_mirrored_and_not_sheared():
    image = image_of(funnel(2.0)[0], 2.0)
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    for axes in (turn, -turn, turn.round(4)):
        image.SetDirection(axes.ravel().tolist())
        assert len(imaging.labels_of(image).masks) == 2
    image.SetDirection((turn @ sheared(3) / 2).ravel().tolist())
    with pytest.raises(mvs.FormatError, match="miss a right angle by 3.0 degrees"):
        imaging.labels_of(image)
    image.SetDirection((1.1 * turn).ravel().tolist())
    with pytest.raises(mvs.FormatError, match="no unit vectors"):
        imaging.labels_of(image)
