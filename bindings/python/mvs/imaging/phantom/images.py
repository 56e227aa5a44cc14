"""Grey values of a valve: micro-CT-like and 3D-ultrasound-like volumes from the share of each part.

Micro-CT: attenuation of each part times its share, blurred by a Gaussian PSF, times a smooth bias
field, plus white Gaussian noise; signed 16 bit, background 200, tissue about 1200.

Ultrasound: a field of random scatterers whose density follows echogenicity, filtered by a Gaussian
PSF that is wider across the beam (Rayleigh-distributed, correlated speckle), plus electronic noise;
its envelope is log-compressed to 40 dB and 8 bit. Leaflets along the beam reflect less (drop-out).
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from .distance import Sheet
from .grid import Grid
from .settings import Settings
from .smooth_noise import SmoothNoise

Array = NDArray[np.float32]
FWHM = 2.3548
"""of a Gaussian over its standard deviation"""

ATTENUATION = {"leaflet": 1000.0, "chordae": 1050.0, "muscles": 900.0, "wall": 850.0}
BACKGROUND = 200.0

ECHO = {"leaflet": 1.0, "chordae": 0.8, "muscles": 0.7, "wall": 1.3, "blood": 0.012}
"""Amplitudes; blood is nearly anechoic."""
DYNAMIC_RANGE_DB, BRIGHTEST_DB = 40.0, 6.0
TRANSDUCER = 60.0
"""mm, its distance from the centre of the volume, on the side of the atrium"""


@dataclasses.dataclass(frozen=True)
class Share:
    """The share of each voxel that one part covers, after the parts that lie over it."""

    part: str
    share: Array


class Shares:
    """Collects the shares of parts in order; each part takes what those before it left."""

    def __init__(self, grid: Grid) -> None:
        self.rest: Array = np.ones(grid.shape, dtype=np.float32)
        self.parts: list[Share] = []

    def add(self, part: str, share: Array) -> None:
        """Adds a part that lies under those added before."""
        taken = np.minimum(share, self.rest)
        self.rest -= taken
        self.parts.append(Share(part, taken))


def micro_ct_image(grid: Grid, shares: Shares, settings: Settings, stage: int) -> NDArray[np.int16]:
    """The micro-CT-like volume [k, j, i]."""
    blurred = _blurred(_attenuation(grid, shares), settings)
    random = np.random.default_rng([settings.seed, 4, stage])
    value = BACKGROUND + blurred * (1 + settings.bias * _bias(grid, random))
    del blurred  # a volume is large
    value += ATTENUATION["leaflet"] * settings.noise * random.standard_normal(
        grid.shape, dtype=np.float32
    )
    return np.clip(np.rint(value), -32768, 32767).astype(np.int16)


def ultrasound_image(
    grid: Grid, shares: Shares, reflection: Array, settings: Settings, stage: int
) -> NDArray[np.uint8]:
    """The ultrasound-like volume [k, j, i]; k is the direction of the beam.

    reflection: [k, j, i], the share of the amplitude that a leaflet reflects (reflection_of)
    """
    energy = ECHO["blood"] ** 2 * shares.rest
    for part in shares.parts:
        amplitude = ECHO[part.part] * (reflection if part.part == "leaflet" else 1.0)
        energy = energy + part.share * np.float32(1) * np.square(amplitude, dtype=np.float32)
    random = np.random.default_rng([settings.seed, 4, stage])
    scatter = [
        _blurred(random.standard_normal(grid.shape, dtype=np.float32) * np.sqrt(energy), settings)
        for _ in range(2)
    ]
    scale = np.float32(1 / np.sqrt(2 * _kernel_energy(settings)))
    gain = 1 - settings.bias * 0.5 * (1 + _bias(grid, random))
    envelope = np.zeros(grid.shape, dtype=np.float32)
    for field in scatter:
        noise = settings.noise / np.sqrt(2) * random.standard_normal(grid.shape, dtype=np.float32)
        envelope += np.square(gain * scale * field + noise, dtype=np.float32)
    decibel = 10 * np.log10(np.maximum(envelope, 1e-12)) - BRIGHTEST_DB
    return np.clip(np.rint(255 * (1 + decibel / DYNAMIC_RANGE_DB)), 0, 255).astype(np.uint8)


def reflection_of(
    grid: Grid, sheets: tuple[Sheet, ...], elements: list[NDArray[np.int32]], settings: Settings
) -> Array:
    """The share of the amplitude that leaflets reflect at each voxel, [k, j, i].

    1 where a leaflet is square to the beam, 1 - drop_out where it is along it, and a fifth of that
    in random patches of about 4 mm on a tenth of the leaflets, where acoustic windows are lost.
    """
    found = np.ones(grid.shape, dtype=np.float32)
    centre = grid.to_patient(np.array(grid.size)[None] / 2.0 - 0.5)[0]
    transducer = centre - TRANSDUCER * grid.axes[:, 2]
    lost = SmoothNoise(np.random.default_rng([settings.seed, 5]), 1, 8.0)
    for sheet, element in zip(sheets, elements):
        voxels = np.argwhere(element >= 0)
        points = grid.to_patient(voxels[:, ::-1].astype(float))
        corners = sheet.points[sheet.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        beam = points - transducer
        beam /= np.linalg.norm(beam, axis=1, keepdims=True)
        facing = np.abs((normals[element[tuple(voxels.T)]] * beam).sum(axis=1))
        share = 1 - settings.drop_out * (1 - facing)
        patch = lost.at(points)[:, 0] > 1.28  # a tenth of a normal deviate is above 1.28
        share[patch] *= 1 - 0.8 * settings.drop_out
        found[tuple(voxels.T)] = share
    return found


def _attenuation(grid: Grid, shares: Shares) -> Array:
    value = np.zeros(grid.shape, dtype=np.float32)
    for part in shares.parts:
        value += ATTENUATION[part.part] * part.share
    return value


def _blurred(value: Array, settings: Settings) -> Array:
    from scipy.ndimage import gaussian_filter

    return np.asarray(gaussian_filter(value, _sigmas(settings), mode="nearest", truncate=4.0))


def _sigmas(settings: Settings) -> tuple[float, float, float]:
    axial, lateral = (width / FWHM / settings.spacing for width in settings.blur)
    return axial, lateral, lateral


def _kernel_energy(settings: Settings) -> float:
    """The sum of the squares of the kernel of _blurred: its gain for the power of white noise."""
    from scipy.ndimage import gaussian_filter1d

    energy = 1.0
    for sigma in _sigmas(settings):
        one = np.zeros(2 * int(np.ceil(4 * sigma)) + 3)
        one[len(one) // 2] = 1
        if sigma > 0:  # gaussian_filter leaves out such axes, gaussian_filter1d divides by 0
            energy *= float((gaussian_filter1d(one, sigma, truncate=4.0) ** 2).sum())
    return energy


def _bias(grid: Grid, random: np.random.Generator) -> Array:
    """A smooth field between -1 and 1: a random polynomial of second order over the volume."""
    axes = [np.linspace(-1, 1, n, dtype=np.float32) for n in grid.shape]
    k, j, i = np.meshgrid(*axes, indexing="ij", sparse=True)
    c = random.normal(size=9).astype(np.float32)
    field = c[0] * k + c[1] * j + c[2] * i + c[3] * k * j + c[4] * j * i + c[5] * k * i
    field = field + c[6] * (k * k - 1 / 3) + c[7] * (j * j - 1 / 3) + c[8] * (i * i - 1 / 3)
    return np.asarray(field / np.float32(max(np.abs(field).max(), 1e-12)))
