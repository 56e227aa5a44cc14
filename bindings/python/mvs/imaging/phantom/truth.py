"""The true valve of a phantom: open, and closed under a pressure by the simulator.

The given valve is posed, refined to a finer mesh, given another tissue and a varying thickness, and
settled. It is the ground truth; nothing of it may be given to a recovery but by the files of images.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ..._core import Simulator, Snapshot
from ...arrays import Leaflet, Valve
from ...editing import valve_of
from ...errors import OpError
from ...kinds import MMHG, LeafletLaw, NodeKind
from .heads import with_spread_heads
from .settings import Settings

if TYPE_CHECKING:
    from ...editing import _FilledValve

MM = 1e3
Progress = Optional[Callable[[str, float], None]]
"""Called with the present stage and its share that is done; may raise to stop."""

POSTERIOR = {
    LeafletLaw.MAY_NEWMAN_YIN: (414.0, 4.848, 305.4),
    LeafletLaw.PROT: (171.0, 5.28, 6.46),
}
"""Constants of posterior leaflets in the papers of include/mvs/valve.h; the defaults are anterior."""


@dataclasses.dataclass(frozen=True)
class Truth:
    """The true valve: open and closed snapshots in m, in the frame of the images.

    pose: (4, 4), from the frame of the given valve to that of the images, in m
    """

    opened: Snapshot
    closed: Optional[Snapshot]
    pose: NDArray[np.float64]


def true_valve(
    valve: Union[Valve, Snapshot], settings: Settings, loaded: bool, progress: Progress = None
) -> Truth:
    """Prepares and closes the true valve; OpError if it does not come to rest without crossings."""
    given = valve_of(valve) if isinstance(valve, Snapshot) else dataclasses.replace(valve)
    given.nodes_now = None
    pose = pose_of(settings)
    with Simulator(log=lambda _level, _text: None) as sim:  # short edges: contact_thickness() heeds them
        spread = with_spread_heads(
            posed(given, pose), settings.head_spread / MM, settings.chord_diameter
        )
        sim.set_valve(spread)
        while _leaflet_vertices(sim.snapshot()) < settings.vertices:
            sim.refine()
        fine = valve_of(sim.snapshot())
        fine.leaflets = [_tissue(leaflet, settings) for leaflet in fine.leaflets]
        fine.triangle_thickness = varied_thickness(fine, settings)
        fine.contact_thickness = contact_thickness(fine)
        fine.nodes_now = None
        sim.set_valve(fine)
        opened = sim.snapshot()
        closed = _closed(sim, settings, progress) if loaded else None
    return Truth(opened, closed, pose)


def pose_of(settings: Settings) -> NDArray[np.float64]:
    """A rotation, uniform over all, and a shift of up to 100 mm; the identity without `pose`."""
    pose = np.eye(4)
    if settings.pose:
        random = np.random.default_rng([settings.seed, 1])
        q = random.normal(size=4)
        w, x, y, z = q / np.linalg.norm(q)
        pose[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        pose[:3, 3] = random.uniform(-0.1, 0.1, 3)
    return pose


def posed(valve: Valve, pose: NDArray[np.float64]) -> Valve:
    """The valve after a rigid motion."""
    turn, shift = pose[:3, :3], pose[:3, 3]
    moved = dataclasses.replace(valve)
    for name in ("nodes", "nodes_loaded", "nodes_open"):
        points = getattr(valve, name)
        if points is not None:
            setattr(moved, name, np.ascontiguousarray(points @ turn.T + shift))
    if valve.triangle_fibre is not None:
        moved.triangle_fibre = np.ascontiguousarray(valve.triangle_fibre @ turn.T)
    moved.rings = [
        dataclasses.replace(ring, curve=ring.curve @ turn.T + shift) for ring in valve.rings
    ]
    return moved


def varied_thickness(valve: _FilledValve, settings: Settings) -> NDArray[np.float64]:
    """The thickness of each triangle times 1 + variation * f, |f| <= 1, a sum of three long waves."""
    random = np.random.default_rng([settings.seed, 2])
    centres = valve.nodes[valve.triangles].mean(axis=1)
    waves = random.normal(size=(3, 3))
    waves *= 2 * np.pi / 15e-3 / np.linalg.norm(waves, axis=1, keepdims=True)
    phases = random.uniform(0, 2 * np.pi, 3)
    factor = np.sin(centres @ waves.T + phases).sum(axis=1) / 3
    return np.ascontiguousarray(valve.triangle_thickness * (1 + settings.thickness_variation * factor))


def contact_thickness(valve: _FilledValve) -> float:
    """The distance of mid-surfaces at which leaflets touch (m): their mean thickness.

    At most three quarters of the median edge: neighbours in the sheet are no contact.
    """
    corners = valve.nodes[valve.triangles]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    return float(min(np.mean(valve.triangle_thickness), 0.75 * np.median(edges)))


def leaflet_nodes(snapshot: Snapshot) -> NDArray[np.bool_]:
    """Which nodes belong to the leaflets or the annulus."""
    return np.isin(np.asarray(snapshot.node_kind), (NodeKind.LEAFLET, NodeKind.ANNULUS))


def _leaflet_vertices(snapshot: Snapshot) -> int:
    return int(leaflet_nodes(snapshot).sum())


def _tissue(leaflet: Leaflet, settings: Settings) -> Leaflet:
    law = LeafletLaw[settings.law.upper()]
    constants = POSTERIOR.get(law, ()) if leaflet.name.upper().startswith("P") else ()
    return dataclasses.replace(leaflet, law=law, constants=constants)


def _closed(sim: Simulator, settings: Settings, progress: Progress) -> Snapshot:
    sim.set_load(settings.pressure * MMHG)

    def report(share: float, _residual: float) -> None:
        if progress:
            progress("closing the true valve", share)

    stats = sim.settle(progress=report)
    closed = sim.snapshot()
    crossings = closed.measures.intersections
    if not stats.converged or crossings:
        raise OpError(
            f"the true valve does not close under {settings.pressure:g} mmHg: residual "
            f"{stats.residual:.1e} N, {crossings} crossing triangle pairs; take another law, fewer "
            "vertices or another valve", "valve",
        )
    return closed
