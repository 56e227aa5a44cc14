"""Snapshot.sensitivity: labelled derivatives, against settles; bad input."""

import numpy as np
import pytest

import mvs

TIGHT = 1e-10  # N: settles for differences of 0.02 um


@pytest.fixture(scope="module")
def sim():
    with mvs.Simulator() as made:
        made.generate(vertices=250)
        made.set_load(mvs.SYSTOLE_PA)
        assert made.settle(residual=TIGHT).converged
        yield made


@pytest.fixture(scope="module")
def closed(sim):
    return sim.snapshot()


def difference(sim, closed, chord, step, value):
    """Central difference of a quantity of settled valves by a rest length."""
    rest = closed.chord_rest_length[closed.find(mvs.PartKind.CHORD, chord).index]
    sides = []
    for by in (step, -step):
        sim.restore(closed)
        sim.apply("chord_length", chord=chord, length=float(rest + by))
        assert sim.settle(residual=TIGHT).converged
        sides.append(value(sim.snapshot()))
    sim.restore(closed)
    return (sides[0] - sides[1]) / (2 * step)


def test_labels_and_values_match_differences(sim, closed):
    found = closed.sensitivity(of=["coaptation", "tension"], to="chords")
    names = [row["name"] for row in closed.chords()]
    assert found.to == tuple(f"chords {name}" for name in names)
    assert found.of == ("coaptation_area", *(f"tension {name}" for name in names))
    assert found.derivative.shape == (1 + len(names), len(names))
    assert found.of_units[:2] == ("m2", "N") and set(found.to_units) == {"m"}
    assert found.value[0] == pytest.approx(closed.measures.coaptation_area, rel=1e-12)
    assert found.value[1:] == pytest.approx(closed.chord_tension, abs=1e-12)
    best = int(np.argmax(np.abs(found["coaptation"])))
    slope = difference(sim, closed, names[best], 2e-8, lambda s: s.measures.coaptation_area)
    # rounding of settles, and kinks of single samples of the coaptation
    assert found["coaptation"][best] == pytest.approx(slope, rel=1e-3)


def test_the_tenting_height_moves_as_through_settles():
    with mvs.Simulator() as made:
        made.generate(vertices=250, annulus_scale=1.05)
        names = [row["name"] for row in made.snapshot().chords()]
        made.apply("chord_length", chord=names[5], length=made.snapshot().chords()[5]["rest_length"] * 1.02)
        made.set_load(mvs.SYSTOLE_PA)
        assert made.settle(residual=TIGHT).converged
        closed = made.snapshot()
        found = closed.sensitivity("tenting_height", "chords")
        best = int(np.argmax(np.abs(found.derivative[0])))
        slopes = [
            difference(made, closed, names[best], step, lambda s: s.measures.tenting_height) for step in (1e-7, 1e-6)
        ]
    assert abs(found.derivative[0, best]) > 0.1 and "raster" not in found.of_notes[0]
    # curvature over 1 um of a chord against lengths of 10 mm; on a raster it was wrong by several times
    assert found.derivative[0, best] == pytest.approx(slopes[0], rel=1e-3)
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-3)


def test_sides_of_contact_that_is_about_to_switch():
    found = None
    for vertices in (230, 200, 330, 310, 290, 240):  # contact of one of these valves is about to switch
        with mvs.Simulator() as made:
            made.generate(vertices=vertices)
            made.set_load(mvs.SYSTOLE_PA)
            assert made.settle(residual=TIGHT).converged
            closed = made.snapshot()
        tried = [closed.sensitivity("coaptation", "annulus_scale", slack=s) for s in np.geomspace(2.5e-7, 1e-5, 6)]
        found = next((f for f in tried if "contact" in f.to_notes[0] and np.isfinite(f.above).all()), None)
        if found is not None:
            break
    assert found is not None
    assert not found.smooth and "contact" in found.of_notes[0]
    assert len(found.weak_contacts) > 0 and found.weak_contacts.max() < len(closed.node_position)
    assert found.above.shape == (1, 1) and found.above[0, 0] != found.below[0, 0]
    assert found.table()[0]["d coaptation_area"] == found.derivative[0, 0]


def test_motion_and_modes(closed):
    heads = closed.sensitivity(of="annulus_cc", to=["heads", "annulus_scale"], motion=True)
    nodes = len(closed.node_position)
    assert heads.motion.shape == (len(heads.to), nodes, 3)
    # the motion of all heads and of the annulus by one vector is a translation
    shift = np.zeros((nodes, 3))
    shift[closed.node_kind == int(mvs.NodeKind.ANNULUS)] = [0, 0, 1]
    shift[closed.head_nodes] = [0, 0, 1]
    moved = closed.sensitivity(of="annulus_cc", to=("up", shift), motion=True)
    bound = closed.node_kind != int(mvs.NodeKind.BRANCH)  # slack branch points have no place
    assert moved.to == ("up",)
    assert moved.motion[0][bound] == pytest.approx(np.tile([0, 0, 1], (bound.sum(), 1)), abs=1e-6)
    assert heads["annulus_cc"][:-1] == pytest.approx(0, abs=1e-12)
    assert heads["annulus_cc"][-1] == pytest.approx(closed.measures.annulus_cc, rel=1e-6)


def test_weights_and_tissue(closed):
    weights = np.random.default_rng(1).normal(size=closed.node_position.shape)
    found = closed.sensitivity(of={"mine": weights}, to=["tissue", "pressure", "prestrain", "scallops"])
    assert found.of == ("mine",)
    assert "pressure" in found.to and "scallops A2" in found.to
    assert any(label.startswith("tissue A ") for label in found.to)
    assert found.value[0] == pytest.approx((weights * closed.node_position).sum(), rel=1e-12)
    single = weights.astype(np.float32)
    short, same = (closed.sensitivity(of={"mine": w}, to=["pressure"]) for w in (single, single.astype(float)))
    assert np.array_equal(short.derivative, same.derivative)
    with pytest.raises(mvs.ArgumentError, match="weights: .* is needed, not int64"):
        closed.sensitivity(of={"mine": np.zeros(weights.shape, int)}, to=["pressure"])
    assert np.isfinite(found.derivative).all()


def test_one_parameter_and_one_quantity_have_a_table(closed):
    found = closed.sensitivity(of=["coaptation"], to=["pressure"], motion=True)
    assert found.derivative.shape == found.above.shape == found.below.shape == (1, 1)
    assert found.motion.shape == (1, len(closed.node_position), 3)
    assert found["coaptation"].shape == (1,)
    assert found.table()["d coaptation_area"][0] == found.derivative[0, 0]


def test_prestrain_is_that_of_a_smaller_rest_shape(closed):
    """Contact is weighted by areas of the rest shape, which shrink too."""
    found = closed.sensitivity(of=["leaflet_area"], to=["prestrain"], motion=True)
    step, sides = 2e-5, []  # moves nodes by 0.3 um, 1e-5 of which a settle to 1e-10 N resolves
    leaf = np.unique(closed.triangle_nodes)
    for by in (step, -step):
        valve = mvs.valve_of(closed)
        valve.nodes_open = valve.nodes.copy() if valve.nodes_open is None else valve.nodes_open
        valve.nodes = valve.nodes.copy()
        valve.nodes[leaf] /= 1 + by
        with mvs.Simulator(log=lambda level, text: None) as sim:
            sim.set_valve(valve)
            sim.set_load(mvs.SYSTOLE_PA)
            assert sim.settle(residual=TIGHT).converged
            sides.append(sim.snapshot())
    motion = (sides[0].node_position - sides[1].node_position) / (2 * step)
    bound = closed.node_kind != int(mvs.NodeKind.BRANCH)  # slack branch points have no place
    error = np.abs(motion - found.motion[0])[bound].max()
    assert error < 1e-4 * np.abs(motion[bound]).max()
    area = (sides[0].measures.leaflet_area - sides[1].measures.leaflet_area) / (2 * step)
    assert found.derivative[0, 0] == pytest.approx(area, rel=1e-4)


def test_a_table_is_sorted_by_influence(closed):
    table = closed.sensitivity(of=["coaptation", "leaflet_area"], to="chords").table()
    sizes = np.abs(table["d coaptation_area"])
    assert (np.diff(sizes) <= 0).all() and sizes[0] > 0
    assert table.units["d leaflet_area"] == "m2"


def test_insertions_move_along_the_edges_of_their_leaflet(closed):
    names = [part.name for part in closed.parts if part.kind == mvs.PartKind.CHORD]
    on_leaflet = closed.node_kind[closed.chord_nodes] == mvs.NodeKind.LEAFLET
    chord = int(np.argmax(closed.chord_tension * on_leaflet[:, 1]))
    start, end = closed.chord_nodes[chord]
    found = closed.sensitivity(of=f"tension {names[chord]}", to=f"sites {names[chord]}", motion=True)
    around = np.setdiff1d(closed.triangle_nodes[(closed.triangle_nodes == end).any(axis=1)], [end])
    assert found.to == tuple(f"site {names[chord]} to {j}" for j in around)
    assert set(found.to_units) == {"m"} and found.smooth
    # its tension changes by one stiffness times the change of its length, whichever way its end moves
    x = closed.node_position
    rest = np.linalg.norm(closed.node_rest[around] - closed.node_rest[end], axis=1)
    moved = found.motion[:, end] + (x[around] - x[end]) / rest[:, None] - found.motion[:, start]
    stiffness = found.derivative[0] / (moved @ (x[end] - x[start]) / np.linalg.norm(x[end] - x[start]))
    assert stiffness.mean() > 0 and np.ptp(stiffness) < 1e-6 * stiffness.mean()
    inner = names[int(np.argmin(on_leaflet.any(axis=1)))]
    with pytest.raises(mvs.ArgumentError, match=f"{inner} does not end on a leaflet"):
        closed.sensitivity(of="coaptation", to=f"sites {inner}")
    assert len(closed.sensitivity(of="coaptation", to="sites", test=False).to) > 4 * on_leaflet.sum()


def test_the_simulator_differentiates_its_present_snapshot(sim, closed):
    sim.restore(closed)
    found = sim.sensitivity(of="coaptation", to="pressure")
    assert found.derivative == closed.sensitivity(of="coaptation", to="pressure").derivative


@pytest.mark.parametrize("to", ["chords", "areas", "sites", "tissue", "scallops", "pressure", "heads", "annulus"])
def test_a_label_of_a_parameter_is_accepted(closed, to):
    label = closed.sensitivity(of="leaflet_area", to=to, test=False).to[-1]
    assert closed.sensitivity(of="leaflet_area", to=label, test=False).to == (label,)


def test_bad_input_is_refused(sim, closed):
    with pytest.raises(mvs.ArgumentError, match="did you mean"):
        closed.sensitivity(of="coaptation_aera", to="chords")
    with pytest.raises(mvs.ArgumentError, match='"chords"'):
        closed.sensitivity(of="coaptation", to="chordae")
    with pytest.raises(mvs.ArgumentError, match="at least one"):
        closed.sensitivity(of=[], to="chords")
    with pytest.raises(mvs.IdError):
        closed.sensitivity(of="tension Q9/1", to="chords")
    with pytest.raises(mvs.ArgumentError, match="nodes"):
        closed.sensitivity(of=np.zeros((3, 3)), to="chords")
    with pytest.raises(KeyError, match="tension"):
        closed.sensitivity(of="tension", to="pressure")["orifice"]
    sim.restore(closed)
    sim.set_load(0.9 * mvs.SYSTOLE_PA)
    with pytest.raises(mvs.StateError, match="not at rest"):
        sim.sensitivity(of="coaptation", to="chords")
    sim.restore(closed)


def test_the_map_shows_the_chordae(closed):
    pytest.importorskip("pyvista")
    picture = closed.sensitivity(of="coaptation", to="chords").plot()
    assert picture.png.startswith(b"\x89PNG")
    with pytest.raises(mvs.ArgumentError, match="all chordae"):
        closed.sensitivity(of="coaptation", to="pressure").plot()
