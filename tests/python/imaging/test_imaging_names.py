"""mvs.imaging: names of landmarks beside the sides of the valve on which they lie."""

import argparse
import json

import mvs
import numpy as np
import pytest

pytest.importorskip("SimpleITK", reason="needs the extra imaging (SimpleITK)")
pytest.importorskip("skimage", reason="needs the extra imaging (scikit-image)")
pytest.importorskip("slicerio", reason="needs the extra imaging (slicerio)")

from mvs.imaging.findings import finding  # noqa: E402
from mvs.imaging.landmark_names import ANTEROLATERAL, POSTEROMEDIAL, side_of  # noqa: E402
from mvs.imaging.landmarks import read_part  # noqa: E402
from mvs.imaging.requests import misnamed_in_files  # noqa: E402

COMMISSURES = finding("commissures", mvs.FindingSource.GIVEN, 1, "given", [-0.02, 0, 0, 0.02, 0, 0], "m")


@pytest.mark.parametrize("name, side", [
    ("AL", ANTEROLATERAL), ("AL1", ANTEROLATERAL), ("Antero-lateral head", ANTEROLATERAL), ("pm tip", POSTEROMEDIAL),
    ("PosteroMedial", POSTEROMEDIAL), ("F-1", None), ("aluminium", None), ("MarkupsPoint-1", None)])
def test_the_side_in_a_name(name, side):
    assert side_of(name) == side


def test_names_of_the_other_side_are_a_doubtful_finding(tmp_path):
    def found(names, points, frame="LPS"):
        path = tmp_path / "tips.mrk.json"
        rows = [{"label": name, "position": [float(c) for c in point]} for name, point in zip(names, points)]
        path.write_text(json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": frame, "coordinateUnits": "mm",
                                                 "controlPoints": rows}]}))
        return misnamed_in_files(argparse.Namespace(commissures=None, tips=path, frame=None), (COMMISSURES,))

    right = np.array([[-15, 3, -20], [14, 3, -20], [1, 0, 0]])
    assert found(("AL tip", "posteromedial", "F-1"), right) == ()
    (swapped,) = found(("PM1", "AL", "F-1"), right)
    assert swapped.doubtful and '"PM1", "AL". Are names swapped' in swapped.sentence
    (third,) = found(("AL", "F-2", "AL-3"), right)
    assert ': "AL-3". Are' in third.sentence
    assert found(("AL", "PM"), right[:2] * [-1, -1, 1], "RAS") == ()


@pytest.mark.parametrize("unit, scale", [("m", 1), ("cm", 100), ("mm", 1000), (None, 1000)])
def test_landmarks_have_the_unit_that_their_file_states_or_mm(tmp_path, unit, scale):
    path = tmp_path / "tips.mrk.json"
    points = [[-0.015, 0.003, -0.02], [0.014, 0.003, -0.02]]
    markup = {"type": "Fiducial", "coordinateSystem": "LPS",
              "controlPoints": [{"label": f"F-{k}", "position": [c * scale for c in point]} for k, point in enumerate(points)]}
    path.write_text(json.dumps({"markups": [{**markup, **({"coordinateUnits": unit} if unit else {})}]}))
    assert read_part(path, "papillary_tips") == pytest.approx(np.array(points))
    misnamed_in_files(argparse.Namespace(commissures=None, tips=path, frame=None), (COMMISSURES,))
