// The same surface from every format; variants of each.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "formats/formats.h"
#include "formats/surface/vtp_blocks.h"
#include "tests/formats/surface/surface_samples.h"

using namespace mvs::core;

namespace {

const SurfaceArray *array_named(const SurfaceFile &file, const std::string &name) {
  for (const SurfaceArray &array : file.arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

// The corners of a triangle in space: numberings differ between formats.
std::vector<std::vector<double>> corners_in_space(const SurfaceFile &file) {
  std::vector<std::vector<double>> all;
  for (const Tri &triangle : file.triangles) {
    std::vector<double> corners;
    for (const uint32_t corner : triangle) {
      for (int c = 0; c < 3; ++c) corners.push_back(file.points[corner][c]);
    }
    all.push_back(corners);
  }
  return all;
}

}  // namespace

TEST_CASE("every_format_gives_the_same_surface") {
  std::vector<std::vector<double>> expected;
  for (const Tri &triangle : sample_triangles) {
    std::vector<double> corners;
    for (const uint32_t corner : triangle) {
      for (int c = 0; c < 3; ++c) corners.push_back(sample_points[corner][c] / 1000);
    }
    expected.push_back(corners);
  }
  for (const SurfaceSample &sample : surface_samples()) {
    CAPTURE(sample.name);
    const SurfaceFile file = read_sample(sample);
    CHECK(file.points.size() == sample_points.size());
    CHECK(corners_in_space(file) == expected);
    CHECK(file.unit == LengthUnit::mm);
    CHECK(file.point_names.empty());
  }
}

TEST_CASE("points_keep_their_order_where_the_file_has_one") {
  for (const SurfaceSample &sample : surface_samples()) {
    if (sample.name.ends_with(".stl")) continue;
    const SurfaceFile file = read_sample(sample);
    CHECK(file.triangles == sample_triangles);
    for (size_t k = 0; k < sample_points.size(); ++k) {
      CHECK(file.points[k] == sample_points[k] / 1000);
    }
  }
}

TEST_CASE("arrays_are_kept_by_name_and_spread_over_the_triangles_of_a_polygon") {
  const std::vector<double> labels = {7, 1, 2, 3, 4, 5};
  for (const SurfaceSample &sample : surface_samples()) {
    CAPTURE(sample.name);
    const SurfaceFile file = read_sample(sample);
    const bool has_label = sample.name.ends_with("ply") || sample.name.ends_with("vtk") ||
                           sample.name.ends_with("vtp");
    const SurfaceArray *label = array_named(file, "label");
    REQUIRE((label != nullptr) == has_label);
    if (!label) continue;
    CHECK(label->on_points);
    CHECK(label->values == labels);
    const SurfaceArray *area = array_named(file, "area of");
    CHECK((area != nullptr) == sample.name.ends_with("vtk"));
    if (area) CHECK(area->values == std::vector<double>{0.5, 1.5, 2.5, 2.5});
    const SurfaceArray *more = array_named(file, "area & more");
    CHECK((more != nullptr) == sample.name.ends_with("vtp"));
    if (more) CHECK(more->values == std::vector<double>{1, 2, 3, 3});
  }
}

TEST_CASE("units_divide_the_coordinates") {
  const SurfaceSample sample = off_sample();
  CHECK(read_sample(sample, LengthUnit::m).points[1][0] == 10);
  CHECK(read_sample(sample, LengthUnit::cm).points[1][0] == 0.1);
  CHECK(read_sample(sample, LengthUnit::mm).points[1][0] == 0.01);
  const Error error = refusal(sample, LengthUnit::unknown);
  CHECK(error.code == MVS_E_ARGUMENT);
  CHECK(error.part == "options.unit");
}

TEST_CASE("a_unit_that_the_file_states_is_used_and_may_not_be_contradicted") {
  const SurfaceSample sample = {"a.obj", "#mvs 1 units=mm\nv 1 2 3\n"};
  CHECK(read_sample(sample, LengthUnit::unknown).points[0][1] == 0.002);
  CHECK(read_sample(sample, LengthUnit::mm).unit == LengthUnit::mm);
  CHECK(refusal(sample, LengthUnit::cm).code == MVS_E_ARGUMENT);
}

TEST_CASE("a_stated_frame_is_found_and_converted_when_asked_for") {
  for (const SurfaceSample &sample : surface_samples()) {
    CAPTURE(sample.name);
    const SurfaceFile as_is = read_sample(sample);
    const bool is_ras = sample.name.ends_with(".obj") || sample.name.ends_with(".vtk");
    const bool is_lps = sample.name.ends_with(".ply") || sample.name.ends_with(".vtp");
    const PatientFrame stated = is_ras   ? PatientFrame::ras
                                : is_lps ? PatientFrame::lps
                                         : PatientFrame::unknown;
    CHECK(as_is.file_frame == stated);
    CHECK(as_is.frame == stated);
    const SurfaceFile lps = read_sample(sample, LengthUnit::mm, PatientFrame::lps);
    CHECK(lps.file_frame == stated);
    CHECK(lps.frame == (stated == PatientFrame::unknown ? stated : PatientFrame::lps));
    for (size_t k = 0; k < as_is.points.size(); ++k) {
      const double sign = is_ras ? -1 : 1;
      CHECK(lps.points[k][0] == sign * as_is.points[k][0]);
      CHECK(lps.points[k][1] == sign * as_is.points[k][1]);
      CHECK(lps.points[k][2] == as_is.points[k][2]);
      CHECK(!(lps.points[k][1] == 0 && std::signbit(lps.points[k][1])));
    }
  }
}

TEST_CASE("headers_of_stl_files_state_frames") {
  const auto frame = [](bool is_binary, const std::string &title) {
    return read_sample(stl_sample(is_binary, title)).frame;
  };
  for (const bool is_binary : {false, true}) {
    CHECK(frame(is_binary, "3D Slicer output. SPACE=LPS") == PatientFrame::lps);
    CHECK(frame(is_binary, "solid x; Coordinates..: RAS") == PatientFrame::ras);
    CHECK(frame(is_binary, "coordinate system: lps") == PatientFrame::lps);
    CHECK(frame(is_binary, "lps") == PatientFrame::unknown);
    CHECK(frame(is_binary, "SPACE=LPSX") == PatientFrame::unknown);
    CHECK(frame(is_binary, "SPACE=LPS SPACE=RAS") == PatientFrame::unknown);
  }
}

TEST_CASE("strips_of_vtk_are_triangles_of_one_orientation") {
  const SurfaceSample sample = {"a.vtk",
                                "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"
                                "POINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\n"
                                "TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
                                "VERTICES 1 2\n1 0\nCELL_DATA 2\nSCALARS s int\n"
                                "LOOKUP_TABLE default\n8 9\n"};
  const SurfaceFile file = read_sample(sample);
  CHECK(file.triangles == std::vector<Tri>{{0, 1, 2}, {2, 1, 3}});
  // the points of a file come first in its cell data
  CHECK(array_named(file, "s")->values == std::vector<double>{9, 9});
}

TEST_CASE("colours_of_vtk_are_bytes_in_ascii_files_as_well") {
  const std::string text = vtk_sample(false, false).bytes;
  const std::string labels = "SCALARS area%20of float 1\nLOOKUP_TABLE default\n";
  const SurfaceFile file =
      read_sample({"a.vtk", replaced(replaced(text, labels, "COLOR_SCALARS bytes 1\n"),
                                     "0.5 1.5 2.5", "0.0039215 1 0.00784")});
  CHECK(array_named(file, "bytes")->values == std::vector<double>{1, 255, 2, 2});
}

TEST_CASE("pieces_of_a_vtp_file_are_joined") {
  std::string text = vtp_sample("ascii").bytes;
  const size_t begin = text.find("<Piece"), end = text.find("</Piece>") + 9;
  text.insert(end, text.substr(begin, end - begin));
  const SurfaceFile file = read_sample({"two.vtp", text});
  CHECK(file.points.size() == 12);
  CHECK(file.triangles.size() == 8);
  CHECK(file.triangles[4] == Tri{6, 7, 8});
  CHECK(array_named(file, "area & more")->values == std::vector<double>{1, 2, 3, 3, 1, 2, 3, 3});
}

TEST_CASE("variants_that_are_not_read_are_refused_with_the_remedy") {
  const std::string vtp = vtp_sample("ascii").bytes;
  const auto sentence = [](const std::string &name, const std::string &bytes) {
    return std::string(refusal({name, bytes}).what());
  };
  const std::string compressed =
      sentence("a.vtp", replaced(vtp, "header_type", "compressor=\"vtkLZMADataCompressor\" h"));
  CHECK(compressed.find("without compression") != std::string::npos);
  CHECK(sentence("a.vtp", replaced(vtp, "\"PolyData\"", "\"UnstructuredGrid\"")).find("PolyData") !=
        std::string::npos);
  CHECK(sentence("a.vtk", replaced(vtk_sample(false, false).bytes, "POLYDATA", "UNSTRUCTURED_GRID"))
            .find("PolyData") != std::string::npos);
  CHECK(sentence("a.step", "").find(".stl") != std::string::npos);
  CHECK(sentence("a.STL", "").find("the file is empty") != std::string::npos);
  CHECK(sentence("a.STL", "x").find("cut short") != std::string::npos);
}

TEST_CASE("damaged_compressed_arrays_are_refused") {
  if (!has_zlib()) {
    MESSAGE("built without zlib");
    return;
  }
  const SurfaceSample whole = vtp_sample("raw", true);
  const size_t stream = whole.bytes.find("\x78\x01\x01");
  REQUIRE(stream != std::string::npos);
  SurfaceSample changed = whole;
  changed.bytes[stream + 8] ^= 1;  // the checksum of zlib finds one bit
  CHECK(std::string(refusal(changed).what()).find("damaged") != std::string::npos);
  changed = whole;
  // the size of whole blocks, the second word of the header: more than the streams can hold
  changed.bytes[whole.bytes.find("   _") + 4 + 6] = '\x7f';
  CHECK(refusal(changed).code == MVS_E_FORMAT);
}

TEST_CASE("numbers_that_are_not_finite_are_refused_with_line_or_point") {
  for (const SurfaceSample &sample : surface_samples()) {
    CAPTURE(sample.name);
    const size_t at = sample.bytes.find("12 2.5");
    const bool is_text = at != std::string::npos;
    if (!is_text) continue;
    for (const char *word : {"nan", "inf", "1e999"}) {
      const Error error = refusal({sample.name, std::string(sample.bytes).replace(at, 2, word)});
      CHECK(error.code == MVS_E_FORMAT);
      CHECK((error.line > 0 || error.part == "point 3"));
    }
  }
  SurfaceSample binary = stl_sample(true, "t");
  const std::string nan = number_bytes(std::nanf(""));
  binary.bytes.replace(84 + 12, 4, nan);
  CHECK(refusal(binary).part == "point 0");
}

TEST_CASE("indices_and_counts_beyond_the_file_are_refused") {
  const auto code = [](const std::string &name, const std::string &bytes) {
    return refusal({name, bytes}).code;
  };
  CHECK(code("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n") == MVS_E_FORMAT);
  CHECK(code("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n") == MVS_E_FORMAT);
  CHECK(code("a.obj", "v 0 0 0\nf 1 1\n") == MVS_E_FORMAT);
  CHECK(code("a.off", "OFF\n4000000000 1 0\n0 0 0\n") == MVS_E_FORMAT);
  CHECK(code("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 18446744073709551615\n") ==
        MVS_E_FORMAT);
  std::string stl = stl_sample(true, "t").bytes;
  stl.replace(80, 4, number_bytes(uint32_t{4000000000}));
  CHECK(code("a.stl", stl) == MVS_E_FORMAT);
  const std::string ply = ply_sample("binary_little_endian").bytes;
  CHECK(code("a.ply", replaced(ply, "vertex 6", "vertex 6000000000")) == MVS_E_FORMAT);
  const std::string vtk = vtk_sample(true, true).bytes;
  CHECK(code("a.vtk", replaced(vtk, "POINTS 6", "POINTS 6000000000000000000")) == MVS_E_FORMAT);
  const std::string vtp = vtp_sample("raw").bytes;
  CHECK(code("a.vtp", replaced(vtp, "NumberOfPoints=\"6\"", "NumberOfPoints=\"600\"")) ==
        MVS_E_FORMAT);
}

TEST_CASE("appended_arrays_may_not_overlap") {
  // each byte is used once, so that the arrays together have no more bytes than the file: here 200
  // times the 144 bytes of the points, each stated in 73 bytes
  std::string vtp = vtp_sample("raw").bytes, arrays;
  const size_t at = vtp.find("offset=", vtp.find("Name=\"Points\""));
  const std::string offset = vtp.substr(at, vtp.find('"', at + 8) + 1 - at);
  for (int k = 0; k < 200; ++k) {
    arrays += "<DataArray type=\"Float64\" Name=\"again\" format=\"appended\" " + offset + "/>";
  }
  vtp = replaced(vtp, "<PointData Scalars=\"label\">", "<PointData>" + arrays);
  CHECK(refusal({"a.vtp", vtp}).code == MVS_E_FORMAT);
}

TEST_CASE("files_that_would_take_far_more_memory_than_their_bytes_are_refused") {
  // a polygon of 300,000 corners whose row has 1,000 numbers: 2.4 GB as rows of triangles
  std::string vtk =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
      "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 300001\n300000";
  for (int k = 0; k < 300000; ++k) vtk += k % 2 == 0 ? " 0" : " 1";
  vtk += "\nCELL_DATA 1\nFIELD f 1\na 1000 1 float\n";
  for (int k = 0; k < 1000; ++k) vtk += "0 ";
  CHECK(refusal({"a.vtk", vtk}).code == MVS_E_MEMORY);
  CHECK(refusal({"a.csv", std::string(size_t{17} << 20, ',')}).code == MVS_E_MEMORY);
}

TEST_CASE("real_surfaces_are_read") {
  const char *data = std::getenv("MVS_TEST_DATA");
  const std::string folder =
      (data ? std::string(data) : MVS_SOURCE_DIR "/../shared/data") + "/real_mitral/";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("no real surfaces in ", folder);
    return;
  }
  const auto read = [&](const std::string &name) {
    return read_sample({name, read_whole_file(folder + name)});
  };
  const SurfaceFile open = read("open_1146.stl");
  CHECK(open.triangles.size() == 2146);
  CHECK(open.frame == PatientFrame::unknown);
  // the mesh was reduced to this number of points
  CHECK(open.points.size() == 1146);
  const SurfaceFile closed = read("closed_anterior_medial.vtk");
  CHECK(closed.points.size() == 498);
  CHECK(closed.triangles.size() == 933);
  CHECK(array_named(closed, "Radius")->values.size() == 498);
  CHECK(array_named(closed, "tcoords")->components == 2);
}
