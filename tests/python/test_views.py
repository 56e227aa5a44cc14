"""Arrays of a snapshot are views of the library's memory: read-only, and never dangling."""

import gc
import re

import mvs
import numpy as np
import pytest

VIEWS = [
    name
    for name, value in vars(mvs.Snapshot).items()
    if isinstance(value, property) and (value.__doc__ or "").startswith("(")
]


def test_there_is_a_view_for_each_array_of_the_header(root_header):
    listed = re.search(r"enum \w+ \{\s*MVS_ARRAY_NODE_POSITION.*?\};", root_header, re.S).group()
    names = re.findall(r"^\s*MVS_ARRAY_([A-Z_]+) =", listed, re.M)
    assert sorted(name.lower() for name in names) == sorted(VIEWS)


@pytest.fixture(scope="module")
def root_header():
    from conftest import ROOT

    return (ROOT / "include" / "mvs" / "snapshot.h").read_text()


@pytest.mark.parametrize("name", VIEWS)
def test_a_view_has_the_documented_shape_and_type(closed, name):
    array = getattr(closed, name)
    shape, dtype = re.match(r"\(([^)]*)\) (\w+)", getattr(mvs.Snapshot, name).__doc__).groups()
    columns = [int(text) for text in re.findall(r"\d+", shape.split(",", 1)[1])]
    assert array.dtype == np.dtype(dtype)
    assert list(array.shape[1:]) == columns
    if shape[0].isdigit():
        assert len(array) == int(shape.split(",")[0])


@pytest.mark.parametrize("name", VIEWS)
def test_a_view_cannot_be_written(closed, name):
    array = getattr(closed, name)
    assert not array.flags.writeable
    if array.size:
        with pytest.raises(ValueError):
            array.setflags(write=True)
        with pytest.raises(ValueError):
            array[...] = 0


@pytest.mark.parametrize("name", VIEWS)
def test_a_view_is_the_same_memory_each_time(closed, name):
    first, second = getattr(closed, name), getattr(closed, name)
    if first.size:
        assert first.__array_interface__["data"] == second.__array_interface__["data"]
    assert first.base is closed or not first.size


def test_a_view_outlives_snapshot_and_simulator():
    sim = mvs.Simulator()
    sim.generate(shape="founding")
    positions = sim.snapshot().node_position
    before = positions.copy()
    sim.set_load(mvs.SYSTOLE_PA)
    sim.settle(max_iterations=3)
    sim.close()
    del sim
    gc.collect()
    # freed memory would be reused by the next valves
    others = []
    for _ in range(8):
        other = mvs.Simulator()
        other.generate(shape="founding")
        others.append(other.snapshot())
    assert np.array_equal(positions, before)


def test_a_snapshot_is_independent_of_later_calls(sim):
    snapshot = sim.snapshot()
    before, hash_before = snapshot.node_position.copy(), snapshot.hash
    sim.set_load(mvs.SYSTOLE_PA)
    sim.settle(max_iterations=5)
    assert np.array_equal(snapshot.node_position, before)
    assert snapshot.hash == hash_before != sim.snapshot().hash


def test_indices_point_into_their_arrays(closed):
    nodes = len(closed.node_position)
    for name in ("triangle_nodes", "annulus_nodes", "free_edge_nodes", "chord_nodes", "head_nodes"):
        assert getattr(closed, name).max() < nodes
    assert (closed.node_kind[closed.head_nodes] == mvs.NodeKind.HEAD).all()
    assert (closed.node_kind[closed.annulus_nodes] == mvs.NodeKind.ANNULUS).all()


def test_parts_name_the_rows_of_their_arrays(closed):
    by_kind = {kind: [p for p in closed.parts if p.kind == kind] for kind in mvs.PartKind}
    assert [p.name for p in by_kind[mvs.PartKind.LEAFLET]] == ["A", "P"]
    assert {p.name for p in by_kind[mvs.PartKind.SCALLOP]} >= {"A1", "A2", "A3", "P1", "P2", "P3"}
    chords = by_kind[mvs.PartKind.CHORD]
    assert [p.index for p in chords] == list(range(len(closed.chord_nodes)))
    assert [p.id for p in chords] == closed.chord_id.tolist()
    assert len({p.id for p in closed.parts}) == len(closed.parts)
    assert closed.find(mvs.PartKind.CHORD, chords[3].name) == chords[3]
