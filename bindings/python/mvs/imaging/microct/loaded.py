"""The loaded volume: its place, the motion of annulus and heads, and the lengths of chordae in it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

import mvs
from ..console import Console
from ..findings import finding
from ..loaded import Motion, motion_of_images
from ..mesh import Sheet, boundary_loops, loop_length
from ..needs import need
from ..pipeline import Pipeline
from .chords import ChordNetwork

Points = NDArray[np.float64]
SAME_CHORD = 4e-3
"""m: an insertion in the loaded image this near to a simulated one may be the same"""


@dataclasses.dataclass(frozen=True, eq=False)
class Loaded:
    """The loaded valve in the frame of the open image."""

    surface: Sheet
    network: ChordNetwork
    tips: Points
    motion: Motion
    findings: list[mvs.Finding]


def loaded_of(volume: Any, fixed: Any, landmarks: Mapping[str, Any], own: Mapping[str, Any],
              register: Optional[str], pipeline: Pipeline, console: Console) -> Loaded:
    """Segments the loaded volume and moves it to the frame of the open one."""
    from ..requests import motion_between

    how = register or "image"
    if how == "image":
        console.stage("registration of the loaded image")
        motion, found = motion_of_images(volume, fixed)
    else:
        motion, found = motion_between(how, dict(landmarks), dict(own))
    run = pipeline.run({"image": volume, "tips": own.get("papillary_tips")},
                       progress=lambda stage: console.stage(f"loaded image: {stage}"))
    sheet: Sheet = run["sheet"]
    network: ChordNetwork = run["chords"]
    moved = dataclasses.replace(
        network, nodes=motion(network.nodes) if len(network.nodes) else network.nodes,
        lines=tuple(motion(line) for line in network.lines))
    surface = Sheet(motion(sheet.points), sheet.triangles, sheet.values)
    return Loaded(surface, moved, moved.nodes[:moved.heads], motion, [found, finding(
        "closed_surface", mvs.FindingSource.MEASURED, 0.5,
        f"loaded image: chordae: {network}; where leaflets touch, the surface is the middle of both")])


def with_loaded_boundary(valve: mvs.Valve, network: ChordNetwork, loaded: Loaded) -> list[mvs.Finding]:
    """Sets the loaded positions of heads and annulus of a valve to those in the loaded image."""
    nodes = np.array(valve.nodes)
    found = []
    if len(loaded.tips):
        away = np.linalg.norm(network.nodes[:network.heads, None] - loaded.tips[None], axis=2)
        rows, columns = need("scipy.optimize").linear_sum_assignment(away)
        near = away[rows, columns] < 10e-3
        heads = np.asarray(valve.head_nodes, np.int64)[rows[near]]
        nodes[heads] = loaded.tips[columns[near]]
        found.append(finding(
            "head_motion", mvs.FindingSource.MEASURED, 0.7,
            f"{int(near.sum())} of {network.heads} papillary heads moved by "
            f"{1e3 * np.median(away[rows, columns][near]) if near.any() else 0:.1f} mm (median) to "
            "their places in the loaded image"))
    annulus = np.asarray(valve.annulus, np.int64)
    loops = boundary_loops(loaded.surface.triangles)
    if loops:
        loop = max(loops, key=lambda one: loop_length(loaded.surface.points, one))
        step = _onto_curve(nodes[annulus], loaded.surface.points[loop])
        nodes[annulus] += step
        size = np.linalg.norm(step, axis=1)
        found.append(finding(
            "annulus_motion", mvs.FindingSource.MEASURED, 0.6,
            f"the annulus moves by {1e3 * size.mean():.1f} mm, at most {1e3 * size.max():.1f} mm, to the "
            "rim in the loaded image, across its own line only"))
    valve.nodes_loaded = nodes
    return found


def _onto_curve(points: Points, curve: Points) -> Points:
    """Steps (n, 3) from a loop of points to their nearest points on a curve, averaged along the loop."""
    dense = np.vstack([curve + share * (np.roll(curve, -1, 0) - curve) for share in (0, 0.25, 0.5, 0.75)])
    away, nearest = need("scipy.spatial").cKDTree(dense).query(points)
    step = np.where((away < 6e-3)[:, None], dense[nearest] - points, 0)
    return np.asarray(need("scipy.ndimage").gaussian_filter1d(step, 2, axis=0, mode="wrap"))


def with_loaded_lengths(valve: mvs.Valve, closed: mvs.Snapshot, network: ChordNetwork,
                        loaded: Loaded) -> tuple[mvs.Snapshot, mvs.Snapshot, mvs.Stats, mvs.Finding]:
    """Rest lengths with which the simulated chordae are as long as those in the loaded image.

    Fixed-point iteration on the closed valve: the stretch that the law of the chords has under their
    simulated tension stays between rest and loaded length. Chords that are found in one image only keep
    the length of the open image.
    """
    rest = np.array(valve.chord_rest_length)
    open_rest = rest.copy()
    matched = _matched(closed, network, loaded, valve)
    stats = None
    opened = closed
    for _ in range(2):
        lengths = _lengths(closed, valve)
        for k, target in matched.items():
            # at most a quarter shorter or longer than in the open image: beyond, another chord was seen
            rest[k] = np.clip(rest[k] + target - lengths[k], 0.75 * open_rest[k], 1.25 * open_rest[k])
        valve.chord_rest_length = rest.copy()
        opened, closed, stats = settled(valve)
    assert stats is not None
    change = rest / open_rest - 1
    return opened, closed, stats, finding(
        "loaded_chordae", mvs.FindingSource.MEASURED, 0.6 if matched else 0.2,
        _sentence_of(change[list(matched)], len(rest)), change, "")


def _sentence_of(change: Points, segments: int) -> str:
    if not len(change):
        return ("no chord of the open image was found in the loaded one: all keep the length that they have "
                "in the open image, and nothing shows whether they are as long under load")
    return (f"{len(change)} of {segments} segments were found in the loaded image, too; their rest lengths "
            f"changed by {100 * np.median(change):.1f} % in the median, so that they are as long under load "
            "as there")


def settled(valve: mvs.Valve) -> tuple[mvs.Snapshot, mvs.Snapshot, mvs.Stats]:
    """The valve open, and closed under 120 mmHg."""
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        opened = sim.snapshot()
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle()
        return opened, sim.snapshot(), stats


def _lengths(closed: mvs.Snapshot, valve: mvs.Valve) -> Points:
    points = np.asarray(closed.node_position)
    ends = np.asarray(valve.chord_nodes, np.int64)
    return np.asarray(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1))


def _matched(closed: mvs.Snapshot, network: ChordNetwork, loaded: Loaded,
             valve: mvs.Valve) -> dict[int, float]:
    """The loaded length of segments from a head straight to a leaflet that both images have."""
    other = loaded.network
    mine = _direct(network)
    theirs = _direct(other)
    if not len(mine) or not len(theirs):
        return {}
    points = np.asarray(closed.node_position)
    ends = np.asarray(valve.chord_nodes, np.int64)[mine]
    their_ends = other.segments[theirs]
    away = np.linalg.norm(points[ends[:, 1]][:, None] - other.nodes[their_ends[:, 1]][None], axis=2)
    heads = np.linalg.norm(points[ends[:, 0]][:, None] - other.nodes[their_ends[:, 0]][None], axis=2)
    cost = np.where((away < SAME_CHORD) & (heads < 4e-3), away, 1.0)
    rows, columns = need("scipy.optimize").linear_sum_assignment(cost)
    # from the simulated head and insertion, so that only the length and no shift is taken over
    return {int(mine[r]): float(other.length[theirs[c]]) for r, c in zip(rows, columns)
            if cost[r, c] < 1.0}


def _direct(network: ChordNetwork) -> NDArray[np.int64]:
    if not len(network.segments):
        return np.zeros(0, np.int64)
    first = network.heads + network.branches
    return np.flatnonzero((network.segments[:, 0] < network.heads) & (network.segments[:, 1] >= first))
