"""The command `mvs-image`: from an image of an open valve to a valve that closes.

    mvs-image open.seg.nrrd --loaded closed.seg.nrrd --tips tips.mrk.json -o valve.h5 --report out.html

`build` is the command that runs if none is named; `phantom` makes test images where it is installed.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Sequence
from typing import Optional

import mvs
from .checks import check_request, findings_path
from .console import Console, warnings_in_lines
from .needs import in_words
from .options import add_build
from .result import print_result, warn_of_contradictions


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; 0: done, 1: failed with a sentence on stderr, 2: wrong usage."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        parser, commands = parser_of()
        if given and given[0] not in commands and given[0] not in ("-h", "--help", "--version"):
            given.insert(0, "build")
        chosen = parser.parse_args(given or ["--help"])
        with warnings_in_lines(getattr(chosen, "quiet", False)):
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
    warn_of_contradictions(made.findings)
    print_result(chosen, made, findings)
    if not made.converged:
        print("mvs-image: the valve does not come to rest under load; the findings say what was "
              "guessed", file=sys.stderr)
    return 0 if made.converged else 1
