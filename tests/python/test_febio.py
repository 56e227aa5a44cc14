"""A valve closed by FEBio, on the same mesh (see tests/validation/febio.py)."""

from dataclasses import replace

import numpy as np
import pytest


@pytest.fixture(scope="module")
def theirs(real_valves):
    import febio_case

    path = real_valves / febio_case.FILE
    if not path.is_file():
        pytest.skip(f"no {path}")
    return febio_case.Theirs(path)


@pytest.fixture(scope="module")
def stiff(theirs):
    """The closure with 60 times the bending stiffness, about that of FEBio's locked shells."""
    import febio

    return febio.close(theirs, febio.STIFF)


def test_it_closes_without_crossings(theirs):
    import febio

    result = febio.close(theirs)
    assert result.stats.converged
    assert result.closed.measures.intersections == 0


def test_chordal_tension_agrees_in_the_shape_of_febio(theirs):
    import febio

    target = febio.close(theirs, replace(febio.BASE, smoothed_chords=True, from_theirs=True)).target
    # the file has a resolution of 1e-4 N; the omitted tail of the table carries 0.3 mN
    assert np.abs(target.chord_tension - theirs.chord_force).max() < 4e-4


def test_smoothing_of_chordae_has_no_effect(theirs, stiff):
    import febio

    smooth = febio.close(theirs, replace(febio.STIFF, smoothed_chords=True))
    # half of 0.02 mm where a chord becomes taut, zero beyond
    assert np.sqrt((np.linalg.norm(
        smooth.closed.node_position - stiff.closed.node_position, axis=1) ** 2).mean()) < 20e-6


def test_bending_stiffness_explains_the_distance_to_febio(theirs, stiff):
    import febio

    plain = febio.close(theirs)
    assert stiff.stats.converged
    # 0.87 and 1.91 mm: FEBio's shape is an equilibrium of a locking shell, not of this sheet
    assert stiff.comparison.surface_rms < 0.5 * plain.comparison.surface_rms


def test_it_can_be_drawn(theirs, stiff, tmp_path):
    import febio

    febio.draw([stiff], tmp_path)
    assert len(list(tmp_path.glob("*.png"))) == 3
    assert "bending x 60" in febio.row(stiff)
    signed = febio.signed_distance(stiff)
    assert signed.min() < 0 < signed.max()
    # nodes sample the surface more coarsely than the comparison does
    assert np.sqrt((signed**2).mean()) < 2 * stiff.comparison.surface_rms * 1e3
