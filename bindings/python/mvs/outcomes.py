"""Outcomes of calculations: statistics of settles and steps, stability, distances between shapes, members
of an ensemble; in SI units, with unit and definition of each field."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Optional

import numpy as np
from numpy.typing import NDArray

from .describe import with_field_help
from .kinds import EnsembleOrder


@with_field_help
@dataclasses.dataclass(frozen=True)
class Stability:
    """Stability of an equilibrium: of overdamped motion, D dx/dt = -K x, D = 500 1/s times the mass.

    K = Ks + N, N the skew part that the follower pressure has at the free edge.
    """

    stable: Annotated[bool, "1", "growth_rate is at most 1e-3 1/s, or Ks is positive definite"]
    stiffness_margin: Annotated[float, "N/m", "smallest eigenvalue of Ks: near 0 a fold may snap"]
    growth_rate: Annotated[float, "1/s", "largest real part of an eigenvalue of -D^-1 K"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Profile:
    """Work done and avoided in a settle or step. Experimental; times are those of this run."""

    skipped: Annotated[int, "1", "MVS_SKIPPED_* bits: work not done in the whole settle or step"]
    factorisations: Annotated[int, "1", "sparse factorisations"]
    shifted: Annotated[int, "1", "iterations with a diagonal shift for positive definiteness"]
    broad_phases: Annotated[int, "1", "broad phases run"]
    orderings: Annotated[int, "1", "new sparsity patterns with their symbolic analysis"]
    linear_iterations: Annotated[int, "1", "iterations of iterative linear solvers"]
    passes: Annotated[int, "1", "evaluations of energy, gradient or Hessian over all terms"]
    untangled: Annotated[int, "1", "crossings removed after interpolation from a coarser mesh"]
    discarded_levels: Annotated[int, "1", "shapes of coarser meshes that were given up"]
    terms_s: Annotated[float, "s", "energy, gradient and Hessian blocks of the terms"]
    broad_s: Annotated[float, "s", "broad phase and step limiter"]
    narrow_s: Annotated[float, "s", "narrow phase: distances"]
    assembly_s: Annotated[float, "s", "blocks into the sparse matrix"]
    ordering_s: Annotated[float, "s", "symbolic analysis"]
    factor_s: Annotated[float, "s", "numeric factorisation"]
    solve_s: Annotated[float, "s", "solutions with the factor"]
    line_search_s: Annotated[float, "s", "trial energies with their distances"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Stats:
    """Outcome of the last settle or step. Ending without convergence raises no error."""

    converged: Annotated[bool, "1", "1: the residual is reached, and nothing has changed since"]
    iterations: Annotated[int, "1", "Newton iterations, or time steps"]
    contact_pairs: Annotated[int, "1", "active contact pairs at the end"]
    lowered: Annotated[int, "1", "MVS_LOWERED_* bits: accuracy given up for the budget of a step"]
    stable: Annotated[
        bool, "1", "1: the last settle found a stable equilibrium, and nothing has changed since"
    ]
    residual: Annotated[float, "N", "largest out-of-balance force on a free node or tool point"]
    energy: Annotated[float, "J", "potential energy at the end, without the work of the pressure at the free edge"]
    kinetic: Annotated[float, "J", "kinetic energy at the end"]
    wall_s: Annotated[float, "s", "elapsed time"]
    stiffness_margin: Annotated[
        float, "N/m", "smallest eigenvalue of the symmetric tangent stiffness at the equilibrium found"
    ]
    growth_rate: Annotated[
        float,
        "1/s",
        "rightmost eigenvalue of overdamped motion at the equilibrium found: negative where it is stable",
    ]
    profile: Annotated[Profile, "1", "work done and avoided"]


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False)
class Comparison:
    """Distances between two shapes. Node figures are NaN if the meshes do not match."""

    same_mesh: Annotated[bool, "1", "the meshes match and node-to-node figures exist"]
    node_rms: Annotated[float, "m", "node to node, RMS, as they lie"]
    node_max: Annotated[float, "m", "node to node, largest, as they lie"]
    surface_rms: Annotated[float, "m", "symmetric surface distance, RMS, as they lie"]
    surface_max: Annotated[float, "m", "symmetric surface distance, largest, as they lie"]
    node_rms_registered: Annotated[float, "m", "node to node, RMS, after the best rigid motion"]
    node_max_registered: Annotated[float, "m", "node to node, largest, after the best rigid motion"]
    surface_rms_registered: Annotated[float, "m", "surface, RMS, after the best rigid motion"]
    surface_max_registered: Annotated[float, "m", "surface, largest, after the best rigid motion"]
    registration: Annotated[NDArray[np.float64], "m", "rows of [R | t], 3 x 4: b ~ R a + t"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class EnsembleSummary:
    """Distances over all members of an ensemble at rest, without registration."""

    members: Annotated[int, "1", "closures, the plain one included"]
    converged: Annotated[int, "1", "members at rest"]
    equilibria: Annotated[int, "1", "distinct shapes among them; a shape and its mirror image are two"]
    lowest: Annotated[Optional[int], "1", "member at rest of lowest energy; None: none at rest"]
    node_rms: Annotated[float, "m", "node to node, RMS over all pairs of members"]
    node_max: Annotated[float, "m", "largest distance of a node between any two members"]
    surface_rms: Annotated[float, "m", "surface distance from member 0, RMS over the others"]
    surface_max: Annotated[float, "m", "the largest distance from the surface of member 0"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class EnsembleMember:
    """One member of an ensemble: its loading path, and its distance from member 0 at the end."""

    converged: Annotated[bool, "1", "at rest; the statistics use only such members"]
    diverged: Annotated[bool, "1", "left the range of numbers; its snapshot is its start"]
    increments: Annotated[int, "1", "equal steps in which the pressure is applied"]
    order: Annotated[EnsembleOrder, "1", "order of boundary motion and pressure"]
    equilibrium: Annotated[Optional[int], "1", "number of its shape; None: not at rest"]
    perturbation: Annotated[float, "m", "largest displacement of a node of its start"]
    node_rms: Annotated[float, "m", "node to node from member 0, RMS"]
    node_max: Annotated[float, "m", "node to node from member 0, largest"]
    surface_rms: Annotated[float, "m", "symmetric surface distance from member 0, RMS"]
    surface_max: Annotated[float, "m", "symmetric surface distance from member 0, largest"]
    ramp: Annotated[float, "s", "time of a dynamic pressure ramp; 0: static increments"]
    stats: Annotated[Stats, "1", "counts and times over all increments, the rest at the end"]
