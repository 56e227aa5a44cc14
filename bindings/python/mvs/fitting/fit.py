"""Bounded Gauss-Newton fit of a closed valve (scipy.optimize.least_squares, trust region reflective) with
the exact Jacobian of Snapshot.sensitivity and normal priors."""

from __future__ import annotations

import time
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..errors import ArgumentError, DivergedError, OpError, StateError, ValveWarning
from ..sensitivities import MOTION, NO_TEST
from .checks import MOST_NOISE, checked_count, checked_groups, checked_number, checked_priors, checked_start
from .quiet import quiet
from .parameters import Free, Prior, free_parameters
from .result import MISFIT, Fit, Start, Trace, misfit_words
from .targets import Target, target_of

Array = NDArray[np.float64]

LOST = 10.0
"""Least residual in standard deviations of every datum of a trial that has no closed valve: it does not come to
rest, or the library refuses it."""

RADII = (8.0, 2.0, 0.5)
"""First trust regions, in standard deviations of the prior: about the length of a draw of 80 parameters; and, for
further starts, shorter ones, which follow a fold where a long step leaves it (tests/bench/fit/fit_starts.py)."""
SHORT_SEARCH = 2
"""Closures of a start with a short first step, times those of the first one."""


class Problem:
    """Residuals and Jacobian of one start; keeps the best and the last closure.

    Every trial starts from the best closure: a refused trial that snapped to another fold would else keep all
    later ones there.
    """

    def __init__(self, start: _core.Snapshot, free: Free, target: Target, noise: float,
                 with_prior: bool, residual: float) -> None:
        self.start, self.free, self.target = start, free, target
        self.noise, self.with_prior, self.residual = noise, with_prior, residual
        self.load = start.load_case
        self.last: tuple[bytes, Optional[_core.Snapshot]] = (b"", None)
        self.best_z: Array = np.zeros(len(free.labels))
        self.best_cost, self.best = np.inf, start
        self.closures = 0
        self.derivatives: Optional[Array] = None
        self.trace: list[Trace] = []
        # worse than the start, so that the step to such a trial is refused
        self.lost = max(LOST, 2 * float(np.abs(self.data(start)).max(initial=0)))
        self.sim = _core.Simulator(log=lambda level, text: None)

    def close(self, z: Array) -> Optional[_core.Snapshot]:
        """The closed valve with these parameters, from the best closed shape; None if it does not come to rest or
        the library refuses it."""
        if np.isfinite(self.best_cost) and np.array_equal(z, self.best_z):
            return self.best
        if self.last[0] != z.tobytes():
            self.last = (z.tobytes(), self._settle(z))
        return self.last[1]

    def _settle(self, z: Array) -> Optional[_core.Snapshot]:
        self.closures += 1
        with quiet():
            try:
                self.sim.set_valve(self.free.valve(z, self.best.node_position))
                self.sim.set_load(self.load.pressure, self.load.boundary_fraction)
                converged = self.sim.settle(residual=self.residual).converged
            except (DivergedError, OpError):
                return None
        return self.sim.snapshot() if converged else None

    def data(self, closed: _core.Snapshot) -> Array:
        return self.target.residuals(np.array(closed.node_position))[0] / self.noise

    def residuals(self, z: Array) -> Array:
        closed = self.close(z)
        count = len(self.data(self.start))
        r = self.data(closed) if closed is not None else np.full(count, self.lost)
        self.trace.append(Trace(self.closures, float(r @ r), float(z @ z), closed is not None))
        cost = 0.5 * float(r @ r + (z @ z if self.with_prior else 0))
        if closed is not None and cost < self.best_cost:
            self.best_z, self.best_cost, self.best = z.copy(), cost, closed
        return np.concatenate([r, z]) if self.with_prior else r

    def jacobian(self, z: Array) -> Array:
        j = self.data_jacobian(z)
        return np.vstack([j, np.eye(len(z))]) if self.with_prior else j

    def data_jacobian(self, z: Array) -> Array:
        """d(data residuals) / dz, from the exact derivatives at the closure. A closure that is about to
        snap has none: those of the last closure that had stand in for them."""
        closed = self.close(z)
        if closed is None:
            raise StateError("fit: the valve does not come to rest; tighten the priors or the bounds", "fit")
        nodes, directions = self.target.residuals(np.array(closed.node_position))[1:]
        try:
            found = closed._sensitivity([(2, 0, 0, None, None, np.zeros((len(closed.node_position), 3)))],
                                        list(self.free.rows), MOTION | NO_TEST, None)
        except (DivergedError, StateError):
            if self.derivatives is None:
                raise
            return self.derivatives
        motion = found["motion"].reshape(len(z), -1, 3)[:, nodes]
        self.derivatives = np.einsum("pki,ki->kp", motion, directions) * (self.free.deviation / self.noise)
        return self.derivatives


def fit(
    start: _core.Snapshot,
    target: Any,
    *,
    free: Union[str, Iterable[str]] = "chords",
    noise: float = 0.5e-3,
    priors: Union[None, bool, Mapping[str, Prior]] = None,
    starts: int = 1,
    residual: float = 1e-5,
    most: int = 15,
    tolerance: float = 1e-3,
) -> Fit:
    """Fits parameters of a closed valve to a measured shape (mvs.Fit); extra ``fit`` (scipy).

        found = mvs.fit(closed, (points, triangles), free=["chords", "heads"], noise=0.5e-3)
        found.table(); found.interval("coaptation"); found.save_report("fit.html")

    start: the closed valve at rest with the parameters to begin with
    target: mvs.Points (tracked nodes), mvs.Surface or (points, triangles) of the closed leaflets, m, or a
        closed mvs.Snapshot, in the frame of the valve; a mvs.imaging.LabelMap of the closed leaflets, each
        with a label of its own where they touch: the mid-surface of its voxels
    free: groups of parameters: "chords" (rest lengths), "tissue" (constants of each leaflet), "thickness",
        "heads" (coordinates), "prestrain"
    noise: m, standard deviation of the data
    priors: mvs.Prior by free group [mvs.PRIORS]; False: no priors, for which the data must have as many
        residuals as there are parameters
    starts: searches, of which the best is returned: up to three from the closure itself, with shorter and shorter
        first steps; further ones from other equilibria of its ensemble
    residual: N, at rest; most: closures of the first search, twice as many with shorter steps; tolerance: of
        the cost, relative

    The closure of each trial starts from the closed shape of the best one so far. The start is not changed. Bounds
    are those of the priors within the ranges of the law's constants and of the thickness; a trial that does not come
    to rest, or whose valve the library refuses, counts as worse than the start. ValveWarning if the model does not
    explain the data (Fit.misfit).
    """
    try:
        from scipy.optimize import least_squares
    except ImportError as error:
        raise ImportError("mvs.fit needs scipy: pip install 'libmvs[fit]'") from error
    start, groups = checked_start(start), checked_groups(free)
    noise = checked_number("noise", noise, MOST_NOISE)
    residual, tolerance = checked_number("residual", residual), checked_number("tolerance", tolerance)
    starts, most = checked_count("starts", starts), checked_count("most", most)
    if not start.at_rest:
        raise StateError("fit: the start is not at rest under its load: settle it first", "start")
    rows = free_parameters(start, groups, checked_priors(priors, groups))
    data = target_of(start, target)
    with_prior = priors is not False
    count = len(data.residuals(np.array(start.node_position))[0])
    if not with_prior and count < len(rows.labels):
        raise ArgumentError(
            f"fit: {count} residuals do not determine {len(rows.labels)} parameters without priors: give "
            "priors, more data, or fewer groups", "priors"
        )
    begun = time.process_time()
    fits, problems = [], []
    for first, radius in _searches(start, starts):
        problem = Problem(first, rows, data, noise, with_prior, residual)
        z = np.zeros(len(rows.labels))
        before = problem.residuals(z)
        fits.append(least_squares(problem.residuals, z, problem.jacobian, (rows.low, rows.high),
                                  method="trf", ftol=tolerance, xtol=1e-6, gtol=1e-6,
                                  max_nfev=most if radius == RADII[0] else SHORT_SEARCH * most,
                                  # "exact" is a dense SVD at each trial, whose BLAS threads take more
                                  # CPU than the closures where cores are shared; "lsmr" takes a step in a
                                  # plane, which one parameter does not have
                                  tr_solver="lsmr" if len(z) > 1 else "exact", x_scale=radius))
        problems.append((problem, before))
    found = _result(start, rows, data, noise, with_prior, fits, problems, begun)
    if found.misfit > MISFIT:
        warnings.warn(f"fit: {misfit_words(found)}", ValveWarning, stacklevel=2)
    return found


def _searches(start: _core.Snapshot, starts: int) -> list[tuple[_core.Snapshot, float]]:
    """The valve and the first trust region of each search."""
    searches = [(start, radius) for radius in RADII[:starts]]
    others = _folds(start, 1 + max(starts - len(RADII), 0))[1:]
    return searches + [(fold, RADII[0]) for fold in others]


def _folds(start: _core.Snapshot, starts: int) -> list[_core.Snapshot]:
    """The start and distinct equilibria of its ensemble."""
    if starts == 1:
        return [start]
    load = start.load_case
    with quiet():
        ensemble = start.ensemble(load.pressure, load.boundary_fraction, members=starts)
    firsts, seen = [start], set()
    for number, member in enumerate(ensemble.members):
        if member.converged and member.equilibrium not in seen:
            seen.add(member.equilibrium)
            if number > 0:
                firsts.append(ensemble.snapshot(number))
    return firsts


def _result(start: _core.Snapshot, rows: Free, data: Target, noise: float, with_prior: bool,
            fits: list[Any], problems: list[Any], begun: float) -> Fit:
    costs = [problem.best_cost for problem, _ in problems]
    best = int(np.argmin(costs))
    problem, before = problems[best]
    closed, z = problem.best, problem.best_z
    if not np.isfinite(costs[best]):
        raise StateError("fit: no trial came to rest; tighten the priors or the bounds", "fit")
    return Fit(
        start=start, closed=closed, free=rows, target=data, noise=noise, z=z,
        jacobian=problem.data_jacobian(z), with_prior=with_prior,
        residuals_before=before[: len(problem.data(start))] * noise,
        residuals_after=problem.data(closed) * noise,
        starts=tuple(Start(cost, problems[k][0].closures, fits[k].message, fits[k].status > 0)
                     for k, cost in enumerate(costs)),
        converged=fits[best].status > 0,
        trace=tuple(problem.trace), closures=sum(p.closures for p, _ in problems),
        cpu_seconds=time.process_time() - begun,
    )
