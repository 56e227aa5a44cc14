"""Arguments of mvs.fit: a sentence for each that would be taken for something else, or for nothing."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, Optional

import numpy as np

from .. import _core
from ..errors import ArgumentError
from ..words import shown
from .parameters import PRIORS, Prior

MOST_NOISE = 0.01
"""m: data of a larger deviation say nothing about a valve of 40 mm; it was given in mm."""
MOST_HEAD = 0.05
"""m, deviation of a head."""
RELATIVE = ("chords", "tissue", "thickness")
"""Groups whose deviation is a share of the value at the start, which has to stay positive."""


def checked_number(name: str, value: Any, most: float = math.inf) -> float:
    """A positive finite number."""
    is_number = isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
    if not is_number or not 0 < value < math.inf:
        raise ArgumentError(f"{name}: a positive number is needed, not {shown(value)}", name)
    if value > most:
        raise ArgumentError(f"{name}: {value:g} m is more than {most:g} m; metres are needed, not millimetres",
                            name)
    return float(value)


def checked_count(name: str, value: Any, least: int = 1) -> int:
    """A whole number of at least this."""
    is_whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    if not is_whole or value < least:
        raise ArgumentError(f"{name}: a whole number of at least {least} is needed, not {shown(value)}", name)
    return int(value)


def checked_level(level: Any) -> float:
    """The share of a distribution that an interval holds."""
    if not isinstance(level, (int, float, np.number)) or not 0 < level < 1:
        raise ArgumentError(f"level: a number between 0 and 1 is needed, not {shown(level)}", "level")
    return float(level)


def checked_start(start: Any) -> _core.Snapshot:
    """A snapshot; whether it is at rest is another question."""
    if not isinstance(start, _core.Snapshot):
        raise ArgumentError(
            f"start: a closed mvs.Snapshot is needed (sim.snapshot() after sim.settle()), not {shown(start)}",
            "start")
    return start


def checked_groups(free: Any) -> list[str]:
    """Names of groups."""
    groups: list[Any] = [free] if isinstance(free, str) else list(free) if isinstance(free, Iterable) else [None]
    if not all(isinstance(group, str) for group in groups):
        raise ArgumentError(f"free: a name or a list of names is needed, not {shown(free)}", "free")
    return groups


def checked_priors(priors: Any, groups: list[str]) -> Optional[Mapping[str, Prior]]:
    """Priors by group, of groups that are free; None for the default ones or none at all."""
    if priors is None or priors is False:
        return None
    if not isinstance(priors, Mapping):
        raise ArgumentError(
            f'priors: a mapping of groups to mvs.Prior is needed, {{"chords": mvs.Prior(0.1)}}, or False for no '
            f"priors, not {shown(priors)}", "priors")
    for group, prior in priors.items():
        if not isinstance(prior, Prior):
            raise ArgumentError(f"priors: {group} needs a mvs.Prior, not {shown(prior)}", "priors")
        if group in PRIORS and group not in groups:
            raise ArgumentError(f'priors: "{group}" is not among the free groups', "priors")
        _check_prior(group, prior)
    return priors


def _check_prior(group: str, prior: Prior) -> None:
    for name in ("deviation", "reach"):
        checked_number(f"priors: {name} of {group}", getattr(prior, name))
    lowest = 1 - prior.deviation * prior.reach
    if group in RELATIVE and lowest <= 0:
        raise ArgumentError(
            f"priors: the bounds of {group} reach {lowest:g} times the start: its deviation is a share (0.1 for "
            "10 %), and deviation times reach has to stay below 1", "priors")
    if group == "heads" and prior.deviation > MOST_HEAD:
        raise ArgumentError(f"priors: heads have a deviation of {prior.deviation:g} m; metres are needed, not "
                            "millimetres", "priors")
