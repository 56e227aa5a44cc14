"""The report of mvs.fit: its figures from the definitions, and its warnings."""

import re

import numpy as np
import pytest
from fitted import found, start, truth  # noqa: F401

import mvs

pytest.importorskip("scipy")


def cells_of(page, first):
    """The cells of the row of a page that begins with this one."""
    row = re.search(rf"<tr><td>{re.escape(first)}</td>(.*?)</tr>", page).group(1)
    return [re.sub("<[^>]*>", "", cell) for cell in re.findall("<td>(.*?)</td>", row)]


def test_the_report_has_the_figures_of_the_definitions(start, truth, found, tmp_path):
    found.save_report(tmp_path / "fit.html")
    page = (tmp_path / "fit.html").read_text()
    nodes = np.unique(start.triangle_nodes)
    rms = [1e3 * np.sqrt(np.mean((valve.node_position[nodes] - truth.node_position[nodes]) ** 2))
           for valve in (start, found.closed)]
    # three decimals
    shown = re.findall(r"[\d.]+", cells_of(page, "residual, RMS")[0])
    assert [float(s) for s in shown] == pytest.approx(rms, abs=6e-4)
    # Laplace's approximation, from the Jacobian of the prior's deviations
    wide = np.linalg.inv(found.jacobian.T @ found.jacobian + np.eye(len(found.z)))
    for k in (0, 17, 40):
        name = [p.name for p in start.parts if p.kind == mvs.PartKind.CHORD][k]
        deviation = 1e3 * np.sqrt(wide[k, k]) * 0.05 * start.chord_rest_length[k]
        length = 1e3 * found.closed.chord_rest_length[k]
        row = cells_of(page, f"chords {name}")
        numbers = [float(x) for x in re.findall(r"-?[\d.]+", " ".join(row[:4]))]
        wanted = [1e3 * start.chord_rest_length[k], length, deviation, length - 1.645 * deviation,
                  length + 1.645 * deviation]
        assert numbers == pytest.approx(wanted, rel=1e-3)  # four digits
        assert float(row[4].split("%")[0]) == pytest.approx(100 * (1 - wide[k, k]), abs=0.6)


def test_the_report_warns_of_a_search_that_stopped(start, truth, tmp_path):
    nodes = np.unique(start.triangle_nodes)
    stopped = mvs.fit(start, mvs.Points(nodes, truth.node_position[nodes]), noise=0.1e-3, most=2)
    assert not stopped.converged
    stopped.save_report(tmp_path / "fit.html")
    assert "stopped at its number of closures" in (tmp_path / "fit.html").read_text()
    free = mvs.fit(start, mvs.Points(nodes, truth.node_position[nodes]), free="heads", priors=False)
    free.save_report(tmp_path / "free.html")
    page = (tmp_path / "free.html").read_text()
    assert "better than the prior" not in page and cells_of(page, "priors") == ["none"]
