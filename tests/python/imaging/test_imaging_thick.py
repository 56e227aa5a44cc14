"""mvs.imaging.microct: thick leaflets, and a free edge without chordae."""

import mvs
import numpy as np
import pytest

pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")

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
