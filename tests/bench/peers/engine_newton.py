"""Newton (`newton`, on NVIDIA Warp, on the CPU): VBD or XPBD, the sheet as springs or as triangles.

Newton's springs are linear and push as well as pull. The bilinear law and tension-only chordae are
made of them by switching: every edge has a second spring of the length at the kink, every chord one
of its length, and before each step those that are slack get a stiffness of zero. sheet=triangles
takes Newton's own membrane, which is linear, instead. The pressure is a force from outside, worked
out anew each step; bending and self-contact are Newton's. Everything in it is float32.
"""

from __future__ import annotations

import newton
import numpy as np
import warp as wp
from loads import pressure, resting_gap, secant
from valve import Recorder, Valve, arguments


def build(valve: Valve, s: dict) -> newton.Model:
    """The scene: one cloth mesh, springs along its edges or none, fixed nodes inactive."""
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    membrane = s["sheet"] == "triangles"
    thickness = float(valve.thickness.mean())
    young = secant(valve, s["strain"])
    lame = young * thickness / (1 - 1 / 9)  # nu = 1/3, plane stress
    plate = float(np.median(valve.hinge_stiffness)) * s["bending"]
    for at, mass in zip(valve.start, valve.mass):
        builder.add_particle(wp.vec3(*at), wp.vec3(0.0), float(max(mass, 1e-9)),
                             radius=resting_gap(valve) / 2)
    stretch = lame * s["scale"] if membrane else 0.0
    for a, b, c in valve.triangles.tolist():
        builder.add_triangle(a, b, c, tri_ke=stretch / 2, tri_ka=stretch / 2,
                             tri_kd=s["kd"], tri_drag=0.0, tri_lift=0.0)
    for a, b, c, d in valve.hinges.tolist():
        builder.add_edge(c, d, a, b, edge_ke=plate, edge_kd=0.0)
    for i, j, stiffness, length, _ in zip(*springs(valve, membrane)):
        builder.add_spring(int(i), int(j), float(stiffness), s["kd"], 0.0)
        builder.spring_rest_length[-1] = float(length)
    if s["solver"] == "vbd":
        builder.color()
    model = builder.finalize(device="cpu")
    flags = model.particle_flags.numpy()
    flags[valve.fixed] &= ~int(newton.ParticleFlags.ACTIVE)
    model.particle_flags = wp.array(flags, device="cpu")
    model.soft_contact_ke, model.soft_contact_kd, model.soft_contact_mu = s["contact_ke"], 0.0, 0.0
    return model


def springs(valve: Valve, membrane: bool) -> tuple[np.ndarray, ...]:
    """Ends, stiffness, length and whether it is switched off when slack, of every spring."""
    low, high, kink = valve.spring_law
    ends, length = [valve.chords], [valve.chord_length]
    stiffness, slack = [valve.chord_stiffness / valve.chord_length], [np.ones(len(valve.chords))]
    if not membrane:
        k = valve.spring_volume / valve.spring_length**2
        ends += [valve.springs, valve.springs]
        stiffness += [low * k, (high - low) * k]
        length += [valve.spring_length, valve.spring_length * (1 + kink)]
        slack += [np.zeros(len(k)), np.ones(len(k))]
    ij = np.concatenate(ends)
    return (ij[:, 0], ij[:, 1], np.concatenate(stiffness), np.concatenate(length),
            np.concatenate(slack).astype(bool))


def solver_of(model: newton.Model, valve: Valve, s: dict) -> newton.solvers.SolverBase:
    """VBD with self-contact, or XPBD, which has none between triangles."""
    if s["solver"] == "xpbd":
        return newton.solvers.SolverXPBD(model, iterations=s["iterations"])
    gap = resting_gap(valve)
    return newton.solvers.SolverVBD(
        model, iterations=s["iterations"], particle_enable_self_contact=bool(s["contact"]),
        particle_self_contact_margin=gap, particle_self_contact_gap=gap / 2,
        particle_vertex_contact_buffer_size=64, particle_edge_contact_buffer_size=128,
        particle_rest_shape_contact_exclusion_radius=1.5 * float(valve.contact[0]),
        particle_enable_tile_solve=False)


def main() -> None:
    """Steps until the valve rests or the time limit is reached."""
    valve, out, s = arguments(solver="vbd", sheet="springs", strain=0.3, dt=1e-4, iterations=10,
                              scale=1.0, bending=1.0, kd=0.0, contact=1, contact_ke=1e3,
                              damping=200.0, ramp=5e-3, still=1e-3, limit=60.0)
    wp.config.quiet = True
    model = build(valve, s)
    solver, now, then = solver_of(model, valve, s), model.state(), model.state()
    control = model.control()
    drag = s["damping"] * valve.mass[:, None]
    i, j, stiffness, length, switched = springs(valve, s["sheet"] == "triangles")

    def advance(share: float) -> tuple[np.ndarray, np.ndarray]:
        nonlocal now, then
        x, v = now.particle_q.numpy().astype(float), now.particle_qd.numpy().astype(float)
        slack = switched & (np.linalg.norm(x[j] - x[i], axis=1) < length)
        model.spring_stiffness.assign(np.where(slack, 0, stiffness).astype(np.float32))
        force = pressure(valve, x, share) - drag * v
        force[valve.fixed] = 0
        now.particle_f.assign(force.astype(np.float32))
        solver.step(now, then, control, None, s["dt"])
        now, then = then, now
        return now.particle_q.numpy(), now.particle_qd.numpy()

    solver.step(now, then, control, None, 1e-9)  # compiles the kernels, which counts as set-up
    now, then = model.state(), model.state()
    recorder, verdict, step, quiet = Recorder(valve, s["limit"], 0.05), "limit", 0, 0
    while True:
        share = min(1.0, (step + 1) * s["dt"] / s["ramp"])
        x, v = advance(share)
        step += 1
        speed = float(np.linalg.norm(v[~valve.fixed], axis=1).max())
        quiet = quiet + 1 if speed < s["still"] and share == 1 else 0
        rests = quiet * s["dt"] >= 2e-3
        if not np.isfinite(x).all() or np.abs(x).max() > 1:
            verdict = "exploded"
            break
        verdict = recorder.verdict(x, speed, rests)
        if verdict:
            break
    version = f"Newton {newton.__version__}, Warp {wp.config.version}"
    recorder.save(out, verdict, step, s, version)


if __name__ == "__main__":
    main()
