"""How often a fit of all rest lengths of a valve of Fung tissue ends in a worse minimum than another start.

    python tests/bench/fit/fit_starts.py [--seeds N] [--starts K]

Truths: the founding valve of 425 vertices with Fung leaflets and rest lengths off by 5 %, tracked nodes
with a noise of 0.3 mm. A row a truth: cost (half of the squares of data and prior) of the fit from the
first start and of each of K, and of the truth itself, below which a fit in the right minimum ends; CPU of both.
"""

from __future__ import annotations

import argparse
import dataclasses
import os
import warnings

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import mvs  # noqa: E402
import numpy as np  # noqa: E402

PRIOR, NOISE = 0.05, 0.3e-3


def closed(valve: mvs.Valve) -> mvs.Snapshot:
    with mvs.Simulator(log=lambda level, text: None) as sim:
        sim.set_valve(valve)
        sim.set_load(mvs.SYSTOLE_PA)
        if not sim.settle(residual=1e-6).converged:
            raise RuntimeError("the valve does not come to rest")
        return sim.snapshot()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--first", type=int, default=0, help="first seed")
    parser.add_argument("--starts", type=int, default=3)
    parser.add_argument("--vertices", type=int, default=425)
    parser.add_argument("--most", type=int, default=15)
    options = parser.parse_args()
    warnings.simplefilter("ignore", mvs.ValveWarning)
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=options.vertices)
        valve = mvs.valve_of(sim.snapshot())
    valve.leaflets = [dataclasses.replace(leaf, law="fung", constants=()) for leaf in valve.leaflets]
    start = closed(valve)
    length, nodes = start.chord_rest_length, np.unique(start.triangle_nodes)
    print("| seed | cost of the truth | one start | CPU s | converged | each of several | CPU s |\n"
          "|---|---|---|---|---|---|---|")
    for seed in range(options.first, options.first + options.seeds):
        random = np.random.default_rng(seed)
        z = random.normal(size=len(length))
        changed = mvs.valve_of(start)
        changed.chord_rest_length = length * (1 + PRIOR * z)
        truth = closed(changed)
        error = NOISE * random.normal(size=(len(nodes), 3))
        data = mvs.Points(nodes, truth.node_position[nodes] + error)
        own = 0.5 * (np.sum((error / NOISE) ** 2) + z @ z)
        fits = [mvs.fit(start, data, noise=NOISE, priors={"chords": mvs.Prior(PRIOR)}, starts=k, most=options.most)
                for k in (1, options.starts)]
        one, several = fits
        print(f"| {seed} | {own:.0f} | {one.starts[0].cost:.0f} | {one.cpu_seconds:.1f} | {one.converged} | "
              f"{' '.join(f'{s.cost:.0f}' for s in several.starts)} | {several.cpu_seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()
