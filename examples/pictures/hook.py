"""Draws hook.png: a nerve hook takes a chord of a closed valve along; its session replays to the same hash.

Run: PYTHONPATH=build/release/python python3 examples/pictures/hook.py [FOLDER]

The hook (three capsules) is brought to the middle of the chord where it has most room, drawn back by 5 mm
in 250 steps of 1 ms, and let rest. The session (hook.h5) and its plan (hook.json) go to FOLDER, by default a
temporary one. The plan is replayed on a new valve and has to end at the same hash. For comparison a ball of
the hook's radius goes the same way: chordae do not touch it.
"""

import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import mvs
import numpy as np
import pyvista as pv

RADIUS = 0.35e-3
HEEL, TOE, TIP, SHAFT = (0, 0, 0), (3e-3, 0, 0), (3e-3, 0, 2e-3), (0, 0, 15e-3)
HOOK = [{"kind": "capsule", "position": a, "end": b, "radius": RADIUS}
        for a, b in ((HEEL, SHAFT), (HEEL, TOE), (TOE, TIP))]
INSIDE = np.array([1.5e-3, 0, 1.2e-3])  # place of the chord in the frame of the hook
WAY, STEPS = 5e-3, 250


def quaternion(axes):
    """w x y z of the rotation with these columns, whose trace is above -1."""
    w = np.sqrt(max(1e-12, 1 + np.trace(axes))) / 2
    v = np.array([axes[2, 1] - axes[1, 2], axes[0, 2] - axes[2, 0], axes[1, 0] - axes[0, 1]]) / (4 * w)
    return np.array([w, *v])


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def closed():
    sim = mvs.Simulator()
    sim.generate(vertices=425)
    sim.set_load(mvs.SYSTOLE_PA)
    sim.settle()
    return sim


def middle(snapshot, chord):
    return snapshot.node_position[snapshot.chord_nodes[chord]].mean(axis=0)


def poses(snapshot):
    """Chordae with positions and orientations of a hook around their middle."""
    for chord, (a, b) in enumerate(snapshot.node_position[snapshot.chord_nodes]):
        if np.linalg.norm(b - a) < 6e-3:
            continue
        along = (b - a) / np.linalg.norm(b - a)
        side = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
        side /= np.linalg.norm(side)
        for angle in np.arange(0, 2 * np.pi, np.pi / 12):
            up = np.cos(angle) * side + np.sin(angle) * np.cross(along, side)
            axes = np.column_stack([np.cross(along, up), along, up])
            if np.trace(axes) > -0.9:
                yield chord, (a + b) / 2 - axes @ INSIDE, quaternion(axes)


def roomiest(sim):
    """The pose with the largest distance from tissue."""
    best = (0.0,)
    for chord, position, turn in poses(sim.snapshot()):
        try:
            tool = sim.add_tool("convex", position, bodies=HOOK, orientation=turn)
        except mvs.StateError:
            continue
        room = sim.tool(tool).distance
        sim.remove_tool(tool)
        if room > best[0]:
            best = (room, chord, position, turn)
    return best[1:]


def pull(sim, position, turn, **tool):
    hand = sim.add_tool(position=position, **tool)
    up = rotation(turn)[:, 2]
    for k in range(STEPS):
        sim.move_tool(hand, position + WAY * (k + 1) / STEPS * up)
        sim.step()
    sim.settle()
    return hand


def capsule(a, b, radius):
    """Surfaces of a capsule."""
    return (pv.Tube(pointa=a, pointb=b, radius=radius, n_sides=20), pv.Sphere(radius=radius, center=a),
            pv.Sphere(radius=radius, center=b))


def draw(snapshot, chord, focus, up):
    plotter = pv.Plotter(off_screen=True, window_size=(520, 520))
    blocks = snapshot.to_pyvista()
    plotter.add_mesh(blocks["leaflets"], color="#e8a898", opacity=0.55, smooth_shading=True)
    plotter.add_mesh(blocks["chords"], color="#c8bf9c", line_width=2)
    ends = snapshot.node_position[snapshot.chord_nodes[chord]]
    plotter.add_mesh(pv.Tube(pointa=ends[0], pointb=ends[1], radius=0.5e-3), color="#0095d9")
    for index, tool in enumerate(snapshot.tools):
        if tool.kind == mvs.ToolKind.BALL:
            plotter.add_mesh(pv.Sphere(radius=tool.radius, center=tool.proxy), color="#7c8794")
        turn = rotation(tool.proxy_orientation)
        for body in snapshot.tool_bodies(index):
            a, b = body.vertices @ turn.T + tool.proxy
            for part in capsule(a, b, body.radius):
                plotter.add_mesh(part, color="#7c8794", smooth_shading=True)
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    away = 0.025 * np.cross(up, along) + 0.03 * along + 0.01 * up
    plotter.camera_position = [focus + away, focus, up]
    return plotter.screenshot(return_img=True)


def main(folder):
    with closed() as sim:
        before = sim.snapshot()
        chord, position, turn = roomiest(sim)
        sim.restore(before)
        up, start = rotation(turn)[:, 2], middle(before, chord)
        hand = sim.add_tool("convex", position, bodies=HOOK, orientation=turn)
        first = sim.snapshot()
        sim.remove_tool(hand)
        sim.restore(before)
        pull(sim, position, turn, kind="convex", bodies=HOOK, orientation=turn)
        hooked = sim.snapshot()
        hooked.save(folder / "hook.h5")
        (folder / "hook.json").write_text(hooked.plan())
    with closed() as sim:
        if not sim.replay_plan((folder / "hook.json").read_text()).same_result:
            raise SystemExit("the replayed plan ends at another hash")
        assert sim.snapshot().hash == hooked.hash
    with closed() as sim:
        pull(sim, position, turn, kind="ball", radius=RADIUS)
        missed = sim.snapshot()
    ways = [1e3 * (middle(s, chord) - start) @ up for s in (first, hooked, missed)]
    name = before.chord_name[chord] if hasattr(before, "chord_name") else str(chord)
    print(f"chord {name}: {ways[1]:.2f} mm with the hook, {ways[2]:.4f} mm with a ball of its radius")
    print(f"force on the hand {np.linalg.norm(hooked.tools[-1].force):.3f} N; replayed to {hooked.hash}")
    titles = ("hook at the chord", f"drawn back: {ways[1]:.1f} mm", f"a ball: {ways[2]:.1f} mm")
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.8), dpi=100)
    for ax, title, snapshot in zip(axes, titles, (first, hooked, missed)):
        ax.imshow(draw(snapshot, chord, start, up))
        ax.set_title(title, fontsize=10)
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(Path(__file__).with_name("hook.png"))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(temporary))
