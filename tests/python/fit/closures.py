"""Closures of a valve with other arrays."""

import mvs


def reclosed(start, **arrays):
    """The valve with other arrays, closed."""
    valve = mvs.valve_of(start)
    for name, array in arrays.items():
        setattr(valve, name, array)
    with mvs.Simulator(log=lambda level, text: None) as sim:
        sim.set_valve(valve)
        sim.set_load(mvs.SYSTOLE_PA)
        assert sim.settle().converged
        return sim.snapshot()
