"""Material laws of the leaflets: selection by name, and refusals."""

import mvs
import numpy as np
import pytest

LAWS = [law.name.lower() for law in mvs.LeafletLaw]


@pytest.mark.parametrize("law", LAWS)
def test_a_valve_closes_with_a_law_by_its_name(sim, law):
    # a neo-Hookean sheet of 100 kPa does not stiffen and would inflate; 2 MPa does not
    sim.set_leaflet(law=law, constants=(2e6,) if law == "neo_hookean" else ())
    sim.set_load(mvs.SYSTOLE_PA)
    stats = sim.settle()
    closed = sim.snapshot()
    assert set(closed.leaflet_law) == {mvs.LeafletLaw[law.upper()]}
    assert stats.converged
    assert closed.measures.intersections == 0


def test_springs_become_the_membrane_of_their_curve(sim):
    sim.set_leaflet(law="bilinear")
    # the fit of the FEBio model to the curve 100 kPa, 6 MPa, 0.25 (include/mvs/valve.h)
    fit = [18.49e3, 3146e3, 3.1611, 0.006]
    assert sim.snapshot().leaflet_constants[0, 1:5] == pytest.approx(fit, rel=1e-12)


def test_a_named_leaflet_changes_and_the_other_stays(sim):
    before = sim.snapshot()
    sim.set_leaflet("P", law=mvs.LeafletLaw.MAY_NEWMAN_YIN, constants=(414, 4.848, 305.4),
                    thickness=0.8e-3)
    after = sim.snapshot()
    posterior = after.triangle_leaflet == after.find(mvs.PartKind.LEAFLET, "P").index
    assert list(after.leaflet_law) == [mvs.LeafletLaw.SPRING, mvs.LeafletLaw.MAY_NEWMAN_YIN]
    assert list(after.leaflet_constants[1, 1:4]) == [414, 4.848, 305.4]
    assert np.allclose(after.triangle_thickness[posterior], 0.8e-3, rtol=1e-15, atol=0)
    assert np.array_equal(
        after.triangle_thickness[~posterior], before.triangle_thickness[~posterior]
    )
    assert np.array_equal(after.node_rest, before.node_rest)


@pytest.mark.parametrize(
    "arguments, error, words",
    [
        ({"law": "rubber"}, mvs.ArgumentError, '"may_newman_yin"'),
        ({"law": 77}, mvs.OpError, "law 77"),
        ({"leaflet": "S", "law": "fung"}, mvs.IdError, "S"),
        ({"law": "fung", "constants": (1, 2, 3, 4)}, mvs.OpError, "only 3"),
        ({"law": "fung", "constants": (-1,)}, mvs.OpError, "constant c0"),
        ({"law": "bilinear", "constants": (1e3, float("nan"))}, mvs.OpError, "constant a"),
        ({"law": "fung", "constants": (1,) * 9}, mvs.ArgumentError, "at most 8"),
        ({"law": "fung", "thickness": -1e-3}, mvs.OpError, "thickness"),
    ],
)
def test_invalid_tissue_is_refused_and_changes_nothing(sim, arguments, error, words):
    before = sim.snapshot().hash
    with pytest.raises(error, match=words):
        sim.set_leaflet(**arguments)
    assert sim.snapshot().hash == before


def test_a_law_is_required(sim):
    with pytest.raises(TypeError):
        sim.set_leaflet("A")


@pytest.mark.parametrize(
    "law, dimensions",
    [
        ("prot", {}),
        ("prot", {"branching": True}),
        ("may_newman_yin", {"vertices": 700, "annulus_scale": 1.2}),
    ],
)
def test_a_resected_leaflet_that_stiffens_exponentially_comes_to_rest(sim, law, dimensions):
    """Forces of hundreds of newtons at the seam, where contact stops a few nodes."""
    sim.generate(shape="founding", **dimensions)
    sim.set_leaflet(law=law)
    sim.set_load(mvs.SYSTOLE_PA)
    assert sim.settle().converged
    sim.apply("resect")
    assert sim.settle(max_iterations=600).converged  # takes about 60, 120, 60
    assert sim.snapshot().measures.intersections == 0


@pytest.mark.parametrize("dimensions", [{}, {"branching": True}])
@pytest.mark.parametrize(
    "kind, fields",
    [
        ("resect", {"width": 6e-3, "base_width": 4e-3}),
        ("ring", {"size": 22e-3}),
        ("band", {"factor": 0.7}),
    ],
)
def test_a_valve_torn_by_an_operation_comes_to_rest(sim, dimensions, kind, fields):
    """The exponential laws end at 100 kPa; up to 100 MPa forces would reach 1e2 to 1e10 N."""
    sim.generate(shape="founding", **dimensions)
    sim.set_leaflet(law="may_newman_yin")
    sim.set_load(mvs.SYSTOLE_PA)
    assert sim.settle().converged
    sim.apply(kind, **fields)
    assert sim.settle().converged
    assert sim.snapshot().measures.intersections == 0


@pytest.mark.parametrize(
    "law, dimensions",
    [
        ("fung", {"annulus_contraction": 0.85}),
        ("fung", {"vertices": 1000, "annulus_contraction": 0.8}),
        ("prot", {"vertices": 1000, "annulus_contraction": 0.8}),
    ],
)
def test_an_annulus_that_contracts_does_not_tear_tissue_in_live_steps(sim, law, dimensions):
    """Full pressure at once: the hardest case for exponential laws."""
    sim.generate(shape="founding", **dimensions)
    sim.set_leaflet(law=law)
    sim.set_load(mvs.SYSTOLE_PA)
    worst = max(sim.step(1, dt=1e-3).residual for _ in range(40))
    # tens of newtons; the pressure force on a leaflet is 10 N
    assert worst < 1e3


@pytest.mark.parametrize("budget", [4, 5, 8])
def test_a_step_of_a_contracting_annulus_stays_within_its_budget(sim, budget):
    sim.generate(shape="founding", annulus_contraction=0.85)
    sim.set_leaflet(law="fung")
    sim.set_load(mvs.SYSTOLE_PA)
    for _ in range(60):
        stats = sim.step(1, dt=1e-3, budget=budget)
        # plus the forces before the first step
        assert stats.profile.passes + stats.profile.factorisations <= budget + 1


@pytest.mark.parametrize("law, key", [
    ("may_newman_yin", "c2"), ("prot", "c2"), ("spring", "kink"), ("neo_hookean", "bending"),
])
def test_a_constant_of_zero_stays_zero(sim, law, key):
    sim.set_leaflet(law=law, constants={key: 0})
    place = 1 + [each.key for each in mvs.leaflet_law(law).constants].index(key)
    before = sim.snapshot()
    assert list(before.leaflet_constants[:, place]) == [0, 0]
    assert not np.signbit(before.leaflet_constants).any()
    sim.set_valve(mvs.valve_of(before))
    after = sim.snapshot()
    assert np.array_equal(after.leaflet_constants, before.leaflet_constants)
    sim.set_leaflet(law=law, constants=(0.0,) * place)  # in order, zeros are defaults
    assert sim.snapshot().leaflet_constants[0, place] > 0


def test_a_constant_of_zero_of_a_chord_stays_zero(sim):
    valve = mvs.valve_of(sim.snapshot())
    count = len(valve.chord_law)
    valve.chord_law = np.full(count, mvs.ChordLaw.BILINEAR, np.uint32)
    valve.chord_constants = np.tile([-0.0, 30e6, 0, 0, 0, 0], (count, 1))
    sim.set_valve(valve)
    before = sim.snapshot()
    assert set(before.chord_constants[:, 0]) == {0.0} and set(before.chord_constants[:, 1]) == {30e6}
    sim.set_valve(mvs.valve_of(before))
    assert np.array_equal(sim.snapshot().chord_constants, before.chord_constants)


def test_constants_are_numbers(sim):
    for wrong in ("12", None, 3.0):
        with pytest.raises(mvs.ArgumentError, match="constants: numbers or a dictionary"):
            mvs.Leaflet("A", constants=wrong)
    for wrong in ({"c0": "2000"}, {"c0": True}, ("2000",), (None,)):
        with pytest.raises(mvs.ArgumentError, match="constants: a number is needed for (c0|0), not "):
            sim.set_leaflet(law="fung", constants=wrong)
    sim.set_leaflet(law="fung", constants={"c0": np.float32(2000), "c2": 5})
    assert sim.snapshot().leaflet_constants[0, 1] == 2000
