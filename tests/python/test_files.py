"""Files: saving and loading keep every bit."""

from pathlib import Path
from xml.etree import ElementTree

import mvs
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
TOY = ROOT / "tests" / "formats" / "data" / "three_leaflets.inp"


def test_a_saved_state_loads_with_the_same_hash(closed, tmp_path):
    path = tmp_path / "closed.obj"
    closed.save(path)
    with mvs.Simulator() as sim:
        sim.load(str(path))
        assert sim.snapshot().hash == closed.hash


def test_bytes_equal_the_file(closed, tmp_path):
    path = tmp_path / "closed.obj"
    closed.save(path)
    data = closed.to_bytes()
    assert path.read_bytes() == data
    with mvs.Simulator() as sim:
        sim.load_bytes(data)
        assert sim.snapshot().hash == closed.hash


def test_settling_a_loaded_valve_gives_the_same_bits(opened, tmp_path):
    path = tmp_path / "open.obj"
    opened.save(path)
    hashes = []
    for load in (lambda s: s.restore(opened), lambda s: s.load(path)):
        with mvs.Simulator() as sim:
            load(sim)
            sim.set_load(mvs.SYSTOLE_PA)
            sim.settle()
            hashes.append(sim.snapshot().hash)
    assert hashes[0] == hashes[1]


def test_an_hdf5_file_loads_with_the_same_hash(closed, tmp_path):
    if "hdf5" not in mvs.features:
        pytest.skip("built without HDF5")
    path = tmp_path / "closed.h5"
    closed.save(path)
    with mvs.Simulator() as sim:
        sim.load(path)
        assert sim.snapshot().hash == closed.hash
        sim.load_bytes(closed.to_bytes(format="h5"), format="h5")
        assert sim.snapshot().hash == closed.hash


def test_a_vtm_file_holds_the_orifice_and_the_coaptation_line(closed, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    path = tmp_path / 'a "b" & c.vtm'
    for snapshot, leaks in ((closed, False), (with_cut_chordae(closed), True)):
        snapshot.save(path)
        blocks = pyvista.read(path)
        names = ["valve", "orifice", "coaptation_line"] if leaks else ["valve", "coaptation_line"]
        assert blocks.keys() == names
        assert blocks["valve"].n_points == len(snapshot.node_position)
        measures = snapshot.measures
        if leaks:
            area = measures.regurgitant_orifice_area * 1e6
            assert blocks["orifice"].area == pytest.approx(area, rel=1e-9)
            assert blocks["orifice"].field_data["regurgitant_orifice_area_mm2"][0] == area
            part = blocks["orifice"].cell_data["orifice_part"]
            assert np.array_equal(part, snapshot.orifice_part)
            assert set(part) == set(range(len(snapshot.orifice_parts())))
        line = blocks["coaptation_line"]
        # the mean over stations at equal distances
        mean = line.point_data["coaptation_length_mm"].mean()
        assert mean == pytest.approx(measures.coaptation_length_mean * 1e3, rel=1e-9)
        steps = line.compute_cell_sizes(length=True).cell_data["Length"]
        assert len(steps) == line.n_points - 1
        assert np.ptp(steps) < 0.5 * steps.mean()  # a curve, no jumps
        lowest, highest = snapshot.node_position.min(axis=0) * 1e3, snapshot.node_position.max(axis=0) * 1e3
        assert ((line.points > lowest) & (line.points < highest)).all()


def with_cut_chordae(closed):
    """The closed valve after the chordae of P2 are cut."""
    with mvs.Simulator() as sim:
        sim.restore(closed)
        for row in closed.chords():
            if row["name"].startswith("P2/"):
                sim.apply("chord_remove", chord=row["name"])
        sim.settle()
        return sim.snapshot()


def test_a_vtp_file_holds_the_leaflets(closed, tmp_path):
    path = tmp_path / "closed.vtp"
    closed.save(path)
    import pyvista

    mesh = pyvista.read(path)
    faces = mesh.regular_faces if mesh.n_lines == 0 else None
    assert mesh.n_points == len(closed.node_position)
    assert mesh.n_cells >= len(closed.triangle_nodes)
    # VTK files are in mm (FORMAT.md), the library in m
    assert np.allclose(mesh.points, closed.node_position * 1e3, atol=1e-3)
    assert faces is None or np.array_equal(faces, closed.triangle_nodes)
    for values in (*mesh.point_data.values(), *mesh.cell_data.values()):
        assert np.all(np.isfinite(values))
    names = {*mesh.point_data, *mesh.cell_data}
    assert not [name for name in names if name.endswith("_m")]
    facing = np.isfinite(closed.node_coaptation)
    assert np.array_equal(mesh.point_data["faces_tissue"] == 1, facing)
    distance = mesh.point_data["coaptation_distance_mm"]
    assert np.allclose(distance[facing], 1e3 * closed.node_coaptation[facing])
    assert mesh.field_data["at_rest"][0] == 1


def test_abaqus_input_is_a_valve_with_its_load(tmp_path):
    messages = []
    with mvs.Simulator(log=lambda level, text: messages.append(text)) as sim:
        sim.load(TOY)
        valve = sim.snapshot()
        assert sim.load_case.pressure == pytest.approx(3000)
        assert len(valve.node_position) == 42
        names = [part.name for part in valve.parts if part.kind == mvs.PartKind.LEAFLET]
        assert names == ["Anterior", "Septal", "Posterior"]
        # ignored lines are reported with their numbers
        line = 1 + TOY.read_text(encoding="ascii").splitlines().index("*Friction")
        assert any(text.startswith(f"line {line}: ") for text in messages)
        sim.load_bytes(TOY.read_bytes(), format="inp")
        assert sim.snapshot().hash == valve.hash
        with pytest.raises(mvs.Error, match="read, not written"):
            valve.save(tmp_path / "toy.inp")
        with pytest.raises(mvs.Error, match=r"toy\.inp:2: .*`x`"):
            (tmp_path / "toy.inp").write_text("*NODE\nx, 1, 2, 3\n", encoding="ascii")
            sim.load(tmp_path / "toy.inp")
        assert sim.snapshot().hash == valve.hash


def rows_of(elements, kind):
    return np.array([[kind(word) for word in element.text.split(",")] for element in elements])


def test_a_febio_model_is_the_valve(tmp_path):
    with mvs.Simulator() as sim:
        sim.load(TOY)
        valve = sim.snapshot()
    valve.save(tmp_path / "toy.feb")
    root = ElementTree.parse(tmp_path / "toy.feb").getroot()
    assert (root.tag, root.get("version")) == ("febio_spec", "4.0")
    # the order of sections that FEBio requires
    assert [section.tag for section in root] == [
        "Module", "Control", "Material", "Mesh", "MeshDomains", "MeshData", "Boundary", "Loads",
        "Contact", "Discrete", "LoadData", "Output",
    ]  # fmt: skip
    nodes = rows_of(root.findall("Mesh/Nodes/node"), float)
    np.testing.assert_allclose(nodes, valve.node_rest * 1e3, rtol=1e-15, atol=1e-15)
    shells = rows_of(root.findall("Mesh/Elements/elem"), int)
    np.testing.assert_array_equal(shells - 1, valve.triangle_nodes)
    springs = rows_of(root.findall("Mesh/DiscreteSet/delem"), int)
    np.testing.assert_array_equal(springs - 1, valve.chord_nodes)
    # every referenced name is defined
    names = {(e.tag, e.get("name")) for e in root.iter() if e.get("name")}
    for load in root.findall("Loads/surface_load"):
        assert ("Surface", load.get("surface")) in names
    for domain in root.find("MeshDomains"):
        assert ("material", domain.get("mat")) in names
        assert ("Elements", domain.get("name")) in names
    for bc in root.find("Boundary"):
        assert ("NodeSet", bc.get("node_set")) in names
        assert ("NodeData", bc.find("value").text) in names
    for binding in root.findall("Discrete/discrete"):
        assert ("DiscreteSet", binding.get("discrete_set")) in names
    assert ("SurfacePair", root.find("Contact/contact").get("surface_pair")) in names
    assert root.findtext("Loads/surface_load/pressure") == "-3"


def test_a_spring_sheet_cannot_be_written_for_febio(opened, tmp_path):
    with pytest.raises(mvs.Error, match="net of springs"):
        opened.save(tmp_path / "springs.feb")
    assert not (tmp_path / "springs.feb").exists()
