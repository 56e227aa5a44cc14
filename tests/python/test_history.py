"""The history of a valve: undo, redo, groups, checkpoints; and operated valves as arrays."""

import mvs
import numpy as np
import pytest


def test_groups_are_undone_together(sim):
    first = sim.snapshot().hash
    with sim.group("repair of P2"):
        sim.apply("chord_length", chord="P2/3", factor=0.75)
        sim.apply("neochord", head="PM1", site=("P2", 0.5, 1.0))
    entries = sim.snapshot().history
    assert [e.group_name for e in entries] == ["repair of P2"] * 2
    assert entries[0].group == entries[1].group is not None
    both = sim.snapshot().hash
    sim.undo()
    assert sim.snapshot().hash == first
    sim.redo()
    assert sim.snapshot().hash == both


def test_a_group_ends_when_an_operation_raises(sim):
    first = sim.snapshot().hash
    with pytest.raises(mvs.IdError), sim.group("repair"):
        sim.apply("chord_length", chord="P2/3", factor=0.75)
        sim.apply("chord_remove", chord="P9/9")
    assert len(sim.snapshot().history) == 1
    sim.undo()
    assert sim.snapshot().hash == first
    sim.begin_group("by hand")
    with pytest.raises(mvs.StateError, match="by hand"):
        sim.undo()
    sim.end_group()
    with pytest.raises(mvs.StateError):
        sim.end_group()


def test_undo_and_redo_stop_at_the_ends_of_the_history(sim):
    for call in (sim.undo, sim.redo):
        with pytest.raises(mvs.StateError, match="no operation to"):
            call()
    sim.apply("chord_length", chord="P2/3", factor=0.75)
    assert "P2/3" in sim.snapshot().history[0].title
    sim.generate(shape="founding")
    assert sim.snapshot().history == ()


def test_checkpoints_restore_every_bit(sim):
    sim.apply("annulus_scale", factor=1.1)
    sim.set_checkpoint("dilated")
    kept = sim.snapshot()
    assert kept.checkpoints == ("dilated",)
    sim.undo()
    sim.apply("chord_remove", chord="P2/3")
    sim.restore_checkpoint("dilated")
    assert sim.snapshot().hash == kept.hash
    assert [e.kind for e in sim.snapshot().history] == ["annulus_scale"]
    with pytest.raises(mvs.IdError, match='"none"'):
        sim.restore_checkpoint("none")
    with pytest.raises(mvs.ArgumentError):
        sim.set_checkpoint("")


def test_restoring_a_snapshot_restores_its_history(sim):
    sim.apply("annulus_scale", factor=1.1)
    one = sim.snapshot()
    sim.apply("chord_remove", chord="P2/3")
    sim.restore(one)
    assert len(sim.snapshot().history) == 1
    sim.undo()
    assert sim.snapshot().history[0].done is False


def test_an_operated_valve_comes_back_as_arrays(sim):
    sim.apply("chord_remove", chord="P2/3")
    sim.apply("head_move", head="PM1", by=(0, 0, 2e-3))
    sim.apply("annulus_scale", factor=1.05)
    operated = sim.snapshot()
    valve = mvs.valve_of(operated)
    assert not np.array_equal(valve.nodes_open, valve.nodes)
    with mvs.Simulator() as other:
        other.set_valve(valve)
        again = other.snapshot()
    assert again.hash == operated.hash
    assert again.history == ()
    valve.nodes_open = None
    with mvs.Simulator() as other:
        other.set_valve(valve)
        assert other.snapshot().hash != operated.hash


def test_rings_and_origins_come_back_as_arrays(opened):
    valve = mvs.valve_of(opened)
    assert valve.rings == [] and (valve.node_origin == np.arange(len(valve.nodes))).all()
    curve = opened.node_rest[opened.annulus_nodes]
    valve.rings = [
        mvs.Ring("ring", curve),
        mvs.Ring("band", curve[:9].astype(np.float32), mvs.RingKind.BAND),
    ]
    valve.node_origin = valve.node_origin[::-1].copy()
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        one = sim.snapshot()
        again = mvs.valve_of(one)
        sim.set_valve(again)
        two = sim.snapshot()
    assert one.hash == two.hash != opened.hash
    assert [(ring.name, ring.kind) for ring in again.rings] == [
        ("ring", mvs.RingKind.RIGID),
        ("band", mvs.RingKind.BAND),
    ]
    assert np.array_equal(again.rings[0].curve, curve)
    assert again.rings[1].id == two.find(mvs.PartKind.RING, "band").id
    assert np.array_equal(two.node_origin, valve.node_origin)
