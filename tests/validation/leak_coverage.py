"""Whether the interval of leaks that a build reports contains the leak of valves with other chordae.

    python tests/validation/leak_coverage.py [--data DIR] [--truths N]

Twin experiments: each surface becomes a valve; the truth is the same valve with random rest lengths
from the plausible range: each group of chordae (leaflet, kind, muscle) between 0.9 and 1.1 times as
long, each chord another 0.97 to 1.03, closed from its open shape. The exit code is 1 if fewer than 19
of 20 truths leak as much as the interval says. A leak of less than 0.5 mm2 beyond the interval counts
as inside: the orifice of one valve differs by as much between meshes.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import mvs
import numpy as np
import surfaces_data as data

NOISE = 0.5e-6
"""m2"""


def group_of(chord: dict) -> tuple:
    """Leaflet, kind and muscle of a chord; a trunk has the kind trunk."""
    return (chord["site"][:1], chord["kind"], chord["head"][:2])


def random_truth(sim: mvs.Simulator, seed: int) -> float:
    """The leak with random lengths, m2; NaN if the valve does not come to rest."""
    random = np.random.default_rng(seed)
    factors: dict[tuple, float] = {}
    for chord in sim.snapshot().chords():
        group = factors.setdefault(group_of(chord), random.uniform(0.9, 1.1))
        sim.apply("chord_length", chord=chord["name"], factor=group * random.uniform(0.97, 1.03))
    sim.set_load(mvs.SYSTOLE_PA)
    stats = sim.settle()
    return sim.snapshot().measures.regurgitant_orifice_area if stats.converged else float("nan")


def covered(name: str, surface: dict, truths: int) -> tuple[int, int]:
    """How many truths of a surface lie inside its interval, and how many came to rest."""
    with mvs.Simulator() as sim:
        findings = sim.build_valve(**surface)
        values = {finding.name: finding.values for finding in findings}
        low, high = values["leak_interval"]
        built = sim.snapshot()
        found = []
        for seed in range(truths):
            sim.restore(built)
            found.append(random_truth(sim, seed))
    found = np.array([leak for leak in found if np.isfinite(leak)])
    inside = int(((found >= low - NOISE) & (found <= high + NOISE)).sum())
    words = " ".join(f"{1e6 * leak:.1f}" for leak in found)
    print(f"| {name} | {1e6 * values['leak'][1]:.1f} | {1e6 * low:.1f} to {1e6 * high:.1f} "
          f"| {inside} of {len(found)} | {words} |", flush=True)
    return inside, len(found)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    folder = Path(os.environ.get("MVS_TEST_DATA", "../shared/data"))
    parser.add_argument("--data", type=Path, default=folder)
    parser.add_argument("--truths", type=int, default=5, help="of each surface")
    parser.add_argument("--only", default="", help="surfaces whose name contains this text")
    options = parser.parse_args()
    surfaces = {
        "healthy": lambda: data.generated(),
        "founding": lambda: data.generated(shape="founding"),
        "dilated": lambda: data.generated(annulus_ap=32e-3, annulus_cc=42e-3),
        "healthy, torn": lambda: data.torn(data.generated(), 0.1, 5),
        "Kaiser N64": lambda: data.kaiser(options.data, "N64"),
        "real": lambda: data.read_stl(options.data / "real_mitral" / "open_1146.stl"),
    }
    print("| surface | leak, mm2 | interval | inside | truths, mm2 |\n|---|---|---|---|---|")
    rows = [covered(n, make(), options.truths) for n, make in surfaces.items() if options.only in n]
    inside, count = (sum(column) for column in zip(*rows))
    print(f"\n{inside} of {count} truths are inside their interval")
    sys.exit(0 if 20 * inside >= 19 * count else 1)


if __name__ == "__main__":
    main()
