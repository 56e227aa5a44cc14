"""A valve on a real annulus, set from its arrays, closes (see tests/validation/kaiser.py)."""

from dataclasses import replace

import mvs
import numpy as np
import pytest


@pytest.fixture(scope="module")
def result(real_valves):
    import kaiser

    path = real_valves / kaiser.FILE
    if not path.is_file():
        pytest.skip(f"no {path}")
    return kaiser.close(path)


def test_it_converges_without_crossings(result):
    assert result.stats.converged
    assert result.stats.residual <= 1e-4
    assert result.closed.measures.intersections == 0


@pytest.mark.parametrize("law", ["FUNG", "MAY_NEWMAN_YIN", "PROT"])
def test_a_membrane_with_needles_converges(real_valves, law):
    """Four triangles of the mesh are 16 to 23 um high: exponential laws reach residuals of 1e7 N if
    steps that raise the energy are accepted.
    """
    import kaiser

    path = real_valves / kaiser.FILE
    if not path.is_file():
        pytest.skip(f"no {path}")
    valve, _ = kaiser.read(path)
    valve.leaflets = [replace(leaf, law=mvs.LeafletLaw[law]) for leaf in valve.leaflets]
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        sim.set_load(mvs.SYSTOLE_PA)
        assert sim.settle(max_iterations=400).converged
        assert sim.snapshot().measures.intersections == 0


def test_its_leaflets_are_identified(result):
    opened = result.opened
    area = {
        name: np.count_nonzero(opened.triangle_leaflet == k) for k, name in enumerate("AP")
    }
    assert min(area.values()) > len(opened.triangle_nodes) / 4
    assert opened.frame.axes[2] @ (
        opened.node_position[opened.head_nodes].mean(axis=0) - opened.frame.origin
    ) < 0


def test_its_boundary_is_at_its_prescribed_positions(result):
    held = np.isin(result.closed.node_kind, (mvs.NodeKind.ANNULUS, mvs.NodeKind.HEAD))
    # prescribed nodes are not unknowns
    assert np.array_equal(result.closed.node_position[held], result.closed.node_loaded[held])


def test_it_is_near_its_own_loaded_shape(result):
    found = result.comparison
    assert found.same_mesh
    # another material law, so that the shapes differ (the leaflets are 16 to 26 mm tall)
    assert found.surface_rms < 4e-3
    assert found.surface_rms <= found.node_rms


def test_its_shape_can_be_plotted(result, tmp_path):
    import kaiser

    kaiser.draw([result], tmp_path)
    assert len(list(tmp_path.glob("*.png"))) == 3
    text = kaiser.table([result], 2)
    assert "crossing" in text and "over 2 of 2 paths at rest" in text
