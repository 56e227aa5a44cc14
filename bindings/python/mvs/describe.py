"""Docstrings of dataclasses whose fields carry unit and definition, for help()."""

from __future__ import annotations

import dataclasses
from typing import TypeVar, get_type_hints

from .errors import ArgumentError
from .words import did_you_mean

Kind = TypeVar("Kind", bound=type)


def annotation_of(kind: type, name: str) -> tuple[str, str]:
    """Unit (or shape and unit) and definition of a field."""
    hints = get_type_hints(kind, include_extras=True)
    if name not in hints:
        near = did_you_mean(name, hints)
        where = f"; help(mvs.{kind.__name__}) lists the fields"
        raise ArgumentError(f'a mvs.{kind.__name__} has no field "{name}"{near or where}', "name")
    unit, definition = getattr(hints[name], "__metadata__", ("", ""))
    return unit, definition


def with_field_help(kind: Kind) -> Kind:
    """Adds unit and definition of every field to the docstring of a dataclass."""
    lines = [(kind.__doc__ or "").rstrip(), ""]
    for field in dataclasses.fields(kind):
        unit, definition = annotation_of(kind, field.name)
        lines.append(f"{field.name}: {'' if unit == '1' else unit + ': '}{definition}")
    kind.__doc__ = "\n".join(lines)
    return kind
