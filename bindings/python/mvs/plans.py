"""What Simulator.replay_plan and check_plan take, as the text that the library reads."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, Union

from .errors import ArgumentError, IoError


def text_of(plan: Union[str, bytes, os.PathLike[str], Mapping[str, Any]]) -> bytes:
    """The text of a plan given as a dictionary, a path, or the text itself.

    A string that begins with a bracket, or is empty, is text: no plan is read from a file of such
    a name unless it is given as a ``Path``.
    """
    if isinstance(plan, bytes):
        return plan
    if isinstance(plan, Mapping):
        return _written(plan)
    if isinstance(plan, str) and plan.lstrip()[:1] in ("", "{", "["):
        # what UTF-8 cannot say goes on to the library, which refuses it with the byte's place
        return plan.encode("utf-8", "surrogatepass")
    if isinstance(plan, (str, os.PathLike)):
        return _read(plan)
    raise ArgumentError(
        f"plan: its text, a path or a dictionary is needed, not {type(plan).__name__}", "plan"
    )


def _written(plan: Mapping[str, Any]) -> bytes:
    # json writes a float with the digits that read back as the same double: no bit is lost
    try:
        return json.dumps(dict(plan), allow_nan=False).encode("ascii")
    except (TypeError, ValueError, RecursionError) as error:
        raise ArgumentError(f"plan: the dictionary is no JSON: {error}", "plan") from error


def _read(path: Union[str, os.PathLike[str]]) -> bytes:
    try:
        with open(path, "rb") as file:
            return file.read()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        name = os.fspath(path)
        raise IoError(f"{name}: cannot read the plan: {why}", name) from error
