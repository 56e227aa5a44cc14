"""Whether a valve that does not come to rest flutters: eigenvalues by differences of forces and SciPy.

    python tests/validation/flutter.py [--data DIR]

`Kaiser N32, moved` of forty_surfaces.py returns to one unstable equilibrium. Here its tangent K is made
without the tangent of the library, from central differences of the forces of 6,000 displaced valves, and
the eigenvalues of -D^-1 K with those masses that the mesh gives (D: 500 1/s times the mass) by LAPACK. A
complex pair with a positive real part is flutter: a valve in overdamped motion circles around this
equilibrium and never rests. The exit code is 1 if there is none, or if it is not that of the library.
Two minutes.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import mvs
import numpy as np
import scipy.linalg
import surfaces_data as data

DAMPING = 500.0  # 1/s, mvs_stability
STEP = 1e-8  # m: of the differences; contact bends forces over 1e-5 m
LEAST_STIFFNESS = 1e-3  # N/m: slack branch points are left out, as by mvs_stability


def settled(folder: Path) -> tuple[mvs.Snapshot, object]:
    with mvs.Simulator(log=lambda *_: None) as sim:
        sim.build_valve(**data.moved(data.kaiser(folder, "N32"), 17), leak=False)
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle()
        return sim.snapshot(), stats


def masses(valve: mvs.Snapshot) -> np.ndarray:
    """The mass of each node: a third of its triangles, half of its chordae, kg."""
    density = float(valve.valve_constants[0])
    rest, triangles = np.asarray(valve.node_rest), np.asarray(valve.triangle_nodes)
    a, b, c = (rest[triangles[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    mass = np.zeros(len(rest))
    for k in range(3):
        np.add.at(mass, triangles[:, k], density * area * np.asarray(valve.triangle_thickness) / 3)
    for k in range(2):
        volume = np.asarray(valve.chord_area) * np.asarray(valve.chord_rest_length)
        np.add.at(mass, np.asarray(valve.chord_nodes)[:, k], 0.5 * density * volume)
    return mass


def tangent(valve: mvs.Snapshot, free: np.ndarray) -> np.ndarray:
    """-d force / d position of the free nodes."""
    arrays = mvs.valve_of(valve)
    start = arrays.nodes_now.copy()
    columns = []
    with mvs.Simulator(log=lambda *_: None) as sim:

        def force(node: int, axis: int, by: float) -> np.ndarray:
            arrays.nodes_now = start.copy()
            arrays.nodes_now[node, axis] += by
            sim.set_valve(arrays)
            sim.set_load(mvs.SYSTOLE_PA)
            return np.asarray(sim.snapshot().node_force)[free].ravel()

        for node in free:
            for axis in range(3):
                difference = force(node, axis, STEP) - force(node, axis, -STEP)
                columns.append(-difference / (2 * STEP))
    return np.array(columns).T


def rates(valve: mvs.Snapshot) -> np.ndarray:
    """Eigenvalues of -D^-1 K, the rightmost first, 1/s."""
    held = np.asarray(valve.node_kind) != mvs.NodeKind.LEAFLET
    held &= np.asarray(valve.node_kind) != mvs.NodeKind.BRANCH
    free = np.flatnonzero(~held)
    stiffness = tangent(valve, free)
    diagonal = np.abs(stiffness.diagonal()).reshape(-1, 3).max(1)
    kept = np.repeat(diagonal > LEAST_STIFFNESS, 3)
    damping = DAMPING * np.repeat(masses(valve)[free], 3)
    found = scipy.linalg.eigvals(-(stiffness / damping[:, None])[np.ix_(kept, kept)])
    return found[np.argsort(-found.real)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    folder = Path(os.environ.get("MVS_TEST_DATA", "../shared/data"))
    parser.add_argument("--data", type=Path, default=folder)
    valve, stats = settled(parser.parse_args().data)
    print(f"at rest: {stats.converged}, residual {stats.residual:.1e} N, {stats.iterations} iterations")
    found = rates(valve)
    print("rightmost eigenvalues, 1/s: " + ", ".join(f"{e.real:.2f}{e.imag:+.2f}i" for e in found[:6]))
    print(f"by the library: {stats.growth_rate:.2f} 1/s")
    flutters = found[0].real > 0 and abs(found[0].imag) > 0
    agrees = abs(found[0].real / stats.growth_rate - 1) < 0.02  # the margins are within 1 %
    print("flutters" if flutters else "does not flutter")
    sys.exit(0 if flutters and agrees else 1)


if __name__ == "__main__":
    main()
