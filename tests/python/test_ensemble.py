"""Ensembles of closures: values, statistics and arrays; callbacks; refusals."""

import dataclasses

import mvs
import numpy as np
import pytest

MEMBERS = 4


@pytest.fixture(scope="module")
def thin():
    """A coarse valve half as thick as the shipped one, open: it has several folded equilibria."""
    with mvs.Simulator() as made:
        made.generate(shape="founding", vertices=250, thickness=0.5e-3)
        return made.snapshot()


@pytest.fixture(scope="module")
def ensemble(thin):
    return thin.ensemble(mvs.SYSTOLE_PA, members=MEMBERS)


def test_member_0_is_the_plain_closure(thin, ensemble):
    with mvs.Simulator() as sim:
        sim.restore(thin)
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle()
        plain = sim.snapshot()
    first = ensemble.members[0]
    assert ensemble.snapshot(0).hash == plain.hash
    assert (first.stats.iterations, first.stats.energy) == (stats.iterations, stats.energy)
    assert (first.perturbation, first.node_max, first.increments) == (0, 0, 1)


def test_the_text_of_an_ensemble_tells_its_size(ensemble):
    found = ensemble.summary
    assert repr(ensemble) == (
        f"<mvs.Ensemble: {MEMBERS} members, {found.converged} at rest, equilibria: {found.equilibria}>"
    )


def test_statistics_are_those_of_the_snapshots(ensemble):
    assert len(ensemble) == MEMBERS == ensemble.summary.converged
    each = [ensemble.snapshot(k).measures for k in range(MEMBERS)]
    for field in dataclasses.fields(mvs.Measures):
        values = np.array([getattr(m, field.name) for m in each], dtype=float)
        if np.isnan(values).any():
            continue
        mean, least, most, deviation, count = (
            getattr(m, field.name)
            for m in (ensemble.mean, ensemble.min, ensemble.max, ensemble.deviation, ensemble.count)
        )
        assert (least, most, count) == (values.min(), values.max(), MEMBERS), field.name
        if isinstance(getattr(each[0], field.name), float):
            # the library sums in another order
            size = np.abs(values).max()
            assert mean == pytest.approx(values.mean(), rel=1e-12), field.name
            assert deviation == pytest.approx(values.std(ddof=1), abs=1e-12 * size), field.name


def test_arrays_are_those_of_the_shapes(ensemble):
    shapes = np.array([ensemble.snapshot(k).node_position for k in range(MEMBERS)])
    node_deviation = np.sqrt(((shapes - shapes.mean(axis=0)) ** 2).sum(axis=2).mean(axis=0))
    np.testing.assert_allclose(ensemble.node_deviation, node_deviation, rtol=1e-6, atol=1e-15)
    sheet = np.unique(ensemble.snapshot(0).triangle_nodes)
    apart = shapes[:, None, sheet] - shapes[None, :, sheet]
    pairs = np.sqrt((apart**2).sum(axis=3).mean(axis=2))
    np.testing.assert_allclose(ensemble.pair_distance, pairs, rtol=1e-12, atol=1e-18)
    assert pairs.max() > 0
    upper = pairs[np.triu_indices(MEMBERS, 1)]
    assert ensemble.summary.node_rms == pytest.approx(np.sqrt((upper**2).mean()), rel=1e-12)
    assert not ensemble.pair_distance.flags.writeable
    assert ensemble.pair_distance.shape == (MEMBERS, MEMBERS)


def test_members_report_their_loading_path(ensemble):
    numbers = [member.equilibrium for member in ensemble.members]
    assert ensemble.summary.equilibria == len(set(numbers))
    energies = [member.stats.energy for member in ensemble.members]
    assert ensemble.summary.lowest == int(np.argmin(energies))
    assert [member.order for member in ensemble.members[:3]] == list(mvs.EnsembleOrder)
    assert [member.ramp > 0 for member in ensemble.members] == [False, False, False, True]
    for member in ensemble.members[1:]:
        assert 0 < member.perturbation <= 0.5e-3 * (1 + 1e-12)
        assert member.surface_rms <= member.surface_max


def test_arrays_outlive_the_ensemble(thin):
    made = thin.ensemble(mvs.SYSTOLE_PA, members=1)
    arrays = made.node_deviation, made.pair_distance
    del made
    assert arrays[0].max() == 0 and arrays[1].tolist() == [[0]]


def test_the_same_seed_gives_the_same_bits(thin, ensemble):
    again = thin.ensemble(mvs.SYSTOLE_PA, members=2, seed=0)
    other = thin.ensemble(mvs.SYSTOLE_PA, members=2, seed=1)
    assert again.snapshot(1).hash == ensemble.snapshot(1).hash
    assert other.snapshot(1).hash != ensemble.snapshot(1).hash


def test_progress_reports_cancels_and_raises(thin):
    shares = []
    thin.ensemble(mvs.SYSTOLE_PA, members=2, progress=lambda share, _: shares.append(share))
    assert shares == sorted(shares) and shares[-1] > 0.5
    with pytest.raises(mvs.CancelledError):
        thin.ensemble(mvs.SYSTOLE_PA, members=2, progress=lambda *_: True)

    def fail(*_):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        thin.ensemble(mvs.SYSTOLE_PA, members=2, progress=fail)


def test_bad_arguments_are_refused(thin, ensemble):
    for name, value, word in [
        ("members", 0, "members"),
        ("members", 1001, "1 to 1000"),
        ("perturbation", 1.0, "0.005"),
        ("wavelength", 1e-6, "wavelength"),
        ("solver", "magic", "newton"),
    ]:
        with pytest.raises(mvs.ArgumentError, match=word):
            thin.ensemble(mvs.SYSTOLE_PA, **{name: value})
    with pytest.raises(mvs.ArgumentError, match="0 to 3"):
        ensemble.snapshot(MEMBERS)


def test_the_depth_of_a_coaptation_that_is_not_there_is_in_no_statistics():
    """It is 0 without coaptation in the central plane: a mean over it is a depth that no member has."""
    with mvs.Simulator() as sim:
        sim.generate(vertices=300, posterior_height=9e-3)
        members = sim.snapshot().ensemble(16e3, members=4, residual=1e-4)
        sim.generate(shape="founding", vertices=250, annulus_scale=1.25)
        apart = sim.snapshot().ensemble(16e3, members=2, residual=1e-4)
    own = [members.snapshot(k).measures for k in range(4)]
    depths = [m.coaptation_depth for m in own if m.coaptation_height > 0]
    assert 0 < len(depths) < 4
    assert members.count.coaptation_depth == len(depths)
    assert members.mean.coaptation_depth == pytest.approx(np.mean(depths), rel=1e-12)
    assert members.count.coaptation_height == 4
    assert apart.count.coaptation_depth == 0 and np.isnan(apart.mean.coaptation_depth)


def test_without_perturbation_paths_differ_by_their_loading_alone(opened):
    found = opened.ensemble(mvs.SYSTOLE_PA, members=3, perturbation=0, residual=1e-2)
    assert [member.perturbation for member in found.members] == [0, 0, 0]
    default = opened.ensemble(mvs.SYSTOLE_PA, members=2, residual=1e-2)
    assert default.members[1].perturbation > 0
