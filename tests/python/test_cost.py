"""Cost of a repair: Snapshot.cost(), in sweeps, and its chapter of the report."""

import math

import mvs
import numpy as np
import pytest


def test_costs_have_the_open_valve_beside_their_figures(closed):
    cost = closed.cost(flow=250e-6)
    assert cost.opened and cost.open_valve.at_rest
    assert cost.open_valve.load_case == mvs.Load(-mvs.DIASTOLE_PA, 0.0)
    assert cost.open_area == cost.open_valve.measures.regurgitant_orifice_area
    speed = 250e-6 / (0.85 * cost.open_area)
    assert cost.gradient == pytest.approx(0.5 * 1060 * speed**2, rel=1e-12)
    assert cost.sam_risk is mvs.SamRisk.NOT_DETERMINED and math.isnan(cost.septal_distance)
    assert "m2: smallest cross-section" in mvs.Cost.__doc__


def test_the_septum_gives_a_distance_and_a_risk(closed):
    frame = closed.frame
    for away, risk in ((60e-3, mvs.SamRisk.LOW), (5e-3, mvs.SamRisk.RAISED)):
        point = frame.origin + frame.axes.T @ [away, 0.0, -10e-3]
        cost = closed.cost(septum=np.array([point, point + frame.axes[0]]))
        expected = mvs.SamRisk.RAISED if cost.length_ratio <= 1.3 else risk
        assert cost.sam_risk is expected
        assert 0 < cost.septal_distance < away + 30e-3
    with pytest.raises(mvs.ArgumentError, match="septum"):
        closed.cost(septum=np.zeros((2, 2)))
    with pytest.raises(mvs.ArgumentError, match=r"point 1 is \(0\.02, nan, 0\)"):
        closed.cost(septum=np.array([[20e-3, 0, 0], [20e-3, np.nan, 0]]))
    behind = frame.origin + [[-40e-3, 0, -10e-3]] @ frame.axes
    with pytest.raises(mvs.ArgumentError, match="on the side of the posterior leaflet"):
        closed.cost(septum=behind)


def test_pressure_and_flow_in_other_units_are_refused(closed):
    with pytest.raises(mvs.ArgumentError, match="pressure"):
        closed.cost(pressure_pa=-5.0)
    with pytest.raises(mvs.ArgumentError, match="looks like mmHg or kPa given as Pa"):
        closed.cost(pressure_pa=5.0)
    with pytest.raises(mvs.ArgumentError, match="0.25 ml/s: .* give it in m3/s"):
        closed.cost(flow=0.25e-6)


@pytest.mark.filterwarnings("ignore::mvs.ValveWarning")
def test_a_resection_changes_neither_the_risk_nor_the_height_of_the_leaflet():
    costs = []
    for resected in ({}, {"width": 5e-3}, {"width": 8e-3, "base_width": 5e-3}):
        with mvs.Simulator() as sim:
            sim.generate()
            if resected:
                sim.apply("resect", **resected)
            sim.set_load(mvs.SYSTOLE_PA)
            assert sim.settle().converged
            valve = sim.snapshot()
            septum = valve.frame.origin + [[60e-3, 0, -10e-3]] @ valve.frame.axes
            costs.append(valve.cost(septum=septum))
    for cost in costs:
        assert cost.sam_risk is mvs.SamRisk.LOW
        # 2.8 mm from the annulus to the seam
        assert cost.posterior_height == pytest.approx(costs[0].posterior_height, abs=1.1e-3)
        # 11.5 with the strip of the quadrangle taken for coaptation
        assert 1.3 < cost.length_ratio < 2.6


def test_the_annulus_bears_the_forces_on_its_nodes(closed):
    force = np.linalg.norm(closed.annulus_force, axis=1)
    assert np.array_equal(closed.annulus_force, closed.node_force[closed.annulus_nodes])
    cost = closed.cost()
    assert cost.annulus_force_max == force.max()
    assert cost.annulus_force_sum == pytest.approx(force.sum(), rel=1e-12)


def test_a_sweep_can_measure_costs(opened):
    rings = {"size": [28e-3, 34e-3]}
    table = mvs.sweep(opened, [("ring", rings)], cost={"flow": 250e-6})
    assert table.units["cost.open_area"] == "m2" and table.units["cost.gradient"] == "Pa"
    assert all(area > 1e-4 for area in table["cost.open_area"])
    assert table["cost.rings"] == [1, 1]
    assert "cost.open_area" not in mvs.sweep(opened, [("ring", rings)]).units
    failed = mvs.sweep(opened, [("ring", {"size": [1.0]})], cost={})
    assert failed["error"][0] and math.isnan(failed["cost.open_area"][0])


def test_the_report_has_a_column_for_each_valve(opened, closed):
    from mvs.report import cases, cost

    stats = mvs.Stats(
        True, 1, 0, 0, True, 1e-6, 0.0, 0.0, 0.1, 1.0, -1.0, mvs.Profile(*[0] * 17)
    )
    text = cost.as_html([cases.Case("a", "Valve <A>", "", opened, closed, stats)])
    area = closed.cost().open_area
    assert f"<th>Open area, mm²</th><td>{area * 1e6:.0f}</td>" in text
    assert "Valve &lt;A&gt;" in text and "opened again by 5 mmHg" in text


def test_the_opening_reports_progress_and_can_be_cancelled(closed):
    shares = []
    closed.cost(progress=lambda share, residual: shares.append(share))
    assert shares and shares == sorted(shares)
    with pytest.raises(mvs.CancelledError):
        closed.cost(progress=lambda *_: True)
