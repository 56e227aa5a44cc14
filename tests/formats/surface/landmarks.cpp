// Landmarks and curves: names, frames, order.
#include "tests/formats/surface/surface_samples.h"

using namespace mvs::core;

TEST_CASE("landmarks_keep_their_names_and_their_frame") {
  for (const SurfaceSample &sample : landmark_samples()) {
    CAPTURE(sample.name);
    const SurfaceFile file = read_sample(sample);
    CHECK(file.triangles.empty());
    CHECK(file.point_names == std::vector<std::string>{"AL", "PM"});
    REQUIRE(file.points.size() == 2);
    CHECK(file.points[0] == Vec3(1.5, -2, 3) / 1000);
    CHECK(file.points[1] == Vec3(4, 5, 6.25) / 1000);
    CHECK(file.frame == PatientFrame::lps);
    const SurfaceFile ras = read_sample(sample, LengthUnit::mm, PatientFrame::ras);
    CHECK(ras.frame == PatientFrame::ras);
    CHECK(ras.points[0] == Vec3(-1.5, 2, 3) / 1000);
  }
}

TEST_CASE("a_byte_order_mark_before_an_obj_costs_no_point") {
  const std::string body = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 5 5 50\nf 1 2 3\n";
  const SurfaceFile plain = read_sample({"a.obj", body});
  const SurfaceFile marked = read_sample({"a.obj", "\xef\xbb\xbf" + body});
  REQUIRE(plain.points.size() == 4);
  CHECK(marked.points == plain.points);
  CHECK(marked.triangles == plain.triangles);
}

TEST_CASE("markups_state_their_unit") {
  SurfaceSample sample = markups_sample();
  CHECK(read_sample(sample, LengthUnit::unknown).unit == LengthUnit::mm);
  CHECK(refusal(sample, LengthUnit::m).part == "options.unit");
  const std::string unit = "\"coordinateUnits\": \"mm\"";
  const size_t at = sample.bytes.find(unit);
  const auto with = [&](const std::string &other) {
    return SurfaceSample{"a.mrk.json", std::string(sample.bytes).replace(at, unit.size(), other)};
  };
  const SurfaceSample coded = with("\"coordinateUnits\": [\"cm\", \"UCUM\", \"centimeter\"]");
  CHECK(read_sample(coded, LengthUnit::unknown).points[1][0] == 0.04);
  CHECK(refusal(with("\"coordinateUnits\": \"inch\"")).code == MVS_E_FORMAT);
  CHECK(refusal(with("\"other\": 1"), LengthUnit::unknown).part == "options.unit");
  CHECK(refusal(with("\"coordinateSystem\": \"IJK\"")).part == "coordinateSystem");
}

TEST_CASE("fcsv_files_state_their_frame_as_a_word_or_a_number") {
  const auto frame = [](const std::string &word) {
    SurfaceSample sample = fcsv_sample();
    const std::string key = "CoordinateSystem = LPS";
    sample.bytes.replace(sample.bytes.find(key), key.size(), "CoordinateSystem = " + word);
    return read_sample(sample).frame;
  };
  CHECK(frame("LPS") == PatientFrame::lps);
  CHECK(frame("RAS") == PatientFrame::ras);
  CHECK(frame("0") == PatientFrame::ras);
  CHECK(frame("1") == PatientFrame::lps);
  CHECK(frame("LAS") == PatientFrame::unknown);
  CHECK_THROWS_AS(frame("2"), Error);
}

TEST_CASE("descriptions_in_fcsv_files_may_hold_semicolons_and_tabs") {
  for (const char *text : {"by hand; again", "by hand\tagain", "by hand again"}) {
    CAPTURE(text);
    SurfaceSample sample = fcsv_sample();
    sample.bytes.replace(sample.bytes.find("AL"), 2, std::string("AL,") + text);
    CHECK(read_sample(sample).point_names == std::vector<std::string>{"AL", "PM"});
    CHECK(read_sample(sample).points == read_sample(fcsv_sample()).points);
  }
}

TEST_CASE("tables_have_columns_by_name_or_three_numbers") {
  const auto read = [](const std::string &text) { return read_sample({"a.csv", text}); };
  const Vec3 first = Vec3(1, 2, 3) / 1000;
  for (const char *text : {"x,y,z\n1,2,3\n4,5,6\n", "1,2,3\n4,5,6\n", "1;2;3\r\n4;5;6\r\n",
                           "1 2  3\n 4 5 6", "1\t2\t3\n", "name,x,y,z\nAL,1,2,3\n", "AL,1,2,3\n",
                           "1,2,3,AL\n", "# a comment\nz,y,x\n3,2,1\n",
                           "\xef\xbb\xbfX,Y,Z\n1,2,3\n", "\"x\",\"y\",\"z\"\n\"1\",2,3\n"}) {
    CAPTURE(text);
    CHECK(read(text).points[0] == first);
    CHECK(read(text).frame == PatientFrame::unknown);
  }
  CHECK(read("AL,1,2,3\n").point_names == std::vector<std::string>{"AL"});
  CHECK(read("\"a \"\"b\"\", c\",1,2,3\n").point_names[0] == "a \"b\", c");
  CHECK(read("label,r,a,s\nAL,1,2,3\n").frame == PatientFrame::ras);
  CHECK(read("# SPACE=LPS\n1,2,3\n").frame == PatientFrame::lps);
  CHECK(read("M\xfcller,1,2,3\n").point_names[0] == "M?ller");
  CHECK(read("M\xc3\xbcller,1,2,3\n").point_names[0] == "M\xc3\xbcller");
}

TEST_CASE("tables_that_could_be_misread_are_refused_with_the_line") {
  const auto error = [](const std::string &text) { return refusal({"a.csv", text}); };
  CHECK(error("1,2,3,4\n").line == 1);
  CHECK(error("x,y,z\n1,2,3\n4,5\n").line == 3);
  CHECK(error("x,y,z\n1,nan,3\n").line == 2);
  CHECK(std::string(error("x;y;z\n1,5;2;3\n").what()).find("decimal mark") != std::string::npos);
  CHECK(error("").code == MVS_E_FORMAT);
  CHECK(error("# nothing\n").code == MVS_E_FORMAT);
}

TEST_CASE("points_of_a_curve_are_in_its_order") {
  const auto order = [](const std::string &lines) {
    const SurfaceSample sample = {"a.vtk",
                                  "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"
                                  "POINTS 5 float\n0 0 0 1 0 0 2 0 0 3 0 0 4 0 0\n" +
                                      lines};
    std::vector<int> points;
    for (const Vec3 &point : read_sample(sample, LengthUnit::m).points) {
      points.push_back(static_cast<int>(point[0]));
    }
    return points;
  };
  CHECK(order("LINES 1 6\n5 4 2 0 1 3\n") == std::vector<int>{4, 2, 0, 1, 3});
  // segments in any order and direction, as boundary edges are extracted
  CHECK(order("LINES 4 12\n2 2 0\n2 1 3\n2 0 1\n2 4 2\n") == std::vector<int>{3, 1, 0, 2, 4});
  CHECK(order("LINES 5 15\n2 2 0\n2 1 3\n2 0 1\n2 4 2\n2 3 4\n") ==
        std::vector<int>{2, 0, 1, 3, 4});
  // a branch has no order: that of the file
  CHECK(order("LINES 3 9\n2 0 3\n2 0 2\n2 0 1\n") == std::vector<int>{0, 3, 2, 1, 4});
  CHECK(order("VERTICES 5 10\n1 4\n1 3\n1 2\n1 1\n1 0\n") == std::vector<int>{0, 1, 2, 3, 4});
}
