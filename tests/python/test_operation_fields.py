"""Fields of operations: forms of values, points, refusals."""

import mvs
import numpy as np
import pytest
from test_operations import site_node


def test_parts_may_be_named_or_given_by_id(sim):
    part = sim.snapshot().find(mvs.PartKind.CHORD, "P2/3")
    hashes = set()
    for chord in ("P2/3", part.id, np.uint64(part.id), part):
        sim.apply("chord_length", chord=chord, factor=0.75)
        hashes.add(sim.snapshot().hash)
        sim.undo()
    assert len(hashes) == 1


def test_a_site_may_be_written_in_several_ways(sim):
    scallop = sim.snapshot().find(mvs.PartKind.SCALLOP, "P2")
    hashes = set()
    for site in (
        ("P2", 0.4, 0.8),
        [scallop, 0.4, 0.8],
        (scallop.id, 0.4, np.float64(0.8)),
        "P2:0.4:0.8",
        mvs.Site(scallop="P2", along=0.4, height=0.8),
    ):
        sim.apply("neochord", head="PM1", site=site)
        hashes.add(sim.snapshot().hash)
        sim.undo()
    assert len(hashes) == 1
    node = site_node(sim.snapshot())
    sim.apply("neochord", head="PM1", site=node)
    as_number = sim.snapshot().hash
    assert sim.snapshot().chord_nodes[-1, 1] == node
    sim.undo()
    for site in (mvs.Site(node=node), f"node:{node}"):
        sim.apply("neochord", head="PM1", site=site)
        assert sim.snapshot().hash == as_number
        sim.undo()
    assert mvs.ops.neochord(head="PM1", site="triangle:5:0.3:0.3:0.4") == mvs.ops.neochord(
        head="PM1", site=(5, (0.3, 0.3, 0.4))
    )


def test_a_choice_may_be_a_word_or_its_number(sim):
    sim.apply("chord_add", head="PM1", site=("P2", 0.4, 0.8), type="strut")
    assert sim.snapshot().chord_kind[-1] == mvs.ChordKind.STRUT
    word = mvs.ops.chord_add(head="PM1", site=3, type="strut")
    assert mvs.ops.chord_add(head="PM1", site=3, type=mvs.ChordKind.STRUT) == word


REFUSED = [
    ("chord_lenght", dict(chord="P2/3"), mvs.ArgumentError, 'no operation "chord_lenght"'),
    ("chord_lenght", dict(chord="P2/3"), mvs.ArgumentError, "chord_length, chord_remove"),
    ("chord_length", dict(chord="P2/3", lenght=1), mvs.ArgumentError, 'no field "lenght"'),
    ("chord_length", dict(chord="P2/3", lenght=1), mvs.ArgumentError, "chord, length (m), factor"),
    ("chord_length", dict(factor=2), mvs.ArgumentError, "needs chord (the chord)"),
    ("chord_length", dict(chord=None, factor=2), mvs.ArgumentError, "needs chord"),
    ("chord_length", dict(chord="P2/3", factor="2"), mvs.ArgumentError, "a number, not '2'"),
    ("chord_length", dict(chord="P2/3", factor=True), mvs.ArgumentError, "a number, not True"),
    ("chord_length", dict(chord="P2/3", factor=0), mvs.ArgumentError, "omit it"),
    ("chord_length", dict(chord="P2/3", factor=-1), mvs.ArgumentError, "0.01 to 100"),
    ("chord_length", dict(chord="P2/3", factor=np.nan), mvs.ArgumentError, "factor is nan"),
    ("chord_length", dict(chord="P2/3", length=20), mvs.ArgumentError, "0.0001 to 0.2"),
    ("chord_length", dict(chord="P2/3"), mvs.ArgumentError, "0 of length, factor and drag_to"),
    ("chord_length", dict(chord="P2/3", drag_to=(1, 2)), mvs.ArgumentError, "three numbers in m"),
    ("chord_length", dict(chord="P2/99", factor=2), mvs.IdError, 'no chord named "P2/99"'),
    ("chord_length", dict(chord=-1, factor=2), mvs.ArgumentError, "name or id of a chord"),
    ("chord_length", dict(chord=1.0, factor=2), mvs.ArgumentError, "name or id of a chord"),
    ("chord_length", dict(chord=10**9, factor=2), mvs.IdError, "1000000000"),
    ("chord_add", dict(head="PM1", site="P2"), mvs.ArgumentError, "(scallop, along, height)"),
    ("chord_add", dict(head="PM1", site="P2:0.4"), mvs.ArgumentError, '"P2:0.5:0.9"'),
    ("chord_add", dict(head="PM1", site="node:x"), mvs.ArgumentError, '"P2:0.5:0.9"'),
    ("ring", dict(size=34), mvs.ArgumentError, "looks like mm given as m"),
    ("chord_add", dict(head="PM1", site=("Q2", 0.1, 1)), mvs.IdError, "there are A"),
    ("chord_add", dict(head="PM1", site=("P2", 1.5, 1)), mvs.ArgumentError, "coordinate of 1.5"),
    ("chord_add", dict(head="PM1", site=10**6), mvs.IdError, "node 1000000"),
    ("chord_add", dict(head="PM1", site=3, type="magic"), mvs.ArgumentError, '"rough_zone"'),
    ("chord_add", dict(head="PM1", site=3, type=9), mvs.ArgumentError, '"rough_zone"'),
    ("neochord", dict(head="PM1", site=3, strands=2.0), mvs.ArgumentError, "a non-negative integer"),
    ("neochord", dict(head="PM1", site=3, name=4), mvs.ArgumentError, "text"),
    ("neochord", dict(head="PM1", site=3, name="a\0b"), mvs.ArgumentError, "zero character"),
    ("neochord", dict(head="PM1", site=3, name="x" * 80), mvs.ArgumentError, "80 bytes"),
    ("head_move", dict(head="PM1", by=1e-3), mvs.ArgumentError, "a vector, three numbers in m"),
    ("head_move", dict(head="PM1", by=(1, 0, 0)), mvs.ArgumentError, "0.05"),
]


@pytest.mark.parametrize("kind, fields, error, words", REFUSED)
def test_impossible_operations_are_refused_and_change_nothing(sim, kind, fields, error, words):
    before = sim.snapshot().hash
    said = []
    for call in (sim.check, sim.apply):
        with pytest.raises(error) as caught:
            call(kind, **fields)
        said.append(str(caught.value))
    assert words in said[0]
    assert said[0] == said[1]
    assert sim.snapshot().hash == before


def test_a_part_of_another_kind_is_refused(sim):
    head = sim.snapshot().find(mvs.PartKind.HEAD, "PM1")
    with pytest.raises(mvs.IdError, match="papillary head PM1, not a chord"):
        sim.apply("chord_remove", chord=head.id)
    with pytest.raises(mvs.ArgumentError, match="name or id of a chord"):
        sim.apply("chord_remove", chord=head)


def test_a_site_has_exactly_one_form():
    for wrong in (
        dict(),
        dict(node=1, scallop="P2"),
        dict(triangle=1),
        dict(node=1, barycentric=(0.3, 0.3, 0.4)),
    ):
        with pytest.raises(mvs.ArgumentError, match="a site is"):
            mvs.Site(**wrong)


def test_many_points_arrive_unchanged(sim):
    wanted = sim.snapshot().node_loaded[sim.snapshot().annulus_nodes] * 0.9
    wide = np.zeros((len(wanted), 6))
    wide[:, ::2] = wanted
    hashes = set()
    for curve in (wanted, wanted.tolist(), np.asfortranarray(wanted), wide[:, ::2]):
        made = sim.apply("ring", curve=curve, landmarks=wanted[::20], landmarks_at=wanted[::20])
        ring = sim.snapshot()
        assert ring.ring_id.tolist() == [made] and ring.ring_kind[0] == mvs.RingKind.RIGID
        hashes.add(ring.hash)
        sim.undo()
    assert len(hashes) == 1
    # landmarks that do not move keep the curve in place, in any order; a rigid fit of coordinates
    # of 0.02 m rounds at 1e-17 m
    apart = np.linalg.norm(ring.ring_points[:, None] - wanted[None], axis=2)
    assert apart.min(axis=0).max() < 1e-12 and apart.min(axis=1).max() < 1e-12
    with mvs.Simulator() as other:
        other.set_valve(mvs.valve_of(ring))
        assert other.snapshot().hash == ring.hash


def test_a_closed_curve_may_repeat_its_first_point(sim):
    wanted = sim.snapshot().node_loaded[sim.snapshot().annulus_nodes] * 0.9
    rings = []
    for curve in (wanted, np.vstack([wanted, wanted[:1]])):
        sim.apply("ring", curve=curve)
        rings.append(sim.snapshot().ring_points)
        sim.undo()
    assert np.array_equal(*rings)
    with pytest.raises(mvs.ArgumentError, match="looks like mm given as m"):
        sim.apply("ring", curve=wanted * 1e3)


def test_points_are_copied_unchanged():
    field = mvs.ops.OpField.described_by(
        "any",
        dict(name="outline", type=10, offset=0, required=False, low=3, high=9, unit="m", help="",
             choices=""),
    )
    given = np.arange(12, dtype=np.float32).reshape(4, 3)
    read = field.read(given)
    assert read.dtype == np.float64 and np.array_equal(read, given)
    given[0] = 7
    assert read[0, 0] == 0 and not read.flags.writeable
    assert np.array_equal(field.read([(0, 1, 2), (3, 4, 5)]), [[0, 1, 2], [3, 4, 5]])
    for wrong in (given[:, :2], given.ravel(), [["a", "b", "c"]], [[1j, 0, 0]], 3, [[1, 2], [3]]):
        with pytest.raises(mvs.ArgumentError, match=r"any: outline must be points.* in m"):
            field.read(wrong)
