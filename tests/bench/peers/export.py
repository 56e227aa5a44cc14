"""A snapshot of libmvs as the plain arrays that the engines read."""

from __future__ import annotations

import mvs
import numpy as np
from valve import Valve


def arrays(snapshot: mvs.Snapshot, pressure: float) -> Valve:
    """The valve with its spring law; it must be of one tissue, with linear chordae."""
    law = np.unique(snapshot.leaflet_constants[:, 1:4], axis=0)
    if (snapshot.leaflet_law != mvs.LeafletLaw.SPRING).any() or len(law) != 1:
        raise ValueError("the engines know one bilinear spring law for all leaflets")
    if (snapshot.chord_law != mvs.ChordLaw.LINEAR).any():
        raise ValueError("the engines know linear chordae only")
    kind, rest = snapshot.node_kind, snapshot.node_rest
    fixed = (kind == mvs.NodeKind.ANNULUS) | (kind == mvs.NodeKind.HEAD)
    start = rest.copy()
    start[fixed] = snapshot.node_loaded[fixed]
    density, thickness, stiffness, bending = snapshot.valve_constants
    triangles = snapshot.triangle_nodes.astype(np.int64)
    area, t = areas(rest, triangles), snapshot.triangle_thickness
    edges, volume, hinges, rigidity = sheet(triangles, area, t, law[0][0] * bending)
    keep = ~fixed[edges].all(axis=1)
    length = np.linalg.norm(rest[edges[:, 1]] - rest[edges[:, 0]], axis=1)
    bent = np.linalg.norm(rest[hinges[:, 1]] - rest[hinges[:, 0]], axis=1)
    cords = snapshot.chord_nodes.astype(np.int64)
    cable = snapshot.chord_area * snapshot.chord_rest_length
    mass = np.zeros(len(rest))
    np.add.at(mass, triangles.ravel(), np.repeat(density * area * t / 3, 3))
    np.add.at(mass, cords.ravel(), np.repeat(density * cable / 2, 2))
    return Valve(
        nodes=rest.copy(), start=start, fixed=fixed, mass=mass, triangles=triangles,
        thickness=t.copy(), springs=edges[keep], spring_length=length[keep],
        spring_volume=volume[keep], spring_law=law[0], hinges=hinges,
        hinge_stiffness=rigidity * bent**2, chords=cords,
        chord_length=snapshot.chord_rest_length.copy(),
        chord_stiffness=snapshot.chord_young * snapshot.chord_area,
        pressure=np.array([pressure]), contact=np.array([thickness, stiffness]))


def areas(nodes: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Areas of the triangles."""
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def sheet(triangles: np.ndarray, area: np.ndarray, thickness: np.ndarray,
          modulus: float) -> tuple[np.ndarray, ...]:
    """Edges, volume beside each, hinges, their rigidity over area (libmvs/energy/bending.h)."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    corner = np.concatenate([triangles[:, 2], triangles[:, 0], triangles[:, 1]])
    owner = np.tile(np.arange(len(triangles)), 3)
    edges, which, count = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True,
                                    return_counts=True)
    volume = np.bincount(which.ravel(), (area * thickness)[owner])
    order = np.argsort(which.ravel(), kind="stable")
    first = np.concatenate([[0], np.cumsum(count)[:-1]])[count == 2]
    one, other = order[first], order[first + 1]
    hinges = np.column_stack([sides[one], corner[one], corner[other]])
    plate = modulus * thickness**3 / (12 * 0.75)
    rigidity = (plate[owner[one]] + plate[owner[other]]) / 2
    return edges, volume, hinges, rigidity / (area[owner[one]] + area[owner[other]])
