"""A valve, another one with other lengths, and the fit of the first to the second."""

import numpy as np
import pytest

import mvs


@pytest.fixture(scope="module")
def start():
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=220)  # 80 chordae without branches
        sim.set_load(mvs.SYSTOLE_PA)
        assert sim.settle().converged
        return sim.snapshot()


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


@pytest.fixture(scope="module")
def truth(start):
    random = np.random.default_rng(5)
    length = start.chord_rest_length
    return reclosed(start, chord_rest_length=length * (1 + 0.05 * random.normal(size=len(length))))


@pytest.fixture(scope="module")
def found(start, truth):
    prior = {"chords": mvs.Prior(0.05)}
    nodes = np.unique(start.triangle_nodes)
    data = mvs.Points(nodes, truth.node_position[nodes])
    return mvs.fit(start, data, noise=0.1e-3, priors=prior)
