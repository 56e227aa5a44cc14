// Planar cuts against closed forms.
#include "measure/tissue/section.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/measure/shapes.h"

namespace mvs::core::test {
namespace {

constexpr double radius = 10e-3;

// A tube that hangs from z = 0 to z = -20 mm.
Sheet tube() {
  Sheet sheet;
  sheet.rings = 8;
  sheet.at = [](double angle, double s) -> Vec3 {
    return {radius * std::cos(angle), radius * std::sin(angle), -20e-3 * s};
  };
  return sheet;
}

double length_of(const std::vector<Vec3> &pairs) {
  double sum = 0;
  for (size_t i = 0; i < pairs.size(); i += 2) sum += (pairs[i + 1] - pairs[i]).norm();
  return sum;
}

}  // namespace

TEST_CASE("cut_across_a_tube_is_its_polygon") {
  const ModelPtr model = model_of(tube());
  const std::vector<Vec3> pairs =
      plane_section(*model, model->valve.rest, {0, 0, -9e-3}, {0, 0, 1});
  CHECK(length_of(pairs) == about(2 * 48 * radius * std::sin(pi / 48), 1e-13));
  for (const Vec3 &p : pairs) CHECK(p[2] == about(-9e-3, 1e-14));
}

TEST_CASE("cut_along_mesh_edges_counts_them_once") {
  const ModelPtr model = model_of(tube());
  const std::vector<Vec3> pairs =
      plane_section(*model, model->valve.rest, {0, 0, -10e-3}, {0, 0, 1});
  CHECK(length_of(pairs) == about(2 * 48 * radius * std::sin(pi / 48), 1e-13));
}

TEST_CASE("cut_of_a_closed_loop_meets_itself_bit_for_bit") {
  const ModelPtr model = model_of(tube());
  const std::vector<Vec3> pairs =
      plane_section(*model, model->valve.rest, {0.1e-3, 0.2e-3, -10.3e-3}, {0.1, -0.2, 1});
  REQUIRE(!pairs.empty());
  for (const Vec3 &p : pairs) CHECK(std::count(pairs.begin(), pairs.end(), p) == 2);
}

TEST_CASE("cut_beside_the_valve_is_empty") {
  const ModelPtr model = model_of(tube());
  CHECK(plane_section(*model, model->valve.rest, {0, 0, 10e-3}, {0, 0, 1}).empty());
}

}  // namespace mvs::core::test
