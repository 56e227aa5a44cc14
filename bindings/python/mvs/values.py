"""The values of the interface: loads, parts, history, tools and findings, in SI units; also those of
``measures`` and ``outcomes``, so that all can be imported from here.

The annotation of every field holds its unit and its definition, so that tables and reports print
the same words: ``unit_of(Measures, "tenting_height")``.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, Optional

import numpy as np
from numpy.typing import NDArray

from .describe import annotation_of, with_field_help
from .kinds import BodyKind, FindingSource, PartKind, ToolKind
from .measures import Cost, Measures
from .outcomes import Comparison, EnsembleMember, EnsembleSummary, Profile, Stability, Stats

__all__ = [
    "ChordLimits", "Coarsening", "Comparison", "Cost", "EnsembleMember", "EnsembleSummary", "Fault", "Finding",
    "Frame", "HistoryEntry", "Load", "Measures", "Part", "Profile", "Replay", "Stability", "Stats", "Tool",
    "ToolBody", "definition_of", "unit_of",
]


def unit_of(kind: type, name: str) -> str:
    """The unit of a field of Measures, Stats or Comparison; "1" for a pure number.

    ArgumentError for an unknown name, with the near ones.
    """
    return annotation_of(kind, name)[0]


def definition_of(kind: type, name: str) -> str:
    """The definition of a field of Measures, Stats or Comparison; errors as of unit_of."""
    return annotation_of(kind, name)[1]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Load:
    """The load on a valve."""

    pressure: Annotated[float, "Pa", "ventricle minus atrium"]
    boundary_fraction: Annotated[float, "1", "position of annulus and heads: 0 open to 1 loaded"]


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
    same_result: Annotated[bool, "1", "the hash at the end is that of the plan; of a journal: its last record was whole"]


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
    doubtful: it contradicts the surface or normal anatomy so far that an input is probably wrong
        (landmarks of another frame, swapped leaflets, atrial wall)
    """

    name: str
    source: FindingSource
    confidence: float
    sentence: str
    values: NDArray[np.float64]
    unit: str
    doubtful: bool = False


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
