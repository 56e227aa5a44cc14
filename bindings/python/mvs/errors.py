"""What the library raises: one class a result code, each with the sentence of the C library."""

from __future__ import annotations


class Error(Exception):
    """A call that failed; the simulator is bit for bit as it was before.

    code: the negative ``MVS_E_*`` number of the C interface
    part: the part of the valve, or the argument, it is about ("triangle 17", "nodes"), or ""
    line: the 1-based line of the file being read, 0 if there is none
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
    """What can be but hardly is: a number that looks like one of another unit, a triangle like a
    needle, a line of a file that is left out. A simulator with a ``log`` tells it there instead.
    """


class ArgumentError(Error, ValueError):
    """A value that is wrong: a dtype, a shape, a range."""

    code = -1


class IdError(Error, LookupError):
    """No part of the valve has this id or name."""

    code = -2


class StateError(Error):
    """The call does not fit the simulator's state, e.g. there is no valve yet."""

    code = -3


class OpError(Error, ValueError):
    """A valve, or a surgical operation, that cannot be."""

    code = -4


class DivergedError(Error, ArithmeticError):
    """The numbers left the range in which they mean something."""

    code = -5


class FormatError(Error, ValueError):
    """A file that is not what it should be; ``line`` says where."""

    code = -6


class VersionError(Error):
    """A file of a version this library does not know."""

    code = -7


class IoError(Error, OSError):
    """The operating system refused to read or write."""

    code = -8


class DeviceError(Error):
    """A haptic device or its driver."""

    code = -9


class LimitError(Error, MemoryError):
    """Out of memory, or above a stated limit."""

    code = -10


class UnsupportedError(Error, NotImplementedError):
    """This build lacks the part asked for."""

    code = -11


class InternalError(Error):
    """A fault of the library itself: please report it."""

    code = -12


class CancelledError(Error):
    """The progress callback asked to stop."""

    code = -13


BY_CODE: dict[int, type[Error]] = {kind.code: kind for kind in Error.__subclasses__()}


def of(code: int, sentence: str, part: str, line: int) -> Error:
    """The exception for a result code of the C interface."""
    return BY_CODE.get(code, InternalError)(sentence, part, line)
