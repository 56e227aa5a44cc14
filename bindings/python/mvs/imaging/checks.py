"""Checks of `mvs-image` before the work: missing inputs, outputs that would overwrite something, options that
contradict one another."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

import mvs
from .options import LANDMARKS, VALVE_ENDINGS

OUTPUTS = {"output": "--output", "findings": "--findings", "report": "--report"}


def findings_path(chosen: argparse.Namespace) -> Path:
    """The file of the findings: that of --findings, or one beside the valve."""
    given: Path = chosen.findings or chosen.output.with_suffix(".import.json")
    return given


def check_request(chosen: argparse.Namespace) -> None:
    """Refuses a call of which it is known before the work that it cannot succeed."""
    check_outputs(chosen)
    for name, path in _inputs(chosen).items():
        if not path.exists():
            raise mvs.IoError(f"{path}: there is no such file", name)
        if path.is_dir() and name not in ("image", "loaded"):
            raise mvs.IoError(f"{path}: is a folder: name a file", name)
    if chosen.plan:
        try:
            json.loads(chosen.plan.read_text(encoding="utf-8"))
        except ValueError as error:
            raise mvs.FormatError(f"{chosen.plan}: is no plan, which is JSON ({error})", "plan") from error
    _check_loaded(chosen)
    _check_segments(chosen)


def _inputs(chosen: argparse.Namespace) -> dict[str, Path]:
    return {name: value for name, value in vars(chosen).items() if isinstance(value, Path) and name not in OUTPUTS}


def check_outputs(chosen: argparse.Namespace) -> None:
    """Refuses outputs that cannot be written, are one another or are an input. Only the file of --with may be
    written again, as the findings."""
    if chosen.output.suffix.lower() not in VALVE_ENDINGS:
        raise mvs.ArgumentError(f"{chosen.output}: the ending names no known format: known endings are "
                                f"{', '.join(VALVE_ENDINGS)}", "output")
    outputs = {"output": chosen.output, "findings": findings_path(chosen), "report": chosen.report}
    written: dict[str, Path] = {}
    for name, path in outputs.items():
        if path is None:
            continue
        if path.is_dir():
            raise mvs.IoError(f"{path}: is a folder: name a file", "output")
        if not path.parent.is_dir():
            raise mvs.IoError(f"{path}: there is no folder {path.parent}: create it first", "output")
        if not os.access(path.parent, os.W_OK):
            raise mvs.IoError(f"{path}: the folder {path.parent} cannot be written", "output")
        for source_name, source in _inputs(chosen).items():
            if _is_part(path, source) and (name, source_name) != ("findings", "known"):
                raise mvs.ArgumentError(f"{path}: is an input as well, which would be lost: give another output", "output")
        for other_name, other in written.items():
            if _is_same(path, other):
                raise mvs.ArgumentError(
                    f"{path}: {OUTPUTS[other_name]} and {OUTPUTS[name]} would be the same file, and one of them lost: give "
                    "each a file of its own", name)
        written[name] = path


def _is_same(path: Path, other: Path) -> bool:
    """Whether two paths are one file, under whatever name, also if it is not there yet."""
    if path.exists() and other.exists():
        return path.samefile(other)
    return path.resolve() == other.resolve()


def _is_part(path: Path, source: Path) -> bool:
    """Whether a file is an input, or one of the files of an input that is a folder."""
    if source.is_dir():
        return path.exists() and _is_same(path.parent, source)
    return _is_same(path, source)


def _check_loaded(chosen: argparse.Namespace) -> None:
    """Refuses options of the loaded image without one."""
    if chosen.loaded:
        return
    given = [f"--loaded-{part}" for part in LANDMARKS if getattr(chosen, f"loaded_{part}")]
    given += ["--register"] if chosen.register else []
    if given:
        raise mvs.ArgumentError(f"{given[0]} is about the loaded image, and none is given: give it with --loaded, or leave "
                                f"{given[0]} out", given[0])


def _check_segments(chosen: argparse.Namespace) -> None:
    """Refuses one segment for two leaflets, and a segment of both beside one of a single leaflet."""
    one, other, both = chosen.anterior_label, chosen.posterior_label, chosen.leaflet_label
    if one is not None and one == other:
        raise mvs.ArgumentError(f'--anterior-label and --posterior-label are both "{one}": give a segment for each, or '
                                "--leaflet-label if one segment holds both leaflets", "labels")
    if both is not None and (one is not None or other is not None):
        given = "--anterior-label" if one is not None else "--posterior-label"
        raise mvs.ArgumentError(f"--leaflet-label is one segment that holds both leaflets: give it without {given}, or "
                                "--anterior-label and --posterior-label without it", "labels")
