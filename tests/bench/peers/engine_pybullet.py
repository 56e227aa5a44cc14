"""PyBullet: the sheet as a soft body of springs, fixed nodes as anchors of the world.

One linear stiffness serves all edges, so it is that of the median edge; chordae and pressure are
forces from outside, node by node. Nodes of the soft body keep the order of the mesh file; fixed
nodes off the sheet stay out of it.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import pybullet as bullet
from loads import chords, pressure, resting_gap, secant
from valve import Recorder, Valve, arguments


def mesh(valve: Valve, nodes: int, scale: float) -> str:
    """The sheet as an OBJ file."""
    lines = [f"v {p[0]:.9g} {p[1]:.9g} {p[2]:.9g}" for p in valve.start[:nodes] * scale]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in valve.triangles.tolist()]
    path = Path(tempfile.mkdtemp()) / "sheet.obj"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return str(path)


def main() -> None:
    """Steps until the valve rests or the time limit is reached."""
    valve, out, s = arguments(dt=1e-4, scale=100.0, strain=0.1, stiffness=1.0, damp=0.1,
                              damping=200.0, ramp=5e-3, contact=1, still=1e-3, limit=60.0)
    nodes = int(valve.triangles.max()) + 1
    free = np.flatnonzero(~valve.fixed[:nodes])
    bullet.connect(bullet.DIRECT)
    bullet.resetSimulation(bullet.RESET_USE_DEFORMABLE_WORLD)
    bullet.setGravity(0, 0, 0)
    bullet.setTimeStep(s["dt"])
    k = np.median(secant(valve, s["strain"]) * valve.spring_volume / valve.spring_length**2)
    scale = s["scale"]
    body = bullet.loadSoftBody(
        mesh(valve, nodes, scale), mass=float(valve.mass[:nodes].sum()), useMassSpring=1,
        springElasticStiffness=float(k * s["stiffness"]), springDampingStiffness=s["damp"],
        useBendingSprings=0, useSelfCollision=int(s["contact"]), useFaceContact=0,
        collisionMargin=resting_gap(valve) / 2 * scale, repulsionStiffness=float(k))
    for i in np.flatnonzero(valve.fixed[:nodes]).tolist():
        bullet.createSoftBodyAnchor(body, i, -1, -1)

    def where() -> np.ndarray:
        x = valve.start.copy()
        seen = bullet.getMeshData(body, -1, flags=bullet.MESH_DATA_SIMULATION_MESH)
        x[:nodes] = np.array(seen[1]) / scale
        return x

    off = np.abs(where() - valve.start).max()
    if off > 1e-5:
        raise SystemExit(f"PyBullet put the nodes in another order: {off:.3g} m off")
    x = where()
    bullet.applyExternalForce(body, int(free[0]), [0, 0, 1.0], [0, 0, 0], bullet.WORLD_FRAME)
    bullet.stepSimulation()
    if np.abs(where() - x).max() < 1e-9:
        raise SystemExit("PyBullet ignores a force of 1 N on a node of a soft body: no pressure")
    recorder, verdict, step, quiet = Recorder(valve, s["limit"], 0.05), "limit", 0, 0
    v = np.zeros_like(x)
    while True:
        share = min(1.0, (step + 1) * s["dt"] / s["ramp"])
        force = (pressure(valve, x, share) + chords(valve, x)
                 - s["damping"] * valve.mass[:, None] * v) * scale
        for i in free.tolist():
            bullet.applyExternalForce(body, i, force[i].tolist(), [0, 0, 0], bullet.WORLD_FRAME)
        bullet.stepSimulation()
        step += 1
        before, x = x, where()
        v = (x - before) / s["dt"]
        speed = float(np.linalg.norm(v, axis=1).max())
        quiet = quiet + 1 if speed < s["still"] and share == 1 else 0
        rests = quiet * s["dt"] >= 2e-3
        if not np.isfinite(x).all() or np.abs(x).max() > 1:
            verdict = "exploded"
            break
        verdict = recorder.verdict(x, speed, rests)
        if verdict:
            break
    recorder.save(out, verdict, step, s, f"PyBullet API {bullet.getAPIVersion()}")


if __name__ == "__main__":
    main()
