"""The command `mvs-image`: from an image of an open valve to a valve that closes.

    mvs-image open.seg.nrrd --loaded closed.seg.nrrd --tips tips.mrk.json -o valve.h5 --report out.html

`build` is the command that runs if none is named; `phantom` makes test images where it is installed.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Optional

import mvs
from .checks import check_request, findings_path
from .console import Console
from .needs import in_words
from .options import add_build


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
    add_build(commands).set_defaults(run=run_build)
    if importlib.util.find_spec("mvs.imaging.phantom") is not None:
        from .phantom.command import add_to

        add_to(commands)
        names.add("phantom")
    return parser, names


def run_build(chosen: argparse.Namespace) -> int:
    """Builds, closes, writes valve, findings and report."""
    from .findings import write_findings
    from .requests import valve_of_request

    check_request(chosen)
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
    print(f"  {'finding':<18} {'from':<9} sure   what was seen, and what to give if it is wrong")
    for row in rows:
        print(f"  {row['name']:<18} {row['source']:<9} {100 * row['confidence']:3.0f} %  "
              f"{row['sentence']}")


def _repair_facts(made: Any) -> dict[str, Any]:
    if not made.repair:
        return {}
    leak = made.repair.closed.measures.regurgitant_orifice_area * 1e6
    return {"repair": {"operations": made.repair.operations, "converged": made.repair.converged,
                       "regurgitant_orifice_area_mm2": leak}}
