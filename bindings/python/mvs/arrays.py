"""A valve as arrays, with its tissue, rings and curves, in SI units."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterable, Sequence, Sized
from typing import Annotated, Any, Optional, Union

from numpy.typing import NDArray

from .describe import Kind, with_field_help
from .errors import ArgumentError
from .kinds import LeafletLaw, RingKind
from .laws import Constants, constants_of, leaflet_law_of
from .words import did_you_mean, shown


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
    """A leaflet and its tissue; a thickness of 0 is the library's default.

        mvs.Leaflet("A", law="fung", constants={"c0": 2e3, "c2": 5})

    thickness: m
    constants: of the law, at most 8, moduli in Pa: in order, or a dictionary by the keys of
        ``mvs.leaflet_law(law)``, where a key that is left out takes its default and 0 is zero. In
        order, 0.0 takes the default and -0.0 is zero; for the spring
        sheet Young's modulus below and above the kink and the strain at the kink
    law: a LeafletLaw, or its lower-case name; the default is the spring sheet of the founding
        model, "bilinear" the membrane that is recommended
    """

    name: str
    thickness: float = 0.0
    constants: Constants = ()
    law: Union[LeafletLaw, str] = LeafletLaw.SPRING
    id: int = 0

    def __post_init__(self) -> None:
        law = leaflet_law_of(self.law)
        known = LeafletLaw(law) if law in list(LeafletLaw) else law
        object.__setattr__(self, "law", known)
        object.__setattr__(self, "constants", constants_of(law, self.constants))


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


def _with_near_names(kind: Kind) -> Kind:
    """Lets the constructor of a dataclass name the fields that an unknown one may mean."""
    make = kind.__init__  # type: ignore[misc]  # a subclass could have another one, and kind is no subclass
    known = {field.name for field in dataclasses.fields(kind)}

    @functools.wraps(make)
    def checked(self: Any, *given: Any, **named: Any) -> None:
        for name in named:
            if name not in known:
                raise TypeError(_no_field(name))
        make(self, *given, **named)

    kind.__init__ = checked  # type: ignore[misc]  # kind is no subclass, as above
    return kind


_PARTS: dict[str, tuple[type, ...]] = {
    "leaflets": (str, Leaflet), "scallops": (str,), "chord_names": (str,), "head_names": (str,),
    "rings": (Ring,), "curves": (Curve,),
}


def check_types(valve: Valve) -> None:
    """Raises ArgumentError where a field of a valve that is no array has another type."""
    if not isinstance(valve.name, str):
        raise ArgumentError(f"name: a text is needed, not {shown(valve.name)}", "name")
    for field, kinds in _PARTS.items():
        parts = getattr(valve, field)
        words = " or ".join("a name" if kind is str else f"a mvs.{kind.__name__}" for kind in kinds)
        if parts is None:
            continue
        if isinstance(parts, (str, bytes)) or not isinstance(parts, Iterable):
            raise ArgumentError(
                f"{field}: a sequence is needed, of which each is {words}, not {shown(parts)}", field
            )
        for k, part in enumerate(parts):
            if not isinstance(part, kinds):
                raise ArgumentError(f"{field}[{k}]: {words} is needed, not {shown(part)}", field)


def _no_field(name: str) -> str:
    near = did_you_mean(name, Valve.__dataclass_fields__)
    return f'a mvs.Valve has no field "{name}"{near or "; help(mvs.Valve) lists the fields"}'


@_with_near_names
@with_field_help
@dataclasses.dataclass(eq=False, repr=False)
class Valve:
    """A valve as arrays: n nodes, m triangles, l leaflets, s scallops, c chord segments, h heads.

    Nodes are one list: leaflet vertices, branch points of chordae and papillary heads. ``None``
    means the library's default. Arrays may have any strides; their dtype must be the stated one,
    because a silent cast of indices or lengths would hide an error.
    """

    nodes: Annotated[Array, "float64 or float32 (n, 3), m", "the open, unloaded valve"]
    triangles: Annotated[
        Array, "uint32 (m, 3)", "normals point into the atrium (or see ``orient``)"
    ]
    annulus: Annotated[Array, "uint32 (k,)", "the annulus, a loop of boundary nodes in order"]
    leaflets: Annotated[
        Sequence[Union[str, Leaflet]], "l names or mvs.Leaflet", "the leaflets, with their tissue"
    ] = ("M",)
    triangle_leaflet: Annotated[Array, "uint32 (m,)", "index into leaflets; None: all 0"] = None
    nodes_loaded: Annotated[
        Array,
        "float64 or float32 (n, 3), m",
        "loaded positions of annulus and heads; other rows are ignored",
    ] = None
    nodes_open: Annotated[
        Array,
        "float64 or float32 (n, 3), m",
        "positions of annulus and heads without load; None: ``nodes``",
    ] = None
    nodes_now: Annotated[
        Array, "float64 or float32 (n, 3), m", "the start shape; None: ``nodes``"
    ] = None
    node_origin: Annotated[
        Array, "uint32 (n,)", "``Snapshot.node_origin`` of a valve after operations"
    ] = None
    scallops: Annotated[Optional[Sequence[str]], "s names", "None: one per leaflet"] = None
    scallop_id: Annotated[Array, "uint64 (s,)", "ids of the scallops; None: new ones"] = None
    triangle_scallop: Annotated[Array, "uint32 (m,)", "index into scallops"] = None
    triangle_thickness: Annotated[Array, "float64 (m,), m", "None: the leaflet's"] = None
    triangle_fibre: Annotated[
        Array, "float64 (m, 3)", "fibre direction; None: circumferential"
    ] = None
    chord_nodes: Annotated[Array, "uint32 (c, 2)", "papillary side first"] = None
    chord_rest_length: Annotated[
        Array, "float64 (c,), m", "None or 0: the distance of the two nodes"
    ] = None
    chord_kind: Annotated[Array, "uint32 (c,)", "ChordKind; None: OTHER"] = None
    chord_young: Annotated[
        Array, "float64 (c,), Pa", "Young's modulus; None or 0: the default"
    ] = None
    chord_area: Annotated[Array, "float64 (c,), m2", "cross-section; None or 0: the default"] = None
    chord_law: Annotated[Array, "uint32 (c,)", "ChordLaw; None: linear"] = None
    chord_constants: Annotated[
        Array, "float64 (c, 6)", "of the law; for ChordLaw.TABLE the index of its curve first"
    ] = None
    curves: Annotated[Sequence[Curve], "curves", "measured stress-strain curves of chordae"] = ()
    chord_id: Annotated[Array, "uint64 (c,)", "ids of the chordae; None: new ones"] = None
    chord_names: Annotated[
        Optional[Sequence[str]], "c names", 'None: built from kind and scallop, "P2/3"'
    ] = None
    head_nodes: Annotated[Array, "uint32 (h,)", "nodes of the papillary heads"] = None
    head_id: Annotated[Array, "uint64 (h,)", "ids of the heads; None: new ones"] = None
    head_names: Annotated[Optional[Sequence[str]], "h names", 'None: "PM1", "PM2", ...'] = None
    rings: Annotated[Sequence[Ring], "rings", "rings and bands on the annulus"] = ()
    name: Annotated[str, "text", "name of the valve"] = "valve"
    density: Annotated[
        Optional[float], "kg/m3", "of leaflets and chordae; None: the default"
    ] = None
    contact_thickness: Annotated[
        Optional[float], "m", "mid-surface distance at which leaflets touch"
    ] = None
    contact_stiffness: Annotated[Optional[float], "Pa", "scale of the contact pressure"] = None
    bending_scale: Annotated[
        Optional[float], "number", "factor on the plate stiffness; 0: no bending"
    ] = None
    orient: Annotated[
        bool, "bool", "reverse triangles where needed, so that normals point into the atrium"
    ] = False

    def __repr__(self) -> str:
        sizes = {"nodes": self.nodes, "triangles": self.triangles, "chord segments": self.chord_nodes,
                 "heads": self.head_nodes, "rings": self.rings}
        said = [f"{len(rows)} {what}" for what, rows in sizes.items() if isinstance(rows, Sized) and len(rows)]
        return f'<mvs.Valve "{self.name}": {", ".join(said) or "empty"}>'

    def __setattr__(self, name: str, value: object) -> None:
        if name not in self.__dataclass_fields__:
            raise AttributeError(_no_field(name))
        super().__setattr__(name, value)
