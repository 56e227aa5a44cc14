"""Sweeps: rows in the order of the combinations, the same with every executor."""

from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor

import mvs
import numpy as np
import pytest

OPS = [
    ("ring", {"size": [30e-3, 34e-3]}),
    ("chord_length", {"chord": "P2/3", "factor": np.array([0.8, 0.9])}),
]
QUICK = {"max_iterations": 3}


@pytest.fixture(scope="module")
def serial(opened):
    return mvs.sweep(opened, OPS, pressure_pa=mvs.SYSTOLE_PA, settle=QUICK)


def test_rows_are_in_the_order_of_the_combinations(opened, serial):
    assert list(zip(serial["ring.size"], serial["chord_length.factor"])) == [
        (30e-3, 0.8), (30e-3, 0.9), (34e-3, 0.8), (34e-3, 0.9)
    ]
    assert serial.units["ring.size"] == "m" and set(serial["error"]) == {""}
    with mvs.Simulator() as sim:
        sim.restore(opened)
        sim.apply("ring", size=30e-3)
        sim.apply("chord_length", chord="P2/3", factor=0.9)
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle(**QUICK)
        alone = sim.snapshot().measures
    assert all(isinstance(row[name], bool) for row in serial for name in ("converged", "at_rest"))
    assert serial[1]["tenting_height"] == alone.tenting_height
    assert serial[1]["max_chord_tension"] == alone.max_chord_tension


@pytest.mark.parametrize("pool", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_rows_do_not_depend_on_the_executor(opened, serial, pool):
    with pool(2) as executor:
        rows = mvs.sweep(opened, OPS, executor, pressure_pa=mvs.SYSTOLE_PA, settle=QUICK)
    assert list(rows) == list(serial)


def test_an_impossible_combination_is_a_row_with_its_sentence(opened):
    rows = mvs.sweep(mvs.valve_of(opened), [("ring", {"size": [8e-3, 34e-3]})], settle=QUICK)
    assert "take a larger ring" in rows[0]["error"] and np.isnan(rows[0]["annulus_ap"])
    assert rows[1]["error"] == "" and rows[1]["annulus_ap"] > 0


def test_operations_of_one_kind_have_columns_of_their_own(opened):
    ops = [("chord_length", {"chord": "P2/3", "factor": 0.9}),
           mvs.ops.annulus_scale(factor=0.95),
           ("chord_length", {"chord": ["A2/1", "A2/2"], "factor": 0.9})]
    rows = mvs.sweep(opened, ops, settle=QUICK)
    assert rows.columns[:2] == ("chord_length 3.chord", "converged")
    assert rows["chord_length 3.chord"] == ["A2/1", "A2/2"] and set(rows["error"]) == {""}


def test_wrong_operations_are_refused_before_any_work(opened):
    for ops, words in (
        ([("rign", {"size": 1})], 'no operation "rign"'),
        ([("ring", {"szie": 1})], 'no field "szie"'),
        ([("ring", {"size": ["a"]})], "a number in m"),
        ([("ring", {"size": []})], "has no values"),
        ([3], "a pair"),
    ):
        with pytest.raises(mvs.ArgumentError, match=words):
            mvs.sweep(opened, ops)


class Idle(Executor):
    """Refuses to begin, which would be work."""

    def submit(self, *given, **named):
        raise AssertionError("work has begun")


@pytest.mark.parametrize("options, error, words", [
    ({"pressure_pa": float("nan")}, mvs.ArgumentError, "pressure"),
    ({"settle": {"residual": -1}}, mvs.ArgumentError, "residual is -1"),
    ({"settle": {"max_iterations": 0}}, mvs.ArgumentError, "max_iterations: 0 is given"),
    ({"settle": {"residul": 1e-4}}, TypeError, "residul"),
    ({"cost": {"flow": 5.0}}, mvs.ArgumentError, "flow is 5 m3/s"),
    ({"cost": {"flwo": 5.0}}, TypeError, "flwo"),
])
def test_faults_that_every_row_has_are_raised_before_any_work(opened, options, error, words):
    with pytest.raises(error, match=words):
        mvs.sweep(opened, OPS, Idle(), **options)


def test_valves_and_executors_of_other_kinds_are_refused(opened, sim):
    for valve in (sim, "valve.obj"):
        with pytest.raises(mvs.ArgumentError, match="^valve: a mvs.Valve or mvs.Snapshot is needed"):
            mvs.sweep(valve, OPS)
    with pytest.raises(mvs.ArgumentError, match="^executor: an executor .* not 3 "):
        mvs.sweep(opened, OPS, 3)


class Interrupted(Future):
    """A row during which Ctrl-C comes."""

    def result(self, timeout=None):
        raise KeyboardInterrupt


def test_ctrl_c_cancels_the_rows_that_have_not_begun(opened):
    class Full(Executor):
        """Begins nothing but a first row."""

        def submit(self, *given, **named):
            waiting.append(Future() if waiting else Interrupted())
            return waiting[-1]

    waiting = []
    with pytest.raises(KeyboardInterrupt):
        mvs.sweep(opened, OPS, Full(), settle=QUICK)
    assert len(waiting) == 4 and all(row.cancelled() for row in waiting)


@pytest.mark.parametrize("pool", [None, ProcessPoolExecutor])
def test_values_like_another_unit_are_warned_of_once(opened, pool):
    site = ("P2", 0.5, 1.0)
    ops = [("ring", {"size": [30e-3, 34e-3]}),
           ("neochord", {"head": "PM1", "site": site, "length": 12e-3, "young": 400.0})]
    executor = pool and pool(2)
    with pytest.warns(mvs.ValveWarning) as caught:
        mvs.sweep(opened, ops, executor, pressure_pa=120, settle=QUICK)
    if executor:
        executor.shutdown()
    assert [each.filename for each in caught] == [__file__] * 2
    assert "looks like a modulus in kPa or MPa given as Pa" in str(caught[0].message)
    assert "looks like mmHg given as Pa" in str(caught[1].message)


def test_a_loaded_snapshot_keeps_its_load(opened):
    with mvs.Simulator() as sim:
        sim.restore(opened)
        sim.set_load(9000.0, 0.25)
        sim.settle(**QUICK)
        half = sim.snapshot()
        sim.apply("chord_length", chord="P2/3", factor=0.9)
        sim.set_load(9000.0, 0.25)
        sim.settle(**QUICK)
        alone = sim.snapshot().measures
    (row,) = mvs.sweep(half, [("chord_length", {"chord": "P2/3", "factor": [0.9]})], settle=QUICK)
    assert row["annulus_area"] == alone.annulus_area
    assert row["tenting_height"] == alone.tenting_height


def test_rows_without_a_value_are_sorted_behind_the_others():
    nan = float("nan")
    table = mvs.Table(({"a": value} for value in (3.0, nan, 1.0, nan, 2.0)), {"a": "m"})
    assert table.sorted("a")["a"][:3] == [1.0, 2.0, 3.0]
    assert table.sorted("a", reverse=True)["a"][:3] == [3.0, 2.0, 1.0]
    assert all(np.isnan(table.sorted("a", reverse=True)["a"][3:]))
