"""Texas and seeded variants of it: time, iterations, crossings and distance from Abaqus of each.

    python tests/validation/texas_variants.py [--variants 10] [--residual 1e-4] [--data DIR]
    python tests/validation/texas_variants.py --variants 0 --chords 0.1 --phases

A variant has its own random thickness of each leaflet (+-20 %) and rest length of each chord (+-5 %):
its distance from Abaqus' frame, which is of the healthy valve, says only that it is still near. The
last row has the median and the worst of the CPU times. `--chords` multiplies the area, and with it the
stiffness, of every chord; `--phases` prints where the time goes.
"""

from __future__ import annotations

import argparse
import statistics
import time
from pathlib import Path

import mvs
import numpy as np
import texas


def variant(seed: int, chords: float = 1) -> texas.Change:
    """Thickness of each leaflet +-20 %, rest length of each chord +-5 %; seed 0 changes neither.

    `chords` multiplies the area of every chord.
    """
    random = np.random.default_rng(seed)

    def change(valve: mvs.Valve) -> None:
        valve.chord_area = np.asarray(valve.chord_area) * chords
        if seed == 0:
            return
        thickness = np.array(valve.triangle_thickness, dtype=float)
        leaflet = np.asarray(valve.triangle_leaflet)
        for k in range(leaflet.max() + 1):
            thickness[leaflet == k] *= random.uniform(0.8, 1.2)
        valve.triangle_thickness = thickness
        valve.chord_rest_length = np.asarray(valve.chord_rest_length) * random.uniform(
            0.95, 1.05, len(valve.chord_rest_length)
        )

    return change


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--variants", type=int, default=10)
    parser.add_argument("--residual", type=float, default=1e-4, help="N")
    parser.add_argument("--chords", type=float, default=1, help="factor of their stiffness")
    parser.add_argument("--phases", action="store_true", help="wall time of each phase, s")
    parser.add_argument("--data", type=Path, default=texas.data_folder())
    options = parser.parse_args()
    frame = texas.read_frame(options.data)
    times, profiles = [], []
    print("| seed | CPU, s | iterations | factorisations | at rest | residual, N | crossings | leak, mm2 "
          "| RMS, mm | most, mm |")
    print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
    for seed in range(options.variants + 1):
        opened = texas.open_valve(options.data, None, change=variant(seed, options.chords))
        with mvs.Simulator() as sim:
            sim.restore(opened)
            sim.set_load(texas.PRESSURE, 1.0)
            started = time.process_time()
            stats = sim.settle(residual=options.residual)
            times.append(time.process_time() - started)
            closed = sim.snapshot()
        errors = texas.errors_of(closed, frame)
        print(f"| {seed} | {times[-1]:.1f} | {stats.iterations} | {stats.profile.factorisations} "
              f"| {stats.converged} | {stats.residual:.0e} "
              f"| {closed.measures.intersections} | {1e6 * closed.measures.regurgitant_orifice_area:.2f} "
              f"| {1e3 * errors.rms:.3f} | {1e3 * errors.max:.2f} |", flush=True)
        profiles.append(stats.profile)
    print(f"\nCPU: median {statistics.median(times):.1f} s, worst {max(times):.1f} s")
    if options.phases:
        for seed, profile in enumerate(profiles):
            print(f"seed {seed}: {profile}")


if __name__ == "__main__":
    main()
