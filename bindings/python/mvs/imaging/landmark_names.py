"""Names of landmarks, AL and PM, beside the sides on which a build has found them, as `mvs import` compares them."""

from __future__ import annotations

import dataclasses
import os
import re
from collections.abc import Iterable, Sequence
from typing import Optional, Union

import numpy as np
from numpy.typing import NDArray

import mvs
from .findings import finding
from .names import words_of

ANTEROLATERAL, POSTEROMEDIAL = -1, 1


def side_of(name: str) -> Optional[int]:
    """The side in a name, such as "AL", "AL1", "pm tip" or "anterolateral"; None: none."""
    plain = "".join(words_of(name))
    for side, letters, word in ((ANTEROLATERAL, "al", "anterolat"), (POSTEROMEDIAL, "pm", "posteromed")):
        if word in plain or any(re.fullmatch(letters + r"\d*", one) for one in words_of(name)):
            return side
    return None


def misnamed(path: Union[str, "os.PathLike[str]"], points: NDArray[np.float64], names: Sequence[str],
             findings: Iterable[mvs.Finding]) -> tuple[mvs.Finding, ...]:
    """A doubtful finding if points of a file lie on the other side of the valve than their names say.

    points: (n, 3) in m and LPS; names: one each, or none
    findings: of the build: its commissures, the anterolateral one first
    """
    ends = next((np.reshape(one.values, (2, 3)) for one in findings
                 if one.name == "commissures" and len(one.values) == 6), None)
    if ends is None:
        return ()
    sides = np.where((points - ends.mean(axis=0)) @ (ends[1] - ends[0]) > 0, POSTEROMEDIAL, ANTEROLATERAL)
    others = [f'"{name}"' for name, side in zip(names, sides) if side_of(name) not in (None, side)]
    if not others:
        return ()
    return (dataclasses.replace(finding(
        "landmark_names", mvs.FindingSource.MEASURED, 0.2,
        f"{os.fspath(path)}: on the other side of the valve than their names say (AL: anterolateral, PM: "
        f"posteromedial): {', '.join(others)}. Are names swapped, is the case mirrored, or are they in the other "
        "frame (LPS or RAS)? Scallops 1 and 3 depend on it"), doubtful=True),)
