"""mvs.imaging.microct: rest lengths move from the measured ones to those that close the valve onto the loaded leaflets."""

import types

import mvs
import numpy as np
import pytest

pytest.importorskip("pyvista", reason="needs the extra imaging (PyVista)")
pytest.importorskip("scipy", reason="needs the extra imaging (SciPy)")

from mvs.imaging.console import Console  # noqa: E402
from mvs.imaging.mesh import Sheet  # noqa: E402
from mvs.imaging.microct import fitted  # noqa: E402
from mvs.imaging.microct.fitted import with_fitted_lengths  # noqa: E402
from mvs.imaging.microct.loaded import settled  # noqa: E402
from mvs.imaging.valve import distance_from_image  # noqa: E402

QUIET = Console(True)


@pytest.fixture(scope="module")
def truth():
    """A small valve, open and closed, and its closed leaflets as those of an image."""
    with mvs.Simulator() as sim:
        sim.generate()
        valve = mvs.valve_of(sim.snapshot())
    _, closed, stats = settled(valve, QUIET)
    assert stats.converged
    used, triangles = np.unique(np.asarray(closed.triangle_nodes, np.int64), return_inverse=True)
    return valve, closed, Sheet(np.asarray(closed.node_position)[used], triangles.reshape(-1, 3), {})


def valve_with(lengths, valve):
    changed = mvs.valve_of(snapshot_of(valve))
    changed.chord_rest_length = np.array(lengths)
    return changed


def snapshot_of(valve):
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        return sim.snapshot()


def test_lengths_with_a_common_error_close_the_valve_onto_the_leaflets_of_the_image(truth):
    valve, closed, sheet = truth
    right = np.array(valve.chord_rest_length)
    random = np.random.default_rng(1)
    wrong = right * 1.06 * (1 + 0.04 * random.uniform(-1, 1, len(right)))
    measured = valve_with(wrong, valve)
    before = settled(measured, QUIET)
    (_, after, stats), found = with_fitted_lengths(measured, before, [], sheet, QUIET)
    away = [distance_from_image(one, sheet).values[0] for one in (before[1], after)]
    assert away[0] > 0.3e-3  # the error is seen
    # the image here is without error, so that the lengths can meet it
    assert stats.converged and away[1] < away[0] / 3
    assert after.compare(closed).surface_rms < before[1].compare(closed).surface_rms / 3
    assert [one.name for one in found] == ["fitted_chordae"]
    change = np.asarray(measured.chord_rest_length) / wrong - 1
    assert np.allclose(found[0].values, change) and np.abs(change).max() <= 0.3 + 1e-9  # three deviations
    # taut chordae take most of the common error back; slack ones pull at nothing
    taut = np.asarray(closed.chord_tension) > 0.1
    assert np.median((np.asarray(measured.chord_rest_length) / right)[taut]) < 1.03
    again = settled(measured, QUIET)[1]
    assert again.hash == after.hash  # the valve that is kept closes from open to just this shape


def test_right_lengths_stay(truth):
    valve, _, sheet = truth
    same = valve_with(valve.chord_rest_length, valve)
    closure = settled(same, QUIET)
    kept, found = with_fitted_lengths(same, closure, [], sheet, QUIET)
    assert kept is closure and np.array_equal(same.chord_rest_length, valve.chord_rest_length)
    assert "stay as measured" in found[0].sentence and not len(found[0].values)


def test_the_law_that_is_nearest_after_the_fit_is_taken(monkeypatch):
    laws = [mvs.LeafletLaw.FUNG, mvs.LeafletLaw.PROT, mvs.LeafletLaw.MAY_NEWMAN_YIN, mvs.LeafletLaw.BILINEAR]
    away = {laws[0]: 0.6e-3, laws[1]: 0.5e-3, laws[2]: 0.4e-3}
    valve = mvs.valve_of(snapshot_of_generated())
    asked = []

    def fit(changed, _closure, _sheet, _console):
        asked.append(changed.leaflets[0].law)
        return fitted.Fitted(changed, ("open", "closed", None), away[asked[-1]], away[asked[-1]])

    monkeypatch.setattr(fitted, "_fitted", fit)
    monkeypatch.setattr(fitted, "_distance", lambda *_: 1e-3)
    at_rest = (None, None, types.SimpleNamespace(converged=True))
    closure, found = with_fitted_lengths(valve, at_rest, laws, None, QUIET)
    assert asked == laws[: fitted.TISSUES]  # no fit is spent on a law that was far away
    assert closure[1] == "closed" and {one.law for one in valve.leaflets} == {laws[2]}
    assert [one.name for one in found] == ["fitted_chordae", "tissue"]
    assert found[1].sentence.startswith("may_newman_yin: ") and list(found[1].values) == sorted(away.values())


def test_a_valve_that_closes_from_open_in_another_fold_is_fitted_from_there(monkeypatch):
    valve = mvs.valve_of(snapshot_of_generated())
    rounds = iter([(0.8e-3, 0.4e-3), (0.41e-3, 0.4e-3), (0.1e-3, 0.1e-3)])
    monkeypatch.setattr(fitted, "_fitted", lambda changed, *_: fitted.Fitted(changed, ("", "", None), *next(rounds)))
    monkeypatch.setattr(fitted, "_distance", lambda *_: 1e-3)
    at_rest = (None, None, types.SimpleNamespace(converged=True))
    _, found = with_fitted_lengths(valve, at_rest, [], None, QUIET)
    assert "0.41 mm RMS" in found[0].sentence and len(list(rounds)) == 1  # the second closed in the fold of its fit


def snapshot_of_generated():
    with mvs.Simulator() as sim:
        sim.generate()
        return sim.snapshot()
