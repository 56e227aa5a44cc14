"""The page of the verification suite, from the tables of `verification --tables`."""

import importlib.util
import pathlib
import re
import sys

import pytest

pytest.importorskip("matplotlib")

INDEX = """name,title,quantity,x,level,source,expects,tolerance,order_low,order_high,worst_error,\
order_least,order_most,verdict
"hencky_disc","Hencky's <disc>","height, m","","edge, m","a table","2: linear",0.01,1.7,2.3,0.0025,\
2,2,holds
"""
ROWS = """case,x,level,value,exact,relative_error,observed_order
"rings, of triangles",0,0.002,1.01,1,0.01,
"rings, of triangles",0,0.001,1.0025,1,0.0025,2
"""


@pytest.fixture(scope="module")
def report():
    path = pathlib.Path(__file__).parents[1] / "verification" / "report.py"
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location("verification_report", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look up their module
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def studies(report, tmp_path):
    (tmp_path / "studies.csv").write_text(INDEX)
    (tmp_path / "hencky_disc.csv").write_text(ROWS)
    return report.read(tmp_path)


def test_tables_are_read_unchanged(studies):
    study = studies["hencky_disc"]
    assert study.verdict == "holds"
    assert [row.level for row in study.rows] == [0.002, 0.001]
    assert study.rows[1].order == 2 and study.rows[0].order != study.rows[0].order
    assert list(study.series()) == [("rings, of triangles", 0)]


def test_the_page_is_self_contained_and_shows_every_row(report, studies):
    from report_pictures import convergence_picture

    png = convergence_picture(studies)
    text = report.page(studies, [("convergence", "errors", png)])
    assert text.count("data:image/png;base64,") == 1
    assert not re.search(r'(src|href)="(?!data:|#)', text)
    assert "Hencky&#x27;s &lt;disc&gt;" in text and "<disc>" not in text
    for cell in ("1.0025", "0.0025", "2.00", "holds", "a table"):
        assert cell in text


def test_pictures_without_tables_are_left_out(report, studies):
    for _, _, draw, needs in report.PICTURES:
        if all(need in studies for need in needs):
            assert draw(studies).startswith(b"\x89PNG")
