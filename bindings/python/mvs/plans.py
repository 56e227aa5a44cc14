"""Converts the plan arguments of Simulator.replay_plan and check_plan to text."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, Union

from .errors import ArgumentError, IoError


def text_of(plan: Union[str, bytes, os.PathLike[str], Mapping[str, Any]]) -> bytes:
    """The text of a plan given as a dictionary, a path, or text.

    A string that is empty or begins with a bracket is text; give the path of a file with such a
    name as a ``Path``.
    """
    if isinstance(plan, bytes):
        return plan
    if isinstance(plan, Mapping):
        return _written(plan)
    if isinstance(plan, str) and plan.lstrip()[:1] in ("", "{", "["):
        # lone surrogates: the library reports the position of the invalid byte
        return plan.encode("utf-8", "surrogatepass")
    if isinstance(plan, (str, os.PathLike)):
        return _read(plan)
    raise ArgumentError(
        f"plan: its text, a path or a dictionary is needed, not {type(plan).__name__}", "plan"
    )


def _written(plan: Mapping[str, Any]) -> bytes:
    # json writes floats with all digits: they read back as the same double
    try:
        return json.dumps(dict(plan), allow_nan=False).encode("ascii")
    except (TypeError, ValueError, RecursionError) as error:
        raise ArgumentError(f"plan: the dictionary is not JSON: {error}", "plan") from error


def _read(path: Union[str, os.PathLike[str]]) -> bytes:
    try:
        with open(path, "rb") as file:
            return file.read()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        name = os.fspath(path)
        raise IoError(f"{name}: cannot read the plan: {why}", name) from error
