"""Result of a fit: parameters with intervals, what the data determine, predictions."""

from __future__ import annotations

import dataclasses
import functools
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..errors import ArgumentError
from ..sensitivities import NO_TEST
from ..sensitivity_rows import SHORT, measure_names
from ..tables import Table
from ..values import Measures, unit_of
from ..words import did_you_mean, listed, shown
from .checks import checked_count, checked_level
from .parameters import Free
from .targets import Target

if TYPE_CHECKING:
    from .linear import Linear

Array = NDArray[np.float64]

ILL_CONDITIONED = 1e8
"""Ratio of the largest to the smallest singular value of the fit from which its intervals mean little."""
MISFIT = 1.5
"""Residual in standard deviations of the data above which the model does not explain them: noise alone gives 1."""


@dataclasses.dataclass(frozen=True)
class Interval:
    """A predicted quantity: value at the fit, standard deviation, and interval of a level."""

    name: str
    unit: str
    value: float
    deviation: float
    low: float
    high: float
    level: float
    samples: Optional[Array] = dataclasses.field(default=None, repr=False)


@dataclasses.dataclass(frozen=True)
class Start:
    """One start of a fit: half the sum of squares at its end, closures, why it ended, and whether there."""

    cost: float
    closures: int
    message: str
    converged: bool


@dataclasses.dataclass(frozen=True)
class Trace:
    """One trial: closures so far, squares of data and prior in standard deviations, whether at rest."""

    closures: int
    data: float
    prior: float
    at_rest: bool


@dataclasses.dataclass(frozen=True, eq=False)
class Fit:
    """A fitted valve, `closed`, with the uncertainty of its parameters.

    z: parameters in standard deviations of their priors; jacobian: of the data residuals over `noise`,
    by z; residuals_before, residuals_after: m; converged: whether the search ended within its tolerance, not
    at its number of closures
    """

    start: _core.Snapshot
    closed: _core.Snapshot
    free: Free
    target: Target
    noise: float
    z: Array
    jacobian: Array
    with_prior: bool
    residuals_before: Array
    residuals_after: Array
    starts: tuple[Start, ...]
    trace: tuple[Trace, ...]
    converged: bool
    closures: int
    cpu_seconds: float

    @property
    def values(self) -> Array:
        """The fitted parameters in their units, in the order of `free.labels`."""
        return self.free.values(self.z)

    @property
    def singular_values(self) -> Array:
        """Singular values of the Jacobian in standard deviations of data and prior: directions above 1 are determined
        better by the data than by the prior."""
        return np.asarray(np.linalg.svd(self.jacobian, compute_uv=False), float)

    @property
    def determined(self) -> Array:
        """Share of the prior variance of each parameter that the data remove: 1 determined, 0 not."""
        if not self.with_prior:
            return np.ones(len(self.z))
        return np.clip(1 - np.diag(self.covariance_z), 0, 1)  # rounding may leave less than 0

    @property
    def covariance_z(self) -> Array:
        """Posterior covariance of z (Laplace's approximation): (J^T J + I)^-1."""
        normal = self.jacobian.T @ self.jacobian + (np.eye(len(self.z)) if self.with_prior else 0)
        return np.asarray(np.linalg.pinv(normal, hermitian=True), float)

    @property
    def covariance(self) -> Array:
        """Posterior covariance of the parameters in their units."""
        d = self.free.deviation
        return d[:, None] * self.covariance_z * d[None, :]

    @functools.cached_property
    def posterior(self) -> Linear:
        """The linearised posterior that `sample` draws from, with the error of its linearisation, for which 30
        valves are closed once."""
        from .posterior import linear_posterior

        return linear_posterior(self)

    @property
    def condition(self) -> float:
        """Condition number of the least-squares problem, priors included."""
        s = np.linalg.svd(np.vstack([self.jacobian, np.eye(len(self.z))]) if self.with_prior
                          else self.jacobian, compute_uv=False)
        return float(s[0] / s[-1]) if s[-1] > 0 else float("inf")

    @property
    def rms(self) -> float:
        """m, root mean square of the residuals at the end."""
        return float(np.sqrt(np.mean(self.residuals_after**2)))

    @property
    def misfit(self) -> float:
        """RMS of the residuals in standard deviations of the data, the root of chi2/n: about 1 or less if the model
        explains the data. Above 1.5 it does not, and all intervals are too narrow."""
        return self.rms / self.noise

    def table(self) -> Table:
        """A row a parameter: start, value, posterior and prior deviation, share determined, at a bound."""
        units = {"parameter": "", "unit": "", "start": "", "value": "", "deviation": "", "prior": "",
                 "determined": "", "at_bound": ""}
        deviation, at_bound = np.sqrt(np.diag(self.covariance)), self.free.at_bound(self.z)
        return Table(
            (
                {"parameter": label, "unit": self.free.units[k], "start": float(self.free.start[k]),
                 "value": float(self.values[k]), "deviation": float(deviation[k]),
                 "prior": float(self.free.deviation[k]), "determined": float(self.determined[k]),
                 "at_bound": bool(at_bound[k])}
                for k, label in enumerate(self.free.labels)
            ),
            units,
        )

    def interval(self, of: str, level: float = 0.9, samples: int = 0, seed: int = 0) -> Interval:
        """Posterior predictive interval of a measure of the closed valve.

        samples: 0: by its derivative, to first order; else closures of draws from the posterior
            (sample), for measures that are not smooth, such as a leak
        """
        level = checked_level(level)
        name = _measure(of)
        unit = unit_of(Measures, name)
        if samples != 0:
            value = float(getattr(self.closed.measures, name))
            drawn = self.draws(name, checked_count("samples", samples), seed)
            low, high = np.quantile(drawn, [0.5 - level / 2, 0.5 + level / 2])
            return Interval(name, unit, value, float(np.std(drawn)), float(low), float(high), level, drawn)
        found = self.closed._sensitivity([(8, 0, 0, name, None, None)], list(self.free.rows), NO_TEST, None)
        value = float(found["value"][0])
        slope = np.asarray(found["derivative"][0]) * self.free.deviation
        deviation = float(np.sqrt(max(float(slope @ self.covariance_z @ slope), 0.0)))
        reach = _normal_quantile(0.5 + level / 2) * deviation
        return Interval(name, unit, value, deviation, value - reach, value + reach, level)

    def draws(self, measure: str, samples: int, seed: int = 0) -> Array:
        """The measure of closed valves with parameters drawn from the posterior, within the bounds; without draws
        that do not come to rest, or that the library refuses."""
        name = _measure(measure)
        found = [getattr(closed.measures, name) for closed in self.closures_of(self.sample(samples, seed))]
        if not found:
            raise ArgumentError("interval: no draw came to rest; use samples=0", "samples")
        return np.array(found)

    def sample(self, count: int, seed: int = 0) -> Array:
        """Parameters z (count, p) drawn from the posterior within the bounds. With priors, chordae that hang
        slack have their one-sided posterior (fitting/posterior.py), which covariance does not describe."""
        from .posterior import draw

        count, seed = checked_count("count", count), checked_count("seed", seed, 0)
        if self.with_prior:
            return draw(self, count, seed)
        random = np.random.default_rng(seed)
        root = np.linalg.cholesky(self.covariance_z + 1e-12 * np.eye(len(self.z)))
        drawn = self.z + random.normal(size=(count, len(self.z))) @ root.T
        return np.clip(drawn, self.free.low, self.free.high)

    def closures_of(self, drawn: Array) -> Iterator[_core.Snapshot]:
        """The closed valve of each row of parameters z, from the fitted shape; without those that do not come to
        rest, or that the library refuses."""
        from .fit import Problem

        problem = Problem(self.closed, self.free, self.target, self.noise, self.with_prior, 1e-5)
        for z in drawn:
            closed = problem.close(z)
            if closed is not None:
                yield closed

    def save_report(self, path: Union[str, os.PathLike[str]], measures: Any = None) -> None:
        """Writes an HTML page: parameters, intervals, covariance, trace, shape before and after."""
        from .report import page_of

        text = page_of(self, measures)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def __repr__(self) -> str:
        doubt = f"; {misfit_words(self)}" if self.misfit > MISFIT else ""
        return (f"<mvs.Fit: {len(self.z)} parameters, residual {self.rms * 1e3:.3f} mm RMS, "
                f"{self.closures} closures{'' if self.converged else ', not converged'}{doubt}>")


def misfit_words(found: Fit) -> str:
    """The meaning of a residual above MISFIT."""
    return (f"the residual is {found.misfit:.1f} times the noise: the model does not explain the data, and the "
            "intervals are too narrow")


def _measure(name: str) -> str:
    """A measure that has a derivative, from its name or its short name."""
    full = SHORT.get(name, name) if isinstance(name, str) else None
    if full not in measure_names():
        known = [*SHORT, *measure_names()]
        near = did_you_mean(name, known) if isinstance(name, str) else ""
        raise ArgumentError(f"of: {shown(name)} is no measure with a derivative{near}; there are {listed(known)}",
                            "of")
    return str(full)


def _normal_quantile(p: float) -> float:
    from statistics import NormalDist

    return NormalDist().inv_cdf(p)
