"""Distances of a recovered valve from the true one: thickness, chordae, closed shape, interval of the leak."""

from __future__ import annotations

import dataclasses
from typing import Any

import mvs
import numpy as np

MM = 1e3


def closed_with_default_law(truth: Any) -> float:
    """RMS in m between the true closed valve and itself closed with the tissue of a recovered valve.

    The part of the closed RMS that no recovery can avoid, as images do not show the tissue law.
    """
    valve = mvs.valve_of(truth.opened)
    valve.leaflets = [
        dataclasses.replace(leaf, law=mvs.LeafletLaw.BILINEAR, constants=()) for leaf in valve.leaflets
    ]
    with mvs.Simulator(log=lambda *_: None) as sim:
        sim.set_valve(valve)
        sim.set_load(truth.closed.load_case.pressure)
        sim.settle()
        return sim.snapshot().compare(truth.closed).surface_rms


def thickness_error(found: mvs.Snapshot, truth: mvs.Snapshot) -> float:
    """The median over the recovered triangles of |t - t_true| / t_true, at the nearest true triangle."""
    from scipy.spatial import cKDTree

    nearest = cKDTree(_centres(truth)).query(_centres(found))[1]
    true = np.asarray(truth.triangle_thickness)[nearest]
    return float(np.median(np.abs(np.asarray(found.triangle_thickness) - true) / true))


def _centres(valve: mvs.Snapshot) -> np.ndarray:
    return np.asarray(valve.node_position)[np.asarray(valve.triangle_nodes)].mean(axis=1)


def chord_errors(found: mvs.Snapshot, truth: mvs.Snapshot, near: float) -> tuple[float, float]:
    """Share of true chordae with both ends right, and the median length error of these, in percent.

    A chord is the way from a papillary head to a leaflet. Chordae are paired one to one so that the
    sum of the distances of their ends is least.
    """
    from scipy.optimize import linear_sum_assignment

    (ends, heads, lengths), (true_ends, true_heads, true_lengths) = ways(found), ways(truth)
    if not len(ends):
        return 0.0, np.nan
    at_leaflet = np.linalg.norm(true_ends[:, None] - ends, axis=2)
    at_head = np.linalg.norm(true_heads[:, None] - heads, axis=2)
    a, b = linear_sum_assignment(np.minimum(at_leaflet + at_head, 0.1))
    right = (at_leaflet[a, b] * MM <= near) & (at_head[a, b] * MM <= near)
    error = np.abs(lengths[b] / true_lengths[a] - 1)[right]
    share = 100 * float(right.sum()) / len(true_ends)
    return share, 100 * float(np.median(error)) if right.any() else np.nan


def ways(valve: mvs.Snapshot) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For each chord end at a leaflet: its place, that of its head (n, 3), and rest length in between.

    Branched chordae are followed along the segment that leads to the head in the fewest steps.
    """
    position, kind = np.asarray(valve.node_position), np.asarray(valve.node_kind)
    segments, rest = np.asarray(valve.chord_nodes), np.asarray(valve.chord_rest_length)
    reached = {int(n): (int(n), 0.0) for n in valve.head_nodes}  # node: head, length to it
    front = list(reached)
    while front:
        following = []
        for (a, b), length in zip(segments.tolist(), rest.tolist()):
            for p, q in ((a, b), (b, a)):
                free = kind[q] not in (mvs.NodeKind.LEAFLET, mvs.NodeKind.ANNULUS)
                if p in front and q not in reached and free:
                    reached[q] = (reached[p][0], reached[p][1] + length)
                    following.append(q)
        front = following
    ends, heads, lengths = [], [], []
    for (a, b), length in zip(segments.tolist(), rest.tolist()):
        for p, q in ((a, b), (b, a)):
            if p in reached and kind[q] in (mvs.NodeKind.LEAFLET, mvs.NodeKind.ANNULUS):
                ends.append(position[q])
                heads.append(position[reached[p][0]])
                lengths.append(reached[p][1] + length)
    shape = np.zeros((0, 3))
    return np.array(ends or shape), np.array(heads or shape), np.array(lengths)


def leak_interval(found: Any) -> tuple[float, float]:
    """The reported interval of the leak in mm2; without one, the leak of the recovered valve twice."""
    values = [f.values for f in found.findings if f.name == "leak_interval"]
    leak = values[-1] if values else [found.closed.measures.regurgitant_orifice_area]
    return float(np.min(leak)) * MM**2, float(np.max(leak)) * MM**2
