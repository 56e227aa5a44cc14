"""Habits of Python users: texts that tell, help with units, copies, tables, pictures."""

import base64
import copy
import os
import pickle
import re
import subprocess
import sys
from pathlib import Path

import mvs
import numpy as np
import pytest


def test_the_text_of_a_snapshot_tells_size_load_and_leak(opened, closed):
    leaflet = int((closed.node_kind <= mvs.NodeKind.ANNULUS).sum())
    size = f"{leaflet} vertices, {len(closed.chord_kind)} chordae"
    assert repr(opened) == f'<mvs.Snapshot "{opened.name}": {size}, no load>'
    assert repr(closed) == f'<mvs.Snapshot "{closed.name}": {size}, 120 mmHg, at rest, no leak>'
    with mvs.Simulator() as sim:
        sim.restore(opened)
        sim.set_load(mvs.SYSTOLE_PA)
        assert repr(sim.snapshot()).endswith("120 mmHg, not at rest>")


@pytest.fixture(scope="module")
def crossing():
    """The default valve settled by the explicit solver, which does not prevent crossing."""
    with mvs.Simulator() as sim:
        sim.generate()
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle(solver="explicit")
        return sim.snapshot(), stats


def test_a_valve_whose_leaflets_cross_is_not_said_to_be_sealed(crossing):
    cases = pytest.importorskip("mvs.report.cases")
    valve, stats = crossing
    pairs = valve.measures.intersections
    assert stats.converged and valve.at_rest and pairs > 0
    said = f"leaflets cross ({pairs} pairs of triangles)"
    assert repr(valve).endswith(f"at rest, {said}: its measures do not count>")
    assert cases.verdict(valve, stats) == f"{said}: its figures do not count"


def test_the_text_of_a_simulator_tells_its_state(closed):
    sim = mvs.Simulator()
    assert "no valve yet" in repr(sim)
    sim.restore(closed)
    assert repr(sim) == repr(closed).replace("Snapshot", "Simulator")
    sim.close()
    assert "closed" in repr(sim)


def test_help_shows_every_field_with_shape_and_unit():
    text = mvs.Valve.__doc__
    for field in mvs.Valve.__dataclass_fields__:
        assert re.search(rf"^{field}: .+", text, re.M), field
    assert "chord_rest_length: float64 (c,), m: None or 0: the distance" in text
    assert "tenting_height: m: " in mvs.Measures.__doc__


def test_an_unknown_field_of_a_valve_is_refused_with_the_near_name(closed):
    valve = mvs.valve_of(closed)
    with pytest.raises(AttributeError, match="chord_restlength.*did you mean.*chord_rest_length"):
        valve.chord_restlength = 1.0
    with pytest.raises(TypeError, match="did you mean.*chord_rest_length"):
        mvs.Valve(nodes=None, triangles=None, annulus=None, chord_restlength=None)
    valve.chord_rest_length = valve.chord_rest_length * 1.1
    assert pickle.loads(pickle.dumps(valve)).name == copy.deepcopy(valve).name == valve.name


def test_constants_of_a_law_are_given_by_name(sim):
    fung = mvs.leaflet_law("fung").constants
    assert mvs.leaflet_law(mvs.LeafletLaw.FUNG).constants == fung
    first, second = fung[0], fung[1]
    tissue = mvs.Leaflet("A", law="fung", constants={second.key: 2 * second.default})
    assert tissue.law is mvs.LeafletLaw.FUNG
    expected = (first.default, 2 * second.default, *(c.default for c in fung[2:]))
    assert tissue.constants == expected
    sim.set_leaflet("A", law="fung", constants={second.key: 2 * second.default})
    row = sim.snapshot().leaflet_constants[0, 1 : 1 + len(fung)]
    assert tuple(row) == expected
    valve = mvs.valve_of(sim.snapshot())
    valve.leaflets = [tissue, *valve.leaflets[1:]]
    sim.set_valve(valve)
    assert tuple(sim.snapshot().leaflet_constants[0, 1 : 1 + len(fung)]) == expected
    for call in (sim.set_leaflet, mvs.Leaflet):
        with pytest.raises(mvs.ArgumentError, match=f'no "young", but {first.key}'):
            call("A", law="fung", constants={"young": 1.0})
        with pytest.raises(mvs.ArgumentError, match='"may_newman_yin"'):
            call("A", law="rubber")


def test_a_snapshot_survives_pickling_and_copying(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    sim.step(3)
    sim.apply("chord_length", chord="P2/3", factor=0.9)
    snapshot = sim.snapshot()
    again = pickle.loads(pickle.dumps(snapshot))
    assert again.hash == snapshot.hash
    if "hdf5" in mvs.features:
        assert [e.title for e in again.history] == [e.title for e in snapshot.history]
    assert copy.copy(snapshot) is snapshot and copy.deepcopy([snapshot])[0] is snapshot


def test_chordae_are_a_table(closed):
    table = closed.chords()
    assert table.columns == ("name", "kind", "head", "site", "length", "rest_length", "strain",
                             "tension", "flag")
    assert table.units["tension"] == "N" and len(table) == len(closed.chord_kind)
    names = [part.name for part in closed.parts if part.kind == mvs.PartKind.CHORD]
    assert table["name"] == names
    assert np.array_equal(table["tension"], closed.chord_tension)
    length, rest = np.array(table["length"]), np.array(table["rest_length"])
    # strain is (L - L0) / L0 of the same lengths: rounding only
    assert np.allclose(length / rest - 1, closed.chord_strain, rtol=0, atol=1e-12)
    heads = [part.name for part in closed.parts if part.kind == mvs.PartKind.HEAD]
    row = table[names.index("P2/3")]
    assert row["site"] == "P2" and row["head"] in heads and row["kind"] in (
        kind.name.lower() for kind in mvs.ChordKind
    )
    strongest = table.sorted("tension", reverse=True)[0]
    assert strongest["tension"] == closed.chord_tension.max()
    assert "tension, N" in repr(table) and "<td>P2/3</td>" in table._repr_html_()
    with pytest.raises(KeyError, match="rest_length"):
        table["lenght"]


def test_chordae_behind_branch_points_have_the_head_of_their_trunk():
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", branching=True)
        snapshot = sim.snapshot()
    table = snapshot.chords()
    assert (snapshot.node_kind[snapshot.chord_nodes[:, 0]] == mvs.NodeKind.BRANCH).any()
    heads = {part.name for part in snapshot.parts if part.kind == mvs.PartKind.HEAD}
    assert {row["head"] for row in table} == heads
    scallops = [part.name for part in snapshot.parts if part.kind == mvs.PartKind.SCALLOP]
    for row in table:
        sites = row["site"].split("+")
        assert sites == [name for name in scallops if name in sites]
        if row["kind"] == "trunk":  # where its branches end
            below = {other["site"] for other in table if other["kind"] != "trunk"}
            assert set(sites) <= below


def test_flags_of_chordae_are_words(closed):
    limits = closed.chord_flags
    with mvs.Simulator() as sim:
        sim.restore(closed)
        sim.apply("chord_length", chord="A2/7", factor=2)
        rows = {row["name"]: row for row in sim.snapshot().chords()}
    assert rows["A2/7"]["flag"] == "slack" and rows["A2/7"]["tension"] == 0
    words = {0: "", 1: "over strain", 2: "over tension", 3: "over strain, over tension"}
    for row, flags in zip(closed.chords(), limits):
        assert row["flag"].removesuffix(", slack") == words[int(flags)] or row["tension"] == 0


def test_data_frames_have_the_values_and_units(closed):
    pytest.importorskip("pandas")
    measures = closed.to_dataframe().set_index("measure")
    assert measures.loc["annulus_ap", "value"] == closed.measures.annulus_ap
    assert measures.loc["annulus_ap", "unit"] == "m"
    chords = closed.to_dataframe("chords")
    assert chords.equals(closed.chords().to_dataframe()) and chords.attrs["units"]["length"] == "m"
    assert len(closed.to_dataframe("nodes")) == len(closed.node_position)
    assert len(closed.to_dataframe("triangles")) == len(closed.triangle_nodes)


def test_a_missing_package_is_named_with_its_extra(closed, monkeypatch):
    for name in ("pandas", "pyvista", "matplotlib"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=r"libmvs\[tables\]"):
        closed.to_dataframe()
    for call in (closed.plot, closed.to_pyvista):
        with pytest.raises(ImportError, match=r"libmvs\[report\]"):
            call()
    assert "libmvs[report]" in closed._repr_html_() and "120 mmHg" in closed._repr_html_()
    with pytest.raises(mvs.ArgumentError, match='"chords"'):
        closed.to_dataframe("everything")
    with pytest.raises(mvs.ArgumentError, match='"atrium"'):
        closed.plot("below")


def test_pictures_leave_the_settings_of_matplotlib_alone(closed, tmp_path, monkeypatch):
    pytest.importorskip("pyvista")
    matplotlib = pytest.importorskip("matplotlib")
    before = dict(matplotlib.rcParams)
    picture = closed.plot()
    picture.save(tmp_path / "valve.png")
    assert (tmp_path / "valve.png").read_bytes() == picture._repr_png_()
    assert picture.png.startswith(b"\x89PNG")
    assert dict(matplotlib.rcParams) == before
    # a notebook shows that picture
    monkeypatch.setattr("mvs.drawing.snapshots.plot", lambda snapshot: picture)
    data = base64.b64encode(picture.png).decode("ascii")
    assert f'src="data:image/png;base64,{data}"' in closed._repr_html_()


def test_pyvista_blocks_hold_the_arrays(closed):
    pytest.importorskip("pyvista")
    blocks = closed.to_pyvista()
    leaflets, chords = blocks["leaflets"], blocks["chords"]
    assert leaflets.n_cells == len(closed.triangle_nodes)
    assert np.array_equal(leaflets.points, closed.node_position)
    assert np.isfinite(leaflets["stretch_1"]).all() and np.isnan(leaflets["coaptation"]).any()
    assert chords.n_cells == len(closed.chord_nodes)
    assert np.array_equal(chords["tension"], closed.chord_tension)
    assert [list(block.field_data["UNITS"]) for block in (leaflets, chords)] == [["m"], ["m"]]


def test_the_report_of_a_file_is_of_that_file_only(opened, tmp_path):
    pytest.importorskip("pyvista")
    pytest.importorskip("matplotlib")
    opened.save(tmp_path / "mine.obj")
    done = subprocess.run(
        [sys.executable, "-m", "mvs.report", "--no-pictures", "--members", "0", "mine.obj"],
        cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(Path(mvs.__file__).parents[1])},
    )
    assert done.returncode == 0, done.stderr
    assert "Shipped" not in done.stdout and "Study" not in done.stderr
    page = (tmp_path / "mine-report" / "report.html").read_text()
    assert "mine" in page and "Shipped valve" not in page and "founding paper" not in page


def test_texts_with_a_zero_byte_are_refused(sim):
    before = sim.snapshot().hash
    for call in (sim.set_checkpoint, sim.restore_checkpoint, sim.begin_group):
        with pytest.raises(mvs.ArgumentError, match="without zero bytes"):
            call("a\0b")
    with pytest.raises(mvs.ArgumentError, match="name: a text without zero bytes"):
        sim.snapshot().find(mvs.PartKind.HEAD, "PM1\0zz")
    for field, value in (("name", "a\0b"), ("head_names", ["PM1\0b", "PM2"])):
        valve = mvs.valve_of(sim.snapshot())
        setattr(valve, field, value if field == "name" else [*value, *valve.head_names[2:]])
        with pytest.raises(mvs.ArgumentError, match=f"{field}: a text without zero bytes"):
            sim.set_valve(valve)
    assert sim.snapshot().hash == before


def test_a_zero_that_would_be_the_default_is_refused(sim):
    before = sim.snapshot().hash
    for options in ({"max_iterations": 0}, {"residual": 0.0}, {"dt": 0.0}):
        with pytest.raises(mvs.ArgumentError, match="0 is given; None is the default"):
            sim.settle(**options)
    calls = {
        "budget": lambda: sim.step(budget=0),
        "damping": lambda: sim.step(solver="explicit", damping=0.0),
        "saddle_height": lambda: sim.generate(saddle_height=0.0),
        "stiffness": lambda: sim.add_tool("ball", (0.0, 0.0, 0.03), stiffness=0.0),
        "flow": lambda: sim.snapshot().cost(flow=0.0),
        "lengths": lambda: sim.find_leak_interval(lengths=0.0),
        "contact_stiffness": lambda: with_field("contact_stiffness", 0.0),
        "density": lambda: with_field("density", 0.0),
    }

    def with_field(name, value):
        valve = mvs.valve_of(sim.snapshot())
        setattr(valve, name, value)
        sim.set_valve(valve)

    for name, call in calls.items():
        with pytest.raises(mvs.ArgumentError, match=f"^{name}: 0 is given; None is the default"):
            call()
    assert sim.snapshot().hash == before
    sim.step(damping=0.0)  # the default of the implicit solver


def test_what_has_to_be_a_function_is_one(sim):
    with pytest.raises(mvs.ArgumentError, match="log: a function or None is needed, not 3"):
        mvs.Simulator(log=3)
    with pytest.raises(mvs.ArgumentError, match="progress: a function or None is needed, not 3"):
        sim.settle(progress=3)


def test_masked_arrays_and_halves_of_characters_are_refused(sim):
    valve = mvs.valve_of(sim.snapshot())
    nodes = valve.nodes
    valve.nodes = np.ma.masked_array(nodes, np.zeros(nodes.shape, bool))
    with pytest.raises(mvs.ArgumentError, match="nodes: a masked array is given"):
        sim.set_valve(valve)
    valve.nodes, valve.name = nodes, "\ud800"
    with pytest.raises(mvs.ArgumentError, match="name: a text in Unicode is needed"):
        sim.set_valve(valve)
    with pytest.raises(mvs.ArgumentError, match="a text in Unicode is needed"):
        sim.apply("neochord", head="PM1", site="P2:0.5:0.9", name="\ud800")
