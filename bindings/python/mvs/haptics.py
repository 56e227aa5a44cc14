"""Haptic devices: which there are, and the plain values of ``mvs.Device``.

SI units throughout; ``mvs.unit_of(mvs.haptics.State, "force")``. "Of the device" means its own
frame: x to the user's right, y up, z towards the user, 0 the middle of its workspace.
"""

from __future__ import annotations

import builtins
import dataclasses
import os
from collections.abc import Mapping
from enum import IntEnum, IntFlag
from typing import Annotated, Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _core

Vector = NDArray[np.float64]
Options = Optional[Mapping[str, Any]]
"""Of a driver: a dictionary, whose values may be strings, paths or numbers."""


class HandMode(IntEnum):
    """What a hand does in a valve; the names in small letters are those of Device.set_hand."""

    LOOK = 0
    GRASP = 1
    BALL = 2
    ROD = 3
    FEEL = 4
    DRAG = 5


class Phase(IntEnum):
    """Where the forces of a device stand."""

    STOPPED = 0
    OFF = 1
    WAITING = 2
    RAMPING = 3
    ON = 4
    FADED = 5
    LATCHED = 6


class Cause(IntEnum):
    """Why forces latched off."""

    NONE = 0
    BUTTON = 1
    VELOCITY = 2
    WATCHDOG = 3
    SOFTWARE = 4
    UNPLUGGED = 5
    DEADMAN = 6
    NOT_FINITE = 7
    THERMAL = 8
    CALIBRATION = 9


class Limited(IntFlag):
    """What was done to a force."""

    FORCE = 1
    CONTINUOUS = 2
    SLEW = 4
    ENERGY = 8
    WALL = 16
    NUMBER = 32


class Event(IntFlag):
    """What happened in Device.sync."""

    PRESSED = 1
    RELEASED = 2
    GRASPED = 4
    LET_GO = 8
    MISSED = 16
    CHOSEN = 32
    DRAGGED = 64
    LOST_TOOL = 128
    BLOCKED = 256
    LATCHED = 512


@dataclasses.dataclass(frozen=True)
class Driver:
    """A driver that is installed."""

    name: str
    path: str


@dataclasses.dataclass(frozen=True)
class Found:
    """A device that a driver finds: the name that mvs.Device takes, and what it is."""

    name: str
    model: str


@dataclasses.dataclass(frozen=True)
class Finding:
    """One check of a driver's doctor.

    verdict: "good", "warning", "fault" or "note"
    check: what was looked at
    sentence: what was found, and what to do
    """

    verdict: str
    check: str
    sentence: str


@dataclasses.dataclass(frozen=True, eq=False)
class Info:
    """What a device is; numbers that its driver does not tell are those of the weakest one."""

    driver: Annotated[str, "1", "name of its driver"]
    model: Annotated[str, "1", "as the driver says"]
    serial: Annotated[str, "1", "as the driver says"]
    firmware: Annotated[str, "1", "as the driver says"]
    freedoms_in: Annotated[int, "1", "3: position; 6: orientation too"]
    freedoms_out: Annotated[int, "1", "0: no force; 3: force; 6: torque too"]
    buttons: Annotated[int, "1", "how many"]
    clock: Annotated[str, "1", '"real" or "virtual"']
    realtime: Annotated[bool, "1", "once started: its thread has real-time priority"]
    workspace_min: Annotated[Vector, "m", "smallest corner, of the device; 0: not told"]
    workspace_max: Annotated[Vector, "m", "largest corner, of the device; 0: not told"]
    peak_force: Annotated[float, "N", "that its motors can give"]
    continuous_force: Annotated[float, "N", "that its motors bear for ever"]
    max_stiffness: Annotated[float, "N/m", "the largest that is stable"]
    max_damping: Annotated[float, "N s/m", "the largest that is stable"]
    max_speed: Annotated[float, "m/s", "of the hand"]
    rate: Annotated[float, "Hz", "of its servo"]


@dataclasses.dataclass(frozen=True)
class Limits:
    """What the user allows."""

    force: Annotated[float, "N", "the most at any time"]
    continuous_force: Annotated[float, "N", "that the motors may give on average"]
    thermal_s: Annotated[float, "s", "over which it is averaged"]
    slew: Annotated[float, "N/s", "how fast the force may change"]
    gate: Annotated[float, "N", "the force has to be below it for forces to begin"]
    ramp_s: Annotated[float, "s", "in which they come up"]
    speed: Annotated[float, "m/s", "above it forces latch off"]
    stale_s: Annotated[float, "s", "a tissue model older than it fades"]
    fade_s: Annotated[float, "s", "in which it does"]
    stiffness: Annotated[float, "N/m", "the most that the hand feels"]


@dataclasses.dataclass(frozen=True, eq=False)
class View:
    """How the device's workspace lies in the scene: p = origin + scale * rotation * p_device."""

    origin: Annotated[Vector, "m", "where the middle of the workspace is"]
    rotation: Annotated[Vector, "1", "quaternion w x y z"]
    scale: Annotated[float, "1", "of lengths, from device to scene"]
    force_scale: Annotated[float, "1", "of forces, from scene to device"]


@dataclasses.dataclass(frozen=True)
class Hand:
    """The hand's tool."""

    mode: Annotated[HandMode, "1", "what it does"]
    chord: Annotated[Optional[int], "1", "id, to feel or drag; None: the nearest at the press"]
    button: Annotated[int, "1", "that grasps, 0 the first"]
    reach: Annotated[float, "m", "in the scene, to what the button takes"]
    radius: Annotated[float, "m", "of ball or rod"]
    length: Annotated[float, "m", "of the rod"]
    stiffness: Annotated[float, "N/m", "of the spring between hand and tool, in the scene"]
    max_force: Annotated[float, "N", "of that spring, in the scene"]
    gain: Annotated[float, "1", "of a felt chord's tension"]


@dataclasses.dataclass(frozen=True, eq=False)
class Report:
    """What the hand points at and did, of one Device.sync; in the scene."""

    events: Annotated[Event, "1", "what happened"]
    tool: Annotated[Optional[int], "1", "id of the hand's tool in the valve"]
    chord: Annotated[Optional[int], "1", "id of the chosen chord"]
    near_chord: Annotated[Optional[int], "1", "id of the chord nearest to the hand"]
    near_chord_distance: Annotated[float, "m", "to it"]
    near_node: Annotated[Optional[int], "1", "nearest free vertex of a leaflet"]
    near_node_distance: Annotated[float, "m", "to it"]
    node: Annotated[Optional[int], "1", "held"]
    position: Annotated[Vector, "m", "of the hand"]
    force: Annotated[Vector, "N", "of the tissue on the hand, before it is scaled"]
    stiffness: Annotated[float, "N/m", "the largest that the device renders of it"]
    drag_to: Annotated[Vector, "m", "where Event.DRAGGED wants the chord's end: chord_length"]


@dataclasses.dataclass(frozen=True, eq=False)
class State:
    """The servo as it is now."""

    phase: Annotated[Phase, "1", "where forces stand"]
    cause: Annotated[Cause, "1", "of a latch"]
    flags: Annotated[int, "1", "MVS_DRIVER_* bits of the driver (driver.h)"]
    limited: Annotated[Limited, "1", "what was done to the last force"]
    buttons: Annotated[int, "1", "debounced, a sum of 1, 2, 4, ..."]
    time: Annotated[float, "s", "since start"]
    position: Annotated[Vector, "m", "in the scene"]
    orientation: Annotated[Vector, "1", "w x y z, from the stylus' axes to the scene"]
    velocity: Annotated[Vector, "m/s", "in the scene"]
    hand: Annotated[Vector, "m", "position, of the device"]
    force: Annotated[Vector, "N", "that the motors were told, of the device"]
    rate: Annotated[float, "Hz", "of late"]
    worst_period: Annotated[float, "s", "the longest between two ticks since start"]
    model_age: Annotated[float, "s", "of the tissue model; infinity: none yet"]
    energy: Annotated[float, "J", "that the loop made and damping has not yet taken out"]
    heat: Annotated[float, "1", "0 cool to 1 at the continuous limit"]
    ticks: Annotated[int, "1", "of the servo"]
    late: Annotated[int, "1", "ticks that came after more than two periods"]


def option_lines(options: Options) -> str:
    """Options as the "key=value" lines of the C interface; a path or number as its text."""
    lines = []
    for key, value in (options or {}).items():
        line = f"{key}={os.fspath(value) if isinstance(value, os.PathLike) else value}"
        if "\n" in line:
            raise ValueError(f"options: {key!r} has a line break")
        lines.append(line)
    return "\n".join(lines)


def drivers() -> tuple[Driver, ...]:
    """The drivers in the folder mvs/drivers beside the library."""
    return tuple(Driver(*row) for row in _core.drivers())


def list(driver: Union[str, os.PathLike[str]], options: Options = None) -> tuple[Found, ...]:
    """The devices that a driver finds.

    driver: its name, or the absolute path of another one
    IoError: there is no such driver. VersionError: it speaks another version. ArgumentError: an
    option makes no sense. DeviceError: the driver's own sentence for what else is wrong.
    """
    return tuple(Found(*row) for row in _core.devices(os.fspath(driver), option_lines(options)))


def doctor(
    driver: Optional[Union[str, os.PathLike[str]]] = None, options: Options = None
) -> tuple[Finding, ...]:
    """All that a driver's device needs, looked at; errors as for ``list``.

    Without a driver: of every driver that is installed, checks being "driver: check"; one whose
    device or vendor's library is not here is one note.
    """
    words = {1: "good", 0: "fault", -1: "warning", 2: "note"}
    rows: builtins.list[tuple[int, str, str]] = _core.doctor(
        None if driver is None else os.fspath(driver), option_lines(options)
    )
    return tuple(Finding(words.get(verdict, "fault"), *told) for verdict, *told in rows)
