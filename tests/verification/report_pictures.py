"""Pictures of the verification suite: stress of every law, orders of convergence, limits of the model."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402
from report_tables import Studies, Study  # noqa: E402

plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False,
                     "axes.spines.right": False, "legend.frameon": False})
DPI = 110
COLOURS = ("#1b6f5a", "#c8553d", "#3a6ea5", "#8c5fa8", "#b08900", "#666666", "#d081a5", "#4fa3a5")


def _png(figure: Any) -> bytes:
    memory = io.BytesIO()
    figure.savefig(memory, format="png", dpi=DPI, facecolor="white", bbox_inches="tight")
    plt.close(figure)
    return memory.getvalue()


MODES = ("uniaxial along", "uniaxial across", "equibiaxial, along", "equibiaxial, across",
         "strip along, along", "strip across, across", "simple shear")


def laws_picture(studies: Studies) -> bytes:
    """Nominal stress over strain: the assembled patch, the published W, the points of the tables."""
    curves, tables = studies["laws_nominal"].curves(), studies["laws_tables"].curves()
    laws = list(dict.fromkeys(case.rsplit(", ", 1)[0] if case.endswith("shear") else
                              next(case[: -len(m) - 2] for m in MODES + ("strip along, across",
                                   "strip across, along") if case.endswith(m)) for case in curves))
    figure, axes = plt.subplots(2, 4, figsize=(15, 7.4), sharex=True)
    for ax, law in zip(axes.flat, laws):
        for colour, mode in zip(COLOURS, MODES):
            rows = curves[f"{law}, {mode}"]
            ax.plot([100 * r.x for r in rows], [r.value / 1e3 for r in rows], color=colour,
                    linewidth=1.4, label=mode)
            ax.plot([100 * r.x for r in rows[1::2]], [r.exact / 1e3 for r in rows[1::2]], "o",
                    color=colour, markersize=3.5, markerfacecolor="none")
            points = tables.get(f"{law}, {mode}, nominal", [])
            ax.plot([100 * r.x for r in points], [r.exact / 1e3 for r in points], "+",
                    color=colour, markersize=6)
        ax.set_title(law, fontsize=10)
        ax.set_xlim(0, 30.5)
        ax.set_ylim(0, {"Fung, Texas anterior": 5}.get(law, 25 if "Hookean" in law else 100))
    for ax in axes[-1]:
        ax.set_xlabel("strain or shear, %")
    for ax in axes[:, 0]:
        ax.set_ylabel("nominal stress, kPa")
    axes[0, 0].legend(fontsize=7.5, loc="upper left")
    figure.tight_layout()
    return _png(figure)


CONVERGING = (
    ("Discs under pressure", ("hencky_disc", "finite_disc", "finite_disc_profile",
                              "finite_disc_stretch")),
    ("Laplace: spheres and tubes; a tube that bends", ("laplace_sphere", "laplace_cylinder",
                                                     "tube_buckling")),
    ("Cables", ("catenary", "elastic_catenary")),
    ("Bending", ("heavy_cantilever", "bending_lattice")),
    ("Steps in time", ("steps_energy", "steps_spin")),
)


def _log_x(ax: Any) -> None:
    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())


def _slopes(ax: Any) -> None:
    """Grey lines of order 1 and 2 through the lower left of the axes."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    for order in (1, 2):
        start = low * 1.6
        ax.plot([left, right], [start, start * (right / left) ** order], color="#bbbbbb",
                linewidth=1, linestyle=":" if order == 1 else "--", zorder=0,
                label=f"order {order}")
    ax.set_xlim(left, right)
    ax.set_ylim(low, high)


def _errors(ax: Any, study: Study, colour: str, label: str, scale: float) -> None:
    for k, rows in enumerate(study.series().values()):
        shown = [row for row in rows if row.error > 1e-9]
        ax.plot([scale * row.level for row in shown], [row.error for row in shown], "o-",
                color=colour, linewidth=1.1, markersize=3.5, alpha=0.85,
                label=label if k == 0 else None)


def convergence_picture(studies: Studies) -> bytes:
    """Relative error over edge length or time step, one line a series."""
    figure, axes = plt.subplots(1, len(CONVERGING), figsize=(17, 4.3))
    for ax, (title, names) in zip(axes, CONVERGING):
        in_time = title == "Steps in time"
        for colour, name in zip(COLOURS, names):
            if name in studies:
                study = studies[name]
                _errors(ax, study, colour, study.title, 1e6 if in_time else 1e3)
        _log_x(ax)
        ax.set_yscale("log")
        ax.set_title(title, fontsize=10)
        ax.set_xlabel("step, µs" if in_time else "edge, mm")
        _slopes(ax)
        ax.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.16))
    axes[0].set_ylabel("relative error")
    return _png(figure)


def limits_picture(studies: Studies) -> bytes:
    """Studies that do not converge: springs as tissue, hinges on meshes that are no lattice."""
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.2))
    if "springs_shear" in studies:
        for colour, (case, rows) in zip(COLOURS, studies["springs_shear"].curves().items()):
            axes[0].plot([100 * r.x for r in rows], [100 * (r.value / r.exact - 1) for r in rows],
                         "o-", color=colour, markersize=3.5, label=case)
    axes[0].axhline(0, color="#bbbbbb", linewidth=1)
    axes[0].set(xlabel="shear or strain, %", ylabel="stress beside the membrane's, %",
                title="Springs beside the membrane")
    for name, label in (("hencky_disc", "membrane"), ("hencky_disc_springs", "springs")):
        for (case, _), rows in (studies[name].series() if name in studies else {}).items():
            axes[1].plot([1e3 * r.level for r in rows], [100 * r.error for r in rows],
                         "o-" if label == "membrane" else "s--", markersize=3.5,
                         color=COLOURS["irregular" in case], label=f"{label}, {case}")
    _log_x(axes[1])
    axes[1].set(xlabel="edge, mm", ylabel="error of the height, %",
                title="Hencky's disc")
    k = 0
    for name in ("bending_lattice", "bending_meshes"):
        for case, rows in (studies[name].curves() if name in studies else {}).items():
            finest = min(row.level for row in rows)
            at = [row for row in rows if row.level == finest]
            axes[2].plot([r.x for r in at], [r.value for r in at], "o-", markersize=3.5,
                         color=COLOURS[k], label=case)
            k += 1
    axes[2].set(xlabel="direction of the cylinder, degrees", ylabel="bending energy over exact",
                title="Hinges on finest meshes of four kinds")
    for ax in axes:
        if ax.get_legend_handles_labels()[0]:
            ax.legend(fontsize=7.5)
    figure.tight_layout()
    return _png(figure)


PICTURES: tuple[tuple[str, str, Callable[[Studies], bytes], tuple[str, ...]], ...] = (
    ("laws", "Nominal stress of every law: lines, the assembled patch of triangles; circles, the "
     "published W, differentiated; crosses, the tables of shared/data/verification. Axes are cut "
     "where a law becomes stiff.", laws_picture, ("laws_nominal", "laws_tables")),
    ("convergence", "Relative error on finer and finer meshes, and over the time step; a line is "
     "one case. Dotted and dashed: orders 1 and 2.", convergence_picture, ()),
    ("limits", "What refinement does not mend. Springs are another tissue than the one their curve "
     "was measured on; hinges have the energy of a cylinder on equilateral triangles only.",
     limits_picture, ()),
)
