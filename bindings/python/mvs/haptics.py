"""Haptic devices: the installed drivers, and the values of ``mvs.Device``.

SI units throughout; ``mvs.unit_of(mvs.haptics.State, "force")``. "Device frame": x to the user's
right, y up, z towards the user, origin in the middle of the workspace.
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
from .describe import with_field_help

Vector = NDArray[np.float64]
Options = Optional[Mapping[str, Any]]
"""Options of a driver: a dictionary whose values are strings, paths or numbers."""


class HandMode(IntEnum):
    """Mode of the hand; Device.set_hand takes the lower-case names."""

    LOOK = 0
    GRASP = 1
    BALL = 2
    ROD = 3
    FEEL = 4
    DRAG = 5
    CONVEX = 6


class Phase(IntEnum):
    """Phase of the forces of a device."""

    STOPPED = 0
    OFF = 1
    WAITING = 2
    RAMPING = 3
    ON = 4
    FADED = 5
    LATCHED = 6


class Cause(IntEnum):
    """Cause of a latch of the forces."""

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
    """Limits that changed a force."""

    FORCE = 1
    CONTINUOUS = 2
    SLEW = 4
    ENERGY = 8
    WALL = 16
    NUMBER = 32
    TORQUE = 64


class SampleFault(IntFlag):
    """Defects of the samples of a driver."""

    NUMBER = 1
    ORIENTATION = 2
    FAR = 4
    SEQUENCE = 8
    CLOCK = 16


class Event(IntFlag):
    """Events of Device.sync."""

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
    """An installed driver."""

    name: str
    path: str


@dataclasses.dataclass(frozen=True)
class Found:
    """A device found by a driver: its name for mvs.Device, and its model."""

    name: str
    model: str


@dataclasses.dataclass(frozen=True)
class Finding:
    """One check of a driver.

    verdict: "good", "warning", "fault" or "note"
    check: subject of the check
    sentence: result and remedy
    """

    verdict: str
    check: str
    sentence: str


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False)
class Info:
    """Properties of a device; unknown ones have the values of the weakest supported device."""

    driver: Annotated[str, "1", "name of the driver"]
    model: Annotated[str, "1", "reported by the driver"]
    serial: Annotated[str, "1", "reported by the driver"]
    firmware: Annotated[str, "1", "reported by the driver"]
    freedoms_in: Annotated[int, "1", "3: position; 6: orientation too"]
    freedoms_out: Annotated[int, "1", "0: no force; 3: force; 6: torque too"]
    buttons: Annotated[int, "1", "number of buttons"]
    clock: Annotated[str, "1", '"real" or "virtual"']
    realtime: Annotated[bool, "1", "its thread has real-time priority (after start)"]
    workspace_min: Annotated[Vector, "m", "smallest corner, device frame; 0: unknown"]
    workspace_max: Annotated[Vector, "m", "largest corner, device frame; 0: unknown"]
    peak_force: Annotated[float, "N", "largest force of the motors"]
    continuous_force: Annotated[float, "N", "largest continuous force of the motors"]
    max_stiffness: Annotated[float, "N/m", "largest stable value"]
    max_damping: Annotated[float, "N s/m", "largest stable value"]
    max_speed: Annotated[float, "m/s", "largest speed of the hand"]
    rate: Annotated[float, "Hz", "of its servo"]
    peak_torque: Annotated[float, "N m", "largest torque of the motors; 0: renders none"]
    continuous_torque: Annotated[float, "N m", "largest continuous torque of the motors"]
    max_angular_stiffness: Annotated[float, "N m/rad", "largest stable value"]
    max_angular_damping: Annotated[float, "N m s/rad", "largest stable value"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Limits:
    """Limits set by the user."""

    force: Annotated[float, "N", "largest force"]
    continuous_force: Annotated[float, "N", "largest mean force"]
    thermal_s: Annotated[float, "s", "averaging time of the mean force"]
    slew: Annotated[float, "N/s", "largest rate of change of the force"]
    gate: Annotated[float, "N", "forces start only below it"]
    ramp_s: Annotated[float, "s", "duration of the ramp at the start"]
    speed: Annotated[float, "m/s", "above which forces latch off"]
    stale_s: Annotated[float, "s", "age at which the tissue model fades"]
    fade_s: Annotated[float, "s", "duration of the fade"]
    stiffness: Annotated[float, "N/m", "largest rendered stiffness"]
    torque: Annotated[float, "N m", "largest torque; 0: the device renders none"]
    continuous_torque: Annotated[float, "N m", "largest mean torque"]
    torque_slew: Annotated[float, "N m/s", "largest rate of change of the torque"]
    angular_stiffness: Annotated[float, "N m/rad", "largest rendered angular stiffness"]
    angular_speed: Annotated[float, "rad/s", "above which forces latch off"]


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False)
class View:
    """Map from the device's workspace to the scene: p = origin + scale * rotation * p_device."""

    origin: Annotated[Vector, "m", "position of the middle of the workspace"]
    rotation: Annotated[Vector, "1", "quaternion w x y z"]
    scale: Annotated[float, "1", "of lengths, from device to scene"]
    force_scale: Annotated[float, "1", "of forces, from scene to device"]


@with_field_help
@dataclasses.dataclass(frozen=True)
class Hand:
    """The hand's tool."""

    mode: Annotated[HandMode, "1", "mode"]
    chord: Annotated[Optional[int], "1", "id, to feel or drag; None: nearest on press"]
    button: Annotated[int, "1", "index of the grasping button"]
    reach: Annotated[float, "m", "reach of the button, in the scene"]
    radius: Annotated[float, "m", "of ball or rod"]
    length: Annotated[float, "m", "of the rod"]
    stiffness: Annotated[float, "N/m", "of the spring between hand and tool, in the scene"]
    max_force: Annotated[float, "N", "of that spring, in the scene"]
    gain: Annotated[float, "1", "factor on the tension of a felt chord"]
    body_count: Annotated[int, "1", "bodies of a convex tool"]


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False)
class Report:
    """Targets and actions of the hand in one Device.sync, in the scene."""

    events: Annotated[Event, "1", "events of this sync"]
    tool: Annotated[Optional[int], "1", "id of the hand's tool in the valve"]
    chord: Annotated[Optional[int], "1", "id of the chosen chord"]
    near_chord: Annotated[Optional[int], "1", "id of the chord nearest to the hand"]
    near_chord_distance: Annotated[float, "m", "distance to it"]
    near_node: Annotated[Optional[int], "1", "nearest free vertex of a leaflet"]
    near_node_distance: Annotated[float, "m", "distance to it"]
    node: Annotated[Optional[int], "1", "held node"]
    position: Annotated[Vector, "m", "of the hand"]
    force: Annotated[Vector, "N", "of the tissue on the hand, before scaling"]
    stiffness: Annotated[float, "N/m", "largest rendered stiffness"]
    drag_to: Annotated[Vector, "m", "target of the chord's end at Event.DRAGGED, for chord_length"]
    torque: Annotated[Vector, "N m", "of the tissue on the hand about its position, before scaling"]
    angular_stiffness: Annotated[float, "N m/rad", "largest rendered angular stiffness"]


@dataclasses.dataclass(frozen=True, eq=False)
class State:
    """Present state of the servo."""

    phase: Annotated[Phase, "1", "phase of the forces"]
    cause: Annotated[Cause, "1", "of a latch"]
    flags: Annotated[int, "1", "MVS_DRIVER_* bits of the driver (driver.h)"]
    limited: Annotated[Limited, "1", "limits that changed the last force"]
    buttons: Annotated[int, "1", "debounced, a sum of 1, 2, 4, ..."]
    time: Annotated[float, "s", "since start"]
    position: Annotated[Vector, "m", "in the scene"]
    orientation: Annotated[Vector, "1", "w x y z, from the stylus' axes to the scene"]
    velocity: Annotated[Vector, "m/s", "in the scene"]
    hand: Annotated[Vector, "m", "position, device frame"]
    force: Annotated[Vector, "N", "sent to the motors, device frame"]
    rate: Annotated[float, "Hz", "over the last ticks"]
    worst_period: Annotated[float, "s", "longest period since start"]
    model_age: Annotated[float, "s", "age of the tissue model; infinity: no model yet"]
    energy: Annotated[float, "J", "generated by the loop and not yet removed by damping"]
    heat: Annotated[float, "1", "0 cool to 1 at the continuous limit"]
    ticks: Annotated[int, "1", "number of ticks"]
    late: Annotated[int, "1", "ticks later than two periods"]
    bad_samples: Annotated[int, "1", "samples of the driver with a defect, since start"]
    sample_faults: Annotated[SampleFault, "1", "defects of these samples"]
    torque: Annotated[Vector, "N m", "sent to the motors, about hand, device frame"]


def option_lines(options: Options) -> str:
    """Options as "key=value" lines for the C interface."""
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

    driver: its name, or its absolute path
    IoError: no such driver. VersionError: the driver has another interface version. ArgumentError:
    invalid option. DeviceError: any other error, in the words of the driver.
    """
    return tuple(Found(*row) for row in _core.devices(os.fspath(driver), option_lines(options)))


def doctor(
    driver: Optional[Union[str, os.PathLike[str]]] = None, options: Options = None
) -> tuple[Finding, ...]:
    """Checks the requirements of a driver's device; errors as for ``list``.

    Without a driver: of every installed driver, with checks named "driver: check"; a driver without
    its device or vendor's library gives one note.
    """
    words = {1: "good", 0: "fault", -1: "warning", 2: "note"}
    rows: builtins.list[tuple[int, str, str]] = _core.doctor(
        None if driver is None else os.fspath(driver), option_lines(options)
    )
    return tuple(Finding(words.get(verdict, "fault"), *texts) for verdict, *texts in rows)
