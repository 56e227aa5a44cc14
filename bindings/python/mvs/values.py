"""The values of the interface: loads, statistics, measures and parts, in SI units.

The annotation of every field holds its unit and its definition, so that tables and reports print
the same words: ``unit_of(Measures, "tenting_height")``.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, Optional

import numpy as np
from numpy.typing import NDArray

from .describe import annotation_of, with_field_help
from .kinds import BodyKind, EnsembleOrder, FindingSource, PartKind, SamRisk, ToolKind


def unit_of(kind: type, name: str) -> str:
    """The unit of a field of Measures, Stats or Comparison; "1" for a pure number."""
    return annotation_of(kind, name)[0]


def definition_of(kind: type, name: str) -> str:
    """The definition of a field of Measures, Stats or Comparison."""
    return annotation_of(kind, name)[1]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Load:
    """The load on a valve."""

    pressure: Annotated[float, "Pa", "ventricle minus atrium"]
    boundary_fraction: Annotated[float, "1", "position of annulus and heads: 0 open to 1 loaded"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Stability:
    """Stability of an equilibrium: of overdamped motion, D dx/dt = -K x, D = 500 1/s times the mass.

    K = Ks + N, N the skew part that the follower pressure has at the free edge.
    """

    stable: Annotated[bool, "1", "growth_rate is at most 1e-3 1/s, or Ks is positive definite"]
    stiffness_margin: Annotated[float, "N/m", "smallest eigenvalue of Ks: near 0 a fold may snap"]
    growth_rate: Annotated[float, "1/s", "largest real part of an eigenvalue of -D^-1 K"]


@dataclasses.dataclass(frozen=True)
class Part:
    """A named part of a valve; ``id`` survives undo, save and load."""

    id: int
    kind: PartKind
    index: int
    name: str


@dataclasses.dataclass(frozen=True)
class HistoryEntry:
    """One operation in the history of a valve.

    kind: its name in ``mvs.ops``
    title: a description, for a menu
    group: equal for operations that are undone together; None outside a group
    made: id of the part that it created, or None
    done: False for an operation that was undone
    """

    kind: str
    title: str
    group: Optional[int]
    group_name: str
    made: Optional[int]
    done: bool


@with_field_help
@dataclasses.dataclass(frozen=True)
class Replay:
    """The result of replaying a plan or a journal."""

    operations: Annotated[int, "1", "operations applied"]
    same_valve: Annotated[bool, "1", "this is the valve of the plan"]
    same_result: Annotated[bool, "1", "the hash at the end is that of the plan"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class ChordLimits:
    """The working range of chordae of a kind; chordae beyond it are flagged."""

    strain: Annotated[float, "1", "largest engineering strain"]
    tension: Annotated[float, "N", "largest tension"]


@dataclasses.dataclass(frozen=True)
class Fault:
    """One fault of a valve given as arrays, or a warning about a valve without faults."""

    part: str
    sentence: str
    is_warning: bool = False


@with_field_help
@dataclasses.dataclass(frozen=True)
class Tool:
    """An instrument in a snapshot: positions of hand and tool, and the force on the hand."""

    id: Annotated[int, "1", "id of the tool"]
    kind: Annotated[ToolKind, "1", "grasp, ball, rod or convex"]
    position: Annotated[NDArray[np.float64], "m", "of the hand"]
    axis: Annotated[NDArray[np.float64], "1", "unit vector of the rod of the hand; 0 for others"]
    proxy: Annotated[NDArray[np.float64], "m", "the held node, or the centre of ball or tip"]
    proxy_axis: Annotated[NDArray[np.float64], "1", "unit vector of the rod; 0 for others"]
    force: Annotated[NDArray[np.float64], "N", "on the hand"]
    torque: Annotated[NDArray[np.float64], "N m", "of a rod or convex tool, on the hand about its position"]
    distance: Annotated[float, "m", "from its surface to the mid-surface of the nearest leaflet"]
    radius: Annotated[float, "m", "of a ball or rod"]
    length: Annotated[float, "m", "of a rod, between the centres of its ends"]
    stiffness: Annotated[float, "N/m", "of the spring between hand and tool"]
    max_force: Annotated[float, "N", "of that spring"]
    node: Annotated[Optional[int], "1", "node held by a grasp; None for others"]
    touching: Annotated[bool, "1", "in contact with tissue; always true for a grasp"]
    orientation: Annotated[NDArray[np.float64], "1", "of the hand of a convex tool, w x y z"]
    proxy_orientation: Annotated[NDArray[np.float64], "1", "of a convex tool, w x y z"]
    body_count: Annotated[int, "1", "bodies of a convex tool"]
    vertex_count: Annotated[int, "1", "vertices of all its bodies"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class ToolBody:
    """A body of a convex tool: the hull of vertices in the frame of the hand, rounded by a radius."""

    kind: Annotated[BodyKind, "1", "as it was given"]
    radius: Annotated[float, "m", "by which the hull is rounded"]
    vertices: Annotated[NDArray[np.float64], "m", "n x 3, in the frame of the hand"]
    triangles: Annotated[NDArray[np.uint32], "1", "n x 3: surface of the hull, normals outwards"]


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
    energy: Annotated[float, "J", "total potential energy at the end"]
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
@dataclasses.dataclass(frozen=True)
class Measures:
    """The measures of a valve. Sources: libmvs/measure/DEFINITIONS.md."""

    intersections: Annotated[int, "1", "pairs of triangles that cross (exact test)"]
    regurgitant_orifice_area: Annotated[
        float, "m2", "smallest cross-section joining ventricle and atrium; 0 when sealed"
    ]
    coaptation_area: Annotated[
        float, "m2", "area of one side where leaflets face each other within the contact thickness"
    ]
    coaptation_length_mean: Annotated[float, "m", "mean along the coaptation line"]
    coaptation_length_min: Annotated[float, "m", "smallest along the coaptation line"]
    coaptation_length_max: Annotated[float, "m", "largest along the coaptation line"]
    coaptation_height: Annotated[
        float, "m", "extent of the coaptation along the valve axis, central AP plane"
    ]
    coaptation_depth: Annotated[
        float, "m", "annulus plane to the highest coapted tissue, central AP plane"
    ]
    tenting_height: Annotated[
        float, "m", "deepest leaflet point on the atrial side below the annulus plane"
    ]
    tenting_area: Annotated[float, "m2", "below the annulus plane, in the central AP plane"]
    tenting_volume: Annotated[float, "m3", "between leaflets and annulus surface, below it"]
    billow_height: Annotated[float, "m", "highest leaflet point above the annulus surface"]
    billow_volume: Annotated[float, "m3", "between leaflets and annulus surface, above it"]
    annulus_ap: Annotated[float, "m", "anteroposterior (septal-lateral) diameter"]
    annulus_cc: Annotated[float, "m", "intercommissural diameter"]
    annulus_perimeter: Annotated[float, "m", "length of the annulus in space"]
    annulus_area_3d: Annotated[float, "m2", "area of the surface spanning the annulus"]
    annulus_area: Annotated[float, "m2", "area projected on the annulus plane"]
    annulus_saddle_height: Annotated[float, "m", "height of the annulus along the valve axis"]
    annulus_nonplanar_angle: Annotated[float, "rad", "angle between the two halves of the saddle"]
    max_chord_strain: Annotated[float, "1", "largest engineering strain, without sutures; 0 when all are slack"]
    max_chord_tension: Annotated[float, "N", "largest tension of a chord segment, without sutures"]
    max_leaflet_strain: Annotated[float, "1", "largest principal engineering strain"]
    max_leaflet_stress: Annotated[float, "Pa", "largest principal Cauchy stress"]
    leaflet_area: Annotated[float, "m2", "area of both leaflets in the present shape"]
    chords_over_strain: Annotated[int, "1", "chordae strained beyond the limit of their kind"]
    chords_over_tension: Annotated[int, "1", "chordae that carry more than the limit of their kind"]
    at_rest: Annotated[int, "1", "1: at rest under its load, as a settle or step found it"]
    under_load: Annotated[int, "1", "1: the pressure closes the valve"]
    leaflet_strain_p50: Annotated[
        float, "1", "largest principal strain that half of the tissue does not exceed, by rest area"
    ]
    leaflet_strain_p95: Annotated[float, "1", "the same for 95 % of the tissue"]
    leaflet_strain_p99: Annotated[
        float, "1", "the same for 99 %: one bad triangle does not change it"
    ]
    leaflet_stress_p50: Annotated[
        float,
        "Pa",
        "largest principal Cauchy stress that half of the tissue does not exceed, by rest area",
    ]
    leaflet_stress_p95: Annotated[float, "Pa", "the same for 95 % of the tissue"]
    leaflet_stress_p99: Annotated[
        float, "Pa", "the same for 99 %: one bad triangle does not change it"
    ]


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False)
class Cost:
    """Cost of a repair. NaN where it is not known. Sources: libmvs/measure/DEFINITIONS.md."""

    opened: Annotated[bool, "1", "1: the open valve came to rest"]
    open_area: Annotated[float, "m2", "smallest cross-section of the valve opened in diastole"]
    gradient: Annotated[
        float, "Pa", "mean pressure drop of the flow through the open area; only with a flow"
    ]
    anterior_height: Annotated[
        float, "m", "tissue from annulus to free edge, unloaded, central AP plane"
    ]
    posterior_height: Annotated[float, "m", "the same of the posterior leaflet"]
    anterior_length: Annotated[
        float, "m", "from annulus to coaptation along the closed leaflet, central AP plane"
    ]
    posterior_length: Annotated[float, "m", "the same of the posterior leaflet"]
    length_ratio: Annotated[float, "1", "anterior over posterior length to coaptation"]
    septal_distance: Annotated[
        float, "m", "in the central AP plane; only with points of the septum"
    ]
    annulus_force_max: Annotated[
        float, "N", "on one node of the annulus; the suture of a ring bears it"
    ]
    annulus_force_sum: Annotated[float, "N", "sum of magnitudes over the nodes of the annulus"]
    sam_risk: Annotated[
        SamRisk,
        "1",
        "0 not determined, 1 low, 2 raised: ratio at most 1.3, or septum within 25 mm",
    ]
    rings: Annotated[int, "1", "rings and bands, whose sutures bear the pull of the annulus"]
    chords_over_strain: Annotated[
        int, "1", "chordae strained beyond the limit of their kind, closed"
    ]
    chords_over_tension: Annotated[
        int, "1", "chordae that carry more than the limit of their kind, closed"
    ]
    open_valve: Annotated[Any, "1", "the valve opened in diastole (mvs.Snapshot)"]


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
    equilibria: Annotated[int, "1", "distinct shapes among them"]
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


@with_field_help
@dataclasses.dataclass(frozen=True)
class Coarsening:
    """The result of coarsening a valve."""

    vertices_before: Annotated[int, "1", "vertices of the leaflets before"]
    vertices: Annotated[int, "1", "vertices of the leaflets now"]
    chords_moved: Annotated[int, "1", "chordae that end at another vertex"]
    chords_merged: Annotated[int, "1", "chordae merged into another one"]
    chord_move: Annotated[float, "m", "largest displacement of an end of a chord"]
    surface_max: Annotated[
        float, "m", "largest distance of a removed vertex from the coarse surface"
    ]
    surface_rms: Annotated[float, "m", "RMS of that distance over all vertices of the fine level"]
    worst_quality: Annotated[float, "1", "worst triangle: 1 equilateral, 0 degenerate"]


@dataclasses.dataclass(frozen=True, eq=False)
class Finding:
    """A value that Simulator.build_valve found, guessed or assumed.

    name: "annulus", "commissures", "thickness"
    source: given, measured on the surface, guessed by a rule, or assumed from normal anatomy
    confidence: 0 to 1
    sentence: what was seen, and what to give if it is wrong
    values: (k,) in `unit`; points as x, y, z in turn
    unit: "m", "m2" or ""
    """

    name: str
    source: FindingSource
    confidence: float
    sentence: str
    values: NDArray[np.float64]
    unit: str


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """The anatomical frame of a valve.

    origin: (3,) m, the centroid of the annulus
    axes: (3, 3), rows AP (towards the anterior leaflet), CC, and the axis into the atrium
    """

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]

    def to_local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Converts points (..., 3) in m to this frame: columns AP, CC, axis."""
        return (points - self.origin) @ self.axes.T
