"""The report: a self-contained page with a picture of each kind and every measure."""

import dataclasses
import io
import re

import mvs
import numpy as np
import pytest

pytest.importorskip("pyvista")
pytest.importorskip("matplotlib")

from mvs.drawing import geometry  # noqa: E402
from mvs.report import cases, ensemble, gallery, page, table  # noqa: E402


@pytest.fixture(scope="module")
def case(opened, closed):
    stats = mvs.Stats(
        True, 1, 0, 0, True, 1e-6, 0.0, 0.0, 0.1, 1.0, -1.0, mvs.Profile(*[0] * 17)
    )
    return cases.Case("shipped", "Shipped <valve>", "a note", opened, closed, stats)


@pytest.fixture(scope="module")
def pictures(case):
    return gallery.pictures_of(case, gallery.common_scales([case]))


def test_there_is_a_picture_of_each_kind_and_none_is_blank(pictures):
    import matplotlib.image

    assert [shown.name for shown in pictures] == list(gallery.CAPTIONS)
    for shown in pictures:
        image = matplotlib.image.imread(io.BytesIO(shown.png))
        # the sheets cover far more than a tenth of a view, the lines of a section 1 %
        drawn = (image[..., :3] < 0.9).any(axis=2).mean()
        assert drawn > (0.01 if shown.name == "section" else 0.1)


def test_the_valve_of_a_file_closes_under_its_own_pressure_unless_given_another(tmp_path):
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=200)
        sim.set_load(3e3)
        sim.snapshot().save(tmp_path / "tricuspid.h5")
    for asked, pressure in ((None, 3e3), (2e3, 2e3)):
        case = cases.from_file(tmp_path / "tricuspid.h5", "file1", asked)
        assert case.closed.load_case.pressure == pressure


def test_the_page_is_self_contained(case, pictures):
    text = page.build([case], pictures)
    assert text.count("data:image/png;base64,") == len(pictures)
    assert not re.search(r"(src|href)=\"(?!data:)", text)
    assert "not a cleared medical device" in text
    assert mvs.__version__ in text and case.closed.hash in text
    assert "Shipped &lt;valve&gt;" in text and "<valve>" not in text


def test_the_table_prints_every_measure_with_its_unit(case):
    conditions = {"at_rest", "under_load"}  # these are in the verdict
    shown = {row.field for row in table.ROWS} | conditions
    assert shown == {f.name for f in dataclasses.fields(mvs.Measures)}
    text = table.as_text([case])
    assert len(text.splitlines()) == 1 + len(table.solution(case)) + len(table.ROWS)
    si = {"mm": "m", "mm²": "m2", "cm²": "m2", "ml": "m3", "%": "1", "": "1", "N": "N",
          "kPa": "Pa", "°": "rad"}
    for row in table.ROWS:
        assert si[row.unit] == mvs.unit_of(mvs.Measures, row.field)


def test_the_elongated_chord_is_a_strut(opened):
    row, name = cases.strut_chord(opened)
    assert opened.chord_kind[row] == mvs.ChordKind.STRUT
    assert opened.find(mvs.PartKind.CHORD, name).index == row


def test_unrolled_leaflets_hang_from_the_annulus(opened):
    drawing = geometry.Drawing(opened)
    flat = geometry.unroll(drawing)
    assert (flat.down[opened.annulus_nodes] == 0).all()
    assert flat.width == pytest.approx(opened.measures.annulus_perimeter * 1e3, rel=0.05)
    # only triangles across the cut are left out: a strip at most two triangles wide
    assert len(flat.triangles) > 0.9 * len(drawing.triangles)
    leaflet = opened.triangle_leaflet[flat.rows]
    left, right = (flat.across[flat.triangles[leaflet == k]].mean() for k in (0, 1))
    assert left < right


def test_the_ensemble_has_a_picture_and_every_figure(case):
    import matplotlib.image

    each = ensemble.Run("thin", "Thin <valve>", case.opened.ensemble(mvs.SYSTOLE_PA, members=2))
    png = ensemble.picture_of(each, 50.0)
    image = matplotlib.image.imread(io.BytesIO(png))
    # the sheets cover far more than a tenth of the picture
    assert (image[..., :3] < 0.9).any(axis=2).mean() > 0.1
    text = ensemble.as_html([each], {"thin": png})
    assert text.count("data:image/png;base64,") == 1
    assert "2 of 2 members at rest" in text and "2 of 2 members at rest" in ensemble.as_text([each])
    assert "Thin &lt;valve&gt;" in text and "<valve>" not in text
    for row in table.ROWS:
        assert f"<tr><th>{row.label}</th><td>{table.value(row, case.closed.measures)}</td>" in text


def test_a_view_from_the_ventricle_shows_papillary_muscles_whole(closed):
    import matplotlib.image
    from mvs.drawing.pictures import picture, view_from_ventricle, view_oblique, whole_valve

    drawing = geometry.Drawing(closed)
    for view in (view_from_ventricle(44), view_oblique(44)):
        png = picture(drawing, view, closed=True)
        red, green, _ = np.moveaxis(matplotlib.image.imread(io.BytesIO(png))[..., :3], 2, 0)
        muscle = (red - green > 0.15) & (green < 0.42)  # darker than leaflets
        assert muscle.sum() > 1000
        assert not muscle[-1].any()
    assert view_from_ventricle(90).around(whole_valve(drawing), 4) == view_from_ventricle(90)
