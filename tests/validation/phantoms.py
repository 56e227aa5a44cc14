"""Valves recovered from phantom volumes, compared with the valves that the volumes were made of.

    python tests/validation/phantoms.py [--kind micro-ct|ultrasound] [--cases N] [--short] [--data DIR]

For each case: a phantom (mvs.imaging.phantom; open and loaded, closed under another tissue law and on
a finer mesh than the recovered model), written to a folder without its truth; the recovery of
`mvs-image build`, which sees that folder only; then distances from the truth. Micro-CT: from the grey
volumes alone. Ultrasound: from labels with errors and landmarks, also without the loaded image.

"Both ends right": a chord is the way from a papillary head to an insertion, so that a fork of three is three
chordae. Recovered and true chordae of the open valve are paired one to one by the least sum of the distances
of their ends. A true chord is right if the insertion and the head of its partner lie within 1.5 mm of its own
(ultrasound 5 mm); branch points do not count. The share is one of all true chordae, also of those that
overlap others in the image. "Length error": of the rest lengths of the ways, the median over the right ones.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Optional

import mvs
import phantom_cases
from mvs.imaging import phantom
from mvs.imaging.phantom.truth import true_valve
from phantom_errors import MM, chord_errors, closed_with_default_law, leak_interval, thickness_error
from phantom_rows import Row, table

NEAR = {"micro-ct": 1.5, "ultrasound": 5.0}
"""mm: an end of a chord is right if it is at most so far from that of its true chord; chordae end 2 to
4 mm apart on the leaflets."""

SAID = ("tissue", "edge_found", "leak", "leak_interval", "shown_gaps", "edge_lost", "filled_holes", "free_edge", "holes")
"""Findings whose sentences are printed for each case."""


def run_case(name: str, valve: mvs.Snapshot, settings: phantom.Settings, folder: Path,
             fitted: bool = True, unfitted: bool = True) -> Row:
    """Makes a phantom, recovers it from its files, compares; `fitted`: with the loaded
    image; `unfitted`: also, or only, without it."""
    row, start = Row(name), time.process_time()
    made = phantom.make(valve, settings)
    phantom.save(made, folder)
    shutil.rmtree(folder / "truth")  # the recovery sees images, labels and landmarks only
    row.cpu_phantom = time.process_time() - start
    row.leak = made.truth.closed.measures.regurgitant_orifice_area * MM**2
    row.law_rms = closed_with_default_law(made.truth) * MM
    start = time.process_time()
    try:
        if not fitted:
            low, high = leak_interval(recover(folder, settings.kind, loaded=False))
            row.unfitted = high - low
            row.cpu_recovery = time.process_time() - start
            return row
        found = recover(folder, settings.kind, loaded=True)
    except mvs.Error as error:
        row.refused = str(error)
        return row
    row.cpu_recovery = time.process_time() - start
    compare(row, made, found)
    for one in found.findings:
        if one.name in SAID:
            print(f"    {one.name}: {one.sentence}", file=sys.stderr)
    if settings.kind == "ultrasound" and unfitted:
        low, high = leak_interval(recover(folder, settings.kind, loaded=False))
        row.unfitted = high - low
    return row


def truth_of(name: str, valve: mvs.Snapshot, settings: phantom.Settings) -> Row:
    """The leak of the true valve, and the part of the closed RMS that is due to the law alone."""
    truth = true_valve(valve, settings, loaded=True)
    leak = truth.closed.measures.regurgitant_orifice_area * MM**2
    return Row(name, leak=leak, law_rms=closed_with_default_law(truth) * MM)


def recover(folder: Path, kind: str, loaded: bool, *options: str) -> Any:
    """The valve that `mvs-image build` makes of the files of a folder and options (mvs.imaging.ImageValve)."""
    from mvs.imaging.command import parser_of
    from mvs.imaging.console import Console
    from mvs.imaging.requests import valve_of_request

    ending = "nrrd" if kind == "micro-ct" else "seg.nrrd"
    given = ["build", str(folder / f"open.{ending}"), "-o", str(folder / "valve.h5"), "--quiet", *options]
    if loaded:
        given += ["--loaded", str(folder / f"loaded.{ending}")]
    if kind == "ultrasound":
        for part in ("commissures", "annulus", "anterior", "tips"):
            given += [f"--{part}", str(folder / f"open_{part}.mrk.json")]
            if loaded:
                given += [f"--loaded-{part}", str(folder / f"loaded_{part}.mrk.json")]
    return valve_of_request(parser_of()[0].parse_args(given), Console(True))


def compare(row: Row, made: phantom.Phantom, found: Any) -> None:
    """Fills the figures of a row; the open image has the frame of the truth."""
    truth = made.truth
    row.mid_rms = found.opened.compare(truth.opened).surface_rms * MM
    row.thickness = 100 * thickness_error(found.opened, truth.opened)
    row.chords, row.lengths = chord_errors(found.opened, truth.opened, NEAR[made.settings.kind])
    row.closed_rms = found.closed.compare(truth.closed).surface_rms * MM
    row.low, row.high = leak_interval(found)


def settings_of(arguments: argparse.Namespace, kind: str, seed: int) -> phantom.Settings:
    """The phantom of a case; --short: a coarser true mesh and voxels."""
    changes: dict[str, Any] = {"seed": seed, "pose": True}
    if arguments.short:
        changes.update(vertices=0, spacing={"micro-ct": 0.3, "ultrasound": 0.7}[kind])
    if arguments.spacing:
        changes["spacing"] = arguments.spacing
    if arguments.law:
        changes["law"] = arguments.law
    if arguments.exact_labels:
        changes["labels"] = phantom.LabelErrors()
    return phantom.PRESETS[kind](**changes)


def main() -> int:
    """Runs the cases and prints the table; the exit code is 1 if no case was recovered."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    add = parser.add_argument
    add("--data", type=Path, default=Path(os.environ.get("MVS_TEST_DATA", default)), metavar="DIR")
    add("--kind", choices=tuple(phantom.PRESETS), default="ultrasound")
    add("--cases", type=int, metavar="N", help="[4; 2 with --short]")
    add("--first", type=int, default=1, metavar="N", help="leave out the cases before this one [1]")
    add("--seed", type=int, default=0, metavar="N", help="of the cases [0]")
    add("--short", action="store_true", help="two cases of coarse phantoms, in less than a minute")
    add("--spacing", type=float, metavar="MM", help="of the voxels [0.15; ultrasound 0.7]")
    add("--fitted-only", action="store_true", help="ultrasound: not also without the loaded image")
    add("--unfitted-only", action="store_true", help="ultrasound: without the loaded image alone: the "
        "width of the interval of leaks")
    add("--exact-labels", action="store_true", help="ultrasound labels without errors")
    add("--law", metavar="LAW", help="tissue of the true leaflets [may_newman_yin]")
    add("--truth-only", action="store_true", help="no volumes: the true leak, and how far the law "
        "alone moves the closed shape")
    add("--save", type=Path, metavar="FILE", help="the rows as JSON, for compare_phantoms.py")
    add("--keep", type=Path, metavar="DIR", help="keep the files that the recovery saw")
    arguments = parser.parse_args()
    count = arguments.cases or (2 if arguments.short else 4)
    rows: list[Row] = []
    spacing: Optional[float] = None
    chosen = phantom_cases.cases(arguments.data, count, arguments.seed)
    for k, (name, valve) in enumerate(chosen[arguments.first - 1 :], arguments.first):
        settings = settings_of(arguments, arguments.kind, 1000 * arguments.seed + k)
        spacing = settings.spacing
        with tempfile.TemporaryDirectory() as temporary:
            folder = arguments.keep / f"case{k}" if arguments.keep else Path(temporary)
            name = f"{arguments.seed}, {name}"
            print(name, file=sys.stderr, flush=True)
            if arguments.truth_only:
                rows.append(truth_of(name, valve(), settings))
            else:
                rows.append(run_case(name, valve(), settings, folder, not arguments.unfitted_only,
                                     not arguments.fitted_only))
            print(f"  {rows[-1]}", file=sys.stderr, flush=True)
    print(table(rows, spacing or 0.0))
    if arguments.save:
        arguments.save.write_text(json.dumps([dataclasses.asdict(row) for row in rows], indent=1))
    return 0 if any(not row.refused for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
