"""Closures of libmvs that other engines are compared with: the open valve, its shapes at rest, distances."""

from __future__ import annotations

import time
from typing import Any, Optional

import mvs
import numpy as np


class Goal:
    """The open valve, its closures at rest along several paths, and comparisons with them."""

    def __init__(self, opened: mvs.Snapshot, pressure: float, paths: int) -> None:
        self.opened, self.pressure = opened, pressure
        self.shapes = [close(opened, pressure, residual=1e-7)[0]]
        if paths > 1:
            ensemble = opened.ensemble(pressure, members=paths)
            self.shapes += [ensemble.snapshot(k) for k, path in enumerate(ensemble.members)
                            if k and path.converged]
        kind = opened.node_kind
        self.sheet = (kind == mvs.NodeKind.LEAFLET) | (kind == mvs.NodeKind.ANNULUS)
        self.free = (kind == mvs.NodeKind.LEAFLET) | (kind == mvs.NodeKind.BRANCH)

    def spread_mm(self) -> float:
        """The largest distance of a node between two of our own shapes."""
        first = self.shapes[0].node_position
        return max(np.linalg.norm(s.node_position - first, axis=1).max() for s in self.shapes) * 1e3

    def judge(self, shape: np.ndarray) -> dict[str, Any]:
        """Distances, crossings by the exact test, and out-of-balance forces off the contact."""
        valve = mvs.valve_of(self.opened)
        valve.nodes_now = shape
        with mvs.Simulator() as sim:
            sim.set_valve(valve)
            sim.set_load(self.pressure)
            found = sim.snapshot()
        return self.figures(found)

    def figures(self, found: mvs.Snapshot) -> dict[str, Any]:
        """The same for a snapshot."""
        apart = min((np.linalg.norm((found.node_position - s.node_position)[self.sheet], axis=1)
                     for s in self.shapes), key=lambda d: float((d * d).sum())) * 1e3
        away = self.free.copy()
        for s in (found, self.shapes[0]):
            away &= np.isinf(s.node_coaptation) & (s.node_contact_force == 0).all(axis=1)
        force = np.linalg.norm(found.node_force[away], axis=1)
        surface = min(found.compare(s).surface_rms for s in self.shapes)
        return {"node_rms_mm": float(np.sqrt((apart**2).mean())),
                "node_median_mm": float(np.median(apart)), "node_max_mm": float(apart.max()),
                "surface_rms_mm": surface * 1e3, "crossings": found.measures.intersections,
                "force_median_N": float(np.median(force)), "force_max_N": float(force.max())}


def close(opened: mvs.Snapshot, pressure: float,
          **how: Any) -> tuple[mvs.Snapshot, mvs.Stats, float]:
    """One closure by libmvs: the shape, the statistics, and its CPU seconds."""
    with mvs.Simulator() as sim:
        sim.restore(opened)
        sim.set_load(pressure)
        started = time.process_time()
        stats = sim.settle(**how)
        return sim.snapshot(), stats, time.process_time() - started


def opened_valve(vertices: Optional[int], law: str) -> mvs.Snapshot:
    """The parametric valve, open, of springs or of membranes."""
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=vertices)
        if law != "spring":
            sim.set_leaflet(law=law)
        return sim.snapshot()
