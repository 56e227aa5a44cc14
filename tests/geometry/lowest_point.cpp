// Lowest points of half-spaces against all corners of their planes.
#include "geometry/lowest_point.h"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <array>
#include <random>

namespace mvs::core::test {
namespace {

constexpr double reach = 0.5e-3;

bool is_inside(const std::vector<HalfSpace> &spaces, const Vec3 &p) {
  // coordinates of 0.5 mm by normals of rounding 1e-16, solved from three planes
  constexpr double rounding = 1e-12;
  return std::all_of(spaces.begin(), spaces.end(),
                     [&](const HalfSpace &h) { return h.normal.dot(p) >= h.offset - rounding; });
}

// The least third coordinate of the corners at which three planes meet, those of the cube included.
double lowest_corner(std::vector<HalfSpace> spaces) {
  for (int axis = 0; axis < 3; ++axis) {
    spaces.push_back({Vec3::Unit(axis), -reach});
    spaces.push_back({-Vec3::Unit(axis), -reach});
  }
  double lowest = reach;
  for (size_t a = 0; a < spaces.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      for (size_t c = 0; c < b; ++c) {
        Mat3 planes;
        planes << spaces[a].normal.transpose(), spaces[b].normal.transpose(),
            spaces[c].normal.transpose();
        if (std::abs(planes.determinant()) < 1e-4) continue;  // a corner of 1e-12 m at best
        const Vec3 corner =
            planes.inverse() * Vec3(spaces[a].offset, spaces[b].offset, spaces[c].offset);
        if (is_inside(spaces, corner)) lowest = std::min(lowest, corner[2]);
      }
    }
  }
  return lowest;
}

}  // namespace

TEST_CASE("the_lowest_point_is_the_lowest_corner") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 2000; ++k) {
    std::vector<HalfSpace> spaces;
    const int count = 1 + k % 9;
    for (int i = 0; i < count; ++i) {
      const Vec3 n(normal(random), normal(random), normal(random));
      // some planes pass through the origin, as those of triangles that the ball touches
      spaces.push_back({n.normalized(), share(random) < 0.3 ? 0 : -reach * share(random)});
    }
    if (k % 4 == 0) spaces.push_back(spaces.front());  // two triangles of one plane
    const Vec3 found = lowest_point(spaces, reach);
    CHECK(is_inside(spaces, found));
    CHECK(found.cwiseAbs().maxCoeff() <= reach * (1 + 1e-12));
    CHECK(std::abs(found[2] - lowest_corner(spaces)) < 1e-11);  // of corners, see above
  }
}

TEST_CASE("without_half_spaces_it_is_straight_below") {
  CHECK(lowest_point({}, reach) == Vec3(0, 0, -reach));
}

TEST_CASE("walls_leave_the_point_above_the_floor_between_them") {
  const double depth = 0.2e-3;
  const std::vector<HalfSpace> spaces = {
      {Vec3(1, 0, 0), 0}, {Vec3(-1, 0, 0), 0}, {Vec3(0, 0, 1), -depth}};
  const Vec3 found = lowest_point(spaces, reach);
  CHECK(found[2] == -depth);
  CHECK(found[0] == 0);
}

}  // namespace mvs::core::test
