"""Time of mvs.fit: the rest lengths of 80 chordae from a closed surface of 425 vertices.

    taskset -c 0 python tests/bench/fit/fit_lengths.py [--truths N]

CPU seconds of one fit to the surface and of one to its tracked nodes, both without noise and fitted as if
it were 0.1 mm; the closure from open beside them. The error of the lengths is of chordae that the data
determine to 95 % of the prior variance and that are taut in both shapes: of tracked nodes it should be
below 2 %.
"""

from __future__ import annotations

import argparse
import time
import warnings

import mvs
import numpy as np

PRIOR, NOISE = 0.05, 0.1e-3


def closed(valve: mvs.Valve) -> mvs.Snapshot:
    with mvs.Simulator(log=lambda level, text: None) as sim:
        sim.set_valve(valve)
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle()
        return sim.snapshot()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--truths", type=int, default=3)
    options = parser.parse_args()
    warnings.simplefilter("ignore", mvs.ValveWarning)
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=425)
        sim.set_load(mvs.SYSTOLE_PA)
        begun = time.process_time()
        sim.settle()
        closure, start = time.process_time() - begun, sim.snapshot()
    length, nodes = start.chord_rest_length, np.unique(start.triangle_nodes)
    print(f"closure from open {closure:.3f} s of CPU, {len(length)} chordae, {len(nodes)} leaflet nodes\n\n"
          "| truth | data | CPU s | closures | RMS before, mm | RMS, mm | determined | largest error, % |\n"
          "|---|---|---|---|---|---|---|---|")
    for seed in range(options.truths):
        valve = mvs.valve_of(start)
        valve.chord_rest_length = length * (1 + PRIOR * np.random.default_rng(seed).normal(size=len(length)))
        truth = closed(valve)
        surface = (np.array(truth.node_position), np.array(truth.triangle_nodes))
        for name, data in (("surface", surface), ("points", mvs.Points(nodes, truth.node_position[nodes]))):
            found = mvs.fit(start, data, noise=NOISE, priors={"chords": mvs.Prior(PRIOR)})
            sure = (found.determined > 0.95) & (truth.chord_strain > 0.005) & (found.closed.chord_strain > 0.005)
            error = np.abs(found.values / truth.chord_rest_length - 1)[sure].max(initial=0)
            before = np.sqrt(np.mean(found.residuals_before**2))
            print(f"| {seed} | {name} | {found.cpu_seconds:.2f} | {found.closures} | {1e3 * before:.3f} | "
                  f"{1e3 * found.rms:.3f} | {sure.sum()} | {100 * error:.2f} |", flush=True)


if __name__ == "__main__":
    main()
