"""Enumerations of the C interface, and two units."""

from enum import IntEnum

MMHG = 133.322
"""1 mmHg in Pa."""

SYSTOLE_PA = 120 * MMHG
"""120 mmHg in Pa: the default systolic load."""

DIASTOLE_PA = 5 * MMHG
"""5 mmHg in Pa: the default pressure difference that opens the valve in Snapshot.cost()."""


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
    SUTURE = 7


class PartKind(IntEnum):
    """Kinds of named parts."""

    LEAFLET = 1
    SCALLOP = 2
    CHORD = 3
    HEAD = 4
    RING = 5
    CURVE = 6


class SamRisk(IntEnum):
    """Risk of systolic anterior motion of the anterior leaflet (mvs.Cost)."""

    NOT_DETERMINED = 0
    LOW = 1
    RAISED = 2


class FindingSource(IntEnum):
    """Where a mvs.Finding comes from."""

    GIVEN = 1
    MEASURED = 2
    GUESSED = 3
    ASSUMED = 4


class RingKind(IntEnum):
    """Kinds of rings: closed and rigid, or a flexible posterior band."""

    RIGID = 1
    BAND = 2


class ToolKind(IntEnum):
    """Kinds of instruments."""

    GRASP = 1
    BALL = 2
    ROD = 3
    CONVEX = 4


class BodyKind(IntEnum):
    """Kinds of bodies of a convex tool."""

    HULL = 1
    BALL = 2
    CAPSULE = 3
    BOX = 4
    CYLINDER = 5
    CONE = 6


class LeafletLaw(IntEnum):
    """Laws of a leaflet: springs, or membranes with W(I1, I4) in J/m3.

    Formulas, constants and sources: include/mvs/valve.h.
    """

    SPRING = 1
    BILINEAR = 2
    FUNG = 3
    MAY_NEWMAN_YIN = 4
    PROT = 5
    NEO_HOOKEAN = 6


class ChordLaw(IntEnum):
    """Laws of a chord: nominal stress over strain, zero when slack (include/mvs/valve.h)."""

    LINEAR = 1
    BILINEAR = 2
    OGDEN = 3
    TABLE = 4


class EnsembleOrder(IntEnum):
    """Order of boundary motion and pressure: together, boundary first, or pressure first."""

    TOGETHER = 1
    BOUNDARY_FIRST = 2
    PRESSURE_FIRST = 3
