"""Draws where steps in time break: symplectic Euler beside the library's own implicit step.

    build/release/bin/stability_breakdown --csv tests/stability/breakdown.csv
    python tests/stability/breakdown.py [--csv FILE] [--out examples/pictures/stability.png]

breakdown.cpp says what breaks means. Needs matplotlib.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
VERDICTS = {
    "sound": ("#1b6ca8", "sound"),
    "crossed": ("#f2c14e", "leaflets cross"),
    "energy": ("#e0700b", "energy from nothing"),
    "not finite": ("#b3262e", "numbers out of range"),
}
MISSING = "#ffffff"
SOLVERS = {"explicit": "symplectic Euler (founding paper)", "implicit": "libmvs, implicit step"}
SIZES = {"annulus": "annulus, times its size", "chord": "chord A2/7, times its length"}


def read(path: Path) -> list[dict[str, str]]:
    """The rows of the table."""
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def in_words(microseconds: float) -> str:
    """A time step for display: "8 us", "2 ms"."""
    return f"{microseconds:g} µs" if microseconds < 1000 else f"{microseconds / 1000:g} ms"


def draw_panel(ax: Any, rows: list[dict[str, str]], steps: list[float], solver: str) -> None:
    """One solver and one operation: a cell a run, the larger the step the farther right."""
    import matplotlib.patches as patches

    sizes = sorted({float(row["size"]) for row in rows}, reverse=True)
    ax.add_patch(patches.Rectangle((0, 0), len(steps), len(sizes), facecolor=MISSING,
                                   hatch="////", edgecolor="#d0d0d0", linewidth=0))
    for row in (r for r in rows if r["solver"] == solver):
        x, y = steps.index(float(row["dt_us"])), sizes.index(float(row["size"]))
        colour = VERDICTS[row["verdict"]][0]
        ax.add_patch(patches.Rectangle((x, y), 1, 1, facecolor=colour, edgecolor="white"))
    ax.set(xlim=(0, len(steps)), ylim=(0, len(sizes)))
    ax.set_xticks([k + 0.5 for k in range(len(steps))], [in_words(s) for s in steps], rotation=60)
    ax.set_yticks([k + 0.5 for k in range(len(sizes))], [f"{size:g}" for size in sizes])
    ax.tick_params(length=0)
    ax.spines[:].set_visible(False)


def draw(rows: list[dict[str, str]], path: Path) -> None:
    """A column a solver, a row an operation."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    steps = sorted({float(row["dt_us"]) for row in rows})
    figure, axes = plt.subplots(2, 2, figsize=(11, 7), sharex=True, squeeze=False)
    for across, solver in enumerate(SOLVERS):
        for down, operation in enumerate(SIZES):
            ax = axes[down][across]
            draw_panel(ax, [r for r in rows if r["operation"] == operation], steps, solver)
            if across == 0:
                ax.set_ylabel(SIZES[operation])
            if down == 0:
                ax.set_title(SOLVERS[solver])
            else:
                ax.set_xlabel("time step")
    handles = [plt.Rectangle((0, 0), 1, 1, color=c, label=text) for c, text in VERDICTS.values()]
    handles.append(plt.Rectangle((0, 0), 1, 1, facecolor=MISSING, hatch="////",
                                 edgecolor="#d0d0d0", label="not run"))
    figure.legend(handles=handles, loc="lower center", ncols=5, frameon=False)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.savefig(path, dpi=130)
    plt.close(figure)


def main() -> None:
    """Reads the table, draws the picture."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--csv", type=Path, default=HERE / "breakdown.csv")
    parser.add_argument("--out", type=Path,
                        default=HERE.parents[1] / "examples" / "pictures" / "stability.png")
    arguments = parser.parse_args()
    draw(read(arguments.csv), arguments.out)


if __name__ == "__main__":
    main()
