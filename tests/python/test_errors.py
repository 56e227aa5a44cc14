"""Failed calls raise the C library's code, part, line and sentence, and change nothing."""

import inspect
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
        lambda: sim.generate(shape="magic"),
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


MISFITS = [
    (lambda sim: sim.set_load("120"), "set_load: pressure_pa has to be a number, not '120' (str)"),
    (lambda sim: sim.set_load(True), "set_load: pressure_pa has to be a number, not True (bool)"),
    (lambda sim: sim.set_load(), "set_load() needs the argument pressure_pa"),
    (lambda sim: sim.set_load(1, 2, 3), "set_load: 3 (int) is one argument too many"),
    (lambda sim: sim.set_load(1e4, presure=1), 'set_load() has no argument "presure"; did you mean'),
    (lambda sim: sim.set_load(1e4, pressure_pa=1e4), "pressure_pa is given twice"),
    (lambda sim: sim.settle("newton"), "settle: 'newton' (str) needs a name, as in settle(solver="),
    (lambda sim: sim.settle(max_iterations=3.5),
     "settle: max_iterations has to be a non-negative integer or None, not 3.5 (float)"),
    (lambda sim: sim.settle(solver=3), "settle: solver has to be text, not 3 (int)"),
    (lambda sim: sim.step(-1), "step: count has to be a non-negative integer, not -1 (int)"),
    (lambda sim: sim.snapshot().ensemble(1e4, seed=2**64), "ensemble: seed is too large: 184467"),
    (lambda sim: sim.snapshot().ensemble(1e4, seed=2**40, members=2**33),
     "ensemble: members or seed is too large: 8589934592"),
    (lambda sim: sim.step(2**64), "step: count is too large: 184467"),
    (lambda sim: sim.apply(), "apply() needs the argument operation"),
    (lambda sim: sim.set_leaflet("A"), "set_leaflet() needs the argument law"),
    (lambda sim: sim.generate(vertices="many"), "generate: vertices has to be a non-negative"),
    (lambda sim: sim.generate(400), "generate: 400 (int) needs a name, as in generate(vertices="),
    (lambda sim: sim.load(3), "load: path has to be a path, not 3 (int)"),
    (lambda sim: sim.snapshot().save(None), "save: path has to be a path, not None (NoneType)"),
    (lambda sim: sim.snapshot().compare(sim), "compare: other has to be a mvs.Snapshot, not"),
    (lambda sim: sim.restore(3), "restore: snapshot has to be a mvs.Snapshot, not 3 (int)"),
    (lambda sim: sim.add_tool("ball", (0, 0)), "add_tool: position has to be 3 numbers, not (0, 0)"),
    (lambda sim: mvs.Simulator(backend=3), "Simulator: backend has to be text, not 3 (int)"),
    (lambda sim: mvs.Device(), "Device() needs the argument driver"),
    (lambda sim: mvs.Device("template", clock="virtual").sync(3),
     "sync: sim has to be a mvs.Simulator, not 3 (int)"),
]


@pytest.mark.parametrize("call, words", MISFITS, ids=[words[:24] for _, words in MISFITS])
def test_a_type_error_says_which_argument_and_why(sim, call, words):
    before = sim.snapshot().hash
    with pytest.raises(TypeError) as caught:
        call(sim)
    said = str(caught.value)
    assert words in said
    assert "\n" not in said and len(said) < 400 and "incompatible" not in said
    assert sim.snapshot().hash == before


@pytest.mark.parametrize("call, words", [
    (lambda sim: sim.step(0), "count: 1 or more steps are needed, not 0"),
    (lambda sim: sim.generate(saddle_height=1.0), "0.01 to 15 mm (or None for 5.5 mm)"),
    (lambda sim: sim.generate(vertices=3), "200 to 100000 (or None for"),
    (lambda sim: sim.settle(residual=-1), "it has to be None (the default) or"),
])
def test_the_default_of_an_option_is_none_in_every_sentence(sim, call, words):
    with pytest.raises(mvs.ArgumentError) as caught:
        call(sim)
    assert words in str(caught.value) and "or 0" not in str(caught.value)


def test_a_type_error_of_a_callback_stays_as_it_is(sim):
    def fail(share, residual):
        raise TypeError("mine")

    with pytest.raises(TypeError, match="^mine$"):
        sim.settle(progress=fail)


def test_backends_are_those_of_the_build():
    offered = {"default", *mvs.features} - {"hdf5", "zlib", "haptics"}
    for name in sorted(offered):
        assert f'"{name}"' in mvs.Simulator.__doc__
        mvs.Simulator(backend=name).close()
    with pytest.raises(mvs.ArgumentError) as caught:
        mvs.Simulator(backend="magic")
    assert all(f'"{name}"' in str(caught.value) for name in offered)
    if "cholmod" not in mvs.features:
        assert "cholmod" not in mvs.Simulator.__doc__ and "cholmod" not in str(caught.value)
        with pytest.raises(mvs.UnsupportedError, match="CHOLMOD|cholmod"):
            mvs.Simulator(backend="cholmod")


def test_methods_have_signatures_for_completion():
    shown = inspect.signature(mvs.Simulator.settle)
    assert list(shown.parameters)[:3] == ["self", "solver", "max_iterations"]
    assert shown.parameters["solver"].default == "newton"
    assert shown.parameters["solver"].kind == inspect.Parameter.KEYWORD_ONLY
    assert inspect.signature(mvs.Device).parameters["clock"].default == "real"
