"""The solids of a valve in mm: leaflets, chordae, papillary muscles and the annulus wall.

Leaflets are sheets of their thickness with round rims, chordae round tubes of their cross-section.
A papillary muscle is a union of round cones, one from each of its heads to a common base; its surface
passes through the heads. The wall is a tube beside the annulus, which lies inside of it.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..._core import Snapshot
from ...kinds import PartKind
from .arcs import chord_paths
from .distance import Cones, Sheet
from .settings import Settings
from .truth import MM, leaflet_nodes

Points = NDArray[np.float64]
SAME_MUSCLE = 8.0
"""mm: heads nearer to each other belong to one papillary muscle"""


@dataclasses.dataclass(frozen=True)
class Anatomy:
    """The solids, in mm and in the frame of the images.

    leaflets: a sheet for each leaflet; chords: all tubes, and the chord of each tube
    paths: the axis of each chord, (k, 3), from the papillary head to the leaflet
    muscles: the cones of all papillary muscles; tips: (p, 3), the mean of each muscle's heads
    """

    leaflets: tuple[Sheet, ...]
    names: tuple[str, ...]
    chords: Cones
    paths: tuple[Points, ...]
    muscles: Cones
    tips: Points
    wall: Cones


def anatomy_of(snapshot: Snapshot, settings: Settings) -> Anatomy:
    """The solids of a valve in its present shape."""
    nodes = MM * np.asarray(snapshot.node_position)
    names = tuple(p.name for p in snapshot.parts if p.kind == PartKind.LEAFLET)
    thickness = _node_thickness(snapshot)
    triangles = np.asarray(snapshot.triangle_nodes).astype(np.int64)
    leaflet = np.asarray(snapshot.triangle_leaflet)
    sheets = tuple(
        Sheet(nodes, triangles[leaflet == k], thickness / 2) for k in range(len(names))
    )
    paths = chord_paths(snapshot, settings, sheets)
    tips, muscles = _muscles(snapshot, paths, settings)
    return Anatomy(
        sheets, names, _tubes(snapshot, paths), paths, muscles, tips, _wall(snapshot, settings)
    )


def _tubes(snapshot: Snapshot, paths: tuple[Points, ...]) -> Cones:
    """Tubes along the paths; a stretched chord keeps its volume."""
    rest = MM * np.asarray(snapshot.chord_rest_length)
    radius = MM * np.sqrt(np.asarray(snapshot.chord_area) / np.pi)
    start, end, wide = [], [], []
    for path, length, r in zip(paths, rest, radius):
        drawn = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
        r = r * np.sqrt(min(1.0, length / max(drawn, 1e-9)))
        start += list(path[:-1])
        end += list(path[1:])
        wide += [r] * (len(path) - 1)
    return _cones(start, end, wide, wide)


def _muscles(
    snapshot: Snapshot, paths: tuple[Points, ...], settings: Settings
) -> tuple[Points, Cones]:
    """Tips and cones of the papillary muscles: heads in reach of each other share a muscle."""
    heads = np.asarray(snapshot.head_nodes)
    if not len(heads):
        return np.zeros((0, 3)), _cones([], [], [], [])
    nodes = MM * np.asarray(snapshot.node_position)
    first, last = settings.muscle_radius
    pulls = _pulls(snapshot, paths)
    start, end, tips = [], [], []
    for group in _groups(nodes[heads]):
        members = heads[group]
        pull = np.sum([pulls[n] for n in members], axis=0)
        pull = pull / max(float(np.linalg.norm(pull)), 1e-9)
        base = nodes[members].mean(axis=0) - (settings.muscle_length + first) * pull
        tips.append(nodes[members].mean(axis=0))
        for n in members:
            own = pulls[n] / max(float(np.linalg.norm(pulls[n])), 1e-9)
            start.append(nodes[n] - first * own)
            end.append(base)
    return np.array(tips), _cones(start, end, [first] * len(start), [last] * len(start))


def _pulls(snapshot: Snapshot, paths: tuple[Points, ...]) -> dict[int, Points]:
    """The sum of the unit tangents of the chordae at each head; the valve's axis where none is."""
    pulls = {int(n): np.zeros(3) for n in snapshot.head_nodes}
    for (a, b), path in zip(np.asarray(snapshot.chord_nodes), paths):
        for node, tangent in ((int(a), path[1] - path[0]), (int(b), path[-2] - path[-1])):
            if node in pulls:
                pulls[node] = pulls[node] + tangent / max(float(np.linalg.norm(tangent)), 1e-9)
    for node, pull in pulls.items():
        if np.linalg.norm(pull) < 1e-6:
            pulls[node] = np.array(snapshot.frame.axes[2])
    return pulls


def _groups(points: Points) -> list[NDArray[np.int64]]:
    """Connected groups of points that are nearer than SAME_MUSCLE to each other."""
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial.distance import cdist

    count, group = connected_components(cdist(points, points) < SAME_MUSCLE, directed=False)
    return [np.flatnonzero(group == k) for k in range(count)]


def _wall(snapshot: Snapshot, settings: Settings) -> Cones:
    """A tube along the annulus, moved outwards by two thirds of its radius."""
    nodes = MM * np.asarray(snapshot.node_position)
    loop = nodes[np.asarray(snapshot.annulus_nodes)]
    axis = np.asarray(snapshot.frame.axes[2])
    out = loop - loop.mean(axis=0)
    out -= (out @ axis)[:, None] * axis
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9)
    centre = loop + 2 / 3 * settings.wall_radius * out
    wide = [settings.wall_radius] * len(loop)
    return _cones(list(centre), list(np.roll(centre, -1, axis=0)), wide, wide)


def _node_thickness(snapshot: Snapshot) -> NDArray[np.float64]:
    """Thickness of each node in mm: that of its triangles by area, which includes their stretch.

    Tissue keeps its volume: a triangle that is stretched to a larger area is thinner.
    """
    nodes, rest = np.asarray(snapshot.node_position), np.asarray(snapshot.node_rest)
    triangles = np.asarray(snapshot.triangle_nodes).astype(np.int64)
    now, before = _areas(nodes, triangles), _areas(rest, triangles)
    thick = np.asarray(snapshot.triangle_thickness) * before
    total, area = np.zeros(len(nodes)), np.zeros(len(nodes))
    for k in range(3):
        np.add.at(total, triangles[:, k], thick)
        np.add.at(area, triangles[:, k], now)
    used = leaflet_nodes(snapshot)
    return np.where(used, MM * total / np.maximum(area, 1e-30), 0.0)


def _areas(nodes: Points, triangles: NDArray[np.int64]) -> NDArray[np.float64]:
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def _cones(start: list[Points], end: list[Points], first: list[float], last: list[float]) -> Cones:
    return Cones(
        np.array(start, dtype=float).reshape(-1, 3), np.array(end, dtype=float).reshape(-1, 3),
        np.array(first, dtype=float), np.array(last, dtype=float),
    )
