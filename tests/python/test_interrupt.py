"""Ctrl-C stops the calls that the README lists within 0.2 s, and the state is that after whole steps."""

import contextlib
import json
import signal
import time

import mvs
import pytest


@contextlib.contextmanager
def interrupted_after(seconds):
    """Expects KeyboardInterrupt at most 0.2 s after a timer, as a person would press Ctrl-C."""
    # tests in the background of a shell ignore the signal
    kept = signal.signal(signal.SIGINT, signal.default_int_handler)
    alarm = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    begin = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            signal.setitimer(signal.ITIMER_REAL, seconds)
            yield
        # the handler runs when the call looks for signals; the rest is for a busy machine
        assert time.monotonic() - begin < seconds + 0.2 + 0.3
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGINT, kept)
        signal.signal(signal.SIGALRM, alarm)


@pytest.mark.parametrize("solver", ["implicit", "explicit"])
def test_ctrl_c_stops_steps_after_a_whole_number_of_them(sim, solver):
    sim.set_load(mvs.SYSTOLE_PA)
    start = sim.snapshot()
    with interrupted_after(0.1):
        sim.step(10**9, solver=solver)
    stopped = sim.snapshot()
    dt = 1e-3 if solver == "implicit" else 8e-6
    steps = round(float(stopped.state_time[0]) / dt)
    assert steps > 0
    sim.restore(start)
    for _ in range(steps):
        sim.step(solver=solver)
    assert sim.snapshot().hash == stopped.hash


def test_ctrl_c_stops_a_replay_and_the_valve_is_as_before(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    sim.step(2)
    plan = json.loads(sim.snapshot().plan())
    (steps,) = (step for step in plan["steps"] if step.get("count") == 2)
    steps["count"] = 1000000
    with mvs.Simulator() as other:
        other.generate(shape="founding")
        before = other.snapshot().hash
        with interrupted_after(0.1):
            other.replay_plan(plan)
        assert other.snapshot().hash == before


def test_ctrl_c_stops_an_ensemble(opened):
    with interrupted_after(0.1):
        opened.ensemble(mvs.SYSTOLE_PA, members=1000)


def test_ctrl_c_stops_a_sensitivity(closed):
    with interrupted_after(0.1):
        closed.sensitivity("measures", ["chords", "annulus"])


def test_ctrl_c_stops_the_virtual_clock_of_a_device():
    with mvs.Device("template", clock="virtual") as device:
        device.start()
        with interrupted_after(0.1):
            while True:
                device.advance(3600)


def test_parts_of_a_long_advance_are_as_many_ticks():
    with mvs.Device("template", clock="virtual") as device:
        device.start()
        rate = device.info.rate
        device.advance(1.1)
        assert device.state.ticks == round(1.1 * rate)
        device.advance(0.0)
        for wrong in (-1, 3601, float("nan")):
            with pytest.raises(mvs.ArgumentError, match="0 to 3600"):
                device.advance(wrong)
        assert device.state.ticks == round(1.1 * rate)
