"""The plain values of the interface: loads, statistics, measures, parts and valves as arrays.

SI units throughout. The unit and the definition of every figure stand in the field's metadata, so
that tables and reports print the same words: ``unit_of(Measures, "tenting_height")``.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from enum import IntEnum
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

MMHG = 133.322
"""1 mmHg in Pa."""

SYSTOLE_PA = 120 * MMHG
"""120 mmHg in Pa: the default systolic load."""


class NodeKind(IntEnum):
    """Values of ``Snapshot.node_kind``."""

    LEAFLET = 0
    ANNULUS = 1
    BRANCH = 2
    HEAD = 3


class ChordKind(IntEnum):
    """Values of ``Snapshot.chord_kind``."""

    OTHER = 0
    MARGINAL = 1
    ROUGH_ZONE = 2
    STRUT = 3
    BASAL = 4
    COMMISSURAL = 5
    TRUNK = 6


class PartKind(IntEnum):
    """Kinds of named parts."""

    LEAFLET = 1
    SCALLOP = 2
    CHORD = 3
    HEAD = 4


class LeafletLaw(IntEnum):
    """The laws a leaflet sheet can follow."""

    SPRING = 1


def _figure(unit: str, definition: str) -> Any:
    return dataclasses.field(metadata={"unit": unit, "definition": definition})


def _metadata(kind: type, name: str) -> Any:
    return kind.__dataclass_fields__[name].metadata  # type: ignore[attr-defined]


def unit_of(kind: type, name: str) -> str:
    """The unit of a field of Measures, Stats or Comparison; "1" where it has none."""
    return str(_metadata(kind, name)["unit"])


def definition_of(kind: type, name: str) -> str:
    """What a field of Measures, Stats or Comparison means, in words."""
    return str(_metadata(kind, name)["definition"])


@dataclasses.dataclass(frozen=True)
class Load:
    """The load on a valve."""

    pressure: float = _figure("Pa", "ventricle minus atrium")
    boundary_fraction: float = _figure("1", "where annulus and heads are: 0 open to 1 loaded")


@dataclasses.dataclass(frozen=True)
class Part:
    """A named part of a valve; ``id`` survives undo, save and load."""

    id: int
    kind: PartKind
    index: int
    name: str


@dataclasses.dataclass(frozen=True)
class Fault:
    """One reason why arrays are no valve."""

    part: str
    sentence: str


@dataclasses.dataclass(frozen=True)
class Stats:
    """How the last settle or step went. Not converged is no error: look at ``converged``."""

    converged: bool = _figure("1", "the residual asked for was reached")
    iterations: int = _figure("1", "Newton iterations, or steps in time")
    factorisations: int = _figure("1", "sparse factorisations")
    contact_pairs: int = _figure("1", "active contact pairs at the end")
    shifted: int = _figure("1", "iterations whose matrix needed a shift to be positive definite")
    residual: float = _figure("N", "largest out-of-balance force on a free node")
    energy: float = _figure("J", "total potential at the end")
    kinetic: float = _figure("J", "kinetic energy at the end")
    wall_s: float = _figure("s", "time taken")
    phase_s: dict[str, float] = _figure("s", "time taken by each phase of the work")


@dataclasses.dataclass(frozen=True)
class Measures:
    """What a valve measures. Sources: libmvs/measure/README.md."""

    intersections: int = _figure("1", "pairs of triangles that cross (exact test)")
    regurgitant_orifice_area: float = _figure(
        "m2", "smallest cross-section joining ventricle and atrium; 0 when sealed"
    )
    coaptation_area: float = _figure(
        "m2", "area of one side where leaflets face each other within the contact thickness"
    )
    coaptation_length_mean: float = _figure("m", "mean along the coaptation line")
    coaptation_length_min: float = _figure("m", "smallest along the coaptation line")
    coaptation_length_max: float = _figure("m", "largest along the coaptation line")
    coaptation_height: float = _figure("m", "extent of the coaptation along the valve axis")
    coaptation_depth: float = _figure("m", "annulus plane to the nearest coapting point")
    tenting_height: float = _figure(
        "m", "deepest leaflet point on the atrial side below the annulus plane"
    )
    tenting_area: float = _figure("m2", "below the annulus plane, in the central AP plane")
    tenting_volume: float = _figure("m3", "between leaflets and annulus surface, below it")
    billow_height: float = _figure("m", "highest leaflet point above the annulus surface")
    billow_volume: float = _figure("m3", "between leaflets and annulus surface, above it")
    annulus_ap: float = _figure("m", "anteroposterior (septal-lateral) diameter")
    annulus_cc: float = _figure("m", "intercommissural diameter")
    annulus_perimeter: float = _figure("m", "length of the annulus in space")
    annulus_area_3d: float = _figure("m2", "area of the surface spanning the annulus")
    annulus_area: float = _figure("m2", "area projected on the annulus plane")
    annulus_saddle_height: float = _figure("m", "height of the annulus along the valve axis")
    annulus_nonplanar_angle: float = _figure("rad", "angle between the two halves of the saddle")
    max_chord_strain: float = _figure("1", "largest engineering strain; 0 when all are slack")
    max_chord_tension: float = _figure("N", "largest tension of a chord segment")
    max_leaflet_strain: float = _figure("1", "largest principal engineering strain")
    max_leaflet_stress: float = _figure("Pa", "largest principal Cauchy stress")
    leaflet_area: float = _figure("m2", "area of both leaflets in the present shape")


@dataclasses.dataclass(frozen=True, eq=False)
class Comparison:
    """How far two shapes are apart. Node figures are NaN where the meshes do not match."""

    same_mesh: bool = _figure("1", "the meshes match, so node-to-node figures exist")
    node_rms: float = _figure("m", "node to node, RMS, as they lie")
    node_max: float = _figure("m", "node to node, largest, as they lie")
    surface_rms: float = _figure("m", "symmetric surface distance, RMS, as they lie")
    surface_max: float = _figure("m", "symmetric surface distance, largest, as they lie")
    node_rms_registered: float = _figure("m", "node to node, RMS, after the best rigid motion")
    node_max_registered: float = _figure("m", "node to node, largest, after the best rigid motion")
    surface_rms_registered: float = _figure("m", "surface, RMS, after the best rigid motion")
    surface_max_registered: float = _figure("m", "surface, largest, after the best rigid motion")
    registration: NDArray[np.float64] = _figure("m", "rows of [R | t], 3 x 4: b ~ R a + t")


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """A valve's own frame.

    origin: (3,) m, the centroid of the annulus
    axes: (3, 3), rows AP (towards the anterior leaflet), CC, and the axis into the atrium
    """

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]

    def to_local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of shape (..., 3) in m, seen from this frame: columns AP, CC, axis."""
        return (points - self.origin) @ self.axes.T


@dataclasses.dataclass(frozen=True)
class Leaflet:
    """A leaflet and its tissue; zeros take the library's defaults.

    thickness: m
    constants: of the law; for the spring sheet Young's modulus below and above the kink (Pa) and
        the strain at the kink
    """

    name: str
    thickness: float = 0.0
    constants: tuple[float, ...] = ()
    law: LeafletLaw = LeafletLaw.SPRING
    id: int = 0


Array = Optional[NDArray[Any]]


@dataclasses.dataclass(eq=False)
class Valve:
    """A whole valve as arrays: n nodes, m triangles, l leaflets, c chord segments, h heads.

    Nodes are one list: leaflet vertices, branch points of chordae and papillary heads. ``None``
    takes the library's default. Arrays may have any strides; their dtype must be the one stated,
    since a silent cast of indices or lengths hides a fault. Lengths in m.
    """

    nodes: Array
    """float64 or float32 (n, 3): the open, unloaded valve"""
    triangles: Array
    """uint32 (m, 3): wound so that normals point into the atrium (or see ``orient``)"""
    annulus: Array
    """uint32 (k,): the boundary loop held by the heart, in order"""
    leaflets: Sequence[Union[str, Leaflet]] = ("M",)
    """names, or leaflets with their tissue"""
    triangle_leaflet: Array = None
    """uint32 (m,): index into leaflets; None: all 0"""
    nodes_loaded: Array = None
    """float64 or float32 (n, 3): where annulus and heads go under load; other rows are ignored"""
    nodes_now: Array = None
    """float64 or float32 (n, 3): the shape to start from; None: ``nodes``"""
    scallops: Optional[Sequence[str]] = None
    """names; None: one per leaflet"""
    scallop_id: Array = None
    """uint64"""
    triangle_scallop: Array = None
    """uint32 (m,): index into scallops"""
    triangle_thickness: Array = None
    """float64 (m,), m; None: the leaflet's"""
    triangle_fibre: Array = None
    """float64 (m, 3): fibre direction; None: circumferential"""
    chord_nodes: Array = None
    """uint32 (c, 2): papillary side first"""
    chord_rest_length: Array = None
    """float64 (c,), m; None or 0: the distance of the two nodes"""
    chord_kind: Array = None
    """uint32 (c,): ChordKind"""
    chord_young: Array = None
    """float64 (c,), Pa"""
    chord_area: Array = None
    """float64 (c,), m2"""
    chord_id: Array = None
    """uint64 (c,)"""
    chord_names: Optional[Sequence[str]] = None
    """None: made from kind and scallop, "P2/3" """
    head_nodes: Array = None
    """uint32 (h,)"""
    head_id: Array = None
    """uint64 (h,)"""
    head_names: Optional[Sequence[str]] = None
    """None: "PM1", "PM2", ..."""
    name: str = "valve"
    density: Optional[float] = None
    """kg/m3"""
    contact_thickness: Optional[float] = None
    """m, mid-surface distance at which leaflets touch"""
    contact_stiffness: Optional[float] = None
    """Pa, scale of the contact pressure"""
    bending_scale: Optional[float] = None
    """factor on the plate stiffness; 0: no bending"""
    orient: bool = False
    """turn triangles so that their normals point into the atrium"""
