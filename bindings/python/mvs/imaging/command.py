"""The command `mvs-image`: from an image of an open valve to a valve that closes.

    mvs-image open.seg.nrrd --loaded closed.seg.nrrd --tips tips.mrk.json -o valve.h5 --report out.html

`build` is the command that runs if none is named; `phantom` makes test images where it is installed.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Optional

import mvs
from .console import Console
from .needs import in_words

LANDMARKS = {"annulus": "points or a curve along the annulus; tissue beyond it is cut off",
             "commissures": "the two commissures",
             "anterior": "a point of the anterior leaflet", "tips": "tips of the papillary muscles"}


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; 0: done, 1: failed with a sentence on stderr, 2: wrong usage."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        parser, commands = parser_of()
        if given and given[0] not in commands and given[0] not in ("-h", "--help", "--version"):
            given.insert(0, "build")
        chosen = parser.parse_args(given or ["--help"])
        return int(chosen.run(chosen) or 0)
    except (mvs.Error, OSError, ImportError) as error:
        print(f"mvs-image: {in_words(error)}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("mvs-image: stopped", file=sys.stderr)
        return 130


def parser_of() -> tuple[argparse.ArgumentParser, set[str]]:
    """The parser and the names of its commands."""
    parser = argparse.ArgumentParser(
        prog="mvs-image", description="Mitral valves from images. A research tool, not a medical "
        "device. `mvs-image IMAGE ...` is short for `mvs-image build IMAGE ...`.")
    parser.add_argument("--version", action="version", version=mvs.__version__)
    commands = parser.add_subparsers(title="commands", required=True)
    names = {"build"}
    add_build(commands)
    if importlib.util.find_spec("mvs.imaging.phantom") is not None:
        from .phantom.command import add_to

        add_to(commands)
        names.add("phantom")
    return parser, names


def add_build(commands: Any) -> None:
    parser = commands.add_parser(
        "build", help="builds a valve from an image of open leaflets, and closes it",
        description="Lengths in mm. Images: NRRD, NIfTI, MetaImage, a folder of DICOM files. A label "
        "map or .seg.nrrd has the leaflets as labels; a grey volume is segmented as a micro-CT.")
    add = parser.add_argument
    add("image", type=Path, help="the open valve")
    add("-o", "--output", type=Path, required=True, help="file for the valve: .h5, .obj, .vtp, .vtm")
    add("--loaded", type=Path, metavar="IMAGE", help="the valve closed under load")
    add("--report", type=Path, metavar="HTML", help="a page with pictures and tables")
    add("--plan", type=Path, metavar="JSON", help="operations on the valve: the report shows it repaired")
    add("--findings", type=Path, metavar="JSON", help="[VALVE.import.json beside the output]")
    add("--with", type=Path, dest="known", metavar="JSON",
        help="findings of an earlier run, edited: what is given, guessed or assumed is used")
    add("--json", action="store_true", help="print one JSON object")
    add("--quiet", action="store_true", help="no progress on stderr")
    labels = parser.add_argument_group("labels").add_argument
    for leaflet in ("anterior", "posterior"):
        labels(f"--{leaflet}-label", metavar="NAME", help=f"segment of the {leaflet} leaflet [by name]")
    labels("--leaflet-label", metavar="NAME", help="segment of both leaflets")
    labels("--hole", type=float, metavar="MM", help="diameter of the largest hole that is filled [7]")
    labels("--edge-error", type=float, metavar="MM",
           help="how far the free edge may lie farther out or in: widens the interval of leaks [half a "
           "voxel]")
    labels("--edge-lost", type=float, metavar="MM",
           help="tissue that the labels may lack at the free edge: widens the interval of leaks [two "
           "voxels]")
    labels("--thickness-error", type=float, metavar="MM",
           help="by how much the leaflets may be thicker or thinner: widens the interval of leaks [0.25 of "
           "assumed tissue, half a voxel of measured]")
    points = parser.add_argument_group("landmarks: .mrk.json, .fcsv, .csv, .vtk, .vtp").add_argument
    for part, words in LANDMARKS.items():
        points(f"--{part}", type=Path, metavar="FILE", help=words)
    for part, words in LANDMARKS.items():
        points(f"--loaded-{part}", type=Path, metavar="FILE", help=f"{words}, in the loaded image")
    points("--frame", choices=("LPS", "RAS"), help="of landmark files that do not state it")
    parser.add_argument_group("loaded image").add_argument(
        "--register", choices=("none", "landmarks", "image"), default=None,
        help="to the open image: none: both have the same frame; landmarks: by those of both images; "
        "image: by grey values [none; image for grey volumes]")
    build = parser.add_argument_group("valve").add_argument
    build("--edge", type=float, metavar="MM", help="of the triangles [1,000 vertices]")
    build("--chords", type=_count, metavar="N", help="chord segments where none are seen, about [100]")
    build("--leaflet", metavar="LAW",
          help="tissue of the leaflets [bilinear; that which is nearest to the loaded image]")
    build("--thickness", type=float, metavar="MM", help="of the leaflets [measured; normal tissue where labels are narrow]")
    build("--coaptation-length", type=float, metavar="MM",
          help="overlap in the middle for which rest lengths are chosen [8]")
    parser.set_defaults(run=run_build)


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: it has to be 1 or more")
    return number


VALVE_ENDINGS = (".h5", ".vtkhdf", ".obj", ".vtp", ".vtm", ".feb")


def findings_path(chosen: argparse.Namespace) -> Path:
    return chosen.findings or chosen.output.with_suffix(".import.json")


def check_outputs(chosen: argparse.Namespace) -> None:
    """Refuses, before the work, outputs that cannot be written and a plan that cannot be read."""
    if chosen.output.suffix.lower() not in VALVE_ENDINGS:
        raise mvs.ArgumentError(f"{chosen.output}: the ending names no known format: known endings are "
                                f"{', '.join(VALVE_ENDINGS)}", "output")
    inputs = [value for name, value in vars(chosen).items()
              if isinstance(value, Path) and name not in ("output", "findings", "report", "known")]
    for path in (chosen.output, findings_path(chosen), chosen.report):
        if path is None:
            continue
        if path.is_dir():
            raise mvs.IoError(f"{path}: is a folder: name a file", "output")
        if not path.parent.is_dir():
            raise mvs.IoError(f"{path}: there is no folder {path.parent}: create it first", "output")
        if not os.access(path.parent, os.W_OK):
            raise mvs.IoError(f"{path}: the folder {path.parent} cannot be written", "output")
        if any(path.exists() and source.exists() and path.samefile(source) for source in inputs):
            raise mvs.ArgumentError(f"{path}: is an input as well, which would be lost: give another output", "output")
    if chosen.plan:
        try:
            json.loads(chosen.plan.read_text(encoding="utf-8"))
        except ValueError as error:
            raise mvs.FormatError(f"{chosen.plan}: is no plan, which is JSON ({error})", "plan") from error


def run_build(chosen: argparse.Namespace) -> int:
    """Builds, closes, writes valve, findings and report."""
    from .findings import write_findings
    from .requests import valve_of_request

    check_outputs(chosen)
    console = Console(chosen.quiet)
    made = valve_of_request(chosen, console)
    if chosen.plan:
        from .repair import repaired

        console.stage("repair")
        made.repair = repaired(made.opened, chosen.plan)
    made.opened.save(str(chosen.output))
    findings = findings_path(chosen)
    write_findings(findings, str(chosen.image), made.findings)
    if chosen.report:
        from .page import write_page

        console.stage("report")
        write_page(chosen.report, made, str(chosen.image))
    console.done()
    _warn_of_contradictions(made.findings)
    _print_result(chosen, made, findings)
    if not made.converged:
        print("mvs-image: the valve does not come to rest under load; the findings say what was "
              "guessed", file=sys.stderr)
    return 0 if made.converged else 1


def _warn_of_contradictions(findings: Iterable[mvs.Finding]) -> None:
    """Names inputs that contradict the image, such as swapped labels, as `mvs import` does."""
    for one in findings:
        if one.doubtful:
            print(f"mvs-image: warning: {one.name}, {100 * one.confidence:.0f} % sure: {one.sentence}", file=sys.stderr)


def _print_result(chosen: argparse.Namespace, made: Any, findings: Path) -> None:
    opened, closed = made.opened, made.closed
    vertices = int((opened.node_kind <= mvs.NodeKind.ANNULUS).sum())
    leak = closed.measures.regurgitant_orifice_area * 1e6
    rows = [{"name": f.name, "source": mvs.FindingSource(f.source).name.lower(),
             "confidence": f.confidence, "sentence": f.sentence, "doubtful": f.doubtful} for f in made.findings]
    if chosen.json:
        print(json.dumps({
            "file": str(chosen.output), "findings_file": str(findings), "vertices": vertices,
            "chords": len(opened.chord_kind), "converged": made.converged,
            "regurgitant_orifice_area_mm2": leak, "hash": str(opened.hash), "findings": rows,
            **_repair_facts(made)}))
        return
    print(f"{chosen.output}: an open valve of {vertices} leaflet vertices, {len(opened.chord_kind)} "
          f"chord segments, {len(opened.head_nodes)} papillary heads")
    print(f"{findings}: what was found, guessed and assumed; edit it and give it by --with")
    interval = next((f.values for f in made.findings if f.name == "leak_interval" and len(f.values) == 2), None)
    shape = "sealed" if leak < 0.05 else f"leaks through {leak:.1f} mm2"
    print(f"closed under 120 mmHg: {f'at rest, {shape}' if made.converged else 'NOT at rest: no figure of this shape holds'}"
          + (f"; {interval[0] * 1e6:.1f} to {interval[1] * 1e6:.1f} mm2 over what is not sure"
             if interval is not None else ""))
    if made.repair:
        facts = _repair_facts(made)["repair"]
        print(f"after {facts['operations']} operations: "
              f"{'at rest' if facts['converged'] else 'NOT at rest'}, "
              f"{facts['regurgitant_orifice_area_mm2']:.1f} mm2")
    for row in rows:
        print(f"  {row['name']:<18} {row['source']:<9} {100 * row['confidence']:3.0f} %  "
              f"{row['sentence']}")


def _repair_facts(made: Any) -> dict[str, Any]:
    if not made.repair:
        return {}
    leak = made.repair.closed.measures.regurgitant_orifice_area * 1e6
    return {"repair": {"operations": made.repair.operations, "converged": made.repair.converged,
                       "regurgitant_orifice_area_mm2": leak}}
