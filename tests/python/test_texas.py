"""A real valve compared with Abaqus on a coarse level (all tables: tests/validation/texas.py)."""

import mvs
import numpy as np
import pytest

VERTICES = 1500


@pytest.fixture(scope="module")
def data(real_valves):
    import texas

    pytest.importorskip("pyvista", reason="the frames of Abaqus are read with it")
    folder = real_valves / texas.FOLDER
    if not (folder / texas.INPUT).is_file():
        pytest.skip(f"no {folder / texas.INPUT}")
    return folder


@pytest.fixture(scope="module")
def frame(data):
    import texas

    return texas.read_frame(data)


@pytest.fixture(scope="module")
def opened(data):
    import texas

    return texas.open_valve(data)


@pytest.fixture(scope="module")
def result(data, frame):
    import texas

    return texas.close(texas.open_valve(data, VERTICES), frame)


def test_the_open_frame_is_the_valve_of_the_input(data, opened):
    import texas

    errors = texas.errors_of(opened, texas.read_frame(data, texas.OPEN_FRAME))
    assert errors.nodes == 8587
    # frames have single precision: 20 mm with 7 digits
    assert errors.max < 2e-8


def test_it_has_three_leaflets_and_their_triangles(frame, opened):
    import texas

    names = [part.name for part in opened.parts if part.kind == mvs.PartKind.LEAFLET]
    own = np.array([texas.LEAFLETS.index(name) for name in names])[opened.triangle_leaflet]
    assert np.array_equal(own, frame.quad_leaflet[texas.triangle_of_quad(frame, opened)])


def test_quads_cut_the_other_way_cover_the_same_surface(frame, opened):
    import texas

    valve = mvs.valve_of(opened)
    texas.split_other_way(frame)(valve)

    def sides(triangles):
        return {(a, b) for t in triangles.tolist() for a, b in zip(t, t[1:] + t[:1])}

    before, after = sides(opened.triangle_nodes), sides(valve.triangles)
    # the sides of quads keep their orientation; every diagonal is replaced, once in each triangle
    kept = {frozenset(side) for side in before & after}
    assert kept == {frozenset(side) for side in sides(frame.quads)}
    assert len(before - after) == len(after - before) == 2 * len(frame.quads)


def test_it_closes_as_abaqus_closes_it(result):
    assert result.stats.converged
    assert result.closed.measures.intersections == 0
    assert result.errors.nodes == VERTICES
    # required for about 1,500 vertices; tests/validation/README.md has the measured errors
    assert result.errors.rms <= 0.7e-3


def test_its_boundary_follows_the_input(frame, result):
    import texas

    rows, origin = texas.kept_nodes(result.closed, len(frame.points))
    held = result.closed.node_kind[rows] == mvs.NodeKind.ANNULUS
    assert held.sum() > 50
    off = result.closed.node_position[rows[held]] - frame.points[origin[held]]
    assert np.abs(off).max() < 2e-8


def test_it_can_be_drawn(frame, result, tmp_path):
    from texas_pictures import draw

    assert all(path.stat().st_size > 10_000 for path in draw(result, frame, tmp_path))
