"""Where a valve leaks: Snapshot.regions(), Snapshot.orifice_parts(), and their chapter of the report."""

import io

import mvs
import numpy as np
import pytest
from test_files import with_cut_chordae

SCALLOPS = ["A1", "A2", "A3", "P1", "P2", "P3"]


@pytest.fixture(scope="module")
def flail(closed):
    """The closed valve after the chordae of P2 are cut."""
    return with_cut_chordae(closed)


def test_regions_are_a_table_whose_scallops_add_up_to_the_measures(closed, flail):
    for snapshot in (closed, flail):
        table, measures = snapshot.regions(), snapshot.measures
        assert table["name"] == [*SCALLOPS, "A1-P1", "A3-P3"]
        assert table["kind"] == ["scallop"] * 6 + ["commissure"] * 2
        assert table.units["coaptation_area"] == "m2" and table.units["gap"] == "m"
        for field, whole in (
            ("coaptation_area", measures.coaptation_area),
            ("orifice_area", measures.regurgitant_orifice_area),
            ("billow_volume", measures.billow_volume),
            ("tenting_volume", measures.tenting_volume),
        ):
            # sums in another order: rounding only
            assert sum(table[field][:6]) == pytest.approx(whole, rel=1e-12, abs=1e-20)
        assert max(table["billow_height"][:6]) == measures.billow_height
        assert max(table["tenting_height"][:6]) == measures.tenting_height


def test_a_scallop_without_chordae_is_where_the_valve_leaks(closed, flail):
    before = {row["name"]: row for row in closed.regions()}
    after = {row["name"]: row for row in flail.regions()}
    assert len(closed.orifice_parts()) == 0 and len(closed.orifice_part) == 0
    rise = {name: after[name]["billow_height"] - before[name]["billow_height"] for name in SCALLOPS}
    assert max(rise, key=rise.__getitem__) == "P2"
    assert max(SCALLOPS[3:], key=lambda name: after[name]["orifice_area"]) == "P2"
    assert after["P2"]["gap"] > 1e-3 and before["P2"]["gap"] == 0
    parts = flail.orifice_parts()
    assert "P2" in parts[0]["posterior"].split("+")
    assert sum(parts["area"]) == pytest.approx(flail.measures.regurgitant_orifice_area, rel=1e-12)
    assert sum(parts["triangles"]) == len(flail.orifice_part) == len(flail.orifice_triangles)
    for row, part in enumerate(parts):
        corners = flail.orifice_vertices[flail.orifice_triangles[flail.orifice_part == row]]
        vectors = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        areas = np.linalg.norm(vectors, axis=1)
        assert part["area"] == pytest.approx(areas.sum(), rel=1e-9)
        jet = vectors.sum(axis=0) / np.linalg.norm(vectors.sum(axis=0))
        assert [part["jet_x"], part["jet_y"], part["jet_z"]] == pytest.approx(jet.tolist())
        centroid = (areas[:, None] * corners.mean(axis=1)).sum(axis=0) / areas.sum()
        assert [part["x"], part["y"], part["z"]] == pytest.approx(centroid.tolist())


def test_the_report_has_a_row_for_each_region_and_a_sentence_for_each_opening(closed, flail):
    from mvs.report import cases, leak

    stats = mvs.Stats(
        True, 1, 0, 0, True, 1e-6, 0.0, 0.0, 0.1, 1.0, -1.0, mvs.Profile(*[0] * 17)
    )
    case = cases.Case("flail", "Flail <P2>", "", closed, flail, stats)
    text = leak.as_html([case])
    for name in flail.regions()["name"]:
        assert f"<tr><th>{name}</th>" in text
    sentences = list(leak.openings(case))
    assert len(sentences) == len(flail.orifice_parts())
    assert sentences[0] in text and "into the atrium" in sentences[0]
    assert "Flail &lt;P2&gt;" in text and "<P2>" not in text


def test_a_picture_shows_each_opening_in_its_colour():
    pytest.importorskip("pyvista")
    from matplotlib import colors, image
    from mvs.drawing.geometry import Drawing
    from mvs.drawing.pictures import opening_words, picture, view_from_atrium
    from mvs.drawing.scene import orifice_colour

    with mvs.Simulator() as sim:
        sim.generate(shape="founding", annulus_scale=1.1)
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle()
        sim.apply("clip")
        sim.apply("annulus_scale", factor=1.3)
        sim.settle()
        snapshot = sim.snapshot()
    parts = snapshot.orifice_parts()
    assert len(parts) == 2
    words = [opening_words(part, first=k == 0) for k, part in enumerate(parts)]
    assert words[0].startswith("regurgitant orifice\n") and words[1].startswith("A")
    assert words[1].endswith(f"{parts[1]['area'] * 1e6:.1f} mm²")
    png = picture(Drawing(snapshot), view_from_atrium(64), closed=True)
    pixels = image.imread(io.BytesIO(png))[:, :, :3]
    for part in range(2):
        near = np.abs(pixels - colors.to_rgb(orifice_colour(part))).max(axis=2) < 0.02
        assert near.sum() > 200, f"opening {part} is not in the picture"
