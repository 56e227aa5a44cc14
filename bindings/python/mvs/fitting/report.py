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
<h2>Correlation</h2>$covariance
<h2>Trace</h2>$trace
</body></html>
""")


def page_of(found: Fit, measures: Optional[Iterable[str]] = None) -> str:
    """The page; `measures`: those with an interval."""
    return PAGE.substitute(
        warnings="".join(f'<p class="warning">{html.escape(w)}</p>' for w in warnings_of(found)),
        summary=_summary(found),
        shape=_shape(found),
        measures=_measures(found, (measures,) if isinstance(measures, str) else tuple(measures or MEASURES)),
        singular=_singular(found),
        parameters=_parameters(found),
        covariance=_covariance(found),
        trace=_trace(found),
    )


def warnings_of(found: Fit) -> list[str]:
    """Sentences about what makes the result doubtful."""
    from .result import ILL_CONDITIONED, MISFIT, misfit_words

    sentences = []
    if not found.converged:
        sentences.append(f"The search stopped at its number of closures ({found.closures} in all) before it "
                         "converged: repeat the fit with a larger most.")
    weak = int((found.determined < WEAK).sum())
    if weak:
        sentences.append(f"{weak} of {len(found.z)} parameters are set by their priors more than by the data.")
    if found.condition > ILL_CONDITIONED:
        sentences.append(f"The problem is ill-conditioned ({found.condition:.1e}): intervals mean little.")
    bound = int(found.free.at_bound(found.z).sum())
    if bound:
        sentences.append(f"{bound} parameters are at a bound: widen it, or the model does not fit.")
    if found.misfit > MISFIT:
        words = misfit_words(found)
        sentences.append(f"{words[0].upper()}{words[1:]}.")
    lost = sum(not t.at_rest for t in found.trace)
    if lost:
        sentences.append(f"{lost} trials did not come to rest, or were refused.")
    return sentences


def _summary(found: Fit) -> str:
    rows = [
        ("parameters", str(len(found.z))),
        ("data", f"{len(found.residuals_after)} residuals with a noise of {found.noise * 1e3:g} mm"),
        ("residual, RMS", f"{np.sqrt(np.mean(found.residuals_before**2)) * 1e3:.3f} mm before, "
                          f"{found.rms * 1e3:.3f} mm after"),
        ("closures", str(found.closures)),
        ("CPU time", f"{found.cpu_seconds:.1f} s"),
        ("priors", "normal" if found.with_prior else "none"),
        ("starts", "; ".join(f"cost {s.cost:.4g} after {s.closures} closures"
                             f"{'' if s.converged else ', not converged'}" for s in found.starts)),
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
    note = "To first order. " if not found.with_prior else (
        "To first order about the fit. A chord that hangs slack may be longer by any amount that its prior "
        "allows: Fit.sample draws from its one-sided posterior. ")
    return table(rows) + (f"<p>{note}Determined: the share of the prior variance that the data remove.</p>"
                          if found.with_prior else f"<p>{note}Without priors the data determine all.</p>")


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


def _by_node(found: Fit, closed: Any, residuals: Any) -> tuple[Any, Any]:
    """Nodes with data and their distance from these, mm, at a closed valve."""
    nodes = found.target.residuals(np.array(closed.node_position))[1]
    listed, row = np.unique(nodes, return_inverse=True)
    return listed, 1e3 * np.sqrt(np.bincount(row, residuals**2))


def _shape(found: Fit) -> str:
    cases = [("before", found.start, found.residuals_before), ("after", found.closed, found.residuals_after)]
    of_nodes = [_by_node(found, closed, residuals) for _, closed, residuals in cases]
    # the plane of the annulus: the two directions in which it extends most
    annulus = np.array(found.start.node_position)[found.start.annulus_nodes]
    plane = np.linalg.svd(annulus - annulus.mean(axis=0))[2][:2].T

    def draw(made: Any) -> None:
        *axes, bar, counts = made.subplots(1, 4, gridspec_kw={"width_ratios": [1, 1, 0.05, 0.9]})
        most = max(float(of_nodes[0][1].max()), 1e-9)
        for ax, (name, closed, _), (nodes, size) in zip(axes, cases, of_nodes):
            at = 1e3 * (np.array(closed.node_position)[nodes] - annulus.mean(axis=0)) @ plane
            dots = ax.scatter(at[:, 0], at[:, 1], 9, np.minimum(size, most), cmap="viridis", vmin=0, vmax=most)
            ax.set_title(f"{name}: largest {size.max():.2f} mm", fontsize=10)
            ax.set_aspect("equal")
            ax.set_xlabel("mm")
        made.colorbar(dots, cax=bar, label="distance, mm")
        bins = np.linspace(-1, 1, 61) * (float(np.abs(found.residuals_before).max()) * 1e3 or 1.0)
        counts.hist(found.residuals_after * 1e3, bins, color="#8fb3d9", label="after")
        counts.hist(found.residuals_before * 1e3, bins, histtype="step", linewidth=1.5, color="#c8553d",
                    label="before")
        counts.set_xlabel("residual, mm")
        counts.set_ylabel("data")
        counts.legend(frameon=False)

    return _picture(draw, "Distance of each node from its data, seen along the axis of the annulus, and residuals "
                          "of all data, before and after the fit.", 11, 3.4)


def _singular(found: Fit) -> str:
    values = found.singular_values
    count = int((values > 1).sum())

    def draw(made: Any) -> None:
        ax = made.subplots()
        ax.semilogy(np.arange(1, len(values) + 1), np.maximum(values, 1e-6), "o-", markersize=3)
        if found.with_prior:
            ax.axhline(1, color="#c8553d")
        ax.xaxis.get_major_locator().set_params(integer=True)
        ax.set_xlabel("direction of the parameters, best determined first")
        ax.set_ylabel("singular value")

    caption = (f"Singular values in standard deviations of data and prior; above the line the data determine a "
               f"direction better than the prior: {count} of {len(values)}.")
    if not found.with_prior:
        caption = "Singular values in standard deviations of the data, for steps of a default prior's deviation."
    return _picture(draw, caption)


def _covariance(found: Fit) -> str:
    def draw(made: Any) -> None:
        ax = made.subplots()
        d = np.sqrt(np.diag(found.covariance_z))
        image = ax.imshow(found.covariance_z / np.outer(d, d), vmin=-1, vmax=1, cmap="coolwarm")
        ax.set_xlabel("row of the table of parameters")
        ax.set_ylabel("row")
        made.colorbar(image, label="correlation")

    return _picture(draw, "Posterior correlation of the parameters, in the order of the table.", 6, 5)


def _trace(found: Fit) -> str:
    rows = [f"<tr>{heads(['closures', 'data, squares', 'prior, squares', 'at rest'])}</tr>"]
    rows += [f"<tr>{cells([t.closures, f'{t.data:.5g}', f'{t.prior:.5g}', 'yes' if t.at_rest else 'no'])}</tr>"
             for t in found.trace]
    return table(rows) + ("<p>Sums of squares in standard deviations of each trial; the cost is half of their sum"
                          f"{'' if found.with_prior else ', without that of the priors'}.</p>")
