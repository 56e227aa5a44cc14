"""Self-convergence: the closed shape of a valve on finer and finer meshes, and its order.

Every level cuts the triangles of the one before in four (mvs remesh, libmvs/anatomy), so that the
nodes of the coarsest are in all. Every level is closed from open: a fold that is found on one level
alone shows in its largest distance. Run it to print the table (30 s of CPU; --long: 27,000 vertices,
5 min):

    python tests/validation/convergence.py [--long]
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from typing import Callable

import mvs
import numpy as np

RESIDUAL = 1e-6
"""N: a shape at this residual is accurate to a fraction of a micrometre, far below the level errors"""


@dataclass
class Level:
    """A valve closed on one mesh."""

    closed: mvs.Snapshot
    stats: mvs.Stats
    cpu_s: float

    @property
    def vertices(self) -> int:
        return len(np.unique(self.closed.triangle_nodes))


def close_levels(
    prepare: Callable[[mvs.Simulator], None], count: int, pressure_pa: float = mvs.SYSTOLE_PA,
    chained: bool = True,
) -> list[Level]:
    """Closes the valve that `prepare` makes, and its refinements, each from open or, chained, from the
    closed shape of the one before."""
    levels: list[Level] = []
    for k in range(count):
        with mvs.Simulator() as sim:
            prepare(sim)
            sim.refine(k)
            if chained and levels:
                sim.transfer_state(levels[-1].closed)
            sim.set_load(pressure_pa)
            started = time.process_time()
            stats = sim.settle(residual=RESIDUAL)
            levels.append(Level(sim.snapshot(), stats, time.process_time() - started))
    return levels


def shipped(law: str) -> Callable[[mvs.Simulator], None]:
    """Makes the founding valve, with springs or another law."""

    def prepare(sim: mvs.Simulator) -> None:
        sim.generate(shape="founding")
        if law != "spring":
            sim.set_leaflet(law=law)

    return prepare


def node_rms(a: mvs.Snapshot, b: mvs.Snapshot, count: int) -> float:
    """Between the first nodes of two levels, m."""
    apart = a.node_position[:count] - b.node_position[:count]
    return float(np.sqrt((apart**2).sum(axis=1).mean()))


def orders(levels: list[Level]) -> list[float]:
    """log2 of how much nearer each level is to the next than the level before it was.

    Distances are those of the nodes of the coarsest level: the same points of tissue everywhere.
    """
    count = len(levels[0].closed.node_rest)
    step = [node_rms(a.closed, b.closed, count) for a, b in zip(levels, levels[1:])]
    return [float(np.log2(a / b)) for a, b in zip(step, step[1:])]


def table(title: str, levels: list[Level]) -> str:
    """The levels of one element, a line each; distances from the finest, in mm."""
    finest, order = levels[-1].closed, [float("nan")] * 2 + orders(levels)
    lines = [
        f"{title}",
        f"{'vertices':>9} {'rest':>4} {'iter.':>5} {'CPU s':>7} {'cross':>5} {'surf.RMS':>8} "
        f"{'max':>6} {'node RMS':>8} {'order':>5} {'energy mJ':>10} {'coapt.mm2':>9}",
    ]
    for level, p in zip(levels, order):
        found, count = level.closed.compare(finest), len(level.closed.node_rest)
        measures = level.closed.measures
        lines.append(
            f"{level.vertices:9d} {'yes' if level.stats.converged else 'NO':>4} "
            f"{level.stats.iterations:5d} {level.cpu_s:7.1f} {measures.intersections:5d} "
            f"{found.surface_rms * 1e3:8.3f} {found.surface_max * 1e3:6.2f} "
            f"{node_rms(level.closed, finest, count) * 1e3:8.3f} {p:5.1f} "
            f"{level.stats.energy * 1e3:10.4f} {measures.coaptation_area * 1e6:9.1f}"
        )
    return "\n".join(lines)


def main() -> None:
    """Prints the table of springs and of the membrane with the same curve."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--long", action="store_true", help="also 27,000 vertices")
    count = 4 if parser.parse_args().long else 3
    print("the founding valve under 120 mmHg; distances from its finest level, in mm")
    for law in ("spring", "bilinear"):
        print("\n" + table(law, close_levels(shipped(law), count, chained=False)), flush=True)


if __name__ == "__main__":
    main()
