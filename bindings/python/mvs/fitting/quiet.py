"""Warnings about a valve are given for the start of a fit, not for each trial."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator

from ..errors import ValveWarning


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Without ValveWarning."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValveWarning)
        yield
