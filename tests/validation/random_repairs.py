"""Random valves under random repairs: does every settle come to rest, without crossings?

    python tests/validation/random_repairs.py [--seeds FIRST:END ...] [--vertices N] [--keep DIR]

A seed draws dimensions, shape and one of six tissues, closes the valve under 120 mmHg, and settles it after each
of three random operations. Dimensions and operations reach further than a surgeon would go: a chord is transferred
to any place, a band shortens the annulus to 0.6. The tables count settles by operation and by tissue; a list names
each settle that did not come to rest or left crossing triangles, and --keep saves the valve before it. Operations
that a valve refuses are counted with their reason. The same seeds draw the same repairs in every version. The exit
code is 1 if one settle did not come to rest or left a crossing.
"""

from __future__ import annotations

import argparse
import collections
import dataclasses
import random
import sys
import time
from pathlib import Path
from typing import Any, Optional

import mvs
import numpy as np

LAWS = ("spring", "bilinear", "fung", "may_newman_yin", "prot", "neo_hookean")
SCALLOPS = ("A1", "A2", "A3", "P1", "P2", "P3")
OPERATIONS = (
    "chord_length", "chord_length", "chord_remove", "chord_add", "chord_transfer", "annulus_scale",
    "ring", "band", "neochord", "head_move", "clip", "resect", "patch",
)  # fmt: skip
REPAIRS = 3  # operations on one valve, one after the other
RING_SIZES = (26, 28, 30, 32, 34, 36)  # mm


@dataclasses.dataclass(frozen=True)
class Settle:
    """A settle of a valve, or the reason why there was none (`refused`)."""

    seed: int
    law: str
    operation: str
    arguments: dict[str, Any]
    refused: str = ""
    at_rest: bool = False
    iterations: int = 0
    residual: float = 0.0  # N
    crossings: int = 0
    seconds: float = 0.0  # of CPU

    def failed(self) -> bool:
        return not self.refused and (not self.at_rest or self.crossings > 0)


def dimensions(draw: random.Random) -> dict[str, float]:
    """Dimensions of a valve, in m; factors have no unit."""
    return dict(
        annulus_ap=draw.uniform(22e-3, 34e-3), annulus_cc=draw.uniform(30e-3, 42e-3),
        saddle_height=draw.uniform(2e-3, 8e-3), anterior_height=draw.uniform(18e-3, 28e-3),
        posterior_height=draw.uniform(10e-3, 18e-3), commissure_height=draw.uniform(5e-3, 9e-3),
        thickness=draw.uniform(0.6e-3, 1.5e-3), papillary_depth=draw.uniform(18e-3, 28e-3),
        papillary_separation=draw.uniform(16e-3, 28e-3), indentation_depth=draw.uniform(0, 4e-3),
        coaptation_depth=draw.uniform(2e-3, 8e-3), annulus_scale=draw.uniform(0.9, 1.2),
        chord_slack=draw.uniform(0.9, 1.15),
    )  # fmt: skip


def operation(draw: random.Random, valve: mvs.Snapshot) -> tuple[str, dict[str, Any]]:
    """A random operation on a valve and its arguments."""
    chords = [part.name for part in valve.parts if part.kind == mvs.PartKind.CHORD]
    heads = [part.name for part in valve.parts if part.kind == mvs.PartKind.HEAD]

    def site() -> str:
        return f"{draw.choice(SCALLOPS)}:{draw.uniform(0.1, 0.9):.2f}:{draw.uniform(0.3, 1):.2f}"

    def site_on_the_edge() -> str:
        return f"{draw.choice(SCALLOPS)}:{draw.uniform(0.2, 0.8):.2f}:1"

    name = draw.choice(OPERATIONS)
    makers = {
        "chord_length": lambda: dict(chord=draw.choice(chords), factor=draw.uniform(0.7, 1.4)),
        "chord_remove": lambda: dict(chord=draw.choice(chords)),
        "chord_add": lambda: dict(head=draw.choice(heads), site=site()),
        "chord_transfer": lambda: dict(chord=draw.choice(chords), site=site()),
        "annulus_scale": lambda: dict(factor=draw.uniform(0.8, 1.15)),
        "ring": lambda: dict(size=draw.choice(RING_SIZES) * 1e-3),
        "band": lambda: dict(factor=draw.uniform(0.6, 0.95)),
        "neochord": lambda: dict(head=draw.choice(heads), site=site_on_the_edge()),
        "head_move": lambda: dict(
            head=draw.choice(heads), by=[draw.gauss(0, 2e-3) for _ in range(3)]
        ),
        "clip": lambda: _clip_width(draw),
        "resect": lambda: dict(scallop="P2"),
        "patch": lambda: dict(
            site=draw.choice(["A2", "P2"]) + ":0.5:0.5", width=draw.uniform(5e-3, 12e-3),
            height=draw.uniform(4e-3, 10e-3)
        ),
    }  # fmt: skip
    return name, makers[name]()


def _clip_width(draw: random.Random) -> dict[str, float]:
    """The width of half of the clips; the others have the default width. The width is drawn in any case."""
    width = draw.uniform(3e-3, 6e-3)
    return {"width": width} if draw.random() < 0.5 else {}


def settles_of(
    seed: int, vertices: int, most_iterations: Optional[int] = None, keep: Optional[Path] = None
) -> list[Settle]:
    """Closes the valve of a seed and repairs it; `keep`: a folder for valves before settles that fail."""
    draw = random.Random(seed)
    chosen = dimensions(draw)
    law = draw.choice(LAWS)
    shape = draw.choice(["healthy", "founding"])
    rows: list[Settle] = []
    with mvs.Simulator(log=lambda *_: None) as sim:
        try:
            sim.generate(shape=shape, leaflet=law, vertices=vertices, **chosen)
        except mvs.Error as error:
            return [Settle(seed, law, "generate", chosen, refused=str(error))]
        sim.set_load(mvs.SYSTOLE_PA)
        for k in range(1 + REPAIRS):
            name, given = operation(draw, sim.snapshot()) if k else ("close", {})
            try:
                if k:
                    sim.apply(name, **given)
            except mvs.Error as error:
                rows.append(Settle(seed, law, name, given, refused=str(error)))
                continue
            before = sim.snapshot()
            rows.append(_settled(sim, Settle(seed, law, name, given), most_iterations))
            if keep and rows[-1].failed():
                before.save(str(keep / f"{seed}_{k}_{name}.h5"))
    return rows


def _settled(sim: mvs.Simulator, row: Settle, most_iterations: Optional[int]) -> Settle:
    """The row with the figures of a settle."""
    start = time.process_time()
    stats = sim.settle(max_iterations=most_iterations)
    seconds = time.process_time() - start
    crossings = int(sim.snapshot().measures.intersections)
    return dataclasses.replace(
        row, at_rest=stats.converged, iterations=stats.iterations, residual=stats.residual,
        crossings=crossings, seconds=seconds
    )  # fmt: skip


def table(rows: list[Settle], key: str) -> str:
    """Settles counted by operation or tissue."""
    lines = [
        f"| {key} | settles | not at rest | with crossings | iterations, median | 95 % | most "
        "| CPU, median, ms | 95 % | most |",
        "|---" * 10 + "|",
    ]
    for value in sorted({getattr(row, key) for row in rows}):
        group = [row for row in rows if getattr(row, key) == value]
        iterations = np.percentile([row.iterations for row in group], (50, 95, 100))
        times = np.percentile([1e3 * row.seconds for row in group], (50, 95, 100))
        figures = " | ".join(f"{figure:.0f}" for figure in (*iterations, *times))
        lines.append(
            f"| {value} | {len(group)} | {sum(not row.at_rest for row in group)} "
            f"| {sum(row.crossings > 0 for row in group)} | {figures} |"
        )
    return "\n".join(lines)


def report(rows: list[Settle]) -> str:
    """The tables, each settle that failed, and the reasons of refusals."""
    done = [row for row in rows if not row.refused]
    parts = [table(done, "operation"), table(done, "law")] if done else []
    failures = [row for row in done if row.failed()]
    for row in failures:
        given = ", ".join(f"{name}={value}" for name, value in row.arguments.items())
        parts.append(
            f"seed {row.seed}, {row.law}: {row.operation}({given}): "
            f"{'at rest' if row.at_rest else f'not at rest after {row.iterations} iterations'}, residual "
            f"{row.residual:.2g} N, {row.crossings} crossings"
        )
    reasons = collections.Counter(
        f"{row.operation}: {row.refused[:100]}" for row in rows if row.refused
    )
    parts += [f"refused {count} times: {reason}" for reason, count in reasons.most_common()]
    parts.append(
        f"{len(done)} settles of {len({row.seed for row in rows})} valves: "
        f"{sum(not row.at_rest for row in done)} did not come to rest, "
        f"{sum(row.crossings > 0 for row in done)} left crossings; {len(rows) - len(done)} refused"
    )
    return "\n\n".join(parts)


def seeds_of(text: str) -> range:
    """FIRST:END, END left out; or one seed."""
    first, colon, end = text.partition(":")
    return range(int(first), int(end) if colon else int(first) + 1)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    add = parser.add_argument
    add("--seeds", type=seeds_of, nargs="+", default=[range(2000, 2050)], metavar="FIRST:END",
        help="ranges without their end, or single seeds [2000:2050]")  # fmt: skip
    add("--vertices", type=int, default=425, metavar="N", help="of the leaflets [425]")
    add("--iterations", type=int, metavar="N", help="at most, of a settle [1000]")
    add("--keep", type=Path, metavar="DIR", help="save the valve before each settle that fails")
    given = parser.parse_args()
    if given.keep:
        given.keep.mkdir(parents=True, exist_ok=True)
    rows: list[Settle] = []
    for seed in (seed for seeds in given.seeds for seed in seeds):
        found = settles_of(seed, given.vertices, given.iterations, given.keep)
        rows += found
        if any(row.failed() for row in found):
            print(f"seed {seed} failed", file=sys.stderr, flush=True)
    print(report(rows))
    done = [row for row in rows if not row.refused]
    return 0 if done and not any(row.failed() for row in done) else 1


if __name__ == "__main__":
    sys.exit(main())
