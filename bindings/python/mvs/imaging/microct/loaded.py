"""The loaded volume: its place, and the motion of annulus and heads."""

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
from ..pipeline import Pipeline, Run
from .chords import ChordNetwork
from .muscles import head_shifts

Points = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Loaded:
    """The loaded valve in the frame of the open image.

    tips: heads that were given or found; heads: loaded places of the heads of the open image, None: those
    in `tips` are not the same ones
    """

    surface: Sheet
    network: ChordNetwork
    tips: Points
    motion: Motion
    heads: Optional[Points]
    findings: list[mvs.Finding]


def loaded_of(volume: Any, fixed: Any, landmarks: Mapping[str, Any], own: Mapping[str, Any],
              register: Optional[str], pipeline: Pipeline, console: Console, opened: Run) -> Loaded:
    """Segments the loaded volume and moves it to the frame of the open one.

    opened: the stages of the open image. Unless tips are given, its heads are looked for in the loaded
    image, so that the chordae of both begin at the same ones.
    """
    from ..requests import motion_between

    how = register or "image"
    if how == "image":
        console.stage("registration of the loaded image")
        motion, found = motion_of_images(volume, fixed)
    else:
        motion, found = motion_between(how, dict(landmarks), dict(own))
    run = pipeline.run({"image": volume, "tips": own.get("papillary_tips"), "loaded": True},
                       progress=lambda stage: console.stage(f"loaded image: {stage}"))
    sheet: Sheet = run["sheet"]
    places: Optional[Points] = None
    mine: ChordNetwork = opened["chords"]
    if own.get("papillary_tips") is None and mine.heads:
        heads = mine.nodes[:mine.heads]
        places = heads + head_shifts(heads, opened.results, run.results, motion)
        known = {name: result for name, result in run.results.items() if name != "chords"}
        run = pipeline.run({**known, "tips": (places - motion.shift) @ motion.turn})
    network: ChordNetwork = run["chords"]
    moved = dataclasses.replace(
        network, nodes=motion(network.nodes) if len(network.nodes) else network.nodes,
        lines=tuple(motion(line) for line in network.lines))
    surface = Sheet(motion(sheet.points), sheet.triangles, sheet.values)
    return Loaded(surface, moved, moved.nodes[:moved.heads], motion, places, [found, finding(
        "closed_surface", mvs.FindingSource.MEASURED, 0.5,
        f"loaded image: chordae: {network}; where leaflets touch, the surface is the middle of both")])


def with_loaded_boundary(valve: mvs.Valve, network: ChordNetwork, loaded: Loaded) -> list[mvs.Finding]:
    """Sets the loaded positions of heads and annulus of a valve to those in the loaded image."""
    nodes = np.array(valve.nodes)
    found = []
    if loaded.heads is not None:
        moved = np.linalg.norm(loaded.heads - network.nodes[:network.heads], axis=1)
        nodes[np.asarray(valve.head_nodes, np.int64)] = loaded.heads
        found.append(finding(
            "head_motion", mvs.FindingSource.MEASURED, 0.8,
            f"the tips of the papillary muscles move by {1e3 * moved.min():.1f} to {1e3 * moved.max():.1f} "
            "mm to their places in the loaded image"))
    elif len(loaded.tips):
        found.append(_with_nearest_tips(nodes, valve, network, loaded.tips))
    annulus = np.asarray(valve.annulus, np.int64)
    rims = [loaded.surface.points[loop] for loop in boundary_loops(loaded.surface.triangles)
            if loop_length(loaded.surface.points, loop) > RIM]
    if rims:
        step = _onto_rims(nodes[annulus], rims)
        nodes[annulus] += step
        size = np.linalg.norm(step, axis=1)
        found.append(finding(
            "annulus_motion", mvs.FindingSource.MEASURED, 0.6,
            f"the annulus moves by {1e3 * size.mean():.1f} mm, at most {1e3 * size.max():.1f} mm, to the "
            "rims in the loaded image, across its own line only"))
    valve.nodes_loaded = nodes
    return found


def _with_nearest_tips(nodes: Points, valve: mvs.Valve, network: ChordNetwork,
                       tips: Points) -> mvs.Finding:
    """Moves each head to the tip of the loaded image that is its own, at most 10 mm away."""
    away = np.linalg.norm(network.nodes[:network.heads, None] - tips[None], axis=2)
    rows, columns = need("scipy.optimize").linear_sum_assignment(away)
    near = away[rows, columns] < 10e-3
    nodes[np.asarray(valve.head_nodes, np.int64)[rows[near]]] = tips[columns[near]]
    return finding(
        "head_motion", mvs.FindingSource.MEASURED, 0.7,
        f"{int(near.sum())} of {network.heads} papillary heads moved by "
        f"{1e3 * np.median(away[rows, columns][near]) if near.any() else 0:.1f} mm (median) to "
        "their places in the loaded image")


RIM = 20e-3
"""m: shorter boundaries are holes. Where leaflets touch they are one sheet: annulus and free edge are then parts of one
or several boundaries, of which no one is the annulus."""
FARTHEST, USUAL = 6e-3, 1e-3
"""m: a point of the annulus moves at most so far to a rim, and a millimetre beside the affine motion of the whole, or
2.5 times as far as the median: others are where the loaded image lacks a part of a leaflet, or at a free edge"""
ROUNDS = 20
LONGEST_GAP = 0.35
"""Share of the annulus over which the affine motion of the rest may stand in; nothing moves where a wider part is not seen"""


def _onto_rims(points: Points, rims: list[Points]) -> Points:
    """Steps (n, 3) from a loop of points to their nearest points on curves, averaged along the loop.

    Where no curve belongs to them, the affine motion of the others.
    """
    dense = np.vstack([rim + share * (np.roll(rim, -1, 0) - rim) for rim in rims for share in (0, 0.25, 0.5, 0.75)])
    away, nearest = need("scipy.spatial").cKDTree(dense).query(points)
    step = dense[nearest] - points
    # the constant is about as large as the coordinates
    terms = np.column_stack([points - points.mean(axis=0), np.full(len(points), 1e-2)])
    used, whole = away < FARTHEST, np.zeros_like(step)
    for _ in range(ROUNDS):
        if not used.any() or _longest_gap(used) > LONGEST_GAP:
            return np.zeros_like(step)
        whole = terms @ np.linalg.lstsq(terms[used], step[used], rcond=None)[0]
        beside = np.linalg.norm(step - whole, axis=1)
        before, used = used, (away < FARTHEST) & (beside < max(USUAL, 2.5 * float(np.median(beside[used]))))
        if (used == before).all():
            break
    step = np.where(used[:, None], step, whole)
    return np.asarray(need("scipy.ndimage").gaussian_filter1d(step, 2, axis=0, mode="wrap"))


def _longest_gap(used: NDArray[np.bool_]) -> float:
    """The longest run of points of a loop that are not used, as a share of all."""
    places = np.flatnonzero(used)
    return float(np.diff(np.append(places, places[0] + len(used))).max() - 1) / len(used)


Closure = tuple[mvs.Snapshot, mvs.Snapshot, mvs.Stats]
"""A valve open, closed under 120 mmHg, and how it came to rest"""


def settled(valve: mvs.Valve, console: Console) -> Closure:
    """The valve open, and closed under 120 mmHg; a closure ends after 1,000 iterations, at rest or not."""
    with mvs.Simulator() as sim:
        sim.set_valve(valve)
        opened = sim.snapshot()
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle(progress=lambda done, _: console.share(done))
        return opened, sim.snapshot(), stats
