"""Laws of leaflets given by their word, and their constants given by their keys."""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, SupportsFloat, Union

import numpy as np

from . import _core
from .errors import ArgumentError
from .kinds import LeafletLaw
from .words import listed, shown

if TYPE_CHECKING:
    from .arrays import Law

Constants = Union[Sequence[float], Mapping[str, float]]
"""Constants of a law: in its order, or by key."""


def leaflet_law_of(law: Union[LeafletLaw, int, str]) -> int:
    """The number of a law given as LeafletLaw, its number, or its lower-case name."""
    if not isinstance(law, str):
        return _number(law)
    names = {each.name.lower(): each for each in LeafletLaw}
    if law not in names:
        raise ArgumentError(f'law: one of {listed(names)} is needed, not "{law}"', "law")
    return names[law]


def _number(law: int) -> int:
    try:
        return operator.index(law)
    except TypeError:
        raise ArgumentError(
            f"law: a mvs.LeafletLaw or its name is needed, not {shown(law)}", "law"
        ) from None


def leaflet_law(law: Union[LeafletLaw, int, str]) -> Law:
    """The description of a leaflet law (mvs.Law): its constants, units, defaults and ranges.

    law: a LeafletLaw, or its lower-case name; ArgumentError for an unknown one
    """
    return _core.leaflet_law(leaflet_law_of(law))


ZERO = -0.0
"""A constant that is zero: where constants are in order, 0.0 takes the default."""


def exact(constant: float) -> float:
    """A constant that no default replaces, also if it is zero."""
    return float(constant) or ZERO


def constants_of(law: int, given: Constants) -> tuple[float, ...]:
    """The constants of a leaflet law in its order; a key that is left out takes its default."""
    if not isinstance(given, Mapping):
        if isinstance(given, (str, bytes)) or not hasattr(given, "__len__"):
            raise ArgumentError(
                f"constants: numbers or a dictionary are needed, not {shown(given)}", "constants"
            )
        if len(given) > 8:
            raise ArgumentError(f"constants: a law has at most 8, not {len(given)}", "constants")
        return tuple(_constant(value, str(k)) for k, value in enumerate(given))
    if not given:
        return ()
    known = {each.key: each for each in leaflet_law(law).constants}
    for key in given:
        if key not in known:
            words = ", ".join(f"{c.key} ({c.unit})" if c.unit else c.key for c in known.values())
            raise ArgumentError(
                f'constants: {leaflet_law(law).name} has no "{key}", but {words}',
                f"constants.{key}",
            )
    values = {key: _constant(value, key) for key, value in given.items()}
    return tuple(exact(values.get(key, each.default)) for key, each in known.items())


def _constant(value: object, key: str) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, SupportsFloat):
        words = f"constants: a number is needed for {key}, not {shown(value)}"
        raise ArgumentError(words, f"constants.{key}")
    return float(value)
