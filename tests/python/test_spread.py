"""Closing along several paths: values, statistics and arrays; callbacks; refusals."""

import dataclasses

import mvs
import numpy as np
import pytest

PATHS = 4


@pytest.fixture(scope="module")
def thin():
    """A coarse valve half as thick as the shipped one, open: it has folds to choose from."""
    with mvs.Simulator() as made:
        made.generate(vertices=250, thickness=0.5e-3)
        return made.snapshot()


@pytest.fixture(scope="module")
def spread(thin):
    return thin.spread(mvs.SYSTOLE_PA, paths=PATHS)


def test_path_0_is_the_plain_closure(thin, spread):
    with mvs.Simulator() as sim:
        sim.restore(thin)
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle()
        plain = sim.snapshot()
    first = spread.paths[0]
    assert spread.snapshot(0).hash == plain.hash
    assert (first.stats.iterations, first.stats.energy) == (stats.iterations, stats.energy)
    assert (first.perturbation, first.node_max, first.increments) == (0, 0, 1)


def test_statistics_are_those_of_the_snapshots(spread):
    assert len(spread) == PATHS == spread.summary.converged
    each = [spread.snapshot(k).measures for k in range(PATHS)]
    for field in dataclasses.fields(mvs.Measures):
        values = np.array([getattr(m, field.name) for m in each], dtype=float)
        if np.isnan(values).any():
            continue
        mean, least, most, deviation, count = (
            getattr(m, field.name)
            for m in (spread.mean, spread.min, spread.max, spread.deviation, spread.count)
        )
        assert (least, most, count) == (values.min(), values.max(), PATHS), field.name
        if isinstance(getattr(each[0], field.name), float):
            # sums in another order
            size = np.abs(values).max()
            assert mean == pytest.approx(values.mean(), rel=1e-12), field.name
            assert deviation == pytest.approx(values.std(ddof=1), abs=1e-12 * size), field.name


def test_arrays_are_those_of_the_shapes(spread):
    shapes = np.array([spread.snapshot(k).node_position for k in range(PATHS)])
    node_spread = np.sqrt(((shapes - shapes.mean(axis=0)) ** 2).sum(axis=2).mean(axis=0))
    np.testing.assert_allclose(spread.node_spread, node_spread, rtol=1e-6, atol=1e-15)
    sheet = np.unique(spread.snapshot(0).triangle_nodes)
    apart = shapes[:, None, sheet] - shapes[None, :, sheet]
    pairs = np.sqrt((apart**2).sum(axis=3).mean(axis=2))
    np.testing.assert_allclose(spread.pairs, pairs, rtol=1e-12, atol=1e-18)
    assert pairs.max() > 0
    upper = pairs[np.triu_indices(PATHS, 1)]
    assert spread.summary.node_rms == pytest.approx(np.sqrt((upper**2).mean()), rel=1e-12)
    assert not spread.pairs.flags.writeable and spread.pairs.shape == (PATHS, PATHS)


def test_paths_tell_how_they_went(spread):
    numbers = [path.equilibrium for path in spread.paths]
    assert spread.summary.equilibria == len(set(numbers))
    energies = [path.stats.energy for path in spread.paths]
    assert spread.summary.lowest == int(np.argmin(energies))
    assert [path.order for path in spread.paths[:3]] == list(mvs.SpreadOrder)
    assert [path.ramp > 0 for path in spread.paths] == [False, False, False, True]
    for path in spread.paths[1:]:
        assert 0 < path.perturbation <= 0.5e-3 * (1 + 1e-12)
        assert path.surface_rms <= path.surface_max


def test_arrays_outlive_the_spread(thin):
    made = thin.spread(mvs.SYSTOLE_PA, paths=1)
    arrays = made.node_spread, made.pairs
    del made
    assert arrays[0].max() == 0 and arrays[1].tolist() == [[0]]


def test_the_same_seed_gives_the_same_bits(thin, spread):
    again = thin.spread(mvs.SYSTOLE_PA, paths=2, seed=0)
    other = thin.spread(mvs.SYSTOLE_PA, paths=2, seed=1)
    assert again.snapshot(1).hash == spread.snapshot(1).hash
    assert other.snapshot(1).hash != spread.snapshot(1).hash


def test_progress_looks_cancels_and_raises(thin):
    shares = []
    thin.spread(mvs.SYSTOLE_PA, paths=2, progress=lambda share, _: shares.append(share))
    assert shares == sorted(shares) and shares[-1] > 0.5
    with pytest.raises(mvs.CancelledError):
        thin.spread(mvs.SYSTOLE_PA, paths=2, progress=lambda *_: True)

    def fail(*_):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        thin.spread(mvs.SYSTOLE_PA, paths=2, progress=fail)


def test_bad_arguments_are_refused(thin, spread):
    for name, value, word in [
        ("paths", 0, "paths"),
        ("paths", 1001, "1 to 1000"),
        ("perturbation", 1.0, "0.005"),
        ("wavelength", 1e-6, "wavelength"),
        ("solver", "magic", "newton"),
    ]:
        with pytest.raises(mvs.ArgumentError, match=word):
            thin.spread(mvs.SYSTOLE_PA, **{name: value})
    with pytest.raises(mvs.ArgumentError, match="0 to 3"):
        spread.snapshot(PATHS)
