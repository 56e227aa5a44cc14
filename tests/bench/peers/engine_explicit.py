"""The founding paper's method written plainly in NumPy: symplectic Euler, damping, penalty contact.

Same law as libmvs's springs; contact is with the nearest facing point.
"""

from __future__ import annotations

import numpy as np
from forces import Law
from valve import Recorder, arguments


def main() -> None:
    """Steps until the force is small or the time limit is reached."""
    valve, out, s = arguments(dt=8e-6, damping=500.0, tolerance=1e-3, limit=60.0)
    law = Law(valve, "penalty")
    x, v = valve.start.copy(), np.zeros_like(valve.start)
    inverse = np.where(valve.fixed, 0, 1 / valve.mass)[:, None]
    recorder, verdict, step = Recorder(valve, s["limit"], 0.02), "limit", 0
    while True:
        step += 1
        force = law.forces(x)
        v += s["dt"] * (force * inverse - s["damping"] * v)
        x += s["dt"] * v
        if step % 50:
            continue
        residual = np.linalg.norm(force, axis=1).max()
        if not np.isfinite(residual) or np.abs(x).max() > 1:
            verdict = "exploded"
            break
        rests = residual <= s["tolerance"]
        verdict = recorder.verdict(x, np.linalg.norm(v, axis=1).max(), rests)
        if verdict:
            break
    recorder.save(out, verdict, step, s, f"NumPy {np.__version__}")


if __name__ == "__main__":
    main()
