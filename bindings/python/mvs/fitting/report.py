"""The report of a fit as one self-contained HTML page."""

from __future__ import annotations

import html
from collections.abc import Iterable
from string import Template
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ..report.markup import cells, figure, heads, table
from ..sensitivities import SHOWN

if TYPE_CHECKING:
    from .result import Fit

MEASURES = ("coaptation_area", "leaflet_area", "max_chord_tension")
"""Measures with an interval unless others are asked for."""
WEAK = 0.5
"""Share of the prior variance that the data have to remove for a parameter to count as determined."""

PAGE = Template("""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Fit of a closed valve: libmvs</title>
<style>
  body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 70rem; margin: 2rem auto; padding: 0 1rem }
  .warning { border-left: 5px solid #c8553d; background: #fbf1ee; padding: .7rem 1rem }
  table { border-collapse: collapse; font-size: .9rem }
  th, td { padding: .2rem .6rem; border-bottom: 1px solid #e5e5e5; text-align: right }
  tr > :first-child { text-align: left }
  figure { margin: 1rem 0 } figure img { max-width: 100% }
</style></head><body>
<h1>Fit of a closed valve</h1>
<p>A research simulator, not a medical device.</p>
$warnings
<h2>Summary</h2>$summary
<h2>Shape before and after</h2>$shape
<h2>Predicted measures</h2>$measures
<h2>What the data determine</h2>$singular
<h2>Parameters</h2>$parameters
<h2>Covariance</h2>$covariance
<h2>Trace</h2>$trace
</body></html>
""")


def page_of(found: Fit, measures: Optional[Iterable[str]] = None) -> str:
    """The page; `measures`: those with an interval."""
    return PAGE.substitute(
        warnings="".join(f'<p class="warning">{html.escape(w)}</p>' for w in warnings_of(found)),
        summary=_summary(found),
        shape=_shape(found),
        measures=_measures(found, tuple(measures or MEASURES)),
        singular=_singular(found),
        parameters=_parameters(found),
        covariance=_covariance(found),
        trace=_trace(found),
    )


def warnings_of(found: Fit) -> list[str]:
    """Sentences about what makes the result doubtful."""
    from .result import ILL_CONDITIONED

    sentences = []
    weak = int((found.determined < WEAK).sum())
    if weak:
        sentences.append(f"{weak} of {len(found.z)} parameters are set by their priors more than by the data.")
    if found.condition > ILL_CONDITIONED:
        sentences.append(f"The problem is ill-conditioned ({found.condition:.1e}): intervals mean little.")
    bound = int((np.abs(found.z) > 0.999 * found.free.reach).sum())
    if bound:
        sentences.append(f"{bound} parameters are at a bound: widen it, or the model does not fit.")
    ratio = found.rms / found.noise
    if ratio > 1.5:
        sentences.append(f"The residual is {ratio:.1f} times the noise: the model does not explain the data, "
                         "and the intervals are too narrow.")
    lost = sum(not t.at_rest for t in found.trace)
    if lost:
        sentences.append(f"{lost} trials did not come to rest.")
    return sentences


def _summary(found: Fit) -> str:
    rows = [
        ("parameters", str(len(found.z))),
        ("data", f"{len(found.residuals_after)} residuals with a noise of {found.noise * 1e3:g} mm"),
        ("residual, RMS", f"{np.sqrt(np.mean(found.residuals_before**2)) * 1e3:.3f} mm before, "
                          f"{found.rms * 1e3:.3f} mm after"),
        ("closures", str(found.closures)),
        ("CPU time", f"{found.cpu_seconds:.1f} s"),
        ("starts", "; ".join(f"cost {s.cost:.4g} after {s.closures} closures ({s.message})"
                             for s in found.starts)),
    ]
    return table(f"<tr>{cells(map(html.escape, row))}</tr>" for row in rows)


def _shown(value: float, unit: str) -> str:
    scale, name = SHOWN.get(unit, (1.0, unit))
    return f"{value * scale:.4g} {name}".strip()


def _measures(found: Fit, names: tuple[str, ...]) -> str:
    rows = [f"<tr>{heads(['measure', 'value', 'deviation', '90 % interval'])}</tr>"]
    for name in names:
        i = found.interval(name)
        rows.append(f"<tr>{cells([i.name, _shown(i.value, i.unit), _shown(i.deviation, i.unit), f'{_shown(i.low, i.unit)} to {_shown(i.high, i.unit)}'])}</tr>")
    return table(rows) + "<p>To first order, by derivatives at the fit.</p>"


def _parameters(found: Fit) -> str:
    rows = [f"<tr>{heads(['parameter', 'start', 'fitted', 'deviation', '90 % interval', 'determined'])}</tr>"]
    for row in found.table():
        unit, value, deviation = row["unit"], row["value"], row["deviation"]
        rows.append(f"<tr>{cells([html.escape(row['parameter']), _shown(row['start'], unit), _shown(value, unit), _shown(deviation, unit), f'{_shown(value - 1.645 * deviation, unit)} to {_shown(value + 1.645 * deviation, unit)}', format(row['determined'], '.0%') + (' at a bound' if row['at_bound'] else '')])}</tr>")
    return table(rows)


def _picture(draw: Any, caption: str, width: float = 8, height: float = 3.2) -> str:
    """A plot, or its caption where matplotlib is missing."""
    try:
        from ..drawing.pictures import new_figure, to_png
    except ImportError:
        return f"<p>{html.escape(caption)} (no picture without matplotlib and pyvista)</p>"
    made = new_figure(width, height)
    draw(made)
    made.tight_layout()
    return figure(to_png(made), caption)


def _shape(found: Fit) -> str:
    def draw(made: Any) -> None:
        ax = made.subplots()
        reach = float(np.abs(found.residuals_before).max()) * 1e3 or 1.0
        bins = np.linspace(-reach, reach, 61)
        ax.hist(found.residuals_before * 1e3, bins, color="#b9c6d2", label="before")
        ax.hist(found.residuals_after * 1e3, bins, color="#3d6fa3", alpha=0.8, label="after")
        ax.set_xlabel("residual, mm")
        ax.legend(frameon=False)

    return _picture(draw, "Residuals of all data before and after the fit.")


def _singular(found: Fit) -> str:
    values = found.singular_values
    count = int((values > 1).sum())

    def draw(made: Any) -> None:
        ax = made.subplots()
        ax.semilogy(np.arange(1, len(values) + 1), np.maximum(values, 1e-6), "o-", markersize=3)
        ax.axhline(1, color="#c8553d")
        ax.set_xlabel("direction")
        ax.set_ylabel("singular value")

    return _picture(draw, f"Singular values in standard deviations of data and prior: the data determine "
                          f"{count} of {len(values)} directions better than the prior.")


def _covariance(found: Fit) -> str:
    def draw(made: Any) -> None:
        ax = made.subplots()
        d = np.sqrt(np.diag(found.covariance_z))
        image = ax.imshow(found.covariance_z / np.outer(d, d), vmin=-1, vmax=1, cmap="coolwarm")
        made.colorbar(image, label="correlation")

    return _picture(draw, "Posterior correlation of the parameters, in the order of the table.", 6, 5)


def _trace(found: Fit) -> str:
    rows = [f"<tr>{heads(['closures', 'data, squares', 'prior, squares', 'at rest'])}</tr>"]
    rows += [f"<tr>{cells([t.closures, f'{t.data:.5g}', f'{t.prior:.5g}', 'yes' if t.at_rest else 'no'])}</tr>"
             for t in found.trace]
    return table(rows)
