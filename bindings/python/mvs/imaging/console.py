"""Progress of long work on stderr: the name of a stage, its share where it is known, and times."""

from __future__ import annotations

import sys
import time
from typing import Optional, TextIO


class Console:
    """Prints one line for each stage when it begins; on a terminal also the share that is done."""

    def __init__(self, quiet: bool = False, stream: Optional[TextIO] = None) -> None:
        self._quiet, self._stream = quiet, stream or sys.stderr
        self._start = time.monotonic()
        self._name = ""

    def stage(self, name: str) -> None:
        """A new stage begins."""
        self._end_line()
        self._name = name
        if not self._quiet:
            after = time.monotonic() - self._start
            self._stream.write(f"[{after:6.1f} s] {name}")
            self._stream.write("" if self._stream.isatty() else "\n")
            self._stream.flush()

    def share(self, done: float) -> None:
        """The present stage is done to a share of 0 to 1."""
        if not self._quiet and self._stream.isatty():
            self._stream.write(f"\r{self._name}: {100 * min(max(done, 0.0), 1.0):3.0f} %   ")
            self._stream.flush()

    def done(self) -> None:
        """The work is finished."""
        self._end_line()
        self._name = ""

    def _end_line(self) -> None:
        if self._name and not self._quiet and self._stream.isatty():
            self._stream.write("\n")
            self._stream.flush()
