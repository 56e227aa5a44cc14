"""mvs.imaging: thick leaflets, lumps of calcium, and a free edge without chordae."""

import mvs
import numpy as np
import pytest

pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")

from label_images import NAMES, funnel, image_of  # noqa: E402
from mvs import imaging  # noqa: E402
from mvs.imaging import mesh  # noqa: E402
from mvs.imaging.microct import PIPELINE  # noqa: E402
from mvs.imaging.microct.valve import BARE_EDGE, bare_edge  # noqa: E402
from test_imaging_microct import (BOTTOM, HEIGHT, INSERTIONS, MUSCLES, THICKNESS, TOP,  # noqa: E402
                                  grey_volume, muscle_of)


def test_thick_leaflets_are_seen_as_whole_as_thin_ones():
    chords = [(MUSCLES[muscle_of(end)], end) for end in INSERTIONS]
    # the lateral area of the cone, mm2
    whole = np.pi * (TOP + BOTTOM) * np.hypot(TOP - BOTTOM, HEIGHT)
    for thickness in (THICKNESS, 1.8):
        run = PIPELINE.run({"image": grey_volume(chords, thickness=thickness)}, until="sheet")
        area = mesh.areas(run["sheet"].points, run["sheet"].triangles).sum() * 1e6
        # a band of a voxel at either rim, 6 % of the area
        assert abs(area / whole - 1) < 0.06, thickness


def test_a_free_edge_without_chordae_is_seen():
    with mvs.Simulator() as sim:
        sim.generate()
        opened = sim.snapshot()
    ends = np.asarray(mvs.valve_of(opened).chord_nodes)[:, 1]
    ends = ends[np.asarray(opened.node_kind)[ends] == mvs.NodeKind.LEAFLET]
    edge = np.asarray(opened.node_rest)[np.asarray(opened.free_edge_nodes)]
    length = np.linalg.norm(np.roll(edge, -1, axis=0) - edge, axis=1).sum()
    assert bare_edge(opened, ends) < BARE_EDGE
    assert bare_edge(opened, ends[:0]) == pytest.approx(length)
    left = np.asarray(opened.node_rest)[ends, 0] > 0
    # half of the edge has none; the mean of both sides of the valve, and a chord spacing of 5 mm
    assert abs(bare_edge(opened, ends[left]) - length / 2) < 10e-3


def test_a_calcified_annulus_is_a_doubtful_finding_and_lowers_the_confidence_of_the_thickness():
    """It was measured as thin tissue, 80 % sure."""
    labels, at = funnel()
    x, y, z = np.moveaxis(at, -1, 0)
    lump = (np.hypot(np.hypot(x, y) - 15, z - 6) < 2.5) & (y < 0)
    for seen, calcified in ((labels, False), (np.where(lump, 2, labels).astype(np.uint8), True)):
        found = {one.name: one for one in imaging.leaflets_in(imaging.labels_of(image_of(seen), NAMES)).findings}
        assert ("thick_tissue" in found) == calcified
        assert (found["image_thickness"].confidence < 0.5) == calcified
    share, most, taken = found["thick_tissue"].values
    assert found["thick_tissue"].doubtful
    true = (lump & (seen > 0)).sum() / (seen > 0).sum()
    # balls of 5 mm in voxels of 0.7 mm
    assert abs(share - true) < 0.15 and abs(most - 5e-3) < 0.7e-3 and taken < 3e-3


def test_a_thick_part_of_narrow_labels_is_a_doubtful_finding_with_the_thickness_that_is_built():
    """Labels of two voxels are built 0.8 mm thick everywhere, also where they are 3.4 mm wide."""
    labels, at = funnel()
    wide, _ = funnel(thickness=3.4)
    seen = np.where((at[..., 1] < 0) & (np.abs(at[..., 0]) < 6), wide, labels).astype(np.uint8)
    leaflets = imaging.leaflets_in(imaging.labels_of(image_of(seen), NAMES))
    found = {one.name: one for one in leaflets.findings}["thick_tissue"]
    assert found.doubtful
    assert abs(found.values[1] - 3.4e-3) < 0.7e-3 and found.values[2] == 0.8e-3
    assert leaflets.sheet.values["thickness"].min() > 0


def test_no_point_of_a_wide_thick_part_is_without_a_thickness():
    """Points far from measured ones had 0 mm, which a build refused as metres."""
    labels, at = funnel(thickness=2.1)
    wide, _ = funnel(thickness=6.3)
    seen = np.where(at[..., 1] < -2, wide, labels).astype(np.uint8)
    leaflets = imaging.leaflets_in(imaging.labels_of(image_of(seen), NAMES))
    assert leaflets.sheet.values["thickness"].min() > 0.5e-3
