// Orientation: sheets of any winding come out facing the atrium, hand-made and real ones.
#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include "model/checks/check.h"
#include "tests/model/real_valves.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;

namespace {

Valve turned(Valve valve, uint32_t every) {
  for (size_t t = 0; t < valve.triangles.size(); t += every) {
    std::swap(valve.triangles[t][1], valve.triangles[t][2]);
  }
  return valve;
}

std::string first_fault(const Valve &valve) {
  const std::vector<Fault> faults = find_faults(valve);
  return faults.empty() ? "" : faults[0].sentence;
}

}  // namespace

TEST_CASE("orient_leaves_a_well_wound_valve_unchanged") {
  Valve valve = small_valve();
  orient(valve);
  CHECK(valve.triangles == small_valve().triangles);
}

TEST_CASE("orient_turns_triangles_of_the_wrong_winding") {
  for (const uint32_t every : {1u, 2u, 3u, 7u}) {
    Valve valve = turned(small_valve(), every);
    CHECK(first_fault(valve) != "");
    orient(valve);
    CHECK(first_fault(valve) == "");
  }
}

TEST_CASE("without_heads_the_hanging_sheet_marks_the_ventricle") {
  Valve valve = small_valve();
  valve.heads.clear();
  valve.chords.clear();
  valve.rest.resize(small_rows * small_segments);
  CHECK(first_fault(valve) == "");
  CHECK(first_fault(turned(valve, 1)).find("faces the ventricle") != std::string::npos);
}

TEST_CASE("a_flat_sheet_without_heads_may_face_either_way") {
  Valve valve = small_valve();
  valve.heads.clear();
  valve.chords.clear();
  valve.rest.resize(small_rows * small_segments);
  for (Vec3 &p : valve.rest) p[2] = 0;
  CHECK(first_fault(valve) == "");
  CHECK(first_fault(turned(valve, 1)) == "");
}

TEST_CASE("orient_turns_the_whole_valve_in_any_position") {
  const Mat3 rotation = Eigen::AngleAxisd(2.5, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  Valve valve = turned(small_valve(), 1);
  for (Vec3 &p : valve.rest) p = rotation * p + Vec3(0.3, -0.2, 0.1);
  orient(valve);
  CHECK(first_fault(valve) == "");
  CHECK(valve.triangles[5][0] == small_valve().triangles[5][0]);
}

TEST_CASE("orient_leaves_indices_out_of_range_to_the_check") {
  Valve valve = small_valve();
  valve.triangles[0][0] = none;
  orient(valve);
  valve = small_valve();
  valve.annulus[0] = none;
  orient(valve);
  valve = small_valve();
  valve.heads[0].node = none;
  orient(valve);
  CHECK(valve.triangles == small_valve().triangles);
}

TEST_CASE("real_valves_pass_the_check_once_oriented") {
  for (const std::string file : {"kaiser_mitral_normal_1/N32.json", "febio/V1_healthy_468.json"}) {
    CAPTURE(file);
    const nlohmann::json json = read_real_valve(file);
    if (json.is_null()) {
      MESSAGE("skipped: no " << file);
      continue;
    }
    Valve valve = json.contains("faces") ? kaiser_valve(json) : febio_valve(json);
    orient(valve);
    CHECK(first_fault(valve) == "");
    // for either winding of the file, the opposite winding is refused
    CHECK(first_fault(turned(valve, 1)).find("faces the ventricle") != std::string::npos);
  }
}

// The relaxed shape of the finer meshes has four triangles whose corners lie on a line (height over
// longest side 4e-15 and 4e-7), so it is no rest shape; their loaded shape is a good sheet.
TEST_CASE("collinear_corners_of_a_real_mesh_are_found_and_its_loaded_shape_is_good") {
  for (const std::string file :
       {"kaiser_mitral_normal_1/N64.json", "kaiser_mitral_normal_1/N128.json"}) {
    CAPTURE(file);
    const nlohmann::json json = read_real_valve(file);
    if (json.is_null()) {
      MESSAGE("skipped: no " << file);
      continue;
    }
    Valve valve = kaiser_valve(json);
    orient(valve);
    CHECK(first_fault(valve).find("has no area") != std::string::npos);
    for (size_t n = 0; n < valve.rest.size(); ++n) {
      valve.rest[n] = in_metres(json["vertices_pressurized"][n]);
    }
    CHECK(first_fault(valve) == "");
    CHECK(first_fault(turned(valve, 1)).find("faces the ventricle") != std::string::npos);
  }
}
