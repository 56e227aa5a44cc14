"""The fields of operations: reads values given in Python and converts them for the C interface."""

from __future__ import annotations

import dataclasses
import operator
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NoReturn, Union

import numpy as np
from numpy.typing import NDArray

from ._op_sites import Site, site_of_text, site_of_tuple
from .errors import ArgumentError
from .kinds import PartKind
from .values import Part

if TYPE_CHECKING:
    from ._core import Snapshot


class FieldType(IntEnum):
    """Types of the fields of operations."""

    NUMBER = 1
    COUNT = 2
    CHOICE = 3
    CHORD = 4
    HEAD = 5
    SCALLOP = 6
    SITE = 7
    POINT = 8
    VECTOR = 9
    POINTS = 10
    TEXT = 11


_PARTS = {
    FieldType.CHORD: PartKind.CHORD,
    FieldType.HEAD: PartKind.HEAD,
    FieldType.SCALLOP: PartKind.SCALLOP,
}

_WANTED = {
    FieldType.NUMBER: "a number",
    FieldType.COUNT: "a non-negative integer",
    FieldType.CHOICE: "a word",
    FieldType.CHORD: "the name or id of a chord",
    FieldType.HEAD: "the name or id of a papillary head",
    FieldType.SCALLOP: "the name or id of a scallop",
    FieldType.SITE: "a node's index, (scallop, along, height), \"P2:0.5:0.9\", "
    "(triangle, (u, v, w)) or a mvs.Site",
    FieldType.POINT: "a point, three numbers",
    FieldType.VECTOR: "a vector, three numbers",
    FieldType.POINTS: "points, an array of shape (n, 3)",
    FieldType.TEXT: "text without a zero character",
}


@dataclasses.dataclass(frozen=True)
class OpField:
    """A field of an operation, as the library describes it.

    low, high: range of a number in ``unit``, of the count of points, or of the bytes of a text
    choices: the accepted words and their numbers in C
    default: of an omitted field: a number in ``unit``, a word of ``choices``, or a rule in words
        ("fitted"); None if it has none
    """

    kind: str
    name: str
    type: FieldType
    offset: int
    required: bool
    low: float
    high: float
    unit: str
    help: str
    choices: tuple[tuple[str, int], ...]
    default: Union[float, int, str, None] = None

    @classmethod
    def described_by(cls, kind: str, fields: dict[str, Any]) -> OpField:
        """The field that a dictionary of the binding describes."""
        pairs = (word.split("=") for word in fields["choices"].split())
        choices = tuple((word, int(number)) for word, number in pairs)
        type_ = FieldType(fields["type"])
        read = {"kind": kind, "type": type_, "choices": choices}
        if type_ == FieldType.COUNT and isinstance(fields["default"], float):
            read["default"] = int(fields["default"])
        return cls(**{**fields, **read})

    def with_unit(self) -> str:
        """The name with the unit: "length (m)"."""
        return f"{self.name} ({self.unit})" if self.unit else self.name

    def described(self) -> str:
        """One line for a docstring."""
        words = f"{self.with_unit()}: {self.help}"
        if self.type == FieldType.NUMBER or self.type == FieldType.COUNT:
            words += f"; {self.low:g} to {self.high:g}"
        if self.choices:
            words += "; " + ", ".join(f'"{word}"' for word, _ in self.choices)
        return words

    def read(self, value: Any) -> Any:
        """The value as an Operation stores it; ArgumentError for a wrong type."""
        try:
            read = _READERS[self.type](self, value)
        except (TypeError, ValueError, OverflowError):
            self._refuse(value)
        if self._means_default(read):
            raise ArgumentError(
                f"{self.kind}: {self.name} is 0, the range is {self.low:g} to {self.high:g}; omit "
                "it for its default",
                f"{self.kind}.{self.name}",
            )
        return read

    def shown(self, value: Any) -> str:
        """The value as source code; more than four points as their count."""
        if isinstance(value, np.ndarray):
            return repr(value.tolist()) if len(value) <= 4 else f"<{len(value)} points>"
        return repr(value)

    def _means_default(self, value: Any) -> bool:
        # 0 in the C struct means "not given"
        numeric = self.type in (FieldType.NUMBER, FieldType.COUNT)
        return bool(numeric and value == 0 and not self.low <= 0 <= self.high)

    def _refuse(self, value: Any) -> NoReturn:
        wanted = _WANTED[self.type]
        if self.choices:
            wanted = "one of " + ", ".join(f'"{word}"' for word, _ in self.choices)
        unit = f" in {self.unit}" if self.unit else ""
        shown = repr(value) if len(repr(value)) < 60 else type(value).__name__
        sentence = f"{self.kind}: {self.name} must be {wanted}{unit}, not {shown}"
        raise ArgumentError(sentence, f"{self.kind}.{self.name}") from None


def _number(_: OpField, value: Any) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (float, int, np.number)):
        raise TypeError
    return float(value)


def _index(value: Any, most: int) -> int:
    if isinstance(value, (bool, np.bool_)) or not 0 <= operator.index(value) <= most:
        raise ValueError
    return operator.index(value)


def _count(_: OpField, value: Any) -> int:
    return _index(value, 2**32 - 1)


def _choice(field: OpField, value: Any) -> str:
    for word, number in field.choices:
        if value == word or (not isinstance(value, (str, bool)) and value == number):
            return word
    raise ValueError


def _part(field: OpField, value: Any) -> Union[str, int]:
    if isinstance(value, Part):
        if value.kind != _PARTS[field.type]:
            raise ValueError
        return value.id
    return _text(field, value) if isinstance(value, str) else _index(value, 2**64 - 1)


def _site(field: OpField, value: Any) -> Site:
    if isinstance(value, str):
        value = site_of_text(value)
    if isinstance(value, (tuple, list)):
        value = site_of_tuple(*value)
    elif not isinstance(value, Site):
        value = Site(node=_index(value, 2**32 - 1))
    return Site(
        node=None if value.node is None else _count(field, value.node),
        triangle=None if value.triangle is None else _count(field, value.triangle),
        barycentric=tuple(_number(field, u) for u in value.barycentric),
        scallop=value.scallop if value.scallop is None else _scallop_of_site(value.scallop),
        along=_number(field, value.along),
        height=_number(field, value.height),
    )


def _scallop_of_site(value: Any) -> Union[str, int]:
    if isinstance(value, Part):
        if value.kind != PartKind.SCALLOP:
            raise ValueError
        return value.id
    return value if isinstance(value, str) else _index(value, 2**64 - 1)


def _triple(field: OpField, value: Any) -> tuple[float, float, float]:
    x, y, z = value
    return _number(field, x), _number(field, y), _number(field, z)


def _points(_: OpField, value: Any) -> NDArray[np.float64]:
    given = np.asarray(value)
    if given.dtype.kind not in "fiu" or given.ndim != 2 or given.shape[1] != 3:
        raise ValueError
    points = np.array(given, dtype=np.float64, order="C")
    points.setflags(write=False)
    return points


def _text(_: OpField, value: Any) -> str:
    if not isinstance(value, str) or "\0" in value:
        raise ValueError
    return value


_READERS = {
    FieldType.NUMBER: _number,
    FieldType.COUNT: _count,
    FieldType.CHOICE: _choice,
    FieldType.CHORD: _part,
    FieldType.HEAD: _part,
    FieldType.SCALLOP: _part,
    FieldType.SITE: _site,
    FieldType.POINT: _triple,
    FieldType.VECTOR: _triple,
    FieldType.POINTS: _points,
    FieldType.TEXT: _text,
}


def resolve(field: OpField, value: Any, snapshot: Snapshot) -> Any:
    """Converts a value of ``read`` for the C interface; looks up names in the snapshot."""
    if field.type in _PARTS:
        return _id(snapshot, _PARTS[field.type], value)
    if field.type == FieldType.CHOICE:
        return dict(field.choices)[value]
    if field.type == FieldType.SITE:
        return _resolved_site(value, snapshot)
    return value


def _id(snapshot: Snapshot, kind: PartKind, value: Union[str, int]) -> int:
    return snapshot.find(kind, value).id if isinstance(value, str) else value


def _resolved_site(site: Site, snapshot: Snapshot) -> tuple[int, int, int, tuple[float, ...]]:
    # how, index, scallop, u of mvs_site
    if site.node is not None:
        return 1, site.node, 0, (0.0, 0.0, 0.0)
    if site.triangle is not None:
        return 2, site.triangle, 0, site.barycentric
    assert site.scallop is not None
    scallop = _id(snapshot, PartKind.SCALLOP, site.scallop)
    return 3, 0, scallop, (site.along, site.height, 0.0)
