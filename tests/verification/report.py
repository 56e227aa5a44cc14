#!/usr/bin/env python3
"""The verification suite as a page: each table that `verification --tables DIR` wrote, with pictures.

    report.py TABLES OUT      writes OUT/verification.html and OUT/verification-*.png

Needs matplotlib; no display. Nothing of libmvs is imported: the numbers are those of the tables.
"""

from __future__ import annotations

import base64
import csv
import html
import io
import math
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False,
                     "axes.spines.right": False, "legend.frameon": False})
DPI = 110
COLOURS = ("#1b6f5a", "#c8553d", "#3a6ea5", "#8c5fa8", "#b08900", "#666666", "#d081a5", "#4fa3a5")


@dataclass(frozen=True)
class Row:
    """One number beside its exact value; NaN where a table has nothing."""

    case: str
    x: float
    level: float
    value: float
    exact: float
    error: float
    order: float


@dataclass(frozen=True)
class Study:
    """A table's entry in studies.csv, and its rows."""

    about: dict[str, str]
    rows: list[Row]

    def __getattr__(self, key: str) -> str:
        try:
            return self.about[key]
        except KeyError:
            raise AttributeError(key) from None

    def series(self) -> dict[tuple[str, float], list[Row]]:
        """Rows of one case at one x, coarse to fine."""
        found: dict[tuple[str, float], list[Row]] = {}
        for row in self.rows:
            found.setdefault((row.case, row.x), []).append(row)
        return found

    def curves(self) -> dict[str, list[Row]]:
        """The rows of a case by x."""
        found: dict[str, list[Row]] = {}
        for row in self.rows:
            found.setdefault(row.case, []).append(row)
        return {case: sorted(rows, key=lambda row: row.x) for case, rows in found.items()}


Studies = dict[str, Study]


def _number(text: str) -> float:
    return float(text) if text else math.nan


def read(folder: Path) -> Studies:
    """The studies of a folder in the order of studies.csv."""
    studies: Studies = {}
    with (folder / "studies.csv").open(newline="", encoding="utf-8") as index:
        for about in csv.DictReader(index):
            with (folder / f"{about['name']}.csv").open(newline="", encoding="utf-8") as table:
                rows = [Row(line["case"], *(_number(line[key]) for key in
                            ("x", "level", "value", "exact", "relative_error", "observed_order")))
                        for line in csv.DictReader(table)]
            studies[about["name"]] = Study(about, rows)
    return studies


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


PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>libmvs: verification</title>
<style>
  body {{ font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 78rem; margin: 2rem auto;
         padding: 0 1rem; }}
  h1 {{ font-weight: 600; margin-bottom: 0 }} h2 {{ margin-top: 2.5rem; font-weight: 600 }}
  figure {{ margin: 0 0 1.5rem }} figure img {{ width: 100%; height: auto }}
  figcaption {{ color: #444 }}
  table {{ border-collapse: collapse; font-size: .88rem; width: 100% }}
  th, td {{ padding: .2rem .6rem; border-bottom: 1px solid #e5e5e5; text-align: right;
           font-variant-numeric: tabular-nums; vertical-align: top }}
  th:first-child, td.words {{ text-align: left; font-weight: 500 }}
  td.words {{ font-weight: 400; color: #444 }}
  .holds {{ color: #1b6f5a }} .fails {{ color: #b3261e; font-weight: 700 }}
  details {{ margin: .6rem 0 }} summary {{ cursor: pointer; font-weight: 600 }}
</style>
</head>
<body>
<h1>Verification</h1>
<p>Numbers of libmvs beside closed forms and independent solutions, printed from scratch by
<code>verification --tables</code>. An error is relative to the exact value (or to what its table
names); the order is that of the two finest levels. “Reported” asks nothing: it shows a limit of the
model as it is.</p>
{pictures}
<h2>Every study</h2>
{summary}
<h2>Every table</h2>
{tables}
</body>
</html>
"""


def _cell(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.6g}"


def _summary(studies: Studies) -> str:
    head = ("study", "source", "expected", "largest error", "allowed", "order", "verdict")
    lines = ["<tr>" + "".join(f"<th>{name}</th>" for name in head) + "</tr>"]
    for s in studies.values():
        least, most = _number(s.order_least), _number(s.order_most)
        order = "" if math.isnan(least) else f"{least:.2f}"
        if order and f"{most:.2f}" != order:
            order += f" to {most:.2f}"
        allowed = _number(s.tolerance)
        lines.append(
            f"<tr><th><a href='#{s.name}'>{html.escape(s.title)}</a></th>"
            f"<td class=words>{html.escape(s.source)}</td>"
            f"<td class=words>{html.escape(s.expects)}</td><td>{_number(s.worst_error):.2g}</td>"
            f"<td>{f'{allowed:g}' if allowed > 0 else ''}</td><td>{order}</td>"
            f"<td class={s.verdict}>{s.verdict}</td></tr>")
    return "<table>\n" + "\n".join(lines) + "\n</table>"


LONG = 200
"""rows of a table that is shown by its worst ones"""


def _table(s: Study) -> str:
    columns = [("case", lambda r: html.escape(r.case))]
    if s.x:
        columns.append((s.x, lambda r: _cell(r.x)))
    if s.level:
        columns.append((s.level, lambda r: _cell(r.level)))
    columns += [("value", lambda r: _cell(r.value)), ("exact", lambda r: _cell(r.exact)),
                ("relative error", lambda r: f"{r.error:.2g}"),
                ("order", lambda r: "" if math.isnan(r.order) else f"{r.order:.2f}")]
    head = "".join(f"<th>{html.escape(name)}</th>" for name, _ in columns)
    lines = [f"<tr>{head}</tr>"]
    rows, note = s.rows, ""
    if len(rows) > LONG:
        rows = [max(of_case, key=lambda row: row.error) for of_case in s.curves().values()]
        note = f"; here the worst of each case, all of them in {s.name}.csv"
    for row in rows:
        first, *rest = (show(row) for _, show in columns)
        lines.append(f"<tr><th>{first}</th>" + "".join(f"<td>{cell}</td>" for cell in rest)
                     + "</tr>")
    return (f"<details id='{s.name}'><summary>{html.escape(s.title)} ({len(s.rows)} rows; "
            f"{html.escape(s.quantity)}{note})</summary>\n<table>\n" + "\n".join(lines)
            + "\n</table>\n</details>")


def page(studies: Studies, pictures: Iterable[tuple[str, str, bytes]]) -> str:
    """The page as one HTML text that needs nothing else."""
    figures = "".join(
        f'<figure><img alt="{html.escape(caption, quote=True)}" '
        f'src="data:image/png;base64,{base64.b64encode(png).decode()}">'
        f"<figcaption>{html.escape(caption)}</figcaption></figure>\n"
        for _, caption, png in pictures)
    return PAGE.format(pictures=figures, summary=_summary(studies),
                       tables="\n".join(_table(s) for s in studies.values()))


def main() -> int:
    """Reads the tables and writes page and pictures; 1 with a sentence on stderr."""
    if len(sys.argv) != 3:
        print("usage: report.py TABLES OUT", file=sys.stderr)
        return 1
    try:
        studies, out = read(Path(sys.argv[1])), Path(sys.argv[2])
        out.mkdir(parents=True, exist_ok=True)
        made = []
        for name, caption, draw, needs in PICTURES:
            if any(need not in studies for need in needs):
                print(f"report.py: no picture of {name}, for its tables were skipped",
                      file=sys.stderr)
                continue
            made.append((name, caption, draw(studies)))
            (out / f"verification-{name}.png").write_bytes(made[-1][2])
        (out / "verification.html").write_text(page(studies, made), encoding="utf-8")
    except OSError as error:
        print(f"report.py: {error}", file=sys.stderr)
        return 1
    print(f"wrote {out / 'verification.html'}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
