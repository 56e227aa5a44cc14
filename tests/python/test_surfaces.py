"""Surfaces and landmarks in files that other programs write: meshio, VTK, trimesh, 3D Slicer."""

import json
import re

import mvs
import numpy as np
import pytest

POINTS = np.array(
    [[-1.5, 0, 2], [10, 0.25, 2], [10, 12, -3.5], [-1.5, 12, 2.5], [20, 0.5, 2.75]], float
)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 2]], np.uint32)
LABELS = np.array([7.0, 1, 2, 3, 4])


def corners(points, triangles):
    """Corners in space: formats without indices number points anew."""
    return np.asarray(points)[np.asarray(triangles, int)]


@pytest.mark.parametrize("ending", ["stl", "ply", "off", "obj"])
@pytest.mark.parametrize("binary", [False, True])
def test_surfaces_written_by_meshio_are_read(tmp_path, ending, binary):
    meshio = pytest.importorskip("meshio")
    path = tmp_path / f"surface.{ending}"
    options = {"binary": binary} if ending in ("stl", "ply") else {}
    meshio.Mesh(POINTS, [("triangle", TRIANGLES.astype(int))]).write(path, **options)
    surface = mvs.read_surface(path)
    tolerance = 1e-9 if ending != "stl" else 2e-9  # m; STL holds floats: 2e-8 of some 20 mm
    assert corners(surface.points, surface.triangles) == pytest.approx(
        corners(POINTS, TRIANGLES) / 1000, abs=tolerance
    )
    assert surface.unit == "mm" and surface.frame is None


@pytest.mark.parametrize("ending", ["stl", "ply", "vtk", "vtp", "obj"])
@pytest.mark.parametrize("binary", [False, True])
def test_surfaces_written_by_vtk_are_read(tmp_path, ending, binary):
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.PolyData.from_regular_faces(POINTS, TRIANGLES.astype(int))
    mesh.point_data["label"] = LABELS
    mesh.cell_data["leaflet"] = np.array([1, 2, 2], np.uint8)
    path = tmp_path / f"surface.{ending}"
    if ending == "vtp":
        mesh.save(path, binary=binary, compression=None)
    elif ending == "obj":
        mesh.save(path)
    else:
        mesh.save(path, binary=binary)
    surface = mvs.read_surface(path)
    assert corners(surface.points, surface.triangles) == pytest.approx(
        corners(POINTS, TRIANGLES) / 1000, abs=1e-9
    )
    if ending in ("vtk", "vtp"):
        assert np.array_equal(surface.points, POINTS / 1000)
        assert np.array_equal(surface.triangles, TRIANGLES)
        assert np.array_equal(surface.point_arrays["label"], LABELS)
        assert np.array_equal(surface.triangle_arrays["leaflet"], [1, 2, 2])


@pytest.mark.parametrize("appended", ["raw", "base64"])
@pytest.mark.parametrize("header", [32, 64])
@pytest.mark.parametrize("compressor", ["None", "ZLib"])
def test_appended_vtp_arrays_are_read(tmp_path, appended, header, compressor):
    pyvista = pytest.importorskip("pyvista")
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    mesh = pyvista.PolyData.from_regular_faces(POINTS, TRIANGLES.astype(int))
    mesh.point_data["label"] = LABELS
    mesh.field_data["SPACE"] = ["RAS"]
    path = tmp_path / "surface.vtp"
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(mesh)
    writer.SetDataModeToAppended()
    writer.SetEncodeAppendedData(appended == "base64")
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    writer.SetBlockSize(64)  # bytes: several blocks, the last one a part
    writer.SetHeaderType(header)
    assert writer.Write() == 1
    surface = mvs.read_surface(path, frame="LPS")
    assert np.array_equal(surface.points, POINTS / 1000 * [-1, -1, 1])
    assert np.array_equal(surface.point_arrays["label"], LABELS)
    assert (surface.frame, surface.file_frame) == ("LPS", "RAS")


def test_strips_of_vtk_are_read(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    sphere = pyvista.Sphere(theta_resolution=12, phi_resolution=9)
    path = tmp_path / "strips.vtk"
    strips = sphere.strip()
    strips.save(path)
    surface = mvs.read_surface(path, unit="m")
    assert len(surface.triangles) == sphere.n_cells
    a, b, c = (surface.points[surface.triangles[:, k]] for k in range(3))
    # the orientation is kept: all normals point outwards
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) > 0).all()


@pytest.mark.parametrize("binary", [False, True])
def test_vtp_files_as_vtk_writes_them_by_default_are_read(tmp_path, binary):
    pyvista = pytest.importorskip("pyvista")
    sphere = pyvista.Sphere(theta_resolution=90, phi_resolution=90)
    path = tmp_path / "surface.vtp"
    sphere.save(path, binary=binary)
    surface = mvs.read_surface(path, unit="m")
    # single precision, in text with the digits that VTK writes
    assert surface.points == pytest.approx(np.asarray(sphere.points, dtype=float), abs=1e-6)
    assert np.array_equal(surface.triangles, sphere.regular_faces)


def test_other_compressors_are_refused_with_the_remedy(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    path = tmp_path / "surface.vtp"
    pyvista.Sphere().save(path, compression="lzma")
    with pytest.raises(mvs.UnsupportedError, match="without compression"):
        mvs.read_surface(path)


def test_our_own_files_are_read_as_surfaces(closed, tmp_path):
    for name in ("closed.vtp", "closed.obj"):
        closed.save(tmp_path / name)
        surface = mvs.read_surface(tmp_path / name, unit=None)
        assert (surface.unit, surface.frame) == ("mm", "LPS")
        assert np.array_equal(surface.triangles, closed.triangle_nodes)
        # x * 1000 / 1000 rounds twice
        assert surface.points == pytest.approx(closed.node_position, rel=4e-16, abs=1e-18)


def markups(tmp_path, **changes):
    markup = {
        "type": "Fiducial",
        "coordinateSystem": "LPS",
        "coordinateUnits": "mm",
        "controlPoints": [
            {"id": "1", "label": "AL", "position": [1.5, -2, 3], "positionStatus": "defined"},
            {"id": "2", "label": "", "position": [0, 0, 0], "positionStatus": "preview"},
            {"id": "3", "label": "Ä", "position": [4, 5, 6.25], "positionStatus": "defined"},
        ],
    }
    path = tmp_path / "points.mrk.json"
    path.write_text(json.dumps({"markups": [{**markup, **changes}]}), encoding="utf-8")
    return path


def test_markups_of_slicer_are_read(tmp_path):
    landmarks = mvs.read_landmarks(markups(tmp_path))
    assert landmarks.names == ("AL", "Ä") and len(landmarks) == 2
    assert np.array_equal(landmarks["AL"], np.array([1.5, -2, 3]) / 1000)
    assert (landmarks.frame, landmarks.unit, landmarks.format) == ("LPS", "mm", "markups")
    ras = mvs.read_landmarks(markups(tmp_path), unit=None, frame="RAS")
    assert np.array_equal(ras.points, landmarks.points * [-1, -1, 1])
    with pytest.raises(KeyError, match="PM"):
        landmarks["PM"]
    with pytest.raises(mvs.ArgumentError, match="states that its lengths are in mm"):
        mvs.read_landmarks(markups(tmp_path), unit="m")
    assert "unknown frame" in repr(mvs.read_landmarks(markups(tmp_path, coordinateSystem="")))


def test_a_curve_of_vtk_is_read_in_its_order(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn), 0.1 * np.cos(2 * turn)])
    shuffled = np.random.default_rng(1).permutation(len(ring))
    place = np.argsort(shuffled)
    curve = pyvista.PolyData(ring[shuffled])
    lines = [[2, place[k], place[(k + 1) % len(ring)]] for k in range(len(ring))]
    curve.lines = np.random.default_rng(2).permutation(lines).ravel()
    path = tmp_path / "annulus.vtp"
    curve.save(path, compression=None)
    points = mvs.read_landmarks(path, unit="m").points
    steps = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1)
    # neighbours on the ring are 0.157 m apart in its plane, the next ones twice that
    assert steps.max() < 0.25 and len(points) == len(ring)


def test_surfaces_and_landmarks_are_not_mistaken_for_one_another(tmp_path):
    with pytest.raises(mvs.ArgumentError, match="read_landmarks"):
        mvs.read_surface(markups(tmp_path))
    path = tmp_path / "a.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(mvs.ArgumentError, match="read_surface"):
        mvs.read_landmarks(path)
    for arguments, word in (({"unit": "inch"}, "unit"), ({"frame": "las"}, "frame")):
        with pytest.raises(mvs.ArgumentError, match=f"^{word}: "):
            mvs.read_surface(path, **arguments)
    with pytest.raises(mvs.ArgumentError, match="does not state its unit"):
        mvs.read_surface(path, unit=None)


def test_arrays_outlive_the_file_and_are_read_only(tmp_path):
    path = tmp_path / "a.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    points = mvs.read_surface(path).points
    assert points[1, 0] == 0.001 and not points.flags.writeable


def test_errors_name_path_and_line(tmp_path):
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 0 nan 0\n")
    with pytest.raises(mvs.FormatError, match=r"a\.obj:2: ") as caught:
        mvs.read_surface(path)
    assert caught.value.line == 2


def test_every_array_is_documented_with_shape_and_type():
    for kind, fields in ((mvs.Surface, ("points", "triangles")), (mvs.Landmarks, ("points",))):
        for field in fields:
            assert re.search(rf"^{field}: \([nmk], 3\) (float64, m|uint32)", kind.__doc__, re.M)


def test_real_surfaces_are_read(real_valves):
    folder = real_valves / "real_mitral"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    surface = mvs.read_surface(folder / "open_1146.stl")
    assert len(surface.triangles) == 2146
    size = np.ptp(surface.points, axis=0)
    assert (size > 0.01).all() and (size < 0.06).all()  # a valve, in m
    closed = mvs.read_surface(folder / "closed_anterior_medial.vtk")
    assert closed.point_arrays["Radius"].shape == (498,)
    trimesh = pytest.importorskip("trimesh")
    other = trimesh.load(folder / "open_1146.stl", process=False)
    assert np.array_equal(
        corners(surface.points, surface.triangles), np.asarray(other.triangles) / 1000
    )
