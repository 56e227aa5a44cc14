"""A valve as arrays, with its tissue, rings and curves, in SI units."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, Optional, Union

from numpy.typing import NDArray

from .kinds import LeafletLaw, RingKind


@dataclasses.dataclass(frozen=True)
class LawConstant:
    """A constant of a law: key in files, unit ("" for a pure number), default and range."""

    key: str
    unit: str
    default: float
    low: float
    high: float


@dataclasses.dataclass(frozen=True)
class Law:
    """A material law: word in files and commands, name, and constants in order."""

    word: str
    name: str
    constants: tuple[LawConstant, ...]


@dataclasses.dataclass(frozen=True)
class Leaflet:
    """A leaflet and its tissue; zeros mean the library's defaults.

    thickness: m
    constants: of the law, at most 8, moduli in Pa; for the spring sheet Young's modulus below and
        above the kink and the strain at the kink
    """

    name: str
    thickness: float = 0.0
    constants: tuple[float, ...] = ()
    law: LeafletLaw = LeafletLaw.SPRING
    id: int = 0


Array = Optional[NDArray[Any]]


@dataclasses.dataclass(frozen=True, eq=False)
class Ring:
    """A ring or band on the annulus, for drawing.

    ``nodes_open`` and ``nodes_loaded`` hold its effect on the annulus.
    curve: float64 or float32 (k, 3), m, its points in order
    """

    name: str
    curve: NDArray[Any]
    kind: RingKind = RingKind.RIGID
    id: int = 0


@dataclasses.dataclass(frozen=True, eq=False)
class Curve:
    """A measured stress-strain curve for chordae of ``ChordLaw.TABLE``.

    points: float64 or float32 (k, 2): increasing strain, non-decreasing nominal stress in Pa; the
        stress is 0 at the first point, where the chord becomes taut
    """

    name: str
    points: NDArray[Any]
    id: int = 0


@dataclasses.dataclass(eq=False)
class Valve:
    """A valve as arrays: n nodes, m triangles, l leaflets, c chord segments, h heads.

    Nodes are one list: leaflet vertices, branch points of chordae and papillary heads. ``None``
    means the library's default. Arrays may have any strides; their dtype must be the stated one,
    because a silent cast of indices or lengths would hide an error. Lengths in m.
    """

    nodes: Array
    """float64 or float32 (n, 3): the open, unloaded valve"""
    triangles: Array
    """uint32 (m, 3): normals point into the atrium (or see ``orient``)"""
    annulus: Array
    """uint32 (k,): the annulus, a loop of boundary nodes in order"""
    leaflets: Sequence[Union[str, Leaflet]] = ("M",)
    """names, or leaflets with their tissue"""
    triangle_leaflet: Array = None
    """uint32 (m,): index into leaflets; None: all 0"""
    nodes_loaded: Array = None
    """float64 or float32 (n, 3): loaded positions of annulus and heads; other rows are ignored"""
    nodes_open: Array = None
    """float64 or float32 (n, 3): positions of annulus and heads without load; None: ``nodes``"""
    nodes_now: Array = None
    """float64 or float32 (n, 3): the start shape; None: ``nodes``"""
    node_origin: Array = None
    """uint32 (n,): ``Snapshot.node_origin`` of a valve after operations"""
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
    chord_law: Array = None
    """uint32 (c,): ChordLaw; None: linear"""
    chord_constants: Array = None
    """float64 (c, 6): of the law; for ChordLaw.TABLE the index of its curve first"""
    curves: Sequence[Curve] = ()
    """measured stress-strain curves of chordae"""
    chord_id: Array = None
    """uint64 (c,)"""
    chord_names: Optional[Sequence[str]] = None
    """None: built from kind and scallop, "P2/3" """
    head_nodes: Array = None
    """uint32 (h,)"""
    head_id: Array = None
    """uint64 (h,)"""
    head_names: Optional[Sequence[str]] = None
    """None: "PM1", "PM2", ..."""
    rings: Sequence[Ring] = ()
    """rings and bands on the annulus"""
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
    """reverse triangles where needed, so that normals point into the atrium"""
