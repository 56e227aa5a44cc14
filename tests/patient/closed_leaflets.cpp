// Closed leaflets that are given as the open ones.
#include <doctest/doctest.h>

#include "base/error.h"
#include "patient/surface/facing_area.h"
#include "patient/surface/rims.h"
#include "tests/about.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("find_rims_doubts_and_refuses_closed_leaflets") {
  // the free edge is pressed flat, to a width of `share`
  const auto pressed = [](double share) {
    Surface s = funnel(48, 12);
    for (Vec3 &x : s.x) x.y() *= 1 + (share - 1) * x.z() / -12e-3;
    return s;
  };
  Findings findings;
  CHECK_THROWS_WITH_AS(rims_of(pressed(0.05), {}, findings), doctest::Contains("to be closed"),
                       Error);
  rims_of(pressed(0.2), {}, findings);
  CHECK(find(findings, "orifice")->confidence < 0.9);
}

TEST_CASE("find_rims_refuses_closed_leaflets_whose_edges_lie_apart_below_the_coaptation") {
  // a slit of 1.6 mm at a depth of 8 mm; below it the leaflets part by twice 0.4 mm per mm, or not
  // at all: then the slit is as wide as the orifice
  const auto closed = [](double size) {
    Surface s = funnel(48, 24);
    for (Vec3 &x : s.x) {
      const double depth = -x.z() / 12e-3;
      const double flat = 0.8e-3 + (depth > 0.75 ? 2.0e-3 * (depth - 0.75) : 0);
      const double radius = std::hypot(x.x(), x.y());
      const double side = x.y() < 0 ? -1 : 1;
      const double pressed = side * std::min(std::abs(x.y()), flat * std::abs(x.y()) / radius);
      x.y() += std::min(1.0, 2 * depth) * (pressed - x.y());
      x *= size;
    }
    return s;
  };
  for (const double size : {1.0, 0.4}) {
    CAPTURE(size);
    Findings findings;
    CHECK_THROWS_WITH_AS(rims_of(closed(size), {}, findings),
                         doctest::Contains("of the other leaflet"), Error);
  }
}

TEST_CASE("tissue_faces_tissue_where_atrial_sides_lie_within_reach") {
  // two plates of 10 x 10 mm that face each other at 1.5 mm, and one 1 mm beside them, back to back
  const auto plate = [](double z, bool up) {
    LeafletSheet sheet;
    sheet.x = {{0, 0, z}, {10e-3, 0, z}, {10e-3, 10e-3, z}, {0, 10e-3, z}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    if (!up) {
      for (Tri &t : sheet.triangles) std::swap(t[1], t[2]);
    }
    return sheet;
  };
  LeafletSheet sheet = plate(0, true);
  for (const LeafletSheet &other : {plate(1.5e-3, false), plate(2.5e-3, true)}) {
    const auto first = static_cast<uint32_t>(sheet.x.size());
    sheet.x.insert(sheet.x.end(), other.x.begin(), other.x.end());
    for (const Tri &t : other.triangles) {
      sheet.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  CHECK(facing_share(sheet, 2e-3) == about(2.0 / 3));
  CHECK(facing_share(sheet, 1.4e-3) == 0);
}

TEST_CASE("find_rims_recognises_a_real_valve_that_is_closed") {
  for (const std::string level : {"N32", "N64"}) {
    const nlohmann::json json = read_real_valve("kaiser_mitral_normal_1/" + level + ".json");
    if (json.is_null()) {
      MESSAGE("skipped: no kaiser_mitral_normal_1 in MVS_TEST_DATA or ../shared/data");
      return;
    }
    Valve valve = kaiser_valve(json);
    for (size_t i = 0; i < json["vertices_pressurized"].size(); ++i) {
      valve.rest[i] = in_metres(json["vertices_pressurized"][i]);
    }
    Findings findings;
    const Surface closed = {valve.rest, valve.triangles};
    // the coarse one has a slit of 0.8 mm, the other one of 2.1 mm with leaflets that coapt beside
    // it
    CHECK_THROWS_WITH_AS(rims_of(closed, {}, findings), doctest::Contains("closed"), Error);
  }
}
