"""Smooth random fields in space: sums of plane waves with random directions and phases.

Each component has mean 0 and standard deviation 1, the same value at a point whatever the grid.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]


class SmoothNoise:
    """A field of some components; wavelengths are between `wavelength` and three times as long."""

    def __init__(
        self, random: np.random.Generator, components: int, wavelength: float, waves: int = 32
    ) -> None:
        direction = random.normal(size=(components, waves, 3))
        direction /= np.linalg.norm(direction, axis=2, keepdims=True)
        lengths = wavelength * random.uniform(1, 3, size=(components, waves, 1))
        self._wave = 2 * np.pi * direction / lengths
        self._phase = random.uniform(0, 2 * np.pi, size=(components, waves))

    def at(self, points: Points) -> Points:
        """The field at points (n, 3), (n, components)."""
        waves = self._phase.shape[1]
        return np.stack([
            np.cos(points @ wave.T + phase).sum(axis=1) * np.sqrt(2 / waves)
            for wave, phase in zip(self._wave, self._phase)
        ], axis=1)
