"""Valves from arrays: any strides, no silent casts, and the round trip through a snapshot."""

import dataclasses
import warnings

import mvs
import numpy as np
import pytest


@pytest.fixture
def valve(opened):
    return mvs.valve_of(opened)


def set_and_look(valve):
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        return sim.snapshot()


def test_a_valve_taken_from_a_snapshot_sets_the_same_valve(opened, valve):
    assert set_and_look(valve).hash == opened.hash


def test_a_valve_can_be_given_as_keywords(opened, valve):
    arrays = {f.name: getattr(valve, f.name) for f in dataclasses.fields(valve)}
    with mvs.Simulator() as sim:
        sim.set_valve(**arrays)
        assert sim.snapshot().hash == opened.hash


def every_second(array):
    """The same values as every second row and column of a larger array."""
    wide = np.zeros(tuple(2 * n for n in array.shape), dtype=array.dtype)
    wide[tuple(slice(None, None, 2) for _ in array.shape)] = array
    return wide[tuple(slice(None, None, 2) for _ in array.shape)]


def padded_rows(array):
    """The same values with gaps between rows, which are read in place."""
    wide = np.zeros((len(array), 2 if array.ndim == 1 else array.shape[1] + 1), dtype=array.dtype)
    if array.ndim == 1:
        wide[:, 0] = array
        return wide[:, 0]
    wide[:, : array.shape[1]] = array
    return wide[:, : array.shape[1]]


def unaligned(array):
    """The same values at an odd address."""
    raw = np.zeros(array.nbytes + 1, dtype=np.uint8)
    odd = raw[1:].view(array.dtype).reshape(array.shape)
    odd[...] = array
    return odd


LAYOUTS = {
    "columns first": np.asfortranarray,
    "every second": every_second,
    "padded rows": padded_rows,
    "backwards": lambda a: a[::-1].copy()[::-1],
    "unaligned": unaligned,
}


def test_a_valve_says_how_large_it_is(opened, valve):
    said = repr(valve)
    assert said.startswith(f'<mvs.Valve "{valve.name}": {len(opened.node_position)} nodes, ')
    assert f"{len(opened.chord_nodes)} chord segments" in said and len(said) < 150
    assert repr(mvs.Valve(nodes=None, triangles=3, annulus=None)) == '<mvs.Valve "valve": empty>'


@pytest.mark.parametrize("layout", LAYOUTS)
def test_strides_do_not_matter(opened, valve, layout):
    for field in dataclasses.fields(valve):
        value = getattr(valve, field.name)
        if isinstance(value, np.ndarray):
            placed = LAYOUTS[layout](value)
            assert np.array_equal(placed, value)
            setattr(valve, field.name, placed)
    assert set_and_look(valve).hash == opened.hash


def test_positions_may_be_single_precision(valve):
    valve.nodes = valve.nodes.astype(np.float32)
    valve.nodes_now = valve.nodes_loaded = None
    seen = set_and_look(valve).node_rest
    assert np.array_equal(seen, valve.nodes.astype(np.float64))


@pytest.mark.parametrize(
    "name, spoil, words",
    [
        ("nodes", lambda a: a.astype(np.int64), "float64 or float32"),
        ("nodes", lambda a: a[:, :2], "shape (count, 3)"),
        ("nodes", lambda a: a.tolist(), "not list"),
        ("nodes", lambda a: a.astype(">f8"), ">f8"),
        ("triangles", lambda a: a.astype(np.int64), "int64"),
        ("triangles", lambda a: a.ravel(), "shape (count, 3)"),
        ("annulus", lambda a: a.astype(np.int32), "int32"),
        ("chord_nodes", lambda a: a[:, :1], "shape (count, 2)"),
        ("chord_rest_length", lambda a: a.astype(np.float32), "float32"),
        ("chord_rest_length", lambda a: a[:-1], "one for each"),
        ("head_nodes", lambda a: a.astype(np.int64), "int64"),
        ("chord_names", lambda a: a[:-1], "names are needed"),
    ],
)
def test_a_wrong_array_is_refused_by_name(valve, name, spoil, words):
    setattr(valve, name, spoil(getattr(valve, name)))
    with pytest.raises(mvs.ArgumentError) as caught:
        set_and_look(valve)
    assert caught.value.part == name
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("field", "value", "sentence"),
    [
        ("leaflets", "AP", "leaflets: a sequence is needed, of which each is a name or a mvs.Leaflet"),
        ("leaflets", [1, 2], r"leaflets\[0\]: a name or a mvs.Leaflet is needed, not 1 \(int\)"),
        ("leaflets", [mvs.Leaflet("A", thickness="thin"), "P"], "leaflets: thickness: a number is needed, not str"),
        ("scallops", 3, "scallops: a sequence"),
        ("head_names", b"P", "head_names: a sequence"),
        ("rings", ["ring"], r"rings\[0\]: a mvs.Ring is needed"),
        ("curves", [None], r"curves\[0\]: a mvs.Curve is needed"),
        ("name", b"x", "name: a text is needed, not b'x'"),
        ("density", "heavy", "density: a number is needed, not str"),
        ("orient", "no", "orient: True or False is needed, not str"),
    ],
)
def test_a_field_of_another_type_is_refused_by_name(valve, field, value, sentence):
    with mvs.Simulator() as sim:
        sim.generate(vertices=250)
        before = sim.snapshot().hash
        setattr(valve, field, value)
        with pytest.raises(mvs.ArgumentError, match=sentence):
            sim.set_valve(valve)
        assert sim.snapshot().hash == before


def test_check_valve_lists_every_fault(valve):
    assert mvs.check_valve(valve) == []
    valve.triangles[3] = valve.triangles[3, 0]
    valve.triangles[8, 1] = valve.triangles[8, 2]
    faults = mvs.check_valve(valve)
    assert len(faults) >= 2
    assert {"triangle 3", "triangle 8"} <= {fault.part for fault in faults}
    with pytest.raises(mvs.OpError) as caught:
        set_and_look(valve)
    assert str(caught.value) == faults[0].sentence
    assert caught.value.part == faults[0].part


def test_check_valve_gives_the_warnings_of_set_valve(valve):
    chord_young = valve.chord_young.copy()
    valve.chord_young = np.full(len(chord_young), 40.0)  # MPa given as Pa
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        set_and_look(valve)
    said = [str(each.message) for each in caught]
    found = mvs.check_valve(valve)
    assert said and [fault.sentence for fault in found] == said
    assert all(fault.is_warning for fault in found)
    valve.chord_young = chord_young
    assert mvs.check_valve(valve) == []


def test_an_edited_chord_is_the_only_thing_that_changes(opened, valve):
    valve.chord_rest_length[5] *= 1.25
    changed = set_and_look(valve)
    ratio = changed.chord_rest_length / opened.chord_rest_length
    assert ratio[5] == pytest.approx(1.25, rel=1e-15)
    assert (np.delete(ratio, 5) == 1).all()
    assert np.array_equal(changed.chord_id, opened.chord_id)


def test_zero_bending_scale_means_no_bending(valve):
    valve.bending_scale = 0.0
    assert set_and_look(valve).valve_constants[3] == 0
    valve.bending_scale = None
    assert set_and_look(valve).valve_constants[3] == 1


def test_dimensions_reach_the_generator():
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", annulus_ap=30e-3, annulus_cc=40e-3, thickness=0.8e-3)
        large = sim.snapshot()
        sim.generate(shape="founding", annulus_ap=24e-3, annulus_cc=32e-3)
        small = sim.snapshot()
    # a polygon through the annulus is slightly narrower than the curve
    assert large.measures.annulus_ap == pytest.approx(30e-3, rel=0.03)
    assert large.measures.annulus_cc == pytest.approx(40e-3, rel=0.03)
    assert small.measures.annulus_cc == pytest.approx(32e-3, rel=0.03)
    assert (large.triangle_thickness == 0.8e-3).all()


def test_dimensions_are_keywords_only(sim):
    with pytest.raises(TypeError):
        sim.generate(500)


def test_values_like_another_unit_are_warned_of(valve):
    valve.chord_young[:] *= 1e-3
    with pytest.warns(mvs.ValveWarning, match="kPa or MPa given as Pa"):
        set_and_look(valve)
    messages = []
    with mvs.Simulator(log=lambda level, text: messages.append(text)) as sim:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # a simulator with a log issues no warning
            sim.set_valve(valve)
            sim.set_load(120)
    assert any("looks like mmHg given as Pa" in text for text in messages)


@pytest.mark.parametrize("number, unit", [
    (120.0, "mmHg"), (119.9, "mmHg"), (120.5, "mmHg"), (122.3, "mmHg"), (16.0, "kPa"), (15.99864, "kPa"),
    (0.016, "MPa"), (0.0159986, "MPa"),
])
def test_a_systolic_pressure_in_another_unit_is_warned_of(sim, number, unit):
    with pytest.warns(mvs.ValveWarning, match=f"looks like {unit} given as Pa"):
        sim.set_load(number)


def test_a_pressure_like_kpa_is_warned_of(sim):
    words = "looks like kPa given as Pa; 16 kPa are 16000 Pa"
    with pytest.warns(mvs.ValveWarning, match=words) as caught:
        sim.set_load(16.0)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("operation, young", [("neochord", 400.0), ("chord_add", 40.0)])
def test_a_modulus_of_an_operation_in_another_unit_is_warned_of(sim, operation, young):
    sim.generate()
    chord = {"head": "PM1", "site": ("P2", 0.5, 1.0), "length": 12e-3}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sim.apply(operation, **chord)
        sim.undo()
    with pytest.warns(mvs.ValveWarning, match="a modulus in kPa or MPa given as Pa") as caught:
        sim.apply(operation, **chord, young=young)
    assert len(caught) == 1 and caught[0].filename == __file__


def test_a_valid_valve_issues_no_warning(valve):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with mvs.Simulator() as sim:
            sim.set_valve(valve)
            sim.set_load(mvs.SYSTOLE_PA)
            assert not sim.settle(max_iterations=1).converged  # reported by the result


def test_an_ensemble_warns_of_a_pressure_in_kpa(opened):
    with pytest.warns(mvs.ValveWarning, match="looks like kPa given as Pa") as caught:
        opened.ensemble(16.0, members=1, max_iterations=1)
    assert len(caught) == 1
