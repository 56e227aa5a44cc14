"""mvs.imaging: the tissue law is that whose fitted closure is nearest to the loaded labels."""

import types

import mvs
import numpy as np
import pytest

pytest.importorskip("pyvista", reason="needs the extra imaging (PyVista)")

from mvs.imaging.fitted_tissue import (  # noqa: E402
    CANDIDATES, CLEARLY_NEARER, SEARCH_VERTICES, LawFit, chosen_tissue, law_fit, search_edge, with_other_fits)
from mvs.imaging.mesh import Sheet  # noqa: E402


def fits(**away):
    """Fits without a leak at distances in m."""
    return {law: LawFit(distance, 0.0) for law, distance in away.items()}


def test_a_law_that_is_clearly_nearer_takes_the_place_of_the_default():
    law, said = chosen_tissue(fits(bilinear=1.33e-3, prot=0.85e-3, may_newman_yin=0.80e-3))
    assert law == "may_newman_yin" and said.name == "tissue" and said.source == mvs.FindingSource.MEASURED
    assert list(said.values) == [0.80e-3, 0.85e-3, 1.33e-3]  # nearest first, as the sentence has them
    assert "may_newman_yin 0.80 mm, prot 0.85 mm, bilinear 1.33 mm" in said.sentence
    alone, sure = chosen_tissue(fits(bilinear=1.33e-3, may_newman_yin=0.80e-3))
    assert alone == law and sure.confidence > said.confidence  # no second law is as near


def test_the_default_stays_where_others_are_hardly_nearer():
    near = 1e-3 * CLEARLY_NEARER
    assert chosen_tissue(fits(bilinear=1e-3, prot=1.001 * near))[0] == "bilinear"
    assert chosen_tissue(fits(bilinear=1e-3, prot=0.999 * near))[0] == "prot"


def test_the_interval_of_leaks_holds_those_of_fits_that_lie_hardly_farther_away():
    def of_area(name, *values, sure=0.7):
        return mvs.Finding(name, mvs.FindingSource.MEASURED, sure, "as built", np.array(values), "m2")

    limits = of_area("leak_limits", 0.5e-6, 20e-6)
    interval = of_area("leak_interval", 0, 2.8e-6)
    near = {"bilinear": LawFit(0.83e-3, 6.5e-6), "prot": LawFit(0.74e-3, 1.3e-6)}
    kept, wider = with_other_fits((limits, interval), {**near, "may_newman_yin": LawFit(1.2e-3, 40e-6)})
    assert kept is limits and wider.source == interval.source
    assert list(wider.values) == pytest.approx([0, 7e-6])  # meshes of one valve differ by 0.5 mm2
    # 17.2 of 20 mm2 are ruled out as built, 13 are left
    assert wider.confidence == pytest.approx(0.7 * 13 / 17.2)
    assert "bilinear, 6.5 mm2" in wider.sentence and "may_newman_yin" not in wider.sentence
    assert "as built" in wider.sentence
    # the coarse fit with the tissue that is taken counts, too; an interval of 20 mm2 says nothing
    alone = with_other_fits((interval, limits), {"prot": LawFit(0.74e-3, 21e-6)})[0]
    assert list(alone.values) == pytest.approx([0, 21.5e-6]) and alone.confidence == 0
    # of a build without an interval or without other fits nothing changes, nor if no closure came to rest
    within = {"prot": LawFit(0.74e-3, 1.3e-6)}
    assert with_other_fits((interval, limits), within)[0] is interval
    assert with_other_fits((interval, limits), {})[0] is interval
    empty = of_area("leak_interval", sure=0.0)
    assert with_other_fits((empty, limits), near)[0] is empty
    assert with_other_fits((), near) == ()


def square(side, above=0.0):
    """Two triangles, side in m, at a height in m."""
    points = np.array([[0, 0, above], [side, 0, above], [side, side, above], [0, side, above]])
    return Sheet(points, np.array([[0, 1, 2], [0, 2, 3]]), {})


def closure(sheet, loaded, converged=True, crossings=0):
    """A build whose closed leaflets are a sheet."""
    measures = types.SimpleNamespace(intersections=crossings, regurgitant_orifice_area=3e-6)
    closed = types.SimpleNamespace(measures=measures, node_position=sheet.points, triangle_nodes=sheet.triangles)
    return lambda: types.SimpleNamespace(converged=converged, closed=closed, loaded=loaded)


def test_tissue_that_the_labels_lack_is_no_distance():
    """The leaflets are three times as large as their labels and lie 1 mm from them."""
    assert law_fit(closure(square(30e-3), square(10e-3, above=1e-3))).distance == pytest.approx(1e-3, rel=1e-6)


def test_laws_without_a_clean_closure_are_left_out():
    def refused():
        raise mvs.OpError("the surface has one boundary")

    sheet, labels = square(30e-3), square(30e-3, above=1e-3)
    assert law_fit(closure(sheet, labels)).leak == 3e-6
    assert law_fit(closure(sheet, labels, converged=False)) is None
    assert law_fit(closure(sheet, labels, crossings=2)) is None
    assert law_fit(refused) is None
    assert chosen_tissue(fits(prot=2e-3))[0] == "prot"  # the default did not come to rest
    law, said = chosen_tissue({})
    assert law == CANDIDATES[0] == "bilinear" and said.source == mvs.FindingSource.ASSUMED and said.confidence < 0.3


def test_the_mesh_of_the_comparison_has_the_stated_vertices():
    side = 30e-3
    # equilateral triangles of that side, two for each vertex, fill the square
    assert side**2 / (search_edge(square(side)) ** 2 * np.sqrt(3) / 2) == pytest.approx(SEARCH_VERTICES)
