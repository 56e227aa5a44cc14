"""MuJoCo: nodes as bodies on three slides, the sheet as a flex of dimension 2, implicit steps.

sheet=tendons: every edge two spatial tendons, one linear and one with a dead band up to the kink:
the bilinear law exactly; the flex bends and collides. sheet=flex: the flex's own elasticity, which
is linear. Chordae are spatial tendons with a dead band, which is tension-only exactly; the pressure
follows the surface through qfrc_applied. contact=ipc is MuJoCo's own intersection-free mode.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from loads import pressure, resting_gap, secant
from valve import Recorder, Valve, arguments


def text(values: Any) -> str:
    """Formats numbers for XML."""
    return " ".join(f"{v:.12g}" if isinstance(v, float) else str(v)
                    for v in np.asarray(values).ravel().tolist())


def bodies(valve: Valve) -> str:
    """A body for each node; the fixed ones have no joints."""
    slides = "".join(f'<joint type="slide" axis="{axis}"/>'
                     for axis in ("1 0 0", "0 1 0", "0 0 1"))
    lines = []
    for i, at in enumerate(valve.start):
        free = "" if valve.fixed[i] else slides
        mass = max(float(valve.mass[i]), 1e-9)
        inertia = f'<inertial pos="0 0 0" mass="{mass:.9g}" diaginertia="1e-9 1e-9 1e-9"/>'
        lines.append(f'<body name="n{i}" pos="{text(at)}">{inertia}{free}'
                     f'<site name="s{i}" size="1e-4"/></body>')
    return "\n".join(lines)


def tendon(ends: np.ndarray, stiffness: float, low: float, high: float) -> str:
    """A spring between two nodes with zero force from `low` to `high`."""
    return (f'<spatial stiffness="{stiffness:.9g}" springlength="{low:.9g} {high:.9g}">'
            f'<site site="s{ends[0]}"/><site site="s{ends[1]}"/></spatial>')


def tendons(valve: Valve, sheet: str) -> str:
    """Chordae, and the edges where they carry the sheet."""
    lines = [tendon(e, float(k / L), 0.0, float(L)) for e, k, L in
             zip(valve.chords, valve.chord_stiffness, valve.chord_length)]
    low, high, kink = valve.spring_law
    if sheet == "tendons":
        for e, v, length in zip(valve.springs, valve.spring_volume, valve.spring_length):
            k = float(v / length**2)
            lines.append(tendon(e, low * k, float(length), float(length)))
            lines.append(tendon(e, (high - low) * k, 0.0, float(length * (1 + kink))))
    return "\n".join(lines)


def model(valve: Valve, s: dict[str, Any]) -> str:
    """The scene in MuJoCo's own format."""
    ipc = '<flag ipc="enable"/>' if s["contact"] == "ipc" else ""
    collide = "none" if s["contact"] == "none" else "auto"
    low = float(valve.spring_law[0])
    young, what = (low, "bend") if s["sheet"] == "tendons" else (s["young"] or secant(valve, 0.3),
                                                                 "both")
    used = np.unique(valve.triangles)
    place = np.full(len(valve.nodes), -1)
    place[used] = np.arange(len(used))
    thickness = float(valve.thickness.mean())
    return f"""<mujoco><size memory="512M"/>
<option gravity="0 0 0" timestep="{s['dt']}" integrator="{s['integrator']}" solver="Newton"
 iterations="{s['iterations']}" tolerance="1e-8">{ipc}</option>
<worldbody>{bodies(valve)}</worldbody>
<deformable><flex name="sheet" dim="2" radius="{resting_gap(valve) / 2:.9g}"
 body="{' '.join(f'n{i}' for i in used)}" element="{text(place[valve.triangles])}">
<contact selfcollide="{collide}" solref="{s['solref']} 1" margin="{s['margin']}"
 condim="1"/>
<elasticity young="{young:.9g}" poisson="{s['poisson']}" thickness="{thickness:.9g}"
 damping="{s['elastic_damping']}" elastic2d="{what}"/></flex></deformable>
<tendon>{tendons(valve, s['sheet'])}</tendon></mujoco>"""


def main() -> None:
    """Steps until the valve rests or the time limit is reached."""
    valve, out, s = arguments(sheet="tendons", contact="auto", integrator="discrete", dt=2e-4,
                              damping=200.0, ramp=5e-3, iterations=50, solref=1e-3, margin=0.0,
                              young=0.0, poisson=0.33, elastic_damping=0.0, still=1e-3, limit=60.0)
    scene = mujoco.MjModel.from_xml_string(model(valve, s))
    data = mujoco.MjData(scene)
    free = np.flatnonzero(~valve.fixed)
    drag = s["damping"] * np.repeat(valve.mass[free], 3)
    mujoco.mj_forward(scene, data)
    recorder, verdict, step, quiet = Recorder(valve, s["limit"], 0.05), "limit", 0, 0
    x = valve.start.copy()
    while True:
        share = min(1.0, (step + 1) * s["dt"] / s["ramp"])
        data.qfrc_applied[:] = pressure(valve, x, share)[free].ravel() - drag * data.qvel
        mujoco.mj_step(scene, data)
        x[free] = valve.start[free] + data.qpos.reshape(-1, 3)
        step += 1
        speed = np.linalg.norm(data.qvel.reshape(-1, 3), axis=1).max()
        quiet = quiet + 1 if speed < s["still"] and share == 1 else 0
        rests = quiet * s["dt"] >= 2e-3
        if not np.isfinite(x).all() or data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            verdict = "exploded"
            break
        verdict = recorder.verdict(x, speed, rests)
        if verdict:
            verdict = "exploded" if verdict == "limit" and np.abs(x).max() >= 1 else verdict
            break
    recorder.save(out, verdict, step, s, f"MuJoCo {mujoco.__version__}")


if __name__ == "__main__":
    main()
