"""Measures: floats in SI units, each with a unit and a definition."""

import dataclasses
import math
import re
import typing
from pathlib import Path

import mvs
import numpy as np
import pytest
from mvs import _core


@pytest.mark.parametrize(
    "kind",
    [mvs.Measures, mvs.Stats, mvs.Comparison, mvs.Coarsening, mvs.Load, mvs.Replay,
     mvs.ChordLimits],
)
def test_every_figure_has_a_unit_and_a_definition(kind):
    for field in dataclasses.fields(kind):
        assert re.fullmatch(r"1|m|m2|m3|N|N/m|Pa|J|s|1/s|rad", mvs.unit_of(kind, field.name))
        assert len(mvs.definition_of(kind, field.name)) > 3


COUNTS = {"intersections", "chords_over_strain", "chords_over_tension", "at_rest", "under_load"}


def test_at_rest_is_a_bool_as_that_of_the_snapshot(opened, closed):
    for valve in (opened, closed):
        assert valve.measures.at_rest is valve.at_rest
        assert isinstance(valve.measures.under_load, bool)


@pytest.mark.parametrize("read", [mvs.unit_of, mvs.definition_of])
def test_an_unknown_field_is_an_argument_error_with_near_names(read):
    with pytest.raises(mvs.ArgumentError, match="did you mean 'tenting_height'"):
        read(mvs.Measures, "tenting_heigth")
    with pytest.raises(mvs.ArgumentError, match=r"help\(mvs.Stats\) lists the fields"):
        read(mvs.Stats, "xyz")


def test_tenting_is_defined_below_the_surface_that_spans_the_annulus():
    assert mvs.definition_of(mvs.Measures, "tenting_height").endswith("below the annulus plane")
    for name in ("tenting_area", "tenting_volume", "billow_height", "billow_volume"):
        assert "surface spanning the annulus" in mvs.definition_of(mvs.Measures, name)


def test_measures_are_finite_floats(closed):
    for field in dataclasses.fields(closed.measures):
        value = getattr(closed.measures, field.name)
        assert isinstance(value, int if field.name in COUNTS else float)
        assert math.isfinite(value)


def test_each_group_alone_has_the_bits_of_the_whole(closed):
    bits = closed.to_bytes()
    with mvs.Simulator() as sim:
        whole, seen = dataclasses.asdict(closed.measures), set()
        for word in _core.measure_groups():
            sim.load_bytes(bits)  # a new snapshot, which has computed nothing
            alone = dataclasses.asdict(sim.snapshot().measure(word))
            given = {name for name, value in alone.items() if name not in COUNTS and value == value}
            assert given.isdisjoint(seen)
            assert given or word == "crossings"  # its only figure is a count
            assert alone["intersections"] == 0
            assert all(alone[name] == whole[name] for name in given)
            seen |= given
            assert (alone["at_rest"], alone["under_load"]) == (1, 1)
        assert seen == set(whole) - COUNTS
        assert sim.snapshot().measure() == closed.measures


def test_several_groups_are_measured_together(closed):
    both = closed.measure(groups=("coaptation", "annulus"))
    assert both.coaptation_area == closed.measures.coaptation_area
    assert both.annulus_ap == closed.measures.annulus_ap
    assert math.isnan(both.regurgitant_orifice_area) and math.isnan(both.leaflet_area)
    nothing = closed.measure([])
    assert math.isnan(nothing.annulus_ap) and nothing.at_rest == 1


def test_an_unknown_group_is_refused_with_the_near_name(closed):
    with pytest.raises(mvs.ArgumentError, match='"orifice".*not \'orifise\'.*did you mean'):
        closed.measure("orifise")
    with pytest.raises(mvs.ArgumentError, match="not 2"):
        closed.measure([2])
    with pytest.raises(mvs.ArgumentError, match="bits 0x80 that this version does not know"):
        closed._measure(128 | 2)


def test_measures_have_the_size_of_a_heart(closed):
    measures = closed.measures
    assert 20e-3 < measures.annulus_ap < measures.annulus_cc < 50e-3
    assert 5e-4 < measures.annulus_area < 12e-4
    assert measures.leaflet_area > measures.annulus_area
    assert 0 < measures.max_chord_tension < 20


def test_chord_figures_agree_with_the_arrays(closed):
    a, b = closed.chord_nodes.T
    length = np.linalg.norm(closed.node_position[a] - closed.node_position[b], axis=1)
    strain = length / closed.chord_rest_length - 1
    # the same formula in another order of operations
    assert np.allclose(closed.chord_strain, strain, atol=1e-12)
    tension = closed.chord_young * closed.chord_area * np.clip(strain, 0, None)
    assert np.allclose(closed.chord_tension, tension, atol=1e-9)
    assert closed.measures.max_chord_tension == pytest.approx(tension.max(), rel=1e-9)


def test_chordae_are_flagged_beyond_the_limits_of_their_kind(closed):
    limits = [mvs.chord_limits(mvs.ChordKind(kind)) for kind in closed.chord_kind]
    strained = closed.chord_strain > [limit.strain for limit in limits]
    loaded = closed.chord_tension > [limit.tension for limit in limits]
    assert np.array_equal(closed.chord_flags, strained + 2 * loaded)
    assert closed.measures.chords_over_strain == strained.sum()
    assert closed.measures.chords_over_tension == loaded.sum()


def test_an_overloaded_chord_is_counted(sim):
    sim.apply("chord_length", chord="P2/3", factor=0.5)
    chord = sim.snapshot().find(mvs.PartKind.CHORD, "P2/3").index
    over = sim.snapshot()
    assert over.chord_flags[chord] == 3
    assert over.measures.chords_over_strain >= 1 and over.measures.chords_over_tension >= 1


def test_every_kind_of_chord_has_limits():
    for kind in mvs.ChordKind:
        limits = mvs.chord_limits(kind)
        assert limits.strain > 0 and limits.tension > 0
        assert math.isinf(limits.tension) == (kind == mvs.ChordKind.SUTURE)
    with pytest.raises(mvs.ArgumentError, match="kind"):
        mvs.chord_limits(99)


def test_head_forces_balance_chordal_tension(closed):
    a, b = closed.chord_nodes.T
    pull = np.zeros_like(closed.node_position)
    along = closed.node_position[b] - closed.node_position[a]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    np.add.at(pull, a, along * closed.chord_tension[:, None])
    np.add.at(pull, b, -along * closed.chord_tension[:, None])
    assert np.allclose(closed.head_force, pull[closed.head_nodes], atol=1e-9)


def test_the_frame_is_right_handed_and_points_into_the_atrium(closed):
    frame = closed.frame
    assert np.allclose(frame.axes @ frame.axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(frame.axes) == pytest.approx(1)
    heads = frame.to_local(closed.node_position[closed.head_nodes])
    assert (heads[:, 2] < 0).all()


def test_a_section_lies_in_its_plane(closed):
    frame = closed.frame
    segments = closed.section(frame.origin, frame.axes[1])
    assert segments.ndim == 3 and segments.shape[1:] == (2, 3) and len(segments) > 10
    assert np.abs(frame.to_local(segments)[..., 1]).max() < 1e-12


def test_a_shape_has_zero_distance_only_from_itself(opened, closed):
    same = closed.compare(closed)
    assert same.same_mesh and same.node_max == 0
    # closest points have the rounding error of their coordinates
    assert same.surface_max < 1e-15
    other = opened.compare(closed)
    assert other.node_max >= other.node_rms > 1e-4
    direct = np.linalg.norm(opened.node_position - closed.node_position, axis=1)
    leaflet = np.unique(opened.triangle_nodes)
    assert other.node_max == pytest.approx(direct[leaflet].max(), rel=1e-9)


def test_laws_describe_their_constants():
    law = mvs.leaflet_law(mvs.LeafletLaw.FUNG)
    assert law.word == "fung"
    assert [(c.key, c.unit) for c in law.constants] == [("c0", "Pa"), ("c1", "Pa"), ("c2", "")]
    assert [c.key for c in mvs.chord_law(mvs.ChordLaw.BILINEAR).constants] == ["kink", "high"]
    for law in mvs.LeafletLaw:
        assert all(c.low <= c.default <= c.high for c in mvs.leaflet_law(law).constants)
    with pytest.raises(mvs.ArgumentError, match="not 9"):
        mvs.leaflet_law(9)


def test_the_description_of_the_files_gives_the_defaults_of_the_laws():
    text = (Path(__file__).parents[2] / "formats" / "FORMAT.md").read_text(encoding="utf-8")
    start = text.index("Constants of the laws")
    text = text[start : text.index("\n\n", start)]
    leaflets, chordae = (" ".join(part.split()) for part in text.split("Chordae:"))
    checked = 0
    for words, laws in (
        (leaflets, map(mvs.leaflet_law, mvs.LeafletLaw)),
        (chordae, map(mvs.chord_law, mvs.ChordLaw)),
    ):
        for law in laws:
            if f"{law.word} has" not in words or law.word in ("ogden", "table"):
                continue  # springs take those of bilinear; ogden's are one default of six constants
            of_law = words.split(f"{law.word} has ")[1].split(" has ")[0]
            for constant in law.constants:
                value = re.search(rf"`{constant.key}`(?: Pa| strain)?,? (\d+(?:\.\d+)?)", of_law)
                assert value and float(value[1]) == constant.default, (law.word, constant.key)
                checked += 1
    assert checked == 4 + 3 + 3 + 3 + 2 + 2


def test_the_dataclasses_have_the_fields_that_the_library_describes():
    for which, kind in ((1, mvs.Measures), (2, mvs.Stats), (3, mvs.Profile), (4, mvs.Cost)):
        described = [(name, unit or "1", text) for name, unit, text in _core.field_descriptions(which)]
        hints = typing.get_type_hints(kind, include_extras=True)
        ours = [(name, *hints[name].__metadata__) for name in hints if name not in ("profile", "open_valve")]
        assert ours == described


@pytest.mark.parametrize("scale", [1.0, 1.3])
def test_forces_on_the_annulus_are_those_of_all_springs(scale):
    """Springs between two annulus nodes pull at both: W = sum over edges of t A sigma (own sum)."""
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=200)
        valve = mvs.valve_of(sim.snapshot())
        valve.bending_scale = 0.0
        sim.set_valve(valve)
        sim.apply("annulus_scale", factor=scale)
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle()
        at = sim.snapshot()
    soft, stiff, kink = at.leaflet_constants[0][1:4]
    rest, now, triangles = at.node_rest, at.node_position, at.triangle_nodes
    normal = np.cross(rest[triangles[:, 1]] - rest[triangles[:, 0]],
                      rest[triangles[:, 2]] - rest[triangles[:, 0]])
    volume = np.linalg.norm(normal, axis=1) / 2 * at.triangle_thickness
    force = np.zeros_like(now)
    for k in range(3):
        i, j = triangles[:, k], triangles[:, (k + 1) % 3]
        length = np.linalg.norm(rest[j] - rest[i], axis=1)
        way = now[j] - now[i]
        now_long = np.linalg.norm(way, axis=1)
        strain = now_long / length - 1
        stress = np.where(strain < kink, soft * strain, soft * kink + stiff * (strain - kink))
        pull = (volume * stress / length / now_long)[:, None] * way
        np.add.at(force, i, pull)
        np.add.at(force, j, -pull)
    load = np.cross(now[triangles[:, 1]] - now[triangles[:, 0]],
                    now[triangles[:, 2]] - now[triangles[:, 0]]) / 6 * at.load_case.pressure
    for k in range(3):
        np.add.at(force, triangles[:, k], load)
    for (a, b), tension in zip(at.chord_nodes, at.chord_tension):
        way = (now[b] - now[a]) / np.linalg.norm(now[b] - now[a])
        force[a] += tension * way
        force[b] -= tension * way
    annulus = at.annulus_nodes
    assert np.abs(force + at.node_contact_force - at.node_force)[annulus].max() < 1e-12
