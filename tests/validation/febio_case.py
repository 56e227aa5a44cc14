"""The valve that FEBio closed: its file, the ways to express it, and the valve that each of them makes."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Optional

import mvs
import numpy as np

FILE = Path("febio") / "V1_healthy_468.json"
HALF_THICKNESS = 0.5e-3
"""m: from FEBio's mesh, the atrial face, to the middle of its shell"""

CHORD_AREA = np.pi / 4 * 1e-6  # m2; with 40 MPa, EA = 31.416 N
SMOOTHING = 0.02e-3  # m
TAIL = 0.5e-3  # m: how far below its rest length a smoothed chord is followed: 0.3 mN


@dataclass(frozen=True)
class Choice:
    """One way to express the case."""

    title: str
    law: mvs.LeafletLaw = mvs.LeafletLaw.BILINEAR
    split: str = "first"
    smoothed_chords: bool = False
    contact_thickness: float = 1e-3
    contact_stiffness: Optional[float] = None
    bending: float = 1.0
    behind: float = 0.0
    from_theirs: bool = False


BASE = Choice("bilinear membrane")
BENDING = tuple(
    replace(BASE, title=f"bending x {factor:g}" if factor else "no bending", bending=factor)
    for factor in (0.0, 4.0, 30.0, 60.0, 100.0, 136.0)
)
STIFF = BENDING[3]


def one_by_one(base: Choice) -> tuple[Choice, ...]:
    """The base, and one thing changed at a time; titles say which."""
    return (
        base,
        replace(base, title="springs", law=mvs.LeafletLaw.SPRING),
        replace(base, title="quads cut along the other diagonal", split="second"),
        replace(base, title="quads cut in four", split="four"),
        replace(base, title="chordae smoothed over 0.02 mm", smoothed_chords=True),
        replace(base, title="contact 0.6 mm", contact_thickness=0.6e-3),
        replace(base, title="contact 1.15 mm", contact_thickness=1.15e-3),
        replace(base, title="contact 1.3 mm", contact_thickness=1.3e-3),
        # -B'(d / r) = p / kappa (libmvs/energy/README.md) at d = 1.15 mm under 120 mmHg
        replace(base, title="contact 2 mm: gap 1.15 mm", contact_thickness=2e-3),
        replace(base, title="contact 1.3 mm, 370 kPa: gap 1.15 mm", contact_thickness=1.3e-3,
                contact_stiffness=370e3),
        replace(base, title="contact 3.7 mm: gap 1.15 + 2 x 0.5 mm", contact_thickness=3.75e-3),
        replace(base, title="mid-surface 0.5 mm behind the mesh", behind=HALF_THICKNESS),
        replace(base, title="closed from FEBio's shape", from_theirs=True),
    )


def data_file() -> Path:
    """Where the data of the case are searched for."""
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    return Path(os.environ.get("MVS_TEST_DATA", default)) / FILE


class Theirs:
    """The file: FEBio's mesh, chordae and result, in m and N; the last two nodes are the heads."""

    def __init__(self, path: Path) -> None:
        data = json.loads(path.read_text())
        self.opened = np.array(data["vertices_open"]) * 1e-3
        self.closed = np.array(data["vertices_closed"]) * 1e-3
        self.quads = np.array(data["quads"])
        self.annulus = np.array(data["annulus"], dtype=np.uint32)
        self.heads = np.array(data["papillary"], dtype=np.uint32)
        chords = data["chords"]
        self.chords = np.array([[c["papillary"], c["leaflet"]] for c in chords], dtype=np.uint32)
        self.rest_length = np.array([c["rest_length"] for c in chords]) * 1e-3
        self.chord_force = np.array(data["chord_force_N"])
        self.title = f"FEBio: {data['solver_cpu_s']:.0f} s, {data['newton_iterations']} iterations"

    def behind(self, nodes: np.ndarray, distance: float) -> np.ndarray:
        """Nodes moved off the surface, away from the atrium."""
        return nodes - distance * normals(nodes, self.quads)


def normals(nodes: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Unit normals at the nodes (n, 3), zero off the sheet; the quads are wound to the atrium."""
    sums = np.zeros_like(nodes)
    corners = nodes[quads]
    for k in range(4):
        ahead, behind = corners[:, (k + 1) % 4], corners[:, k - 1]
        np.add.at(sums, quads[:, k], np.cross(ahead - corners[:, k], behind - corners[:, k]))
    length = np.linalg.norm(sums, axis=1, keepdims=True)
    return sums / np.where(length > 0, length, 1)


def split(quads: np.ndarray, how: str, nodes: int) -> np.ndarray:
    """Triangles of the quads; "four" needs a node in the middle of each, after the others."""
    if how == "four":
        middle = np.arange(nodes, nodes + len(quads))
        sides = [np.column_stack([quads[:, k - 1], quads[:, k], middle]) for k in range(4)]
        return np.concatenate(sides).astype(np.uint32)
    corners = ([0, 1, 2], [0, 2, 3]) if how == "first" else ([0, 1, 3], [1, 2, 3])
    return np.concatenate([quads[:, c] for c in corners]).astype(np.uint32)


def with_middles(nodes: np.ndarray, theirs: Theirs, choice: Choice) -> np.ndarray:
    """The nodes, moved behind the mesh where the choice says so, and the middles of the quads."""
    moved = theirs.behind(nodes, choice.behind)
    if choice.split != "four":
        return moved
    return np.concatenate([moved, moved[theirs.quads].mean(axis=1)])


def smooth_curves(length: np.ndarray) -> list[mvs.Curve]:
    """FEBio's tension (EA / L0) (u + sqrt(u^2 + s^2)) / 2 as a table for each rest length L0.

    One is needed for each: s is a length, so in strain the curve is s / L0 wide.
    """
    u = np.concatenate([np.linspace(-TAIL, -0.1e-3, 9), np.linspace(-0.08e-3, 0.08e-3, 65),
                        np.linspace(0.1e-3, 2e-3, 20)])
    curves = []
    for k, rest in enumerate(length):
        start = rest - TAIL
        stress = 40e6 * (u + np.sqrt(u * u + SMOOTHING**2)) / 2 / rest
        stress[0] = 0
        curves.append(mvs.Curve(f"chord {k}", np.column_stack([(u + TAIL) / start, stress])))
    return curves


def read(theirs: Theirs, choice: Choice) -> mvs.Valve:
    """The case as a valve, open."""
    rest, loaded = (with_middles(n, theirs, choice) for n in (theirs.opened, theirs.closed))
    # a chord that ends behind the mesh is as slack or taut in FEBio's shape as it is there
    ends = [n[theirs.chords[:, 0]] - n[theirs.chords[:, 1]] for n in (loaded, theirs.closed)]
    length = theirs.rest_length + np.linalg.norm(ends[0], axis=1) - np.linalg.norm(ends[1], axis=1)
    valve = mvs.Valve(
        name="febio",
        nodes=rest,
        nodes_loaded=loaded,
        triangles=split(theirs.quads, choice.split, len(theirs.opened)),
        annulus=theirs.annulus,
        leaflets=[mvs.Leaflet("M", law=choice.law)],
        chord_nodes=theirs.chords,
        chord_rest_length=length,
        head_nodes=theirs.heads,
        contact_thickness=choice.contact_thickness,
        contact_stiffness=choice.contact_stiffness,
        bending_scale=choice.bending,
    )
    if choice.smoothed_chords:
        valve.curves = smooth_curves(length)
        valve.chord_rest_length = length - TAIL
        valve.chord_law = np.full(len(length), mvs.ChordLaw.TABLE, dtype=np.uint32)
        valve.chord_constants = np.zeros((len(length), 6))
        valve.chord_constants[:, 0] = np.arange(len(length))
    return valve
