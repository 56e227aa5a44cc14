"""Dynamic relaxation in NumPy: steps in a time of its own, masses scaled to the stiffness at hand.

Kinetic damping: all speed is taken away whenever the kinetic energy has passed a peak. Same law as
libmvs's springs; contact is with the nearest facing point.
"""

from __future__ import annotations

import numpy as np
from forces import Law
from valve import Recorder, Valve, arguments


def scaled_masses(valve: Valve, law: Law, x: np.ndarray, safety: float) -> np.ndarray:
    """The sum of the stiffnesses at each node: a time step of 1 is then stable (Gershgorin)."""
    low, high, kink = valve.spring_law
    strain = law.sheet.lengths(x)[1] / valve.spring_length - 1
    modulus = np.where(strain > kink - 0.05, high, low)
    stiffness = modulus * valve.spring_volume / valve.spring_length**2
    total = np.zeros(len(x))
    np.add.at(total, valve.springs.ravel(), np.repeat(stiffness, 2))
    taut = law.cords.lengths(x)[1] > 0.98 * valve.chord_length
    cords = np.where(taut, valve.chord_stiffness / valve.chord_length, 0)
    np.add.at(total, valve.chords.ravel(), np.repeat(cords, 2))
    if law.contact:
        total += 4 * law.contact.strength / law.contact.range
    total[total == 0] = 1
    return safety * total


def main() -> None:
    """Iterates until the force is small or the time limit is reached."""
    valve, out, s = arguments(safety=1.0, longest=5e-4, tolerance=1e-3, limit=60.0)
    law = Law(valve, "penalty")
    x, v = valve.start.copy(), np.zeros_like(valve.start)
    recorder, verdict, step, before = Recorder(valve, s["limit"], 0.02), "limit", 0, 0.0
    while True:
        if step % 20 == 0:
            mass = scaled_masses(valve, law, x, s["safety"])[:, None]
        step += 1
        force = law.forces(x)
        residual = np.linalg.norm(force, axis=1).max()
        v += force / mass
        energy = float((mass * v * v).sum())
        if energy < before:
            v, energy = 0.5 * force / mass, 0.0
        before = energy
        length = np.linalg.norm(v, axis=1, keepdims=True)
        v *= np.minimum(1, s["longest"] / np.maximum(length, 1e-300))
        x += v
        rests = residual <= s["tolerance"]
        verdict = recorder.verdict(x, np.inf, rests)
        if verdict:
            break
    recorder.save(out, verdict, step, s, f"NumPy {np.__version__}")


if __name__ == "__main__":
    main()
