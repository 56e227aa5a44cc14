"""The valve as plain arrays, and the trace of node positions over CPU time that an engine returns.

An engine is a script that is called as `engine_NAME.py VALVE.npz OUT.npz [key=value ...]`: it reads
the valve, closes it, and hands back a trace. It does not import libmvs. SI units.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import dataclass, fields
from typing import Any

import numpy as np


@dataclass
class Valve:
    """n nodes, m triangles, s springs, h hinges, c chordae; lengths in m."""

    nodes: np.ndarray
    """(n, 3) where rest lengths are taken"""
    start: np.ndarray
    """(n, 3) where the closure starts: open, the fixed nodes at their targets"""
    fixed: np.ndarray
    """(n,) bool: annulus and papillary heads"""
    mass: np.ndarray
    """(n,) kg, lumped from triangles and chordae"""
    triangles: np.ndarray
    """(m, 3), normals into the atrium: the pressure pushes along them"""
    thickness: np.ndarray
    """(m,)"""
    springs: np.ndarray
    """(s, 2): the edges"""
    spring_length: np.ndarray
    spring_volume: np.ndarray
    """(s,) m3, thickness times area of the triangles beside: tension is stress volume / length"""
    spring_law: np.ndarray
    """3: Young's modulus up to the kink and beyond it, Pa; strain at the kink"""
    hinges: np.ndarray
    """(h, 4): the ends of an inner edge, then the corners on both sides"""
    hinge_stiffness: np.ndarray
    """(h,) N m a radian"""
    chords: np.ndarray
    chord_length: np.ndarray
    chord_stiffness: np.ndarray
    """(c,) N: Young's modulus times cross-section, in tension only"""
    pressure: np.ndarray
    """1: Pa"""
    contact: np.ndarray
    """2: thickness, m; stiffness, Pa"""

    def save(self, path: str) -> None:
        """Writes the arrays."""
        np.savez(path, **{each.name: getattr(self, each.name) for each in fields(self)})

    @staticmethod
    def load(path: str) -> "Valve":
        """Reads what save wrote."""
        with np.load(path) as data:
            return Valve(**{each.name: data[each.name] for each in fields(Valve)})


class Recorder:
    """Positions over the CPU time of this process, all its threads, from the first step on.

    Building the model counts apart, as set-up. Copying a shape into the trace counts nowhere.
    """

    def __init__(self, valve: Valve, limit: float, every: float = 0.0) -> None:
        self.limit, self.every = limit, every
        self.cpu: list[float] = []
        self.shapes: list[np.ndarray] = []
        self.speeds: list[float] = []
        self.setup = time.process_time()
        self.lost, self.started = 0.0, time.process_time()
        self.sample(valve.start, np.inf)

    def elapsed(self) -> float:
        """CPU seconds since the first step."""
        return time.process_time() - self.started - self.lost

    def due(self) -> bool:
        """Whether a sample is due."""
        return not self.cpu or self.elapsed() >= self.cpu[-1] + self.every

    def sample(self, nodes: np.ndarray, speed: float) -> bool:
        """Takes a shape and the largest speed in it, m/s; False when the time is up or it blew up.
        """
        now = time.process_time()
        self.cpu.append(now - self.started - self.lost)
        sane = bool(np.isfinite(nodes).all() and np.abs(nodes).max() < 1)
        if sane:
            self.shapes.append(np.array(nodes, dtype=float))
            self.speeds.append(float(speed))
        else:
            self.cpu.pop()
        self.lost += time.process_time() - now
        return sane and self.cpu[-1] < self.limit

    def verdict(self, nodes: np.ndarray, speed: float, rests: bool) -> str:
        """Takes a shape if one is due, or the last one; "rest" or "limit" where it is, else ""."""
        if not rests and not self.due():
            return ""
        goes_on = self.sample(nodes, speed)
        return "rest" if rests else "" if goes_on else "limit"

    def save(self, path: str, verdict: str, steps: int, settings: dict[str, Any],
             version: str = "") -> None:
        """Writes the trace, the verdict (rest, limit, exploded) and the settings that were used."""
        np.savez(path, cpu=self.cpu, shapes=self.shapes, speeds=self.speeds)
        told = {"verdict": verdict, "steps": steps, "setup_cpu_s": self.setup, "version": version,
                "settings": settings}
        with open(path + ".json", "w", encoding="utf-8") as file:
            json.dump(told, file, indent=1)


def arguments(**defaults: Any) -> tuple[Valve, str, dict[str, Any]]:
    """The valve, where to write, and the settings: the defaults, changed by key=value."""
    settings = dict(defaults)
    for word in sys.argv[3:]:
        key, value = word.split("=", 1)
        if key not in defaults:
            sys.exit(f"{key} is no setting of this engine: {', '.join(defaults)}")
        settings[key] = type(defaults[key])(float(value) if not isinstance(defaults[key], str)
                                            else value)
    return Valve.load(sys.argv[1]), sys.argv[2], settings
