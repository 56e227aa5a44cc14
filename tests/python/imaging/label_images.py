"""Label maps of an open valve of known shape for the tests of mvs.imaging."""

import numpy as np
import pytest

sitk = pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")

VOXEL = 0.7  # mm, of ultrasound


def funnel(voxel=VOXEL, thickness=1.4, gap=0.0, seed=None, ends="flat"):
    """Labels of an open valve: a cone around z, wide at the annulus (top); 1 anterior, 2 posterior.

    Distances from the cone are exact, so that its mid-surface and thickness are known. Both rims are flat,
    or round: half circles around the ends of the mid-surface.
    """
    n = int(40 / voxel)
    z, y, x = np.meshgrid(*[(np.arange(n) - n / 2 + 0.5) * voxel] * 3, indexing="ij")
    radius = np.hypot(x, y)
    # from (16, 8) at the annulus to (8, -8) at the free edge, in the plane (radius, z)
    along = np.array([-8, -16]) / np.hypot(8, 16)
    share = (radius - 16) * along[0] + (z - 8) * along[1]
    away = np.abs((radius - 16) * along[1] - (z - 8) * along[0])
    past = np.maximum(0, np.maximum(-share, share - np.hypot(8, 16)))
    inside = past == 0 if ends == "flat" else np.hypot(away, past) < thickness / 2
    tissue = (away < thickness / 2) & inside
    labels = np.where(tissue, np.where(y > gap, 1, 2), 0).astype(np.uint8)
    if seed is not None:
        random = np.random.default_rng(seed)
        edge = tissue ^ (np.pad(tissue, 1)[2:, 1:-1, 1:-1] | tissue)
        labels[tissue & (random.random(labels.shape) < 0.03)] = 0
        labels[edge & (random.random(labels.shape) < 0.1)] = 1
    return labels, np.stack([x, y, z], -1)


def image_of(labels, voxel=VOXEL):
    image = sitk.GetImageFromArray(labels)
    image.SetSpacing([voxel] * 3)
    n = labels.shape[0]
    image.SetOrigin([(0.5 - n / 2) * voxel] * 3)
    return image


NAMES = {1: "anterior leaflet", 2: "posterior leaflet"}


def write_dicom(folder, slices, places, orientation="1\\0\\0\\0\\1\\0", names=None, **tags):
    """One file for each slice, as scanners write them.

    slices: SimpleITK.Image each; places: (n, 3) mm, of the first voxel of each; orientation: of rows and columns, as
    in the file; names: of the files, else numbers in the order of the slices; tags: by group and element ("0018|0050")
    """
    folder.mkdir()
    writer = sitk.ImageFileWriter()
    writer.KeepOriginalImageUIDOn()
    series = f"1.2.826.0.1.3680043.2.1125.{sum(map(ord, folder.name))}"
    for k, (image, place) in enumerate(zip(slices, places)):
        for tag, value in {"0020|000e": series, "0020|000d": "1.2.3", "0008|0018": f"{series}.{k + 1}",
                           "0020|0032": "\\".join(f"{x:.6f}" for x in place), "0020|0037": orientation,
                           "0020|0013": str(k), "0008|0060": "CT", **tags}.items():
            image.SetMetaData(tag, value)
        writer.SetFileName(str(folder / (names[k] if names else f"{k:03d}.dcm")))
        writer.Execute(image)
