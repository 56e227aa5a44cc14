"""The picture of time_error.py: distance from the reference over CPU time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

COLOURS = {"newton": "#1b6ca8", "implicit": "#e08e0b", "explicit": "#b3262e",
           "viscous": "#3f8f4a", "kinetic": "#8b5fb0"}
NAMES = {"viscous": "relaxation, viscous", "kinetic": "relaxation, kinetic"}
MARKERS = {"spring": "o", "bilinear": "s", "fung": "D"}


def draw(rows: list[dict], path: Path) -> None:
    """Error over time, a panel a valve; larger markers are finer meshes, hollow ones crossed, and
    a cross is not at a stable rest."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    valves = list(dict.fromkeys(row["valve"] for row in rows))
    columns = len(valves) if len(valves) < 4 else 2
    lines = -(-len(valves) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(6 * columns, 0.8 + 4.8 * lines),
                                squeeze=False)
    for ax, valve in zip(axes.flat, valves):
        _draw_valve(ax, valve, [r for r in rows
                                if r["valve"] == valve and r["converged"] != "diverged"])
    handles = [plt.Line2D([], [], color=c, marker="o", ls="", label=NAMES.get(s, s))
               for s, c in COLOURS.items() if any(r["solver"] == s for r in rows)]
    handles += [plt.Line2D([], [], color="#555555", marker=MARKERS[e], ls="", label=name)
                for e, name in (("spring", "springs"), ("bilinear", "membrane"), ("fung", "Fung"))
                if any(r["element"] == e for r in rows)]
    handles.append(plt.Line2D([], [], color="#555555", marker="o", ls="", mfc="none",
                              label="crosses itself"))
    if any(row["converged"] == "no" for row in rows):
        handles.append(plt.Line2D([], [], color="#555555", marker="x", ls="",
                                  label="not at a stable rest"))
    rows_of_keys = 3 if columns == 1 else 2
    figure.legend(handles=handles, loc="lower center", ncols=-(-len(handles) // rows_of_keys),
                  frameon=False)
    figure.tight_layout(rect=(0, (0.3 + 0.25 * rows_of_keys) / figure.get_figheight(), 1, 1))
    figure.savefig(path, dpi=130)
    plt.close(figure)


def _draw_valve(ax: Any, name: str, rows: list[dict]) -> None:
    """The runs of one valve that did not diverge."""
    from matplotlib.ticker import LogLocator

    own = any(row["error_rms_mm"] for row in rows)
    sizes = sorted({row["vertices"] for row in rows})
    for row in rows:
        colour = COLOURS[row["solver"]]
        place = row["cpu_s"], row["error_rms_mm" if own else "other_rms_mm"]
        size = 40 + 90 * sizes.index(row["vertices"])
        if row["converged"] == "no":
            ax.scatter(*place, s=size, marker="x", linewidths=1.4, color=colour, alpha=0.75)
            continue
        ax.scatter(*place, s=size, marker=MARKERS[row["element"]], linewidths=1.4,
                   edgecolors=colour, alpha=0.75,
                   facecolors="none" if row["crossings"] else colour)
    goal = "its finest level" if own else "Abaqus"
    ax.set(xscale="log", yscale="log", xlabel="CPU time to close, s",
           ylabel=f"distance from {goal}, RMS, mm",
           title=f"{name}: {' and '.join(f'{size:,}' for size in sizes)} vertices")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("")
    ax.grid(True, which="both", alpha=0.25)
    ax.spines[["top", "right"]].set_visible(False)
