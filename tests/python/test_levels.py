"""Mesh levels: finer and coarser meshes of one valve, and states between them."""

import mvs
import numpy as np
import pytest


def test_refining_keeps_old_nodes_and_parts(sim):
    before = sim.snapshot()
    sim.refine()
    after = sim.snapshot()
    n = len(before.node_rest)
    assert len(after.triangle_nodes) == 4 * len(before.triangle_nodes)
    assert np.array_equal(after.node_rest[:n], before.node_rest)
    assert np.array_equal(after.node_origin[:n], np.arange(n))
    assert np.all(after.node_origin[n:] == np.iinfo(np.uint32).max)
    assert after.parts == before.parts
    sim.refine(2)
    assert len(sim.snapshot().triangle_nodes) == 64 * len(before.triangle_nodes)


def test_a_coarse_result_is_compared_with_a_fine_one_node_by_node(sim):
    fine = sim.snapshot()
    made = sim.coarsen(vertices=220)
    assert made.vertices == 220
    assert made.surface_rms < 0.2e-3  # m, of the shipped valve with edges of 3 mm
    coarse = sim.snapshot()
    assert np.array_equal(coarse.node_rest, fine.node_rest[coarse.node_origin])


def test_a_coarse_closure_is_transferred_to_the_fine_level(sim, opened):
    sim.coarsen(edge=3e-3)
    sim.set_load(mvs.SYSTOLE_PA)
    assert sim.settle().converged
    coarse = sim.snapshot()
    sim.restore(opened)
    sim.transfer_state(coarse)
    fine = sim.snapshot()
    assert fine.load_case == coarse.load_case
    assert np.array_equal(fine.node_position[coarse.node_origin], coarse.node_position)
    assert sim.settle().converged


def test_impossible_levels_are_refused(sim):
    with pytest.raises(mvs.ArgumentError, match="it needs"):
        sim.coarsen(vertices=3)
    with pytest.raises(mvs.ArgumentError, match="either vertices or edge"):
        sim.coarsen()
    with pytest.raises(mvs.ArgumentError, match="refine"):
        sim.coarsen(vertices=10**6)
    before = sim.snapshot().hash
    with pytest.raises(mvs.ArgumentError, match="cannot be split 20 times: the limit is"):
        sim.refine(20)
    assert sim.snapshot().hash == before
