"""A simulator and the functions that it holds are freed together when they hold each other."""

import gc
import weakref

import mvs
import pytest


class Owner:
    """Owns a simulator whose messages go to a method of its own."""

    def __init__(self):
        self.sim = mvs.Simulator(log=self.on_log)
        self.said = []

    def on_log(self, level, text):
        self.said.append(text)


class Derived(mvs.Simulator):
    """A simulator whose messages go to a method of its own."""

    def __init__(self):
        super().__init__(log=self.on_log)
        self.said = []

    def on_log(self, level, text):
        self.said.append(text)


@pytest.mark.parametrize("kind", [Owner, Derived])
def test_an_owner_whose_method_is_the_log_is_freed(kind):
    made = kind()
    sim = getattr(made, "sim", made)
    sim.generate(shape="founding")
    gc.collect()  # it is held: the log stays
    sim.generate(shape="founding")
    assert len(made.said) == 2
    seen = [weakref.ref(made), weakref.ref(sim)]
    del made, sim
    gc.collect()
    assert [each() for each in seen] == [None, None]


def test_a_callback_that_is_at_work_is_not_collected():
    calls = []

    class Watched:
        def __init__(self):
            self.sim = mvs.Simulator()

        def close(self):
            self.sim.generate(shape="founding")
            self.sim.set_load(mvs.SYSTOLE_PA)
            self.sim.settle(progress=self.on_progress)

        def on_progress(self, share, residual):
            gc.collect()
            calls.append(share)
            return len(calls) == 3

    with pytest.raises(mvs.CancelledError):
        Watched().close()
    assert len(calls) == 3


def test_a_simulator_that_could_not_be_made_is_collected():
    kept = mvs.Simulator.__new__(mvs.Simulator)
    tracked = gc.is_tracked(kept)
    gc.collect()
    del kept  # no text of it in a failure: it has no simulator
    assert tracked
    for _ in range(3):
        with pytest.raises(mvs.ArgumentError):
            mvs.Simulator(backend="magic", log=print)
    gc.collect()
