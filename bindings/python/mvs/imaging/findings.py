"""Findings in an image, as those of a build (mvs.Finding), and their file."""

from __future__ import annotations

import dataclasses
import json
import os
import warnings
from collections.abc import Iterable, Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

import mvs

Values = Union[Sequence[float], NDArray[np.float64]]
CLOSED = ("closed_annulus", "closed_tips")
POINTS = ("annulus", "commissures", "anterior", "papillary_tips", *CLOSED)
LENGTHS = ("thickness", "edge_error", "edge_lost", "thickness_error", "closed_error")
RANGES = {"edge": (2e-4, 5e-3), "thickness": (1e-4, 5e-3), "coaptation_length": (1e-3, 20e-3), "edge_error": (1e-6, 5e-3),
          "edge_lost": (1e-6, 5e-3), "thickness_error": (1e-6, 2e-3), "closed_error": (1e-6, 5e-3),
          "chords": (20, 400)}
"""Ranges of the options of a build (include/mvs/build.h), m; of `chords` a number"""
LAW = "tissue"
INPUTS = (*POINTS, *LENGTHS, LAW)
"""Findings that are an input of a build; lengths are one number each, m, the law is that of `mvs.LeafletLaw`."""


def finding(name: str, source: mvs.FindingSource, confidence: float, sentence: str,
            values: Values = (), unit: str = "") -> mvs.Finding:
    """A finding; `values` in SI units, points as x, y, z in turn."""
    return mvs.Finding(name, source, float(confidence), sentence,
                       np.asarray(values, float).ravel(), unit)


def row_of(one: mvs.Finding) -> dict[str, Any]:
    """A finding as an object of JSON, with its values in SI units."""
    return {"name": one.name, "source": mvs.FindingSource(one.source).name.lower(), "confidence": float(one.confidence),
            "sentence": one.sentence, "unit": one.unit, "values": [float(value) for value in one.values],
            "doubtful": one.doubtful}


def write_findings(path: Union[str, "os.PathLike[str]"], source: str,
                   findings: Iterable[mvs.Finding]) -> None:
    """Writes the file that `mvs import --with` reads, beside and then renamed."""
    rows = [{**row_of(one), "unedited": _digest(one.values)} for one in findings]
    text = json.dumps({"format": "libmvs import", "version": 1, "surface": source,
                       "findings": rows}, indent=2, ensure_ascii=False)
    beside = f"{os.fspath(path)}.part"
    with open(beside, "w", encoding="utf-8") as file:
        file.write(text + "\n")
    os.replace(beside, path)


def _digest(values: Values) -> str:
    """A digest of the bits of the values (FNV-1a), as `mvs import` writes it: an edited row has another one."""
    known = 14695981039346656037
    for byte in np.asarray(values, "<f8").tobytes():
        known = (known ^ byte) * 1099511628211 % 2**64
    return f"{known:016x}"


def read_rows(path: Union[str, "os.PathLike[str]"]) -> list[dict[str, Any]]:
    """The inputs of a build among the findings of a file (`--with`) that are given, guessed or assumed.

    Measured ones are left out: they are measured again, with a warning if they were edited. FormatError for another file, and for a row without a name or
    one written by hand that is no input.
    """
    try:
        with open(path, encoding="utf-8") as file:
            read = json.load(file)
        rows = read["findings"] if read["format"] == "libmvs import" else None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise mvs.FormatError(f"{os.fspath(path)}: is no file of findings ({error})", "with") from error
    if rows is None or read.get("version") != 1:
        raise mvs.FormatError(f"{os.fspath(path)}: is no file of findings of this version", "with")
    for row in rows if isinstance(rows, list) else (None,):
        if not isinstance(row, dict) or not isinstance(row.get("name"), str):
            raise mvs.FormatError(f"{os.fspath(path)}: has a finding without a name", "with")
        if row["name"] not in INPUTS and "unedited" not in row:  # written by hand: those of a build have a digest
            raise mvs.FormatError(f"{os.fspath(path)}: the finding \"{row['name']}\" is no input of a build; inputs are "
                                  f"{', '.join(INPUTS)}", row["name"])
    used = [row for row in rows if row["name"] in INPUTS and row.get("source") != "measured"]
    for row in rows:
        if row not in used and _is_edited(row):
            why = ('it was measured, and is measured again; change its source to "given" if it is known'
                   if row["name"] in INPUTS else "it is a result of the build and no input")
            warnings.warn(f"{os.fspath(path)}: the edited value of \"{row['name']}\" is not used: {why}",
                          mvs.ValveWarning, stacklevel=2)
    return used


def _is_edited(row: dict[str, Any]) -> bool:
    """Whether the values of a finding that a build wrote are others now."""
    try:
        return "unedited" in row and row["unedited"] != _digest(row.get("values", ()))
    except (TypeError, ValueError):  # no numbers
        return True


def read_known(path: Union[str, "os.PathLike[str]"]) -> dict[str, Any]:
    """The values of the rows of a file, by name."""
    return known_values(path, read_rows(path))


def known_values(path: Union[str, "os.PathLike[str]"], rows: Iterable[dict[str, Any]]) -> dict[str, Any]:
    """The values of rows of a file, by name; FormatError if they are no numbers."""
    known: dict[str, Any] = {}
    for row in rows:
        try:
            values = np.asarray(row.get("values"), float)
        except (TypeError, ValueError):
            values = np.empty(0)
        count = 3 if row["name"] in POINTS else 1
        if values.ndim != 1 or not len(values) or len(values) % count or not np.isfinite(values).all():
            raise mvs.FormatError(f"{os.fspath(path)}: the finding \"{row['name']}\" needs finite numbers: points need "
                                  "x, y, z each, the others one", row["name"])
        least, most = RANGES.get(row["name"], (-np.inf, np.inf))
        if row["name"] in LENGTHS and not least <= values[0] <= most:
            raise mvs.FormatError(f"{os.fspath(path)}: the finding \"{row['name']}\" has the value {values[0]:g} m: it has "
                                  f"to be {least * 1e3:g} to {most * 1e3:g} mm", row["name"])
        known[row["name"]] = (float(values[0]) if row["name"] in LENGTHS else _law(path, values[0])
                              if row["name"] == LAW else values.reshape(-1, 3).copy())
    return known


def keep_doubts(rows: Iterable[dict[str, Any]], findings: Iterable[mvs.Finding]) -> tuple[mvs.Finding, ...]:
    """Findings of a build with the values of rows of a file. Unedited guesses and assumptions keep their source,
    confidence and doubt, though the build takes them for given."""
    unsure = {row["name"]: row for row in rows
              if row.get("source") in ("guessed", "assumed") and row.get("unedited") == _digest(row["values"])}

    def kept(one: mvs.Finding) -> mvs.Finding:
        row = unsure.get(one.name)
        if row is None or one.source != mvs.FindingSource.GIVEN:
            return one
        return dataclasses.replace(
            one, source=mvs.FindingSource[row["source"].upper()], confidence=min(one.confidence, row["confidence"]),
            doubtful=one.doubtful or bool(row.get("doubtful")),
            sentence=f"{one.sentence}; {row['source']} in an earlier import: change its source to \"given\" if it is known")

    return tuple(kept(one) for one in findings)


UNVARIED = {"papillary_tips": "papillary heads", "commissures": "commissures"}


def with_limits(findings: Iterable[mvs.Finding]) -> tuple[mvs.Finding, ...]:
    """Findings in which the interval of leaks names the landmarks that are guessed or assumed, whose errors are not in
    it. A build says so of its own guesses; not of those of an earlier run, nor beside chordae of an image."""
    kept = tuple(findings)
    unsure = (mvs.FindingSource.GUESSED, mvs.FindingSource.ASSUMED)
    words = " and ".join(meaning for name, meaning in UNVARIED.items()
                         if any(one.name == name and one.source in unsure for one in kept))
    said = {"leak_interval": f"; errors of the {words}, which were not given, are not in it",
            "leak_limits": f"; errors of the guessed {words} are not in it: give them as landmarks"}

    def limited(one: mvs.Finding) -> mvs.Finding:
        known = "which were not given" in one.sentence or "errors of the guessed" in one.sentence
        if not words or known or one.name not in said or one.name == "leak_interval" and not len(one.values):
            return one
        return dataclasses.replace(one, sentence=one.sentence + said[one.name])

    return tuple(limited(one) for one in kept)


def _law(path: Union[str, "os.PathLike[str]"], number: float) -> mvs.LeafletLaw:
    for law in mvs.LeafletLaw:
        if law == number:
            return law
    raise mvs.FormatError(f'{os.fspath(path)}: the finding "{LAW}" has the value {number:g}: it has to be the number '
                          f"of a law of leaflets, 1 to {len(mvs.LeafletLaw)}", LAW)
