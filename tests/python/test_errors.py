"""Failed calls raise the C library's code, part, line and sentence, and change nothing."""

import pickle

import mvs
import numpy as np
import pytest
from mvs import errors


def test_every_code_of_the_header_has_its_exception():
    import re

    from conftest import ROOT

    header = (ROOT / "include" / "mvs" / "base.h").read_text()
    codes = {int(code) for code in re.findall(r"MVS_E_\w+ = (-\d+)", header)}
    assert codes == set(errors.BY_CODE)
    for code, kind in errors.BY_CODE.items():
        assert kind.code == code and issubclass(kind, mvs.Error)


@pytest.mark.parametrize("code", sorted(errors.BY_CODE))
def test_an_exception_survives_pickling(code):
    error = errors.of(code, "chord P2/3 is slack", "chord P2/3", 17)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert (str(again), again.code, again.part, again.line) == (str(error), code, "chord P2/3", 17)


def test_a_simulator_without_a_valve_is_a_state_error():
    with mvs.Simulator() as sim, pytest.raises(mvs.StateError) as caught:
        sim.settle()
    assert caught.value.code == -3
    assert len(str(caught.value)) > 20


def test_a_bad_file_is_reported_with_its_line(tmp_path, sim):
    path = tmp_path / "valve.obj"
    sim.snapshot().save(path)
    lines = path.read_text().splitlines()
    row = next(k for k, line in enumerate(lines) if line.startswith("v "))
    lines[row] = "v 1 2 three"
    path.write_text("\n".join(lines) + "\n")
    before = sim.snapshot().hash
    with pytest.raises(mvs.FormatError) as caught:
        sim.load(path)
    assert caught.value.line == row + 1
    assert "valve.obj" in str(caught.value)
    assert sim.snapshot().hash == before


def test_a_missing_file_is_an_io_error(sim, tmp_path):
    with pytest.raises(OSError) as caught:
        sim.load(tmp_path / "none.obj")
    assert isinstance(caught.value, mvs.IoError) and caught.value.code == -8


def test_an_unknown_part_is_an_id_error(closed):
    with pytest.raises(LookupError) as caught:
        closed.find(mvs.PartKind.SCALLOP, "Q9")
    assert isinstance(caught.value, mvs.IdError)


@pytest.mark.parametrize("pressure", [np.nan, np.inf])
def test_a_load_that_is_not_finite_is_refused(sim, pressure):
    before = sim.snapshot().hash
    with pytest.raises(mvs.ArgumentError):
        sim.set_load(pressure)
    assert sim.snapshot().hash == before


def test_words_of_choices_are_checked(sim, closed):
    for call in (
        lambda: mvs.Simulator(backend="magic"),
        lambda: sim.settle(solver="magic"),
        lambda: closed.to_bytes(format="magic"),
    ):
        with pytest.raises(mvs.ArgumentError, match="magic"):
            call()


def test_a_closed_simulator_is_reported(sim):
    snapshot = sim.snapshot()
    sim.close()
    with pytest.raises(mvs.StateError, match="closed"):
        sim.settle()
    assert snapshot.measures.annulus_ap > 0
