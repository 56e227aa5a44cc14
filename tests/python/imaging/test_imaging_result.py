"""mvs.imaging: what the command prints of a valve, as text, as JSON and as warnings."""

import argparse
import dataclasses
import json
import types
import warnings
from pathlib import Path

import mvs
import numpy as np
import pytest

pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")

from mvs.imaging.console import warnings_in_lines  # noqa: E402
from mvs.imaging.findings import finding  # noqa: E402
from mvs.imaging.result import print_result, verdict_of  # noqa: E402

MEASURED = mvs.FindingSource.MEASURED


def made_with(*findings, leak=0.0, converged=True):
    """A valve whose leak is given in mm2."""
    opened = types.SimpleNamespace(node_kind=np.zeros(3, int), chord_kind=[0], head_nodes=[0, 1], hash="0")
    closed = types.SimpleNamespace(measures=types.SimpleNamespace(regurgitant_orifice_area=leak * 1e-6))
    return types.SimpleNamespace(opened=opened, closed=closed, converged=converged, findings=findings, repair=None)


def printed(capsys, made, as_json):
    print_result(argparse.Namespace(output=Path("a.h5"), json=as_json), made, Path("a.import.json"))
    return capsys.readouterr().out


def test_json_has_the_values_of_findings_and_the_interval_of_leaks(capsys):
    interval = finding("leak_interval", MEASURED, 0.5, "said", [1e-6, 4.5e-6], "m2")
    read = json.loads(printed(capsys, made_with(interval), True))
    assert read["regurgitant_orifice_area_interval_mm2"] == pytest.approx([1, 4.5])
    (row,) = read["findings"]
    assert row["values"] == [1e-6, 4.5e-6] and row["unit"] == "m2"
    assert json.loads(printed(capsys, made_with(), True))["regurgitant_orifice_area_interval_mm2"] is None


def test_the_headline_names_gaps_of_the_loaded_leaflets_that_the_valve_lacks(capsys):
    gaps = finding("shown_gaps", MEASURED, 0.3, "said", [15.6e-6], "m2")
    assert verdict_of(made_with(gaps)) == "at rest, sealed, but the loaded leaflets show gaps of 15.6 mm2"
    assert "sealed, but the loaded leaflets" in printed(capsys, made_with(gaps), False)
    assert verdict_of(made_with(gaps, leak=14)) == "at rest, leaks through 14.0 mm2"
    assert verdict_of(made_with(finding("shown_gaps", MEASURED, 0.9, "none", [0.0], "m2"))) == "at rest, sealed"
    assert verdict_of(made_with(gaps, converged=False)).startswith("NOT at rest")


def test_the_headline_names_doubtful_findings(capsys):
    interval = finding("leak_interval", MEASURED, 0.5, "said", [0, 3.3e-6], "m2")
    fit = dataclasses.replace(finding("closed_fit", MEASURED, 0.1, "far", [3.5e-3], "m"), doubtful=True)
    rest = dataclasses.replace(finding("leak_at_rest", MEASURED, 0.1, "few", [0.1]), doubtful=True)
    said = "at rest, sealed; 0.0 to 3.3 mm2 over what is not sure"
    assert f"{said}; doubtful: closed_fit, leak_at_rest\n" in printed(capsys, made_with(fit, interval, rest), False)
    assert f"{said}\n" in printed(capsys, made_with(interval), False)


@pytest.mark.parametrize("quiet", [False, True])
def test_warnings_are_one_line_without_source_code(capsys, quiet):
    with warnings_in_lines(quiet):
        warnings.simplefilter("always")
        warnings.warn("two\nlines", mvs.ValveWarning)
        warnings.warn("of a library", RuntimeWarning)
    lines = capsys.readouterr().err.splitlines()
    assert lines == ["mvs-image: warning: two lines"] + ["mvs-image: warning: of a library"] * (not quiet)
