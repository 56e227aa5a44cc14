"""mvs.imaging.microct: ways of chordae that touch, and the insertions of curved ones."""

import numpy as np
import pytest

pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
pytest.importorskip("pyvista", reason="needs the extra imaging (PyVista)")

from mvs.imaging.grid import Grid  # noqa: E402
from mvs.imaging.mesh import Sheet  # noqa: E402
from mvs.imaging.microct.chords import chords_of  # noqa: E402
from mvs.imaging.microct.graph import Muscles, Paths, paths_of  # noqa: E402
from mvs.imaging.microct.segment import Thick, Tissue  # noqa: E402

VOXEL, TOP, DIAMETER = 0.2, 16.0, 0.8  # mm: voxels, the leaflet's height, chordae


def leaflet():
    """A plane sheet 0.8 mm thick at z = TOP."""
    x, y = np.meshgrid(np.arange(0, 12.1, 0.3), np.arange(0, 6.1, 0.3), indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, TOP)]) * 1e-3
    row = np.arange(points.shape[0]).reshape(x.shape)
    a, b, c, d = row[:-1, :-1].ravel(), row[1:, :-1].ravel(), row[1:, 1:].ravel(), row[:-1, 1:].ravel()
    return Sheet(points, np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])]),
                 {"thickness": np.full(len(points), 0.8e-3)})


def segmented(lines, muscles):
    """Results of the stages before `paths`: straight chordae (start, end) and round muscles, mm, below a leaflet."""
    shape = (86, 31, 61)  # z, y, x
    at = np.stack(np.meshgrid(*[np.arange(n) for n in shape], indexing="ij"), -1)[..., ::-1] * VOXEL
    mask = np.abs(at[..., 2] - TOP) < 0.4
    for start, end in np.asarray(lines, float):
        along = (end - start) / np.linalg.norm(end - start)
        place = np.clip((at - start) @ along, 0, np.linalg.norm(end - start))
        mask |= np.linalg.norm(at - start - place[..., None] * along, axis=-1) < DIAMETER / 2
    label = np.zeros(shape, np.int32)
    for k, centre in enumerate(muscles):
        label[np.linalg.norm(at - centre, axis=-1) < 1.5] = k + 1
    grid = Grid(VOXEL * 1e-3, np.zeros(3), np.eye(3), shape[::-1])
    mask |= label > 0
    names = tuple(range(1, len(muscles) + 1))
    return {"tissue": Tissue(grid, mask.astype(np.float32), mask, 0.0, 1.0), "sheet": leaflet(),
            "thick": Thick(label, len(muscles), 1e-3),
            "muscles": Muscles(names, label > 0, np.zeros(shape, bool))}


def ends_of(results):
    """Muscle and the x of the insertion, mm, of each way."""
    paths = paths_of(results)
    return sorted((label, float(paths.voxels[path[-1]][2] * VOXEL))
                  for label, path in zip(paths.muscle, paths.paths))


def test_chordae_that_cross_go_straight_on():
    """Two chordae touch halfway. The shortest paths to both ends come from the first muscle, the nearer one."""
    muscles = np.array([[3.0, 3, 4], [9.0, 3, 1.5]])
    lines = [(muscles[0], (9.0, 3, TOP)), (muscles[1], (3.0, 3, TOP))]
    found = ends_of(segmented(lines, muscles))
    assert [label for label, _ in found] == [1, 2]
    # the skeleton ends up to REACH, 1.5 mm, below a leaflet that a chord meets at 60 degrees
    assert [x for _, x in found] == pytest.approx([9.0, 3.0], abs=1.0)


def test_a_chord_that_forks_has_two_ways_that_begin_alike():
    muscle, fork = np.array([6.0, 3, 2]), np.array([6.0, 3, 9])
    results = segmented([(muscle, fork), (fork, (3.0, 3, TOP)), (fork, (9.0, 3, TOP))], [muscle])
    paths = paths_of(results)
    assert len(paths.paths) == 2
    first, second = paths.paths
    shared = np.flatnonzero(first[: len(second)] != second[: len(first)])[0]
    # the junction of cables 0.8 mm wide lies within their width of the fork, and the muscle ends 1.5 mm above its centre
    assert paths.voxels[first[shared - 1]][0] * VOXEL == pytest.approx(9.0, abs=DIAMETER)
    assert shared * VOXEL == pytest.approx(9.0 - 3.5, abs=1.2)


def test_chordae_that_end_in_one_place_are_two():
    """They share their last 2 mm: the shortest path to their common end left one of them out."""
    muscles = np.array([[3.0, 3, 2], [9.0, 3, 2]])
    join = np.array([6.0, 3, TOP - 2])
    found = ends_of(segmented([(muscles[0], join), (muscles[1], join), (join, (6.0, 3, TOP))], muscles))
    assert [label for label, _ in found] == [1, 2]


def test_a_curved_chord_is_continued_along_its_curve():
    """An arc with a radius of 10 mm is seen up to 2.5 mm before the leaflet, which it meets at 25 degrees; a
    straight continuation misses the insertion by 3 mm. The slope of 4 mm of voxels of 0.2 mm is known to 0.05, and the
    continuation is 10 times the sine of 25 degrees high: 0.6 mm."""
    angle = np.arange(0, 0.8, 1e-3)  # from the insertion on backwards
    slope = np.radians(25) - angle
    x = -10 * (np.sin(np.radians(25)) - np.sin(slope))
    z = 10 * (np.cos(np.radians(25)) - np.cos(slope))
    line = np.column_stack([6.0 + x, np.full(len(x), 3.0), TOP + z])
    seen = np.rint(line[angle > 0.25][::-1] / VOXEL).astype(int)[:, ::-1]
    voxels = seen[np.r_[True, (np.diff(seen, axis=0) != 0).any(axis=1)]]
    mask = np.zeros((86, 31, 61), bool)
    mask[tuple(voxels.T)] = True
    grid = Grid(VOXEL * 1e-3, np.zeros(3), np.eye(3), mask.shape[::-1])
    network = chords_of({
        "tissue": Tissue(grid, mask.astype(np.float32), mask, 0.0, 1.0), "sheet": leaflet(),
        "paths": Paths(voxels, (np.arange(len(voxels)),), (1,), mask)})
    assert np.linalg.norm(1e3 * network.nodes[-1] - [6.0, 3.0, TOP]) < 0.6
