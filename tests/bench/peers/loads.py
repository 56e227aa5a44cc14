"""Loads that engines lack, as external forces, and values that several of them need. NumPy only."""

from __future__ import annotations

import numpy as np
from valve import Valve


def pressure(valve: Valve, x: np.ndarray, share: float = 1.0) -> np.ndarray:
    """The follower pressure: a third of p A n on each corner."""
    a, b, c = (x[valve.triangles[:, k]] for k in range(3))
    third = np.cross(b - a, c - a) * (share * float(valve.pressure[0]) / 6)
    forces = np.zeros_like(x)
    np.add.at(forces, valve.triangles.ravel(), np.repeat(third, 3, axis=0))
    return forces


def chords(valve: Valve, x: np.ndarray) -> np.ndarray:
    """Tension-only chordae."""
    d = x[valve.chords[:, 1]] - x[valve.chords[:, 0]]
    length = np.linalg.norm(d, axis=1)
    tension = valve.chord_stiffness * np.maximum(length / valve.chord_length - 1, 0)
    pull = d * (tension / length)[:, None]
    forces = np.zeros_like(x)
    np.add.at(forces, valve.chords[:, 0], pull)
    np.add.at(forces, valve.chords[:, 1], -pull)
    return forces


def resting_gap(valve: Valve) -> float:
    """The distance, m, at which libmvs's contact carries the pressure: -kappa B'(d / r) = p.

    Engines with a hard contact distance get this one, so that their sheets lie as far apart.
    """
    thickness, stiffness = valve.contact
    s = np.linspace(1e-3, 1 - 1e-3, 9999)
    push = -stiffness * (2 * (1 - s) * np.log(s) - (1 - s) ** 2 / s)
    return float(thickness * s[np.argmin(np.abs(push - abs(valve.pressure[0])))])


def secant(valve: Valve, strain: float) -> float:
    """Young's modulus, Pa, of the line through the bilinear law at a strain."""
    low, high, kink = valve.spring_law
    return float((low * strain + (high - low) * max(strain - kink, 0.0)) / strain)
