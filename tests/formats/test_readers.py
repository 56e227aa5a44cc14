"""Other programs' readers find the same valve in our files as the lines themselves say."""

from pathlib import Path

import h5py
import meshio
import numpy as np
import pytest
import pyvista
import trimesh
import vtk

DATA = Path(__file__).parent / "data"
OBJ = DATA / "valve.obj"
VTP = DATA / "valve.vtp"
SESSION = DATA / "session.h5"
PRESENT = DATA / "session_present.obj"

# Coordinates go through a decimal text or a product by 1000: a few units in the last place.
CLOSE = {"rtol": 1e-15, "atol": 0}


def rows(statement, kind, path=OBJ):
    """The numbers of all lines of an OBJ file that start with a statement."""
    lines = (line.split() for line in path.read_text(encoding="ascii").splitlines())
    return np.array([[kind(word) for word in line[1:]] for line in lines if line[:1] == [statement]])


@pytest.fixture(scope="module", name="points")
def fixture_points():
    return rows("v", float)


@pytest.fixture(scope="module", name="faces")
def fixture_faces():
    return rows("f", int) - 1


@pytest.fixture(scope="module", name="chords")
def fixture_chords():
    return rows("l", int) - 1


def test_the_file_has_something_to_compare(points, faces, chords):
    assert points.shape == (68, 3)
    assert faces.shape == (96, 3)
    assert chords.shape == (12, 2)


def test_meshio_reads_nodes_and_faces_of_the_obj(points, faces):
    mesh = meshio.read(OBJ)
    np.testing.assert_allclose(mesh.points, points, **CLOSE)
    triangles = [block.data for block in mesh.cells if block.type == "triangle"]
    np.testing.assert_array_equal(np.concatenate(triangles), faces)


def test_trimesh_reads_faces_of_the_obj(points, faces):
    mesh = trimesh.load(OBJ, process=False, force="mesh")
    # nodes that no face uses (branch points, heads) may be gone, and groups may come in any order:
    # compare the triangles by their corners, turned so that the smallest corner is first
    found = np.asarray(mesh.triangles)
    wanted = points[faces]
    assert found.shape == wanted.shape
    np.testing.assert_allclose(sorted_triangles(found), sorted_triangles(wanted), **CLOSE)


def sorted_triangles(triangles):
    turned = []
    for triangle in triangles.tolist():
        first = triangle.index(min(triangle))
        turned.append(triangle[first:] + triangle[:first])
    return np.array(sorted(turned))


# VTK's own array GroupIds has a row for polygons only, which pyvista remarks on
@pytest.mark.filterwarnings("ignore:PolyData mesh is not valid")
def test_vtk_reads_nodes_faces_and_chordae_of_the_obj(points, faces, chords):
    reader = vtk.vtkOBJReader()
    reader.SetFileName(str(OBJ))
    reader.Update()
    mesh = pyvista.wrap(reader.GetOutput())
    # VTK's OBJ reader has points in single precision
    np.testing.assert_allclose(mesh.points, points, rtol=1e-7, atol=1e-30)
    np.testing.assert_array_equal(mesh.faces.reshape(-1, 4)[:, 1:], faces)
    np.testing.assert_array_equal(mesh.lines.reshape(-1, 3)[:, 1:], chords)
    # where 3D Slicer looks for the coordinate system
    assert "SPACE=LPS" in reader.GetComment()


def test_vtk_reads_the_vtp(points, faces, chords):
    mesh = pyvista.read(VTP)
    assert mesh.points.dtype == np.float64
    np.testing.assert_allclose(mesh.points, points, **CLOSE)
    np.testing.assert_array_equal(mesh.faces.reshape(-1, 4)[:, 1:], faces)
    np.testing.assert_array_equal(mesh.lines.reshape(-1, 3)[:, 1:], chords)
    assert list(mesh.field_data["SPACE"]) == ["LPS"]
    assert list(mesh.field_data["UNITS"]) == ["mm"]
    assert list(mesh.field_data["leaflet_names"]) == ["A", "P"]
    assert list(mesh.field_data["scallop_names"]) == ["A2", "P1", "P3"]
    assert len(mesh.field_data["chord_names"]) == len(chords)
    assert mesh.field_data["TimeValue"][0] == 0.125
    assert mesh.field_data["pressure_Pa"][0] == 15998.64


def test_the_arrays_of_the_vtp_belong_to_their_cells(faces, chords):
    mesh = pyvista.read(VTP)
    is_chord = np.arange(mesh.n_cells) < len(chords)
    assert mesh.n_cells == len(chords) + len(faces)
    cells = mesh.cell_data
    np.testing.assert_array_equal(cells["leaflet"] < 0, is_chord)
    np.testing.assert_array_equal(cells["scallop"] < 0, is_chord)
    np.testing.assert_array_equal(cells["chord_kind"] >= 0, is_chord)
    np.testing.assert_array_equal(cells["rest_length_mm"] == 0, ~is_chord)
    np.testing.assert_array_equal(cells["thickness_mm"] == 0, is_chord)
    # half of the triangles are of leaflet A, whose id is 1000 in the file
    assert np.sum(cells["id"] == 1000) == len(faces) / 2
    kinds = mesh.point_data["node_kind"]
    assert [int(np.sum(kinds == kind)) for kind in range(4)] == [48, 16, 2, 2]


def test_the_rest_lengths_of_the_vtp_are_those_at_rest(chords):
    mesh = pyvista.read(VTP)
    ends = mesh.point_data["rest_mm"][chords]
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    # the file's chordae have the lengths of its rest shape; sums of squares round a little
    np.testing.assert_allclose(mesh.cell_data["rest_length_mm"][: len(chords)], lengths, rtol=1e-14)


@pytest.fixture(scope="module", name="session")
def fixture_session():
    reader = vtk.vtkHDFReader()
    assert reader.CanReadFile(str(SESSION))
    reader.SetFileName(str(SESSION))
    reader.Update()
    return pyvista.wrap(reader.GetOutput())


def test_vtk_reads_the_present_of_a_session(session):
    faces, chords = rows("f", int, PRESENT) - 1, rows("l", int, PRESENT) - 1
    assert session.points.dtype == np.float64
    np.testing.assert_allclose(session.points, rows("v", float, PRESENT), **CLOSE)
    np.testing.assert_array_equal(session.faces.reshape(-1, 4)[:, 1:], faces)
    np.testing.assert_array_equal(session.lines.reshape(-1, 3)[:, 1:], chords)


def test_vtk_finds_the_arrays_of_the_vtp_in_a_session(session):
    vtp = pyvista.read(VTP)
    for data in ("point_data", "cell_data", "field_data"):
        found, wanted = getattr(session, data), getattr(vtp, data)
        assert set(found.keys()) == set(wanted.keys())
        for name in wanted.keys():
            assert found[name].dtype.kind == wanted[name].dtype.kind, name
    is_chord = np.arange(session.n_cells) < session.n_lines
    np.testing.assert_array_equal(session.cell_data["leaflet"] < 0, is_chord)
    np.testing.assert_array_equal(session.cell_data["rest_length_mm"] == 0, ~is_chord)
    assert list(session.field_data["SPACE"]) == ["LPS"]
    assert list(session.field_data["scallop_names"]) == ["A2", "P1", "P3"]
    assert len(session.field_data["chord_names"]) == session.n_lines


def test_h5py_reads_the_pools_of_a_session():
    with h5py.File(SESSION) as file:
        assert file.userblock_size == 512
        kinds = set()
        file["mvs"].visititems(lambda _, item: kinds.add(type(item)))
        assert kinds == {h5py.Group, h5py.Dataset}
        texts = file["mvs/texts/values"][:].tobytes()
        ends = file["mvs/texts/ends"][:]
        words = [texts[a:b].decode() for a, b in zip([0, *ends[:-1]], ends)]
        assert {"short chord", "two at once", "annulus_scale"} <= set(words)
        for pool in ("numbers", "indices", "parts", "texts"):
            assert file["mvs"][pool]["ends"][-1] == len(file["mvs"][pool]["values"])
        # no filters, no chunks
        assert file["mvs/numbers/values"].chunks is None
