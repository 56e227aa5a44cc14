"""Surgical operations from Python: every kind by its description, undo, history, and refusals."""

import mvs
import numpy as np
import pytest


def a_chord(snapshot):
    return next(part for part in snapshot.parts if part.kind == mvs.PartKind.CHORD)


def test_every_kind_and_field_is_described():
    kinds = {kind.name: kind for kind in mvs.operations()}
    assert {"chord_length", "chord_remove", "chord_add", "annulus_scale"} <= set(kinds)
    for kind in kinds.values():
        assert kind.help and kind.fields
        for field in kind.fields:
            assert field.help and field.type
            assert field.type != "number" or field.low < field.high
    end = {field.name: field for field in kinds["chord_transfer"].fields}["end"]
    assert end.choices == {"leaflet": 1, "head": 2}


@pytest.mark.parametrize("how", ["part", "name", "id"])
def test_a_part_may_be_given_as_itself_its_name_or_its_id(sim, how):
    before = sim.snapshot()
    chord = a_chord(before)
    given = {"part": chord, "name": chord.name, "id": chord.id}[how]
    assert sim.apply_op("chord_length", chord=given, factor=0.75) == 0
    after = sim.snapshot().chord_rest_length
    assert after[chord.index] == 0.75 * before.chord_rest_length[chord.index]
    assert np.array_equal(np.delete(after, chord.index),
                          np.delete(before.chord_rest_length, chord.index))


def test_undo_and_redo_give_every_bit_back(sim):
    before = sim.snapshot().hash
    sim.apply_op("annulus_scale", factor=1.1)
    after = sim.snapshot().hash
    sim.undo()
    assert sim.snapshot().hash == before != after
    sim.redo()
    assert sim.snapshot().hash == after
    with pytest.raises(mvs.StateError):
        sim.redo()


def test_the_history_tells_what_was_done(sim):
    chord = a_chord(sim.snapshot())
    sim.apply_op("annulus_scale", factor=1.1)
    sim.set_checkpoint("dilated")
    sim.begin_group("repair")
    sim.apply_op("annulus_scale", factor=0.9)
    sim.apply_op("chord_remove", chord=chord)
    sim.end_group()
    history = sim.snapshot().history
    assert [entry.kind for entry in history.done] == [
        "annulus_scale", "annulus_scale", "chord_remove",
    ]
    assert [entry.in_group for entry in history.done] == ["", "repair", "repair"]
    assert chord.name in history.done[2].title
    assert history.undone == () and history.checkpoints == ("dilated",)
    sim.undo()
    history = sim.snapshot().history
    assert len(history.done) == 1 and len(history.undone) == 2
    sim.restore_checkpoint("dilated")
    assert sim.snapshot().history.undone == ()


def test_a_site_may_be_a_node_a_triangle_or_a_place_in_a_scallop(sim):
    opened = sim.snapshot()
    head = next(part for part in opened.parts if part.kind == mvs.PartKind.HEAD)
    free = np.setdiff1d(opened.triangle_nodes, opened.chord_nodes)
    node = int(free[opened.node_kind[free] == mvs.NodeKind.LEAFLET][0])
    for site in (node, (17, (0.3, 0.3, 0.4)), ("P2", 0.4, 0.7)):
        made = sim.apply_op("chord_add", head=head, site=site, length=0.02, type="rough_zone")
        now = sim.snapshot()
        row = next(p.index for p in now.parts if p.kind == mvs.PartKind.CHORD and p.id == made)
        assert now.chord_rest_length[row] == 0.02
        assert now.chord_kind[row] == mvs.ChordKind.ROUGH_ZONE
        assert now.chord_nodes[row, 0] == now.head_nodes[head.index]
        if site == node:
            assert now.chord_nodes[row, 1] == node
        sim.undo()
    assert sim.snapshot().hash == opened.hash


@pytest.mark.parametrize(
    ("kind", "fields", "error", "words"),
    [
        ("chord_lenght", {}, mvs.ArgumentError, "chord_length"),
        ("chord_length", {"chrod": 3}, mvs.ArgumentError, "chord, length, factor"),
        ("chord_length", {"chord": "Z9/9", "factor": 0.5}, mvs.IdError, "Z9/9"),
        ("chord_length", {"chord": "A2/1", "factor": 0}, mvs.ArgumentError, "factor is 0"),
        ("chord_length", {"chord": "A2/1", "factor": -1}, mvs.ArgumentError, "factor is -1"),
        ("chord_length", {"chord": "A2/1", "factor": "half"}, mvs.ArgumentError, "a number"),
        ("chord_length", {"chord": "A2/1", "drag_to": (0, 1)}, mvs.ArgumentError, "three numbers"),
        ("chord_length", {"factor": 0.5}, mvs.IdError, "chord is not given"),
        ("chord_add", {"head": "PM1", "site": "P2"}, mvs.ArgumentError, "a node"),
        ("chord_add", {"head": "PM1", "site": (1, 2, 3, 4)}, mvs.ArgumentError, "a node"),
        ("chord_transfer", {"chord": "A2/1", "end": "foot"}, mvs.ArgumentError, "leaflet=1"),
    ],
)
def test_what_cannot_be_is_refused_in_words_and_changes_nothing(sim, kind, fields, error, words):
    before = sim.snapshot().hash
    for call in (sim.check_op, sim.apply_op):
        with pytest.raises(error, match=words):
            call(kind, **fields)
    assert sim.snapshot().hash == before


def test_checking_says_what_applying_would(sim):
    sim.check_op("annulus_scale", factor=1.1)
    assert sim.snapshot().history.done == ()
    with pytest.raises(mvs.ArgumentError) as checked:
        sim.check_op("annulus_scale", factor=99)
    with pytest.raises(mvs.ArgumentError) as applied:
        sim.apply_op("annulus_scale", factor=99)
    assert str(checked.value) == str(applied.value)
