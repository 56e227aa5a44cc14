"""Surgical operations: applied and refused, as the library describes them."""

import inspect
import pickle
import re

import mvs
import numpy as np
import pytest


def site_node(snapshot):
    """A free vertex of P2."""
    scallop = snapshot.find(mvs.PartKind.SCALLOP, "P2").index
    nodes = np.unique(snapshot.triangle_nodes[snapshot.triangle_scallop == scallop])
    tied = snapshot.chord_nodes[:, 1]
    free = nodes[snapshot.node_kind[nodes] == mvs.NodeKind.LEAFLET]
    return int(np.setdiff1d(free, tied)[0])


EXAMPLES = {
    "chord_length": [
        dict(chord="P2/3", factor=0.75),
        dict(chord="P2/3", length=15e-3),
        dict(chord="P2/3", drag_to=(0.0, 0.0, 0.0)),
    ],
    "chord_remove": [dict(chord="P2/3")],
    "chord_add": [
        dict(head="PM1", site=("P2", 0.4, 0.8)),
        dict(head="PM1", site=site_node, type="strut", name="mine", young=30e6, area=1e-6),
        dict(head="PM2", site=(5, (0.3, 0.3, 0.4)), length=0.02),
    ],
    "chord_transfer": [
        dict(chord="P2/3", site=("A2", 0.5, 0.9)),
        dict(chord="A1/2", end="head", head="PM2"),
    ],
    "annulus_scale": [dict(factor=0.95), dict(ap=0.9, cc=1.05)],
    "neochord": [dict(head="PM1", site=("P2", 0.5, 1.0), strands=4, diameter=0.2e-3)],
    "head_move": [
        dict(head="PM1", by=(0, 0, 2e-3), frame="valve"),
        dict(head="PM1", by=np.array([1e-3, 0, 0])),
    ],
    "ring": [
        dict(size=34e-3),
        dict(curve=lambda valve: valve.node_loaded[valve.annulus_nodes] * 0.9, name="own"),
        dict(
            curve=[(0.017 * np.cos(t), 0.013 * np.sin(t), 0) for t in np.linspace(0, 6, 24)],
            landmarks=np.eye(3) * 1e-2,
            landmarks_at=np.eye(3, dtype=np.float32) * 1e-2,
        ),
    ],
    "band": [dict(factor=0.9)],
    "clip": [dict(), dict(angle=0.3)],
    "resect": [dict(scallop="P2", width=6e-3, depth=6e-3)],
    "patch": [dict(site=("P2", 0.5, 0.5))],
}
CASES = [(kind, fields) for kind in mvs.ops.KINDS for fields in EXAMPLES[kind]]


def filled(fields, snapshot):
    return {key: made(snapshot) if callable(made) else made for key, made in fields.items()}


def test_every_kind_has_an_example():
    assert len(mvs.ops.KINDS) >= 7
    assert set(mvs.ops.KINDS) <= set(EXAMPLES)


@pytest.mark.parametrize("kind, fields", CASES)
def test_undo_and_redo_restore_every_bit(sim, kind, fields):
    fields = filled(fields, sim.snapshot())
    before = sim.snapshot().hash
    assert sim.check(kind, **fields) is None
    assert sim.snapshot().hash == before
    made = sim.apply(kind, **fields)
    changed = sim.snapshot()
    assert changed.hash != before
    (entry,) = changed.history
    assert (entry.kind, entry.made, entry.done, entry.group) == (kind, made, True, None)
    assert made is None or made in {part.id for part in changed.parts}
    sim.undo()
    assert sim.snapshot().hash == before
    assert [e.done for e in sim.snapshot().history] == [False]
    sim.redo()
    assert sim.snapshot().hash == changed.hash


@pytest.mark.parametrize("kind, fields", CASES)
def test_an_operation_object_is_the_same_as_its_fields(sim, kind, fields):
    fields = filled(fields, sim.snapshot())
    operation = getattr(mvs.ops, kind)(**fields)
    sim.apply(kind, **fields)
    expected = sim.snapshot().hash
    sim.undo()
    sim.check(operation)
    sim.apply(pickle.loads(pickle.dumps(operation)))
    assert sim.snapshot().hash == expected
    if "points>" not in repr(operation):
        assert eval(repr(operation), {"mvs": mvs}) == operation


def test_factors_scale_their_lengths(sim):
    before = sim.snapshot()
    row = before.find(mvs.PartKind.CHORD, "P2/3").index
    assert sim.apply(mvs.ops.chord_length(chord="P2/3", factor=0.75)) is None
    ratio = sim.snapshot().chord_rest_length / before.chord_rest_length
    assert ratio[row] == pytest.approx(0.75, rel=1e-15)
    assert (np.delete(ratio, row) == 1).all()


def test_a_created_part_can_be_used_by_its_id(sim):
    made = sim.apply("neochord", head="PM1", site=("P2", 0.5, 1.0), name="loop")
    assert sim.snapshot().find(mvs.PartKind.CHORD, "loop").id == made
    sim.apply("chord_length", chord=made, factor=0.9)
    assert "loop" in sim.snapshot().history[1].title


def test_a_new_chord_that_carries_no_force_is_warned_of(sim):
    sim.apply("neochord", head="PM1", site=("P2", 0.5, 1.0), length=0.04, name="loop")
    sim.set_load(mvs.SYSTOLE_PA)
    with pytest.warns(mvs.ValveWarning, match="chord loop carries no force"):
        sim.settle()


def test_only_operations_are_applied(sim):
    with pytest.raises(mvs.ArgumentError, match="not int"):
        sim.apply(3)
    with pytest.raises(mvs.ArgumentError, match="already has its fields"):
        sim.apply(mvs.ops.chord_remove(chord="P2/3"), chord="P2/4")
    with pytest.raises(AttributeError, match="chord_length"):
        mvs.ops.chord_lenght
    with pytest.raises(mvs.StateError), mvs.Simulator() as empty:
        empty.apply("annulus_scale", factor=0.9)


def test_an_operation_is_a_value():
    one = mvs.ops.chord_length(chord="P2/3", factor=0.75)
    assert repr(one) == "mvs.ops.chord_length(chord='P2/3', factor=0.75)"
    assert one == mvs.ops.chord_length(factor=0.75, chord="P2/3", length=None)
    assert len({one, mvs.Operation("chord_length", chord="P2/3", factor=0.75)}) == 1
    assert one != mvs.ops.chord_length(chord="P2/3", factor=0.76)
    with pytest.raises(AttributeError):
        one.kind = None
    with pytest.raises(TypeError):
        one.fields["factor"] = 2


def test_constructors_document_fields_and_units():
    for name, kind in mvs.ops.KINDS.items():
        made = getattr(mvs.ops, name)
        assert kind.help in made.__doc__
        assert set(inspect.signature(made).parameters) == {f.name for f in kind.fields}
        for field in kind.fields:
            assert f"{field.with_unit()}: {field.help}" in made.__doc__
    assert "length (m): new rest length" in mvs.ops.chord_length.__doc__


def test_the_default_of_a_field_is_what_its_help_says_and_an_omitted_field_takes(opened):
    numbers = 0
    for kind in mvs.ops.KINDS.values():
        for field in kind.fields:
            said = re.search(r"\[([^]]*)\]$", field.help)
            if said is None:
                assert field.default is None
            elif isinstance(field.default, str):
                assert field.default == said[1]
                assert not field.choices or field.default in dict(field.choices)
            else:
                assert field.default == float(said[1])
                numbers += 1
    assert numbers >= 5
    assert mvs.ops.KINDS["chord_length"].field("chord").default is None
    # an omitted field and its default give the same valve
    hashes = []
    strands = mvs.ops.KINDS["neochord"].field("strands").default
    assert strands == 2
    assert isinstance(strands, int)
    for fields in ({}, {"strands": strands}):
        with mvs.Simulator() as sim:
            sim.restore(opened)
            sim.apply("neochord", head=opened.chords()[0]["head"], site="P2:0.5:0.9", **fields)
            hashes.append(sim.snapshot().hash)
    assert hashes[0] == hashes[1]
