"""Surfaces of mitral leaflets as people have them, for forty_surfaces.py and tests/python/test_build.py.

All lengths in m. A surface is a dict of the arguments of mvs.Simulator.build_valve.
"""

from __future__ import annotations

import json
from pathlib import Path

import mvs
import numpy as np

Surface = dict


def leaflets_of(snapshot: mvs.Snapshot) -> Surface:
    """The leaflets of an open valve without its chordae, and the tips of its papillary muscles."""
    kinds = np.asarray(snapshot.node_kind)
    count = int((kinds <= mvs.NodeKind.ANNULUS).sum())
    assert (kinds[:count] <= mvs.NodeKind.ANNULUS).all(), "leaflet vertices come first"
    rest = np.array(snapshot.node_rest)
    return {
        "points": rest[:count].copy(),
        "triangles": np.array(snapshot.triangle_nodes, dtype=np.uint32),
        "papillary_tips": rest[kinds == mvs.NodeKind.HEAD].copy(),
    }


def generated(**dimensions) -> Surface:
    """The leaflets of a generated valve, under another law than the one it is rebuilt with."""
    with mvs.Simulator() as sim:
        sim.generate(**dimensions)
        return leaflets_of(sim.snapshot())


def kaiser(folder: Path, size: str) -> Surface:
    """A valve on a real annulus with real papillary tips; its leaflets unloaded."""
    data = json.loads((folder / "kaiser_mitral_normal_1" / f"{size}.json").read_text())
    points = np.array(data["vertices_relaxed"]) * 1e-3
    return {
        "points": points[: data["n_leaflet_vertices"]].copy(),
        "triangles": np.array(data["faces"], dtype=np.uint32),
        "papillary_tips": points[data["papillary"]],
    }


def read_stl(path: Path) -> Surface:
    """A binary STL file in mm: three points for each triangle."""
    raw = path.read_bytes()
    count = int.from_bytes(raw[80:84], "little")
    rows = np.frombuffer(raw, dtype=np.uint8, offset=84).reshape(count, 50)
    corners = rows[:, 12:48].copy().view("<f4").reshape(-1, 3)
    return {"points": corners.astype(float) * 1e-3}


def moved(surface: Surface, seed: int) -> Surface:
    """Rotated and displaced by a rigid motion, with its landmarks.

    Rounded to 1 um: the last bits of NumPy's matrix products depend on the processor, and a valve may rest on one
    side of a difference of 1e-16 m and flutter on the other.
    """
    random = np.random.default_rng(seed)
    turn, upper = np.linalg.qr(random.normal(size=(3, 3)))
    turn *= np.sign(np.diag(upper))
    if np.linalg.det(turn) < 0:
        turn[:, 0] *= -1
    shift = random.uniform(-0.1, 0.1, 3)
    found = dict(surface)
    for name in ("points", "papillary_tips", "annulus", "commissures", "anterior"):
        if name in found:
            found[name] = np.round(found[name] @ turn.T + shift, 6)
    return found


def renumbered(surface: Surface, seed: int) -> Surface:
    """Points and triangles in another order, each triangle from another corner."""
    random = np.random.default_rng(seed)
    order = random.permutation(len(surface["points"]))
    place = np.argsort(order).astype(np.uint32)
    triangles = place[surface["triangles"]]
    turns = random.integers(0, 3, len(triangles))
    triangles = np.array([np.roll(t, k) for t, k in zip(triangles, turns)], dtype=np.uint32)
    shuffled = np.ascontiguousarray(triangles[random.permutation(len(triangles))])
    return {**surface, "points": surface["points"][order], "triangles": shuffled}


def flipped(surface: Surface, seed: int) -> Surface:
    """Half of the triangles wound the other way."""
    triangles = surface["triangles"].copy()
    chosen = np.random.default_rng(seed).random(len(triangles)) < 0.5
    triangles[chosen] = triangles[chosen][:, ::-1]
    return {**surface, "triangles": triangles}


def soup(surface: Surface) -> Surface:
    """Three points for each triangle, rounded to single precision, as STL has them."""
    points = surface["points"][surface["triangles"]].reshape(-1, 3).astype(np.float32)
    return {**{k: v for k, v in surface.items() if k != "triangles"}, "points": points}


def noisy(surface: Surface, size: float, seed: int) -> Surface:
    """Each point displaced by a normal deviate of `size` (m) in each direction."""
    noise = np.random.default_rng(seed).normal(scale=size, size=surface["points"].shape)
    return {**surface, "points": surface["points"] + noise}


def without(surface: Surface, triangles: np.ndarray) -> Surface:
    """The surface without some of its triangles."""
    kept = np.ascontiguousarray(np.delete(surface["triangles"], triangles, axis=0))
    return {**surface, "triangles": kept}


def boundary_points(triangles: np.ndarray) -> np.ndarray:
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), 1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    return np.unique(unique[counts == 1])


def torn(surface: Surface, share: float, seed: int) -> Surface:
    """Some of the triangles at the rims are missing."""
    at_rim = np.isin(surface["triangles"], boundary_points(surface["triangles"])).any(1)
    chosen = np.flatnonzero(at_rim & (np.random.default_rng(seed).random(len(at_rim)) < share))
    return without(surface, chosen)


def welded(surface: Surface) -> Surface:
    """A surface with triangles; points of a soup that are equal become one."""
    if "triangles" in surface:
        return surface
    points, index = np.unique(surface["points"], axis=0, return_inverse=True)
    return {**surface, "points": points, "triangles": index.reshape(-1, 3).astype(np.uint32)}


def free_edge(surface: Surface) -> np.ndarray:
    """The points of the free edge: the rim that spans less."""
    triangles = surface["triangles"].astype(int)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {tuple(e) for e in edges}
    after = {int(a): int(b) for a, b in edges if (b, a) not in known}
    loops = []
    while after:
        loop = [next(iter(after))]
        while (following := after.pop(loop[-1], None)) is not None and following != loop[0]:
            loop.append(following)
        loops.append(np.array(loop))

    def spanned(loop: np.ndarray) -> float:
        x = surface["points"][loop] - surface["points"][loop].mean(0)
        return float(np.linalg.norm(np.cross(x, np.roll(x, -1, axis=0)).sum(0)) / 2)

    return min(sorted(loops, key=len)[-2:], key=spanned)


def eaten(surface: Surface, stretches: int, seed: int) -> Surface:
    """Stretches of the free edge, 4 to 10 mm wide and 1 to 3 mm deep, are missing, as networks lose them."""
    surface = welded(surface)
    random = np.random.default_rng(seed)
    edge = surface["points"][free_edge(surface)]
    middle = surface["points"][surface["triangles"]].mean(1)
    gone = np.zeros(len(middle), bool)
    for _ in range(stretches):
        centre = edge[random.integers(len(edge))]
        half, depth = random.uniform(2e-3, 5e-3), random.uniform(1e-3, 3e-3)
        away = np.linalg.norm(edge - centre, axis=1)
        for n in np.flatnonzero(away < half):
            radius = depth * np.sqrt(1 - (away[n] / half) ** 2)
            gone |= np.linalg.norm(middle - edge[n], axis=1) < radius
    return without(surface, np.flatnonzero(gone))


def with_holes(surface: Surface, count: int, seed: int) -> Surface:
    """All triangles around some inner points are missing."""
    triangles = surface["triangles"]
    rim = boundary_points(triangles)
    near_rim = np.unique(triangles[np.isin(triangles, rim).any(1)])
    inner = np.setdiff1d(np.unique(triangles), near_rim)
    chosen = np.random.default_rng(seed).choice(inner, count, replace=False)
    return without(surface, np.flatnonzero(np.isin(triangles, chosen).any(1)))


def normals_of(surface: Surface) -> np.ndarray:
    """Unit normals of the points, of the side on which the triangles turn counter-clockwise."""
    points, triangles = surface["points"], surface["triangles"]
    corners = points[triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], faces)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def offset(surface: Surface, distance: float) -> Surface:
    """Moved along its normals by a distance (m)."""
    return {**surface, "points": surface["points"] + distance * normals_of(surface)}


def skinned(surface: Surface, thickness: float) -> Surface:
    """Both sides of leaflets of a thickness (m), joined along the rims."""
    points, triangles = surface["points"], surface["triangles"]
    normals, count = normals_of(surface), len(points)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {tuple(e) for e in edges}
    rim = np.array([e for e in edges if (e[1], e[0]) not in known])
    a, b = rim[:, 0], rim[:, 1]
    band = np.concatenate(
        [np.stack([b, a, a + count], 1), np.stack([b, a + count, b + count], 1)]
    )
    both = np.concatenate([triangles, triangles[:, ::-1] + count, band]).astype(np.uint32)
    return {
        **surface,
        "points": np.concatenate(
            [points + 0.5 * thickness * normals, points - 0.5 * thickness * normals]
        ),
        "triangles": both,
    }
