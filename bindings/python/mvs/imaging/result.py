"""What `mvs-image build` prints of a valve: its leak, its findings, warnings of doubtful ones."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Optional

import mvs
from .findings import row_of


def warn_of_contradictions(findings: Iterable[mvs.Finding]) -> None:
    """Names inputs that contradict the image, such as swapped labels, as `mvs import` does."""
    for one in findings:
        if one.doubtful:
            print(f"mvs-image: warning: {one.name}, {100 * one.confidence:.0f} % sure: {one.sentence}", file=sys.stderr)


def print_result(chosen: argparse.Namespace, made: Any, findings: Path) -> None:
    """Prints the valve, its leak and the findings, or one JSON object of them."""
    opened, closed = made.opened, made.closed
    vertices = int((opened.node_kind <= mvs.NodeKind.ANNULUS).sum())
    leak = closed.measures.regurgitant_orifice_area * 1e6
    rows = [row_of(one) for one in made.findings]
    interval = interval_of(made.findings)
    if chosen.json:
        print(json.dumps({
            "file": str(chosen.output), "findings_file": str(findings), "vertices": vertices,
            "chords": len(opened.chord_kind), "converged": made.converged,
            "regurgitant_orifice_area_mm2": leak, "regurgitant_orifice_area_interval_mm2": interval,
            "hash": str(opened.hash), "findings": rows, **_repair_facts(made)}))
        return
    print(f"{chosen.output}: an open valve of {vertices} leaflet vertices, {len(opened.chord_kind)} "
          f"chord segments, {len(opened.head_nodes)} papillary heads")
    print(f"{findings}: what was found, guessed and assumed; edit it and give it by --with")
    print(f"closed under 120 mmHg: {verdict_of(made)}"
          + (f"; {interval[0]:.1f} to {interval[1]:.1f} mm2 over what is not sure" if interval else "")
          + doubts_in(made.findings))
    if made.repair:
        facts = _repair_facts(made)["repair"]
        print(f"after {facts['operations']} operations: "
              f"{'at rest' if facts['converged'] else 'NOT at rest'}, "
              f"{facts['regurgitant_orifice_area_mm2']:.1f} mm2")
    print(f"  {'finding':<18} {'from':<9} sure   what was seen, and what to give if it is wrong")
    for row in rows:
        print(f"  {row['name']:<18} {row['source']:<9} {100 * row['confidence']:3.0f} %  "
              f"{row['sentence']}")


def verdict_of(made: Any) -> str:
    """The state of the closed valve, its leak, and gaps of the loaded leaflets that it does not have."""
    if not made.converged:
        return "NOT at rest: no figure of this shape holds"
    leak = made.closed.measures.regurgitant_orifice_area * 1e6
    shape = "sealed" if leak < SEALED else f"leaks through {leak:.1f} mm2"
    shown = sum(float(one.values[0]) * 1e6 for one in made.findings if one.name == "shown_gaps" and len(one.values))
    if shown >= SEALED and leak < SHARE_OF_SHOWN * shown:
        shape += f", but the loaded leaflets show gaps of {shown:.1f} mm2"
    return f"at rest, {shape}"


def doubts_in(findings: Iterable[mvs.Finding]) -> str:
    """The names of the doubtful findings, on which the leak depends, to follow it; empty without any."""
    names = [one.name for one in findings if one.doubtful]
    return f"; doubtful: {', '.join(names)}" if names else ""


SEALED, SHARE_OF_SHOWN = 0.05, 0.5
"""mm2 that are shown as 0.0, and the share of the gaps of the loaded leaflets below which a leak is another one"""


def interval_of(findings: Iterable[mvs.Finding]) -> Optional[list[float]]:
    """The ends of the interval of leaks, mm2; None without this finding."""
    found = next((one.values for one in findings if one.name == "leak_interval" and len(one.values) == 2), None)
    return None if found is None else [float(value) * 1e6 for value in found]


def _repair_facts(made: Any) -> dict[str, Any]:
    if not made.repair:
        return {}
    leak = made.repair.closed.measures.regurgitant_orifice_area * 1e6
    return {"repair": {"operations": made.repair.operations, "converged": made.repair.converged,
                       "regurgitant_orifice_area_mm2": leak}}
