"""Instruments from Python: grasping, pushing, forces, threads, undo."""

import base64
import json
import threading

import mvs
import numpy as np
import pytest


def test_a_leaflet_is_grasped_pulled_and_released(sim):
    edge = sim.snapshot().free_edge_nodes[0]
    at = sim.snapshot().node_position[edge]
    tool = sim.add_tool("grasp", at)
    held = sim.tool(tool)
    assert (held.id, held.kind, held.node) == (tool, mvs.ToolKind.GRASP, edge)
    assert held.touching and held.stiffness == 200 and held.max_force == 5
    for k in range(10):
        sim.move_tool(tool, at + [0, 0, 2e-4 * (k + 1)])
        sim.step()
    pulled = sim.snapshot()
    (seen,) = pulled.tools
    np.testing.assert_array_equal(seen.proxy, pulled.node_position[edge])
    # the formula of the spring of the hand
    np.testing.assert_allclose(seen.force, 200 * (seen.proxy - seen.position), rtol=1e-12)
    sim.remove_tool(tool)
    assert sim.snapshot().tools == ()
    with pytest.raises(mvs.IdError, match="does not exist"):
        sim.tool(tool)
    sim.restore(pulled)
    assert sim.snapshot().hash == pulled.hash


def test_a_ball_stays_out_of_the_leaflets(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    tool = sim.add_tool("ball", (0, 0, 0.03), radius=3e-3)
    for k in range(30):
        sim.move_tool(tool, (0, 0, 0.03 - 1e-3 * (k + 1)))
        sim.step()
        assert sim.tool(tool).distance > 0
    assert sim.snapshot().measures.intersections == 0


def test_a_rod_has_an_axis(sim):
    tool = sim.add_tool("rod", [0, 0, 0.05], axis=[0, 3, 4], length=0.02)
    np.testing.assert_allclose(sim.tool(tool).proxy_axis, [0, 0.6, 0.8], rtol=1e-12)
    with pytest.raises(mvs.ArgumentError, match="direction"):
        sim.move_tool(tool, [0, 0, 0.05], [0, 0, 0])


def test_a_hand_moves_while_the_simulator_works(sim):
    tool = sim.add_tool("ball", [0, 0, 0.05])
    done = threading.Event()

    def move():
        for k in range(200):
            sim.move_tool(tool, [0, 0, 0.05 - 1e-5 * k])
        done.set()

    hand = threading.Thread(target=move)
    hand.start()
    while not done.is_set():
        sim.step()
    hand.join()
    sim.step()
    assert sim.tool(tool).position[2] == 0.05 - 1e-5 * 199


def test_a_plan_does_not_change_held_tools(sim):
    edge = sim.snapshot().free_edge_nodes
    at = sim.snapshot().node_position
    with mvs.Simulator() as other:
        other.restore(sim.snapshot())
        theirs = other.add_tool("grasp", at[edge[0]])
        for k in range(20):
            other.move_tool(theirs, at[edge[0]] + [0, 0, 1e-4 * (k + 1)])
            other.step()
        plan = other.snapshot().plan()
    (run,) = [step for step in json.loads(plan)["steps"] if step["do"] == "tool_trajectory"]
    assert run["count"] == 20
    points = np.frombuffer(base64.b64decode(run["points_m"])).reshape(-1, 3)
    np.testing.assert_array_equal(points[-1], at[edge[0]] + [0, 0, 2e-3])
    mine = sim.add_tool("grasp", at[edge[8]])
    assert mine == theirs
    assert not sim.replay_plan(plan).same_result
    held, led = sim.snapshot().tools
    assert (held.id, held.node, led.node) == (mine, edge[8], edge[0])
    np.testing.assert_array_equal(held.position, at[edge[8]])
    np.testing.assert_array_equal(led.position, points[-1])


HOOK = [
    {"kind": "capsule", "position": (0, 0, 0), "end": (0, 0, 20e-3), "radius": 0.6e-3},
    {"kind": "box", "position": (2e-3, 0, 0), "size": (4e-3, 1e-3, 1e-3), "radius": 0.2e-3},
    {"kind": "cone", "position": (4e-3, 0, 0), "end": (4e-3, 0, 3e-3), "size": 0.5e-3},
]


def test_a_hook_turns_with_its_hand(sim):
    half = np.sqrt(0.5)
    tool = sim.add_tool("convex", (0, 0, 0.05), bodies=HOOK, orientation=(half, 0, 0, half))
    sim.move_tool(tool, (0, 0, 0.04), orientation=(1, 0, 0, 0.9))
    for _ in range(300):
        sim.step()
    seen = sim.tool(tool)
    assert seen.kind == mvs.ToolKind.CONVEX and seen.body_count == 3 and seen.touching is False
    wanted = np.array([1, 0, 0, 0.9]) / np.hypot(1, 0.9)
    np.testing.assert_allclose(seen.orientation, wanted, atol=1e-15)
    # the proxy is where the hand is, after 300 steps to a residual of 1e-5 N over 200 N/m
    np.testing.assert_allclose(seen.proxy_orientation, wanted, atol=1e-5)
    np.testing.assert_allclose(seen.proxy, (0, 0, 0.04), atol=1e-6)


def test_the_bodies_of_a_hook_are_read_back(sim):
    sim.add_tool("grasp", sim.snapshot().node_position[sim.snapshot().free_edge_nodes[0]])
    sim.add_tool("convex", (0, 0, 0.05), bodies=HOOK)
    snapshot = sim.snapshot()
    assert snapshot.tool_bodies(0) == ()
    shaft, bar, tip = snapshot.tool_bodies(1)
    assert (shaft.kind, shaft.radius, len(shaft.triangles)) == (mvs.BodyKind.CAPSULE, 0.6e-3, 0)
    np.testing.assert_allclose(shaft.vertices, [(0, 0, 0), (0, 0, 20e-3)])
    assert bar.vertices.shape == (8, 3) and bar.triangles.shape == (12, 3)
    # a regular polygon of 24 corners: volume of the pyramid on it
    corners = tip.vertices[tip.triangles]
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    area = 24 / 2 * np.sin(2 * np.pi / 24) * 0.5e-3**2
    np.testing.assert_allclose(volume, area * 3e-3 / 3, rtol=1e-12)


def test_wrong_bodies_are_refused(sim):
    def refused(match, *bodies, **more):
        with pytest.raises(mvs.ArgumentError, match=match):
            sim.add_tool("convex", (0, 0, 0.05), bodies=bodies, **more)

    before = sim.snapshot().hash
    refused("1 to 16 bodies")
    refused("needed, not \"torus\"", {"kind": "torus"})
    refused("has no \"colour\"", {"kind": "ball", "colour": 1})
    refused("n x 3", {"kind": "hull", "vertices": [1.0, 2.0]})
    refused("no volume", {"kind": "hull", "vertices": 1e-3 * np.eye(3)[[0, 1, 2, 0]]})
    dented = np.vstack([np.zeros(3), 1e-3 * np.eye(3), np.full(3, 2e-4)])
    refused("not convex: 1 of its 5", {"kind": "hull", "vertices": dented}, strict_hulls=True)
    with pytest.raises(mvs.ArgumentError, match="one of them"):
        sim.move_tool(0, (0, 0, 0), (0, 0, 1), orientation=(1, 0, 0, 0))
    assert sim.snapshot().hash == before


def test_wrong_words_are_refused(sim):
    with pytest.raises(mvs.ArgumentError, match="grasp"):
        sim.add_tool("knife", (0, 0, 0))
    with pytest.raises(mvs.ArgumentError, match="no free vertex"):
        sim.add_tool("grasp", (0, 0, 1))
    with pytest.raises(mvs.ArgumentError, match="desc.position lies 10 m from the middle of a valve"):
        sim.add_tool("ball", (0, 0, 10))  # mm
    with pytest.raises(mvs.StateError, match="leaflet tissue"):
        sim.add_tool("ball", sim.snapshot().node_position[sim.snapshot().free_edge_nodes[0]])
