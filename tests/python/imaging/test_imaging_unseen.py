"""mvs.imaging.microct: chordae that no image shows, parted leaflets, rims of closed leaflets."""

import mvs
import numpy as np
import pytest

pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("pyvista", reason="needs the extra imaging (PyVista)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")

from mvs.imaging.console import Console  # noqa: E402
from mvs.imaging.grid import Grid  # noqa: E402
from mvs.imaging.mesh import Sheet  # noqa: E402
from mvs.imaging.microct.loaded import _onto_rims, settled  # noqa: E402
from mvs.imaging.microct.segment import Thick, Tissue, leaflets_of  # noqa: E402
from mvs.imaging.microct.unseen import EMPTY, with_unseen_chords  # noqa: E402

QUIET = Console(True)
CHORD_FIELDS = ("nodes", "rest_length", "area", "kind", "young", "law", "constants")


@pytest.fixture(scope="module")
def whole():
    """A generated valve whose chordae have no branches, open and closed."""
    with mvs.Simulator() as sim:
        sim.generate(branching=False)
        opened = sim.snapshot()
    _, closed, stats = settled(mvs.valve_of(opened), QUIET)
    assert stats.converged
    return opened, closed


def with_chords_of(opened, kept):
    """The valve with some of its chord segments."""
    valve = mvs.valve_of(opened)
    for name in CHORD_FIELDS:
        setattr(valve, f"chord_{name}", getattr(valve, f"chord_{name}")[kept])
    valve.chord_id = valve.chord_names = None
    return valve


def test_chordae_that_are_not_seen_are_added_with_their_lengths_under_load(whole):
    opened, closed = whole
    ends = np.asarray(opened.chord_nodes, np.int64)
    place = np.asarray(opened.node_rest)[ends[:, 1]]
    lost = place[:, 0] > 0  # half of the leaflets
    valve = with_chords_of(opened, ~lost)
    seen = len(valve.chord_nodes)
    used, triangles = np.unique(np.asarray(closed.triangle_nodes, np.int64), return_inverse=True)
    sheet = Sheet(np.asarray(closed.node_position)[used], triangles.reshape(-1, 3), {})
    (found,) = with_unseen_chords(valve, opened, closed, sheet)
    assert found.source == mvs.FindingSource.ASSUMED and len(found.values) == len(valve.chord_nodes) - seen
    added = np.asarray(valve.chord_nodes, np.int64)[seen:]
    # every lost insertion is there again but those near one that is seen, and no other
    away = np.linalg.norm(place[lost][:, None] - place[~lost][None], axis=2).min(axis=1)
    assert set(added[:, 1]) == set(ends[lost, 1][away > EMPTY])
    # its head and its place in the closed valve are known here, so that its length is the distance less the strain
    distance = np.linalg.norm(np.asarray(closed.node_position)[added[:, 0]] - np.asarray(closed.node_position)[added[:, 1]],
                              axis=1)
    assert np.isin(added[:, 0], np.asarray(opened.head_nodes)).all()
    assert np.asarray(valve.chord_rest_length)[seen:] * 1.015 == pytest.approx(distance, rel=1e-6)
    without = settled(with_chords_of(opened, ~lost), QUIET)[1].compare(closed).surface_rms
    _, filled, stats = settled(valve, QUIET)
    assert stats.converged and without > 2e-3  # half of the valve balloons
    assert filled.compare(closed).surface_rms < without / 4
    # nothing is added twice, and a whole valve gets none
    assert not with_unseen_chords(valve, opened, closed, sheet)
    assert not with_unseen_chords(mvs.valve_of(opened), opened, closed, sheet)


def test_leaflets_that_their_coaptation_parts_are_both_found_under_load():
    """Two plates at a thick block, as leaflets at the tissue of both where they touch: one of them was dropped, and a valve
    was fitted to the other alone, 2.5 mm RMS from the truth."""
    step = 0.4e-3
    mask = np.zeros((60, 60, 60), bool)
    mask[10:50, 8:28, 20:23] = True
    mask[10:50, 32:52, 20:23] = True
    block = np.zeros_like(mask)
    block[10:50, 28:32, 15:28] = True
    tissue = Tissue(Grid(step, np.zeros(3), np.eye(3), mask.shape), (mask | block).astype(np.float32), mask | block, 0.0, 1.0)
    results = {"tissue": tissue, "thick": Thick(block.astype(np.int32), 1, 1e-3)}
    for loaded, sides in ((False, 1), (True, 2)):
        leaflets = leaflets_of({**results, "loaded": loaded}).mask
        assert int(leaflets[:, 8:28].any()) + int(leaflets[:, 32:52].any()) == sides


def closed_rims(annulus):
    """Boundaries of two closed leaflets that are one sheet along the middle: each has half of the annulus and a free edge."""
    half = len(annulus) // 2
    rims = []
    for side in (annulus[:half], annulus[half:]):
        share = np.linspace(0, 1, 40)[1:-1, None]
        edge = side[-1] + share * (side[0] - side[-1])
        rims.append(np.vstack([side, edge - [0, 0, 10e-3] * np.sin(np.pi * share)]))
    return rims


@pytest.mark.parametrize("lost", [False, True])
def test_the_annulus_moves_to_the_rims_of_closed_leaflets_though_none_is_the_annulus(lost):
    """The longest rim was taken for the annulus: half of it moved to a free edge."""
    angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    points = np.stack([18e-3 * np.cos(angle), 14e-3 * np.sin(angle), np.zeros(120)], -1)
    motion = np.array([0.3e-3, 0, 1e-3]) + points * [-0.05, 0.03, 0]
    rims = closed_rims(points + motion)
    if lost:  # a corner of a leaflet is not in the loaded image
        rims[0] = rims[0][14:]
    step = _onto_rims(points, rims)
    along = np.roll(points, -1, 0) - np.roll(points, 1, 0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    error = step - motion
    error -= (error * along).sum(axis=1)[:, None] * along  # a rim does not show motion along itself
    # the averaging along the annulus, and what motion along it leaves in an affine one
    assert np.linalg.norm(error, axis=1).max() < (0.5e-3 if lost else 0.25e-3)
    assert not _onto_rims(points, [rims[1]]).any()  # half of the annulus shows no motion of the whole
