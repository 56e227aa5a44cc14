"""Output of the command on stderr: progress of long work; lines of ITK are left out."""

from __future__ import annotations

import contextlib
import os
import sys
import time
import warnings
from collections.abc import Iterator
from typing import Optional, TextIO, Union

from mvs import ValveWarning


class Console:
    """Prints one line for each stage when it begins, and the share that is done: on a terminal in that
    line, elsewhere a line for each fifth."""

    def __init__(self, quiet: bool = False, stream: Optional[TextIO] = None) -> None:
        self._quiet, self._stream = quiet, stream or sys.stderr
        self._start = time.monotonic()
        self._name, self._fifths = "", 0

    def stage(self, name: str) -> None:
        """A new stage begins."""
        self._end_line()
        self._name, self._fifths = name, 0
        if not self._quiet:
            after = time.monotonic() - self._start
            self._stream.write(f"[{after:6.1f} s] {name}")
            self._stream.write("" if self._stream.isatty() else "\n")
            self._stream.flush()

    def share(self, done: float) -> None:
        """The present stage is done to a share of 0 to 1."""
        if self._quiet:
            return
        percent = 100 * min(max(done, 0.0), 1.0)
        if self._stream.isatty():
            self._stream.write(f"\r{self._name}: {percent:3.0f} %   ")
        elif int(percent / 20) > self._fifths:
            self._fifths = int(percent / 20)
            after = time.monotonic() - self._start
            self._stream.write(f"[{after:6.1f} s]   {percent:.0f} %\n")
        self._stream.flush()

    def done(self) -> None:
        """The work is finished."""
        self._end_line()
        self._name = ""

    def _end_line(self) -> None:
        if self._name and not self._quiet and self._stream.isatty():
            self._stream.write("\n")
            self._stream.flush()


@contextlib.contextmanager
def silenced() -> Iterator[None]:
    """Drops what C++ libraries write to stderr, such as warnings of ITK and GDCM before they raise an error, whose
    sentence is shown."""
    sys.stderr.flush()
    try:
        kept = os.dup(2)
    except OSError:  # a process without stderr
        yield
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        sys.stderr.flush()
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)


@contextlib.contextmanager
def warnings_in_lines(quiet: bool) -> Iterator[None]:
    """Shows each warning as one line on stderr, without source code; quiet: only those about the valve and its files."""
    def show(message: Union[Warning, str], category: type[Warning], filename: str, lineno: int,
             file: Optional[TextIO] = None, line: Optional[str] = None) -> None:
        if not quiet or issubclass(category, ValveWarning):
            print(f"mvs-image: warning: {' '.join(str(message).split())}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.showwarning = show
        yield
