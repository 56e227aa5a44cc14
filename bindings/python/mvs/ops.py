"""Surgical operations: one constructor for each operation of the library.

    sim.apply(mvs.ops.chord_length(chord="P2/3", factor=0.75))
    sim.apply("chord_length", chord="P2/3", factor=0.75)  # the same

Parts are given by name, id or ``mvs.Part``. A site is a node's index, ``("P2", along, height)``,
the command's text ``"P2:0.5:0.9"``, ``(triangle, (u, v, w))`` or a ``Site``; points are (n, 3)
arrays; choices are words. SI units throughout. The constructors follow the library's description of
its operations, ``KINDS``, which also serves dialogs.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _core
from ._op_fields import FieldType, OpField, resolve
from ._op_sites import Site
from .errors import ArgumentError

if TYPE_CHECKING:
    from types import TracebackType


@dataclasses.dataclass(frozen=True)
class OpKind:
    """A kind of operation; ``number`` and ``size`` are those of its struct in C."""

    name: str
    number: int
    size: int
    help: str
    fields: tuple[OpField, ...]

    def field(self, name: str) -> OpField:
        """The field of this name; ArgumentError lists the fields."""
        for field in self.fields:
            if field.name == name:
                return field
        listed = ", ".join(f.with_unit() for f in self.fields)
        raise ArgumentError(f'{self.name} has no field "{name}"; choose from: {listed}', self.name)


def _read_kinds() -> Mapping[str, OpKind]:
    kinds = {}
    for described in _core.op_kinds():
        name = described["name"]
        fields = tuple(OpField.described_by(name, field) for field in described["fields"])
        kinds[name] = OpKind(
            name, described["number"], described["size"], described["help"], fields
        )
    return MappingProxyType(kinds)


KINDS: Mapping[str, OpKind] = _read_kinds()
"""All operations by name, as the library describes them."""


class Operation:
    """One operation with its values: immutable, comparable, independent of a simulator.

    kind: the OpKind
    fields: the given fields, by name
    """

    kind: OpKind
    fields: Mapping[str, Any]
    __slots__ = ("fields", "kind")

    def __init__(self, name: str, /, **fields: Any) -> None:
        kind = _kind(name)
        given = {key: value for key, value in fields.items() if value is not None}
        for key in given:
            kind.field(key)
        missing = [f.name for f in kind.fields if f.required and f.name not in given]
        if missing:
            words = ", ".join(f"{key} ({kind.field(key).help})" for key in missing)
            raise ArgumentError(f"{name} needs {words}", f"{name}.{missing[0]}")
        read = {f.name: f.read(given[f.name]) for f in kind.fields if f.name in given}
        object.__setattr__(self, "kind", kind)
        object.__setattr__(self, "fields", MappingProxyType(read))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"an operation cannot be changed: {name}")

    def __repr__(self) -> str:
        values = ", ".join(
            f"{k}={self.kind.field(k).shown(value)}" for k, value in self.fields.items()
        )
        return f"mvs.ops.{self.kind.name}({values})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Operation):
            return NotImplemented
        return self._plain() == other._plain()

    def __hash__(self) -> int:
        return hash(self._plain())

    def __reduce__(self) -> tuple[Any, ...]:
        return operation, (self.kind.name, dict(self.fields))

    def _plain(self) -> tuple[Any, ...]:
        values = (
            tuple(map(tuple, value.tolist())) if hasattr(value, "tolist") else value
            for value in self.fields.values()
        )
        return (self.kind.name, *zip(self.fields, values))

    def rows(self, snapshot: _core.Snapshot) -> list[tuple[int, int, Any]]:
        """Type, offset and value of each given field in the C struct; for the binding."""
        return [
            (int(f.type), f.offset, resolve(f, self.fields[f.name], snapshot))
            for f in self.kind.fields
            if f.name in self.fields
        ]


def operation(
    given: Union[str, Operation], fields: Optional[Mapping[str, Any]] = None
) -> Operation:
    """The given Operation, or one made of a name and fields."""
    if isinstance(given, str):
        return Operation(given, **(fields or {}))
    if not isinstance(given, Operation):
        raise ArgumentError(
            f"operation: a mvs.ops.Operation or its name is needed, not {type(given).__name__}",
            "operation",
        )
    if fields:
        raise ArgumentError(
            f"operation: {given!r} already has its fields; make a new one to change them",
            "operation",
        )
    return given


def _kind(name: str) -> OpKind:
    if name not in KINDS:
        raise ArgumentError(
            f'there is no operation "{name}"; choose from: {", ".join(KINDS)}', "operation"
        )
    return KINDS[name]


def name_of_kind(number: int) -> str:
    """The name of a kind by its number in C."""
    return next((kind.name for kind in KINDS.values() if kind.number == number), f"op {number}")


class Group:
    """Context manager of ``sim.group(name)``; operations within are undone together."""

    def __init__(self, sim: _core.Simulator, name: str) -> None:
        self._sim = sim
        self._name = name

    def __enter__(self) -> None:
        self._sim.begin_group(self._name)

    def __exit__(
        self,
        kind: Optional[type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        self._sim.end_group()


def _constructor(kind: OpKind) -> Callable[..., Operation]:
    def make(**fields: Any) -> Operation:
        return Operation(kind.name, **fields)

    first = sorted(kind.fields, key=lambda f: not f.required)
    make.__name__ = make.__qualname__ = kind.name
    make.__doc__ = "\n".join([f"{kind.help}.", "", *(field.described() for field in first)])
    setattr(make, "__signature__", inspect.Signature(
        [
            inspect.Parameter(
                f.name,
                inspect.Parameter.KEYWORD_ONLY,
                default=inspect.Parameter.empty if f.required else None,
            )
            for f in first
        ],
        return_annotation=Operation,
    ))
    return make


for _each in KINDS.values():
    globals()[_each.name] = _constructor(_each)


def __getattr__(name: str) -> Callable[..., Operation]:
    """Declares to type checkers that any operation may exist."""
    raise AttributeError(f'there is no operation "{name}"; choose from: {", ".join(KINDS)}')


__all__ = ["KINDS", "FieldType", "Group", "OpField", "OpKind", "Operation", "Site", *KINDS]
