"""libmvs: mitral valve repair, simulated for one patient. A research tool, not a medical device.

    import mvs

    with mvs.Simulator() as sim:
        sim.generate()
        sim.set_load(mvs.SYSTOLE_PA)
        print(sim.settle().converged)
        closed = sim.snapshot()
    print(closed.measures.regurgitant_orifice_area)

SI units throughout: m, kg, s, N, Pa, rad.
"""

from . import _core, haptics, methods, ops
from ._core import (
    Device,
    Ensemble,
    Simulator,
    Snapshot,
    check_valve,
    chord_law,
    chord_limits,
)
from .arrays import Curve, Law, LawConstant, Leaflet, Ring, Valve
from .editing import valve_of
from .errors import (
    ArgumentError,
    CancelledError,
    DeviceError,
    DivergedError,
    Error,
    FormatError,
    IdError,
    InternalError,
    IoError,
    LimitError,
    OpError,
    StateError,
    UnsupportedError,
    ValveWarning,
    VersionError,
)
from .fitting import Fit, Points, Prior, fit
from .kinds import (
    DIASTOLE_PA,
    MMHG,
    SYSTOLE_PA,
    BodyKind,
    ChordKind,
    ChordLaw,
    EnsembleOrder,
    FindingSource,
    LeafletLaw,
    NodeKind,
    PartKind,
    RingKind,
    SamRisk,
    ToolKind,
)
from .laws import leaflet_law
from .ops import Operation, Site
from .sensitivities import Sensitivity
from .surfaces import Landmarks, Surface, read_landmarks, read_surface
from .sweeps import sweep
from .tables import Table
from .values import (
    ChordLimits,
    Coarsening,
    Comparison,
    Cost,
    EnsembleMember,
    EnsembleSummary,
    Fault,
    Finding,
    Frame,
    HistoryEntry,
    Load,
    Measures,
    Part,
    Profile,
    Replay,
    Stability,
    Stats,
    Tool,
    ToolBody,
    definition_of,
    unit_of,
)

__version__ = _core.version()
features = tuple(_core.features().split())

methods.attach()

__all__ = [
    "DIASTOLE_PA",
    "MMHG",
    "SYSTOLE_PA",
    "ArgumentError",
    "BodyKind",
    "CancelledError",
    "ChordKind",
    "ChordLaw",
    "ChordLimits",
    "Coarsening",
    "Comparison",
    "Cost",
    "Curve",
    "Device",
    "DeviceError",
    "DivergedError",
    "Ensemble",
    "EnsembleMember",
    "EnsembleOrder",
    "EnsembleSummary",
    "Error",
    "Fault",
    "Finding",
    "FindingSource",
    "Fit",
    "FormatError",
    "Frame",
    "HistoryEntry",
    "IdError",
    "InternalError",
    "IoError",
    "Landmarks",
    "Law",
    "LawConstant",
    "Leaflet",
    "LeafletLaw",
    "LimitError",
    "Load",
    "Measures",
    "NodeKind",
    "OpError",
    "Operation",
    "Part",
    "PartKind",
    "Points",
    "Prior",
    "Profile",
    "Replay",
    "Ring",
    "RingKind",
    "SamRisk",
    "Sensitivity",
    "Simulator",
    "Site",
    "Snapshot",
    "StateError",
    "Stability",
    "Stats",
    "Surface",
    "Table",
    "Tool",
    "ToolBody",
    "ToolKind",
    "UnsupportedError",
    "Valve",
    "ValveWarning",
    "VersionError",
    "check_valve",
    "chord_law",
    "chord_limits",
    "definition_of",
    "features",
    "fit",
    "haptics",
    "leaflet_law",
    "ops",
    "read_landmarks",
    "read_surface",
    "sweep",
    "unit_of",
    "valve_of",
]
