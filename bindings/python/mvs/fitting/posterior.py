"""Draws from the posterior of a fit where chordae may be slack.

A chord that hangs slack at the fit says that it is longer than its length there, and nothing else: its
posterior is one-sided, and the normal approximation of Fit.covariance does not describe it. So all
chordae are taken as taut, at no tension where they hang slack, and the equilibrium is linearised there:

    tension t = t0 + T (w - w0),   residuals r = r0 + J (w - w0)

with w the lengths that act. A chord of length z acts with w = z while it is taut, and otherwise with
w = z - y, at which its tension vanishes: y >= 0, t >= 0, y t = 0, a linear complementarity problem.
Draws of z are by Hamiltonian Monte Carlo (Neal, MCMC using Hamiltonian dynamics, 2011) with the normal
prior, its bounds, and the residuals of w(z).

Far from the fit the equilibrium is not linear. So valves are closed at first draws, and the difference e of
their residuals from the linear ones is taken as an error of the model, normal with the mean and covariance
of these draws and independent of z (the approximation error of Kaipio & Somersalo, J. Comput. Appl. Math.
198, 2007): the residuals gain its mean, the noise its covariance. More rounds of this changed nothing.

The error is not independent of z: a Jacobian that grows where residuals do moves the mean. So the mean
difference of the exact gradient of minus the logarithm of the posterior, at closed draws, from that of the
linearised one is added to the latter as a constant (`tilt`): the condition that its draws have the mean
gradient of zero that those of the posterior have (Opper & Archambeau, Neural Computation 21, 2009, with the
curvature left as it is). Without it marginal chordae of the posterior leaflet came out 0.3 deviations too long
(tests/validation/calibration.py).
"""

from __future__ import annotations

import dataclasses
import functools
from typing import TYPE_CHECKING, Optional

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..errors import DivergedError, StateError
from ..sensitivities import MOTION, NO_TEST, PARAMETER, QUANTITY
from .quiet import quiet
from .taut import just_taut

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .fit import Problem
    from .parameters import Free
    from .result import Fit

Array = NDArray[np.float64]

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
STEP = 0.25
"""Leapfrog step, in standard deviations of a posterior whose chordae are all taut; STEPS of them."""
STEPS = 15
CLOSED = 30
"""Valves that are closed for the errors of the linearisation, and again for those of its gradient."""
PILOT = 3
"""Trajectories from one of these draws to the next."""
OUTLIER = 2.0
"""Difference of gradients, of their median, from which on it counts as that many: of a valve near another fold."""
MOVES = 12
"""Draws that try a tilted posterior; if they do not move, half of the tilt is taken: it may move the mean beyond
the bounds."""
MOVING = 0.7
"""Share of different draws from which a chain is taken to move; most have 0.9 or more."""
PATIENCE = 5
AT_REST = 1e-5
"""N, as in a fit."""


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
        return own + SOFTEST * np.abs(np.diag(own)).max(initial=0) * np.eye(len(own))

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
        return max(share, 0.0) * mean

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
    quantities = [(QUANTITY["tension"], int(c), 0, None, None, None) for c in of]
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


def _normal(fit: Fit) -> Linear:
    """Without chordae that may be slack: the normal posterior of the fit."""
    scaled = fit.residuals_after / fit.noise
    return Linear(fit.z, fit.jacobian.T @ fit.jacobian, fit.jacobian.T @ scaled, np.zeros(0, np.int64),
                  np.zeros(0), np.zeros((0, len(fit.z))), scaled, fit.jacobian)


def linear_posterior(fit: Fit) -> Linear:
    """The linearisation at a fit with its errors at CLOSED valves and those of its gradient at as many. At a fit
    that is about to snap, where the linearisation fails, that of the normal posterior."""
    random = np.random.default_rng(0)
    for make in (linearised, lambda fit: linearised(fit, trees=False), _normal):
        try:
            linear = make(fit)
        except (DivergedError, StateError):
            continue
        drawn = _chain(fit, linear, CLOSED, random, PILOT)
        # a complementarity problem with several solutions stops the chain: the valve is about to snap where
        # these chordae pull
        if _moves(drawn):
            break
    errors = _errors(fit, linear, drawn)
    if len(errors) < 2:
        return linear
    linear = dataclasses.replace(linear.with_errors(errors), first=drawn[-1])
    drawn = _chain(fit, linear, CLOSED, random, PILOT)
    linear = dataclasses.replace(linear, first=drawn[-1])
    gradients = _gradients(fit, linear, drawn)
    if len(gradients) < 2:
        return linear
    tilt = linear.tilt_of(gradients)
    for share in (1, 0.5, 0.25, 0.125):
        tilted = dataclasses.replace(linear, tilt=share * tilt)
        drawn = _chain(fit, tilted, MOVES, random, PILOT)
        if _moves(drawn):
            return dataclasses.replace(tilted, first=drawn[-1])
    return linear


def _moves(drawn: Array) -> bool:
    """Whether a chain is not stopped: MOVING of its draws differ."""
    return len(np.unique(drawn[:, 0])) >= MOVING * len(drawn)


def draw(fit: Fit, count: int, seed: int, thin: int = 6) -> Array:
    """Parameters z (count, p) from the posterior within the bounds, each `thin` trajectories after the last, or
    PATIENCE times as many where a chain seldom moves; from the fit if it does not move at all."""
    random = np.random.default_rng(seed)
    for first, times in ((fit.posterior.first, 1), (fit.posterior.first, PATIENCE), (None, PATIENCE)):
        drawn = _chain(fit, dataclasses.replace(fit.posterior, first=first), count, random, times * thin)
        if _moves(drawn):
            break
    return drawn


def _closures(fit: Fit, drawn: Array) -> Iterator[tuple[Array, Problem, _core.Snapshot]]:
    """The draws that come to rest, with the problem of the fit and their closed valves."""
    from .fit import Problem

    problem = Problem(fit.closed, fit.free, fit.target, fit.noise, fit.with_prior, AT_REST)
    for z in drawn:
        closed = problem.close(z)
        if closed is not None:
            yield z, problem, closed


def _errors(fit: Fit, linear: Linear, drawn: Array) -> Array:
    """Residuals of closed valves less the linear ones, a row a draw that comes to rest."""
    return np.array([problem.data(closed) - linear.residual_at(z) for z, problem, closed in _closures(fit, drawn)])


def _gradients(fit: Fit, linear: Linear, drawn: Array) -> Array:
    """Gradients of minus the logarithm of the posterior at closed valves, by one adjoint solution each, less
    those of its linearisation: a row a draw that comes to rest and is not about to snap."""
    rows = []
    for z, _, closed in _closures(fit, drawn):
        residual, nodes, directions = fit.target.residuals(np.array(closed.node_position))
        weights = np.zeros((len(closed.node_position), 3))
        np.add.at(weights, nodes, (residual / fit.noise**2)[:, None] * directions)
        linear_part = (QUANTITY["linear"], 0, 0, None, None, weights)
        try:
            found = closed._sensitivity([linear_part], list(fit.free.rows), NO_TEST, None)
        except (DivergedError, StateError):
            continue
        exact = z + np.asarray(found["derivative"][0]) * fit.free.deviation
        rows.append(exact - linear.energy(z, linear.tension < SLACK)[1])
    return np.array(rows)


def _chain(fit: Fit, linear: Linear, count: int, random: np.random.Generator, thin: int) -> Array:
    """Draws from the posterior of a linearisation by Hamiltonian Monte Carlo. The complementarity problem may have
    several solutions; each is sought from one guess, so that the energy is a function of z alone, without which
    these are no draws: with the last solution as a guess chains fell into one that was never found again."""
    reach = fit.free.reach
    guess = linear.tension < SLACK
    # the mass is the posterior precision of a valve whose chordae are all taut
    inverse = np.linalg.inv(np.linalg.cholesky(linear.normal + np.eye(len(fit.z))))
    z = np.clip(fit.z if linear.first is None else linear.first, -0.999 * reach, 0.999 * reach)
    value, slope, _ = linear.energy(z, guess)
    drawn = []
    for number in range((count + 4) * thin):
        momentum = random.normal(size=len(z))
        begun, there = value + 0.5 * momentum @ momentum, z
        grade, energy = slope, value
        step = STEP * random.uniform(0.6, 1.2)
        for _ in range(STEPS):
            momentum = momentum - 0.5 * step * (inverse @ grade)
            there = there + step * (momentum @ inverse)
            energy, grade, _ = linear.energy(there, guess)
            momentum = momentum - 0.5 * step * (inverse @ grade)
        # bounds at the end only: most paths of a hundred parameters touch one
        inside = bool((np.abs(there) <= reach).all())
        if inside and np.log(random.uniform()) < begun - energy - 0.5 * momentum @ momentum:
            z, value, slope = there, energy, grade
        if number >= 4 * thin and number % thin == 0:
            drawn.append(z.copy())
    return np.array(drawn)
