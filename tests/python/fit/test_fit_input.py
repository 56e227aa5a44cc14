"""Arguments of mvs.fit and questions about its result that would be taken for something else."""

import numpy as np
import pytest
from fitted import found, start, truth  # noqa: F401

import mvs

pytest.importorskip("scipy")


@pytest.mark.parametrize("options, words", [
    ({"noise": 0.3}, "metres are needed, not millimetres"),
    ({"noise": float("inf")}, "noise: a positive number"),
    ({"noise": "0.3"}, "noise: a positive number"),
    ({"priors": 0.1}, "a mapping of groups"),
    ({"priors": True}, "a mapping of groups"),
    ({"priors": {"chords": 0.1}}, "chords needs a mvs.Prior"),
    ({"priors": {"heads": mvs.Prior(1e-3)}}, '"heads" is not among the free groups'),
    ({"priors": {"chords": mvs.Prior(10)}}, "its deviation is a share"),
    ({"priors": {"chords": mvs.Prior(float("nan"))}}, "deviation of chords: a positive number"),
    ({"free": "heads", "priors": {"heads": mvs.Prior(2)}}, "metres are needed, not millimetres"),
    ({"free": 3}, "free: a name or a list of names"),
    ({"starts": 1.5}, "starts: a whole number"),
    ({"most": 1.5}, "most: a whole number"),  # scipy never ended
    ({"residual": 0}, "residual: a positive number"),
    ({"tolerance": -1}, "tolerance: a positive number"),
])
def test_options_that_would_be_taken_for_others_are_refused(start, options, words):
    nodes = np.unique(start.triangle_nodes)
    with pytest.raises(mvs.ArgumentError, match=words):
        mvs.fit(start, mvs.Points(nodes, start.node_position[nodes]), **options)


def test_targets_of_the_wrong_kind_are_refused(start):
    nodes, triangles = np.unique(start.triangle_nodes), np.array(start.triangle_nodes)
    x = np.array(start.node_position)
    mask = np.isin(np.arange(len(x)), nodes)
    for target, words in (
        (mvs.Points(nodes + 0.5, x[nodes]), "whole numbers"),
        (mvs.Points(mask, x[: len(mask)]), "whole numbers, not bool"),
        (mvs.Points(nodes, [["a"] * 3] * len(nodes)), "have to be numbers"),
        (mvs.Points(nodes, np.full((len(nodes), 3), np.nan)), "finite places"),
        (mvs.Points(nodes, x[nodes, :2]), "finite places"),
        ((x, triangles[:0]), "no triangles"),
        ((x, np.zeros((4, 3), int)), "no triangle of the surface has an area"),
        ((x, triangles + 0.5), "whole numbers"),
        ((np.where(x > 0, np.nan, x), triangles), "not finite"),
    ):
        with pytest.raises(mvs.ArgumentError, match=words):
            mvs.fit(start, target)
    with pytest.raises(mvs.ArgumentError, match="start: a closed mvs.Snapshot"):
        mvs.fit(mvs.valve_of(start), mvs.Points(nodes, x[nodes]))


def test_questions_about_a_fit_are_checked(found, tmp_path):
    with pytest.raises(mvs.ArgumentError, match="did you mean"):
        found.interval("coaptation_are")
    with pytest.raises(mvs.ArgumentError, match="level"):
        found.interval("coaptation", level=90)
    with pytest.raises(mvs.ArgumentError, match="level: a number between 0 and 1 is needed, not '0.9'"):
        found.interval("coaptation", level="0.9")
    for call in (found.sample, lambda count, seed: found.interval("coaptation", samples=count, seed=seed)):
        with pytest.raises(mvs.ArgumentError, match="seed: a whole number of at least 0"):
            call(3, seed=-1)
    with pytest.raises(mvs.ArgumentError, match="samples: a whole number"):
        found.interval("coaptation", samples=1.5)
    with pytest.raises(mvs.ArgumentError, match="count: a whole number"):
        found.sample(-1)
    with pytest.raises(mvs.ArgumentError, match="no measure"):
        found.save_report(tmp_path / "fit.html", measures=["foo"])
    assert not (tmp_path / "fit.html").exists()
    found.save_report(tmp_path / "fit.html", measures="coaptation")  # was taken letter by letter
    assert "coaptation_area" in (tmp_path / "fit.html").read_text()
