"""Draws hook.png: a hook and a thin plate take a chord of a closed valve along; their sessions replay to the same hash.

Run: PYTHONPATH=build/release/python python3 examples/pictures/hook.py [FOLDER]

The instrument (a hook of three capsules; a spatula of 5 x 3 x 0.6 mm) is brought to the middle of the chord where
it has most room, drawn back by 5 or 3 mm in 250 steps of 1 ms, and let rest. Its session (hook.h5, plate.h5) and plan
(hook.json, plate.json) go to FOLDER, by default a temporary one. The session is loaded, and the plan is replayed on
a new valve: both have to end at the same hash. For comparison a ball of the hook's radius, and of half the
thickness of the plate, goes the same way: chordae do not touch it.
"""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import mvs
import numpy as np
import pyvista as pv

@dataclass(frozen=True)
class Instrument:
    """Bodies in the frame of the hand, which is drawn along z; `inside` is the place of the chord there."""

    name: str
    bodies: list
    inside: np.ndarray
    radius: float  # m, of the ball to compare with
    way: float  # m, that it is drawn back
    side: int = 1  # -1: seen from the other side of the chord


RADIUS = 0.35e-3
HEEL, TOE, TIP, SHAFT = (0, 0, 0), (3e-3, 0, 0), (3e-3, 0, 2e-3), (0, 0, 15e-3)
HOOK = Instrument("hook", [{"kind": "capsule", "position": a, "end": b, "radius": RADIUS}
                           for a, b in ((HEEL, SHAFT), (HEEL, TOE), (TOE, TIP))],
                  np.array([1.5e-3, 0, 1.2e-3]), RADIUS, 5e-3)
PLATE = Instrument("plate", [{"kind": "box", "size": (5e-3, 3e-3, 0.4e-3), "radius": 0.1e-3}],
                   np.array([0, 0, 1e-3]), 0.3e-3, 3e-3, -1)
STEPS = 250


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


def poses(snapshot, inside):
    """Chordae with positions and orientations of an instrument around their middle."""
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
                yield chord, (a + b) / 2 - axes @ inside, quaternion(axes)


def roomiest(sim, instrument):
    """The pose with the largest distance from tissue."""
    best = (0.0,)
    for chord, position, turn in poses(sim.snapshot(), instrument.inside):
        try:
            tool = sim.add_tool("convex", position, bodies=instrument.bodies, orientation=turn)
        except mvs.StateError:
            continue
        room = sim.tool(tool).distance
        sim.remove_tool(tool)
        if room > best[0]:
            best = (room, chord, position, turn)
    return best[1:]


def pull(sim, position, turn, way, **tool):
    hand = sim.add_tool(position=position, **tool)
    up = rotation(turn)[:, 2]
    for k in range(STEPS):
        sim.move_tool(hand, position + way * (k + 1) / STEPS * up)
        sim.step()
    sim.settle()
    return hand


def capsule(a, b, radius):
    """Surfaces of a capsule."""
    return (pv.Tube(pointa=a, pointb=b, radius=radius, n_sides=20), pv.Sphere(radius=radius, center=a),
            pv.Sphere(radius=radius, center=b))


def surfaces(body, points):
    """Surfaces of a body whose vertices are at these points: a capsule, or a hull with round edges."""
    if len(points) == 2:
        return capsule(*points, body.radius)
    hull = pv.PolyData.from_regular_faces(points, body.triangles)
    edges = hull.extract_feature_edges(feature_angle=1).tube(radius=body.radius, n_sides=20)
    return hull, edges, *(pv.Sphere(radius=body.radius, center=p) for p in points)


def draw(snapshot, chord, focus, up, side):
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
            for part in surfaces(body, body.vertices @ turn.T + tool.proxy):
                plotter.add_mesh(part, color="#7c8794")
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    away = side * 0.025 * np.cross(up, along) + 0.03 * along + 0.01 * up
    plotter.camera_position = [focus + away, focus, up]
    return plotter.screenshot(return_img=True)


def must_be_the_same(snapshot, path):
    """The session file holds the bits of the snapshot, and its plan makes them on a new valve."""
    with mvs.Simulator() as sim:
        sim.load(path)
        if sim.snapshot().hash != snapshot.hash:
            raise SystemExit(f"{path} holds another hash")
    with closed() as sim:
        replayed = sim.replay_plan(path.with_suffix(".json").read_text())
        if not replayed.same_result or sim.snapshot().hash != snapshot.hash:
            raise SystemExit(f"the replayed plan of {path} ends at another hash")


def show(instrument, folder):
    """Three pictures with titles: the instrument at its chord, drawn back, and a ball on the same way."""
    name = instrument.name
    with closed() as sim:
        before = sim.snapshot()
        chord, position, turn = roomiest(sim, instrument)
        sim.restore(before)
        up, start = rotation(turn)[:, 2], middle(before, chord)
        sim.add_tool("convex", position, bodies=instrument.bodies, orientation=turn)
        first = sim.snapshot()
        sim.restore(before)
        pull(sim, position, turn, instrument.way, kind="convex", bodies=instrument.bodies, orientation=turn)
        taken = sim.snapshot()
    taken.save(folder / f"{name}.h5")
    (folder / f"{name}.json").write_text(taken.plan())
    must_be_the_same(taken, folder / f"{name}.h5")
    with closed() as sim:
        pull(sim, position, turn, instrument.way, kind="ball", radius=instrument.radius)
        missed = sim.snapshot()
    ways = [round(1e3 * (middle(s, chord) - start) @ up, 4) + 0.0 for s in (first, taken, missed)]
    chordae = [part.name for part in before.parts if part.kind == mvs.PartKind.CHORD]
    print(f"{name}: chord {chordae[chord]}: {ways[1]:.2f} mm, {ways[2]:.4f} mm with a ball of "
          f"{1e3 * instrument.radius:.2f} mm")
    print(f"{name}: force on the hand {np.linalg.norm(taken.tools[-1].force):.3f} N; replayed to {taken.hash}")
    titles = (f"{name} at the chord", f"drawn back: {ways[1]:.1f} mm", f"a ball: {ways[2]:.1f} mm")
    return [(title, draw(snapshot, chord, start, up, instrument.side))
            for title, snapshot in zip(titles, (first, taken, missed))]


def main(folder):
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 7.4), dpi=100)
    for row, instrument in zip(axes, (HOOK, PLATE)):
        for ax, (title, picture) in zip(row, show(instrument, folder)):
            ax.imshow(picture)
            ax.set_title(title, fontsize=10)
            ax.axis("off")
    figure.tight_layout()
    figure.savefig(Path(__file__).with_name("hook.png"))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(temporary))
