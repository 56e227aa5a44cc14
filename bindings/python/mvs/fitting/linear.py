"""The equilibrium at a fit, linearised with all chordae taut, and the energy of the posterior that it gives.

A chord that hangs slack at the fit says that it is longer than its length there, and nothing else. So all
chordae are taken as taut, at no tension where they hang slack, and the equilibrium is linearised there:

    tension t = t0 + T (w - w0),   residuals r = r0 + J (w - w0)

with w the lengths that act. A chord of length z acts with w = z while it is taut, and otherwise with
w = z - y, at which its tension vanishes: y >= 0, t >= 0, y t = 0, a linear complementarity problem.
"""

from __future__ import annotations

import dataclasses
import functools
from typing import TYPE_CHECKING, Optional

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..sensitivities import MOTION, NO_TEST
from ..sensitivity_rows import PARAMETER, QUANTITY
from .quiet import quiet
from .taut import just_taut

if TYPE_CHECKING:
    from .parameters import Free
    from .result import Fit

Array = NDArray[np.float64]
Quantity = tuple[int, int, int, None, None, Optional[Array]]
"""A row for Snapshot._sensitivity; the last: weights of the positions."""

EXACT, LINEARISED = 1e-9, 1e-7
"""N, residuals of the fit and of the valve whose chordae are all just taut: a node with a stiffness of 0.05 N/m
must not move as far as a chord of 10 mm is stretched then (taut.STRAIN)."""
SLACK = 1e-3
"""N, tension at the linearisation below which a chord is slack at the fit: a first guess."""
SOFTEST = 1e-6
"""Stiffness of a slack chord, of the stiffest: the least that makes the problem definite."""
FLIPS = 60
"""Changes of the set of slack chordae at most; block changes first, then one at a time."""
BLOCKS = 8
OUTLIER = 2.0
"""Difference of gradients, of their median, from which on it counts as that many: of a valve near another fold."""


@dataclasses.dataclass(frozen=True)
class Linear:
    """The equilibrium with all chordae taut: z at it, normal matrix J^T R^-1 J and J^T R^-1 r, the places of
    chord lengths among z, tensions, their slope T by all z, residuals r and Jacobian J in standard deviations
    of the data, which have the covariance R."""

    z: Array
    normal: Array
    right: Array
    chords: NDArray[np.int64]
    tension: Array
    slope: Array
    residual: Array
    jacobian: Array
    tilt: Optional[Array] = None
    first: Optional[Array] = None
    """Start of a chain; None: the fit."""

    @functools.cached_property
    def own(self) -> Array:
        """Tension by slack, of all chordae, with the stiffness of SOFTEST."""
        own = -self.slope[:, self.chords]
        return np.asarray(own + SOFTEST * np.abs(np.diag(own)).max(initial=0) * np.eye(len(own)))

    def slack_of(self, z: Array, guess: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
        """Slack y >= 0 of each chord, with w = z - y, and which are slack, from a guess of these: block
        principal pivoting with least-index steps at its end (Judice & Pires, 1994). Chordae in series share
        their tension, and the least slack is taken (SOFTEST)."""
        slack, own = guess.copy(), self.own
        taut = self.tension + self.slope @ (z - self.z)
        y = np.zeros(len(taut))
        for flip in range(FLIPS):
            y = np.zeros(len(taut))
            if slack.any():
                y[slack] = np.linalg.solve(own[np.ix_(slack, slack)], -taut[slack])
            wrong = np.where(slack, y < -1e-12, taut + own @ y < -1e-10)
            if not wrong.any():
                break
            slack = slack ^ (wrong if flip < BLOCKS else np.arange(len(wrong)) == np.argmax(wrong))
        return y, slack

    def residual_at(self, z: Array) -> Array:
        """The linear residuals."""
        d = z - self.z
        d[self.chords] -= self.slack_of(z, self.tension < SLACK)[0]
        return self.residual + self.jacobian @ d

    def with_errors(self, errors: Array) -> Linear:
        """With errors (n, data) of the residuals at draws. R = 1 + E^T E by the Woodbury identity."""
        mean = errors.mean(axis=0)
        spread = (errors - mean) / np.sqrt(len(errors) - 1)
        small = np.eye(len(errors)) + spread @ spread.T
        weighted = self.jacobian - spread.T @ np.linalg.solve(small, spread @ self.jacobian)
        return dataclasses.replace(self, normal=self.jacobian.T @ weighted,
                                   right=weighted.T @ (self.residual + mean))

    def tilt_of(self, gradients: Array) -> Array:
        """A constant for the gradient of `energy`: the mean of differences (n, p), in the metric of the
        posterior. Differences of more than OUTLIER medians count as that many (Huber): of valves near another
        fold, which the posterior has few of. The mean is shrunk by the share of chance in it (James & Stein)."""
        inverse = np.linalg.inv(self.normal + np.eye(len(self.z)))
        size = np.sqrt(np.einsum("ki,ij,kj->k", gradients, inverse, gradients))
        most = OUTLIER * np.median(size)
        kept = gradients * np.minimum(1, most / np.maximum(size, 1e-300))[:, None]
        mean = kept.mean(axis=0)
        chance = np.trace(inverse @ np.atleast_2d(np.cov(kept, rowvar=False))) / len(kept)
        share = 1 - chance / max(mean @ inverse @ mean, 1e-300)
        return np.asarray(max(share, 0.0) * mean)

    def energy(self, z: Array, slack: NDArray[np.bool_]) -> tuple[float, Array, NDArray[np.bool_]]:
        """Minus the logarithm of the posterior, its gradient, and the slack chordae."""
        y, slack = self.slack_of(z, slack)
        d = z - self.z
        d[self.chords] -= y
        pull = self.normal @ d
        value = 0.5 * z @ z + d @ (0.5 * pull + self.right)
        slope = pull + self.right
        rows = self.chords[slack]
        if len(rows):
            inside = self.own[np.ix_(slack, slack)]
            # dy = -inside^-1 slope dz of the slack chordae
            slope = slope + self.slope[slack].T @ np.linalg.solve(inside.T, slope[rows])
        if self.tilt is not None:
            value, slope = value + self.tilt @ z, slope + self.tilt
        return float(value), z + slope, slack


def linearised(fit: Fit, trees: bool = True) -> Linear:
    """The linearisation at a fit; trees: as of just_taut."""
    free, closed = fit.free, fit.closed
    chords = np.array([k for k, row in enumerate(free.rows) if row[0] == PARAMETER["length"]], np.int64)
    of = np.array([free.rows[k][1] for k in chords], np.int64)
    z = fit.z.copy()
    at = _settled(free, z, np.array(closed.node_position), closed, EXACT)
    if len(of):
        taut, places = just_taut(at, trees)
        z[chords] = (taut[of] - free.start[chords]) / free.deviation[chords]
        at = _settled(free, z, places, closed, LINEARISED)
    x = np.array(at.node_position)
    residual, nodes, directions = fit.target.residuals(x)
    quantities: list[Quantity] = [(QUANTITY["tension"], int(c), 0, None, None, None) for c in of]
    quantities = quantities or [(QUANTITY["linear"], 0, 0, None, None, np.zeros_like(x))]
    found = at._sensitivity(quantities, list(free.rows), MOTION | NO_TEST, None)
    motion = found["motion"].reshape(len(z), -1, 3)[:, nodes]
    jacobian = np.einsum("pki,ki->kp", motion, directions) * (free.deviation / fit.noise)
    tension, slope = np.zeros(0), np.zeros((0, len(z)))
    if len(of):
        tension = np.asarray(found["value"], float).copy()
        slope = np.asarray(found["derivative"], float).reshape(len(of), -1) * free.deviation
    scaled = residual / fit.noise
    return Linear(z, jacobian.T @ jacobian, jacobian.T @ scaled, chords, tension, slope, scaled, jacobian)


def _settled(free: Free, z: Array, places: Array, closed: _core.Snapshot, residual: float) -> _core.Snapshot:
    """The valve with parameters z, closed from these places under the load of another."""
    with quiet(), _core.Simulator(log=lambda level, text: None) as sim:
        sim.set_valve(free.valve(z, places))
        sim.set_load(closed.load_case.pressure, closed.load_case.boundary_fraction)
        sim.settle(residual=residual)
        return sim.snapshot()
