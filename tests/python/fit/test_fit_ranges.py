"""Bounds of a fit lie within the values that the library accepts; a valve that it refuses ends nothing."""

import dataclasses

import numpy as np
import pytest
from fitted import reclosed

import mvs

pytest.importorskip("scipy")


@pytest.fixture(scope="module")
def membrane():
    """The default valve, whose leaflets are bilinear membranes, small and closed."""
    with mvs.Simulator() as sim:
        sim.generate(vertices=200)
        sim.set_load(mvs.SYSTOLE_PA)
        assert sim.settle().converged
        return sim.snapshot()


def with_tissue(start, law=None, **constants):
    """The leaflets of a valve with other constants, of their own law or of another."""
    leaflets = []
    for leaflet in mvs.valve_of(start).leaflets:
        law = leaflet.law if law is None else law
        keys = [constant.key for constant in mvs.leaflet_law(law).constants]
        old = dict(zip(keys, leaflet.constants)) if law == leaflet.law else {}
        leaflets.append(mvs.Leaflet(leaflet.name, leaflet.thickness, {**old, **constants}, law, leaflet.id))
    return leaflets


def tracked(valve, count=None, noise=0.0, seed=9):
    """Tracked leaflet vertices of a valve, all or some."""
    nodes = np.flatnonzero(valve.node_kind == mvs.NodeKind.LEAFLET)
    random = np.random.default_rng(seed)
    nodes = nodes if count is None else random.choice(nodes, count, replace=False)
    return mvs.Points(nodes, valve.node_position[nodes] + noise * random.normal(size=(len(nodes), 3)))


def free_of(start, group):
    from mvs.fitting.parameters import free_parameters

    return free_parameters(start, [group], None)


def opened_with(start, **fields):
    """The valve with other fields, as it is, not closed."""
    valve = dataclasses.replace(mvs.valve_of(start), **fields)
    with mvs.Simulator(log=lambda level, text: None) as sim:
        sim.set_valve(valve)
        return sim.snapshot()


@pytest.mark.parametrize("law, zero", [
    ("bilinear", None), ("fung", None), ("prot", "c2"), ("may_newman_yin", "c2"), ("neo_hookean", None),
    ("neo_hookean", "bending"), ("spring", "kink"),
])
def test_the_library_accepts_every_bound_of_every_law(membrane, law, zero):
    start = opened_with(membrane, leaflets=with_tissue(membrane, law, **({zero: 0} if zero else {})))
    free = free_of(start, "tissue")
    with mvs.Simulator(log=lambda level, text: None) as sim:
        for z in (free.low, free.high):
            sim.set_valve(free.valve(z, start.node_position))
    assert (free.low <= 0).all() and (free.high > 0).all()
    # 0 stands for no bending limit: no number next to it does the same
    assert any("bending" in label for label in free.labels) == (law == "neo_hookean" and not zero)


def test_the_deviation_of_a_constant_counts_from_the_low_end_of_its_range(membrane):
    free = free_of(membrane, "tissue")
    start, deviation = dict(zip(free.labels, free.start)), dict(zip(free.labels, free.deviation))
    # Ic is I1 where fibres are straight, and I1 is 3 at rest
    assert deviation["tissue A ic"] == pytest.approx(0.2 * (start["tissue A ic"] - 3), rel=1e-12)
    assert deviation["tissue A c"] == pytest.approx(0.2 * start["tissue A c"], rel=1e-6)  # from 1e-3 Pa
    at_end = opened_with(membrane, leaflets=with_tissue(membrane, ic=3))
    free = free_of(at_end, "tissue")
    row = free.labels.index("tissue A ic")
    assert free.low[row] == 0 and free.deviation[row] == pytest.approx(0.2 * 0.1611, rel=1e-9)


def test_thickness_that_varies_stays_within_its_range(membrane):
    each = membrane.triangle_thickness * np.random.default_rng(1).uniform(0.3, 1.6, len(membrane.triangle_nodes))
    start = reclosed(membrane, triangle_thickness=each)
    free = free_of(start, "thickness")
    for z in (free.low, free.high):
        valve = free.valve(z, start.node_position)
        assert valve.triangle_thickness.min() >= 1e-5 and valve.triangle_thickness.max() <= 2e-2
    # of 0.3 times the thickness 0.24 mm are left, less than the three deviations of 0.16 mm
    assert (free.low > -2).all() and np.allclose(free.high, 3)
    truth = reclosed(start, triangle_thickness=0.4 * each)
    found = mvs.fit(start, tracked(truth), free="thickness", noise=0.3e-3, most=4)
    assert (found.z >= free.low).all() and (found.values < free.start).all()


def test_a_fit_of_stiffer_tissue_with_a_lower_ic_ends(membrane):
    valve = mvs.valve_of(membrane)
    old = valve.leaflets[0].constants
    leaflets = with_tissue(membrane, c=3 * old[0], a=3 * old[1], ic=0.96 * old[2])
    truth = reclosed(membrane, leaflets=leaflets)
    # it stopped with "constant Ic 2.97769, outside 3 to 100"
    with pytest.warns(mvs.ValveWarning, match="the model does not explain the data"):
        found = mvs.fit(membrane, tracked(truth), free="tissue", noise=1e-5, most=4)
    assert found.rms < np.sqrt(np.mean(found.residuals_before**2))
    assert found.misfit == found.rms / 1e-5 and found.misfit > 1.5
    assert f"{found.misfit:.1f} times the noise: the model does not explain the data" in repr(found)


def test_draws_of_tissue_that_data_hardly_determine_close(membrane):
    found = mvs.fit(membrane, tracked(membrane, 6, 1e-3), free="tissue", noise=1e-3)
    assert found.misfit < 1.5 and "explain" not in repr(found)
    drawn = found.sample(12, seed=1)
    assert (drawn >= found.free.low).all() and (drawn <= found.free.high).all()
    # it stopped with "constant Ic 2.94311, outside 3 to 100"
    assert len(found.interval("coaptation", samples=4).samples) == 4


def test_a_trial_that_the_library_refuses_is_worse_than_the_start(membrane):
    from mvs.fitting.fit import LOST, Problem
    from mvs.fitting.targets import target_of

    target = target_of(membrane, tracked(reclosed(membrane, leaflets=with_tissue(membrane, c=6e4, a=9e6))))
    free = free_of(membrane, "tissue")
    # beyond the bounds, without the values that are clipped to them
    free = dataclasses.replace(free, lowest=np.full(len(free.start), -np.inf))
    problem = Problem(membrane, free, target, 1e-6, True, 1e-5)
    zero = problem.residuals(np.zeros(len(free.start)))
    far = np.where([label.endswith(" ic") for label in free.labels], -6.0, 0.0)
    assert problem.close(far) is None
    refused = problem.residuals(far)
    assert not problem.trace[-1].at_rest and np.abs(zero).max() > LOST
    # each datum was 10 deviations away, fewer than those of the start
    assert refused @ refused > zero @ zero and problem.best is not membrane
