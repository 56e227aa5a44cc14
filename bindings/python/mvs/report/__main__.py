"""Command line of the report: python -m mvs.report [--out DIR] [FILE ...]"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

import mvs
from mvs import study

from . import ensemble, operations, repairs
from .cases import Case, from_file, leaking, shipped, verdict
from .table import as_text


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m mvs.report",
        description="Closes the valves of the files, prints tables and writes DIR/report.html. "
        "Without a FILE: of the shipped valve and a leaking variant of it, with every operation "
        "and the founding paper's study of repairs.",
    )
    parser.add_argument("--out", type=Path, metavar="DIR",
                        help="output folder [the name of the first FILE, and -report]")
    parser.add_argument("--pressure", type=float, metavar="MMHG",
                        help="pressure [that of the load in a FILE, else 120]")
    parser.add_argument("--members", type=int, default=8, metavar="N",
                        help="closures in the ensemble of each valve; 0: no such chapter [8]")
    parser.add_argument("--no-pictures", action="store_true", help="tables only")
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE",
                        help="valves (.obj, .h5, .inp); only they are reported")
    arguments = parser.parse_args()
    if arguments.out is None:
        first = arguments.files[0].stem if arguments.files else "mvs"
        arguments.out = Path(f"{first}-report")
    return arguments


def _close_all(files: list[Path], asked_pa: float | None, pressure_pa: float) -> list[Case]:
    cases: list[Case] = []
    of_files = (from_file(file, f"file{k}", asked_pa) for k, file in enumerate(files, 1))
    for case in of_files if files else (make(pressure_pa) for make in (shipped, leaking)):
        cases.append(case)
        print(f"{case.title}: {case.verdict}", file=sys.stderr)
    return cases


def _draw(cases: list[Case], folder: Path) -> list[Any]:
    from .gallery import common_scales, pictures_of

    folder.mkdir(parents=True, exist_ok=True)
    scales = common_scales(cases)
    pictures = []
    for case in cases:
        print(f"{case.title}: drawing", file=sys.stderr)
        pictures += pictures_of(case, scales)
    for shown in pictures:
        (folder / f"{shown.case}-{shown.name}.png").write_bytes(shown.png)
    return pictures


def _study(folder: Path, with_picture: bool) -> str:
    """Runs the founding paper's study, prints its tables, and returns its chapter."""
    stages = []
    for stage in study.run(study.healthy_valve(), study.PARAMETRIC):
        stages.append(stage)
        print(f"Study, {stage.title}: {verdict(stage.closed, stage.stats)}", file=sys.stderr)
    print(f"\n{repairs.as_text(stages)}")
    png = repairs.sections(stages) if with_picture else b""
    if png:
        (folder / "pictures" / "study-sections.png").write_bytes(png)
    return repairs.as_html(stages, png)


def _operations(folder: Path, with_pictures: bool, pressure_pa: float) -> str:
    """Applies every operation to the shipped valve, and returns the chapter."""
    shown, pictures = [], {}
    for each in operations.run(pressure_pa):
        shown.append(each)
        print(f"{each.title}: {each.verdict}", file=sys.stderr)
        if with_pictures:
            png = pictures[each.kind] = operations.picture_of(each)
            (folder / "pictures" / f"operation-{each.kind}.png").write_bytes(png)
    return operations.as_html(shown, pictures)


def _ensembles(
    cases: list[Case], folder: Path, with_pictures: bool, members: int, pa: float
) -> str:
    """Closes an ensemble of every valve, prints the distances, and returns the chapter."""
    runs = []
    for each in ensemble.run(cases, members, pa):
        runs.append(each)
        print(f"Ensemble, {each.title}: {ensemble.verdict(each)}", file=sys.stderr)
    print(f"\n{ensemble.as_text(runs)}")
    pictures = {}
    if with_pictures:
        from .gallery import common_scales

        width = common_scales(cases).atrium_mm
        for each in runs:
            png = pictures[each.key] = ensemble.picture_of(each, width)
            (folder / "pictures" / f"{each.key}-ensemble.png").write_bytes(png)
    return ensemble.as_html(runs, pictures)


def main() -> int:
    """Writes the report; returns 0, or 1 with a sentence on stderr."""
    arguments = _arguments()
    try:
        asked = None if arguments.pressure is None else arguments.pressure * mvs.MMHG
        pressure = mvs.SYSTOLE_PA if asked is None else asked
        cases = _close_all(arguments.files, asked, pressure)
        arguments.out.mkdir(parents=True, exist_ok=True)
        print(as_text(cases))
        pictures = [] if arguments.no_pictures else _draw(cases, arguments.out / "pictures")
        from .page import build

        page = arguments.out / "report.html"
        chapter = ""
        if not arguments.files:
            chapter += _study(arguments.out, not arguments.no_pictures)
            chapter += _operations(arguments.out, not arguments.no_pictures, pressure)
        if arguments.members > 0:
            chapter += _ensembles(
                cases, arguments.out, not arguments.no_pictures, arguments.members, pressure
            )
        page.write_text(build(cases, pictures, chapter), encoding="utf-8")
        print(f"wrote {page}", file=sys.stderr)
    except (mvs.Error, OSError, ImportError) as error:
        print(f"mvs.report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
