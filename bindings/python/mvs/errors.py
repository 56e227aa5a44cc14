"""Exceptions: one class per result code, with the sentence of the C library."""

from __future__ import annotations

import re


class Error(Exception):
    """A failed call; the simulator is unchanged, bit for bit.

    code: the negative ``MVS_E_*`` number of the C interface
    part: the part of the valve or the argument at fault ("triangle 17", "nodes"), or ""
    line: 1-based line of the file, 0 without a file
    """

    code: int = 0
    part: str
    line: int

    def __init__(self, sentence: str = "", part: str = "", line: int = 0) -> None:
        super().__init__(sentence)
        self.part = part
        self.line = line

    def __reduce__(self) -> tuple[type[Error], tuple[str, str, int]]:
        return type(self), (str(self), self.part, self.line)


class ValveWarning(UserWarning):
    """A suspicious input: a number that looks like another unit, a needle triangle, an ignored line
    of a file. A simulator with a ``log`` reports it there instead.
    """


class ArgumentError(Error, ValueError):
    """A wrong value: dtype, shape or range."""

    code = -1


class IdError(Error, LookupError):
    """No part of the valve has this id or name."""

    code = -2


class StateError(Error):
    """The call does not fit the state of the simulator, e.g. it has no valve."""

    code = -3


class OpError(Error, ValueError):
    """An invalid valve, or an impossible surgical operation."""

    code = -4


class DivergedError(Error, ArithmeticError):
    """The solution left the range of finite, meaningful numbers."""

    code = -5


class FormatError(Error, ValueError):
    """A file with a wrong format; ``line`` is the line."""

    code = -6


class VersionError(Error):
    """A file of an unknown version."""

    code = -7


class IoError(Error, OSError):
    """The operating system could not read or write."""

    code = -8


class DeviceError(Error):
    """An error of a haptic device or its driver."""

    code = -9


class LimitError(Error, MemoryError):
    """Out of memory, or above a stated limit."""

    code = -10


class UnsupportedError(Error, NotImplementedError):
    """This build lacks the requested part."""

    code = -11


class InternalError(Error):
    """A defect of the library; please report it."""

    code = -12


class CancelledError(Error):
    """The progress callback requested a stop."""

    code = -13


BY_CODE: dict[int, type[Error]] = {kind.code: kind for kind in Error.__subclasses__()}


_ZERO_IS_DEFAULT = re.compile(r"(?<=be )0(?= \(the default)|(?<=or )0(?= for )")
"""The default in a sentence of the C interface, which an option that is None takes in Python."""


def of(code: int, sentence: str, part: str, line: int) -> Error:
    """The exception for a result code of the C interface."""
    if code == ArgumentError.code:
        sentence = _ZERO_IS_DEFAULT.sub("None", sentence)
    return BY_CODE.get(code, InternalError)(sentence, part, line)
