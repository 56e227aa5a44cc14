"""Draws from the posterior of a fit where chordae may be slack.

The posterior of a chord that hangs slack at the fit is one-sided, and the normal approximation of
Fit.covariance does not describe it. Draws are from that of the linearisation with all chordae taut
(linear.py), whose residuals r(z) follow from a linear complementarity problem, by Hamiltonian Monte Carlo
(Neal, MCMC using Hamiltonian dynamics, 2011) with the normal prior, its bounds, and these residuals.

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
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..errors import DivergedError, OpError, StateError
from ..sensitivities import NO_TEST
from ..sensitivity_rows import QUANTITY
from .linear import SLACK, Linear, linearised

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .. import _core
    from .fit import Problem
    from .result import Fit

Array = NDArray[np.float64]

STEP = 0.25
"""Leapfrog step, in standard deviations of a posterior whose chordae are all taut; STEPS of them."""
STEPS = 15
CLOSED = 30
"""Valves that are closed for the errors of the linearisation, and again for those of its gradient."""
PILOT = 3
"""Trajectories from one of these draws to the next."""
MOVES = 12
"""Draws that try a tilted posterior; if they do not move, half of the tilt is taken: it may move the mean beyond
the bounds."""
MOVING = 0.7
"""Share of different draws from which a chain is taken to move; most have 0.9 or more."""
PATIENCE = 5
AT_REST = 1e-5
"""N, as in a fit."""


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
        except (DivergedError, OpError, StateError):
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
    """The draws whose valves close, with the problem of the fit and their closed valves."""
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
    low, high = fit.free.low, fit.free.high
    guess = linear.tension < SLACK
    # the mass is the posterior precision of a valve whose chordae are all taut
    inverse = np.linalg.inv(np.linalg.cholesky(linear.normal + np.eye(len(fit.z))))
    z = np.clip(fit.z if linear.first is None else linear.first, 0.999 * low, 0.999 * high)
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
        inside = bool(((there >= low) & (there <= high)).all())
        if inside and np.log(random.uniform()) < begun - energy - 0.5 * momentum @ momentum:
            z, value, slope = there, energy, grade
        if number >= 4 * thin and number % thin == 0:
            drawn.append(z.copy())
    return np.array(drawn)
