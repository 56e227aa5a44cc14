"""Minimum of the potential by scipy.optimize (L-BFGS-B), the law in NumPy, penalty contact.

The pressure at the free edge has no potential: it is frozen, and minimised again until it agrees.
Same law as libmvs's springs; contact is with the nearest facing point, so the slope has jumps where
the nearest triangle changes: on them a line search ends, and the forces that are left are told.
"""

from __future__ import annotations

import numpy as np
import scipy
from forces import Law
from scipy.optimize import minimize
from valve import Recorder, arguments


class TimeUp(Exception):
    """Raised at the time limit."""


def main() -> None:
    """Minimises, updates the frozen pressure, and repeats."""
    valve, out, s = arguments(memory=30, rounds=40, tolerance=1e-3, limit=60.0, contact="penalty")
    law = Law(valve, s["contact"])
    free = np.flatnonzero(law.free)
    x, scale = valve.start.copy(), 1e-3
    recorder, calls = Recorder(valve, s["limit"], 0.02), 0

    def place(y: np.ndarray) -> np.ndarray:
        full = valve.start.copy()
        full[free] += scale * y.reshape(-1, 3)
        return full

    def value(y: np.ndarray, frozen: np.ndarray, base: float) -> tuple[float, np.ndarray]:
        nonlocal calls
        calls += 1
        at = place(y)
        energy, force = law.energy(at, frozen)
        if recorder.elapsed() >= s["limit"]:
            raise TimeUp
        return (energy - base) * 1e6, -force[free].ravel() * scale * 1e6

    def look(y: np.ndarray) -> None:
        if recorder.due():
            recorder.sample(place(y), np.inf)

    y, verdict = np.zeros(3 * len(free)), "limit"
    try:
        for _ in range(s["rounds"]):
            frozen = law.frozen_rim(place(y))
            frozen[~law.free] = 0
            base = law.energy(place(y), frozen)[0]
            y = minimize(value, y, (frozen, base), jac=True, method="L-BFGS-B", callback=look,
                         options={"maxcor": s["memory"], "maxiter": 5000, "maxfun": 20000,
                                  "ftol": 1e-14, "gtol": 0.3 * s["tolerance"] * scale * 1e6}).x
            if np.linalg.norm(law.forces(place(y)), axis=1).max() <= s["tolerance"]:
                verdict = "rest"
                break
        else:
            verdict = "stalled"
    except TimeUp:
        pass
    if verdict != "limit":
        recorder.sample(place(y), np.inf)
    recorder.save(out, verdict, calls, s, f"SciPy {scipy.__version__}")


if __name__ == "__main__":
    main()
