"""Whether the interval of leaks that a build reports contains the leak of valves with other chordae.

    python tests/validation/leak_coverage.py [--data DIR] [--truths N] [--seed N]

Twin experiments: each surface becomes a valve; the truth is the same valve with random rest lengths
from the plausible range: each group of chordae (leaflet, kind, muscle) between 0.9 and 1.1 times as
long, each chord another 0.97 to 1.03, closed from its open shape. Of torn and eaten surfaces the truth
is the valve of the whole surface: the build sees a free edge that lacks triangles, or four stretches of
4 to 10 mm. The exit code is 1 if fewer than 19 of 20 truths leak as much as the interval says. A leak
of less than 0.5 mm2 beyond the interval counts as inside: the orifice of one valve differs by as much
between meshes.
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


def true_leaks(sim: mvs.Simulator, truths: int, seed: int) -> np.ndarray:
    """Leaks in m2 of the valve of `sim` with random lengths, of those that come to rest."""
    built = sim.snapshot()
    found = []
    for k in range(truths):
        sim.restore(built)
        found.append(random_truth(sim, 1000 * seed + k))
    return np.array([leak for leak in found if np.isfinite(leak)])


def covered(name: str, whole: dict, given: dict, truths: int, seed: int) -> tuple[int, int, float]:
    """How many truths of a surface lie inside its interval, how many came to rest, its width in m2."""
    with mvs.Simulator(log=lambda *_: None) as sim:
        values = {finding.name: finding.values for finding in sim.build_valve(**given)}
        low, high = values["leak_interval"]
        if whole is not given:
            sim.build_valve(**whole)
        found = true_leaks(sim, truths, seed)
    inside = int(((found >= low - NOISE) & (found <= high + NOISE)).sum())
    words = " ".join(f"{1e6 * leak:.1f}" for leak in found)
    lost = f"{1e3 * values['edge_lost'][0]:.1f}" if "edge_lost" in values else ""
    print(f"| {name} | {1e6 * values['leak'][1]:.1f} | {lost} | {1e6 * low:.1f} to {1e6 * high:.1f} "
          f"| {inside} of {len(found)} | {words} |", flush=True)
    return inside, len(found), high - low


def surfaces_of(folder: Path, seed: int) -> dict[str, tuple]:
    """By name: the whole surface, and what the build sees of it."""
    whole = {
        "healthy": lambda: data.generated(vertices=1500),
        "founding": lambda: data.generated(shape="founding"),
        "dilated": lambda: data.generated(vertices=1500, annulus_ap=32e-3, annulus_cc=42e-3),
        "Kaiser N64": lambda: data.kaiser(folder, "N64"),
        "real": lambda: data.welded(data.read_stl(folder / "real_mitral" / "open_1146.stl")),
    }
    found: dict[str, tuple] = {name: (make, lambda s: s) for name, make in whole.items()}
    for k, (name, make) in enumerate(whole.items()):
        found[f"{name}, torn"] = (make, lambda s, k=k: data.torn(s, 0.1, 100 * seed + k))
        found[f"{name}, eaten"] = (make, lambda s, k=k: data.eaten(s, 4, 100 * seed + k))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    folder = Path(os.environ.get("MVS_TEST_DATA", "../shared/data"))
    parser.add_argument("--data", type=Path, default=folder)
    parser.add_argument("--truths", type=int, default=3, help="of each surface")
    parser.add_argument("--seed", type=int, default=0, help="of lengths, tears and eaten stretches")
    parser.add_argument("--only", default="", help="surfaces whose name contains this text")
    options = parser.parse_args()
    print("| surface | leak, mm2 | lost, mm | interval | inside | truths, mm2 |\n|---|---|---|---|---|---|")
    rows = []
    for name, (make, seen) in surfaces_of(options.data, options.seed).items():
        if options.only in name:
            whole = make()
            rows.append(covered(name, whole, seen(whole), options.truths, options.seed))
    inside, count = (sum(column) for column in list(zip(*rows))[:2])
    width = 1e6 * float(np.median([row[2] for row in rows]))
    print(f"\n{inside} of {count} truths are inside their interval; median width {width:.1f} mm2")
    sys.exit(0 if 20 * inside >= 19 * count else 1)


if __name__ == "__main__":
    main()
