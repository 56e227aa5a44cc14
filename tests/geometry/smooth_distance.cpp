// The smooth distance of a hull and a triangle against its definition, and its derivative where a
// facet passes through being parallel; corners found by descent against all corners.
#include "geometry/smooth_distance.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double lean = 0.5, everywhere = 1e300;

double ratio_of(const SmoothDistance &found, double radius) {
  return (found.distance - radius) / found.factor;
}

// m for the weights of a place on a part.
double factor_at(const std::vector<double> &place) {
  double squared = 0;
  for (const double w : place) squared += w * w;
  return 1 + lean * ((1 - squared) / (1 - 1 / static_cast<double>(place.size())) - 0.5);
}

std::vector<double> place_of(const SmoothDistance &found, size_t parts) {
  std::vector<double> place(parts, 0.0);
  for (uint32_t k = 0; k < found.count; ++k) place[found.second[k]] += found.weight[k];
  return place;
}

Vec3 point_at(const Positions &part, const std::vector<double> &place) {
  Vec3 q = Vec3::Zero();
  for (size_t k = 0; k < part.size(); ++k) q += place[k] * part[k];
  return q;
}

// The ratio at a place of a part, with the nearest point of the hull.
double ratio_at(const Positions &hull, const Positions &part, const std::vector<double> &place,
                double radius) {
  const Positions q = {point_at(part, place)};
  return (convex_distance(hull, q, everywhere).distance - radius) / factor_at(place);
}

void check_minimum(const Positions &hull, const Positions &part, double radius) {
  const SmoothDistance found = smooth_distance(hull, part, radius, lean, everywhere);
  const double ratio = ratio_of(found, radius);
  const std::vector<double> place = place_of(found, part.size());
  double sum = 0;
  for (uint32_t k = 0; k < found.count; ++k) {
    CHECK(found.weight[k] > 0);
    sum += found.weight[k];
  }
  CHECK(sum == about(1, 1e-14));
  CHECK(found.factor == about(factor_at(place), 1e-13));
  // rounding of the places, 1e-18 m, over the least gap of these pairs, 1e-6 m
  CHECK(ratio == about(ratio_at(hull, part, place, radius), 1e-10));
  constexpr int cells = 24;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= (part.size() == 3 ? cells - i : 0); ++j) {
      const double u = static_cast<double>(i) / cells, v = static_cast<double>(j) / cells;
      std::vector<double> at = {1 - u - v, u};
      if (part.size() == 3) at.push_back(v);
      CHECK(ratio <= ratio_at(hull, part, at, radius) * (1 + 1e-10));
      // and beside the minimum itself
      for (size_t k = 0; k < at.size(); ++k) at[k] = place[k] + 1e-4 * (at[k] - place[k]);
      CHECK(ratio <= ratio_at(hull, part, at, radius) * (1 + 1e-10));
    }
  }
}

Positions cube(double half) {
  Positions points;
  for (int k = 0; k < 8; ++k)
    points.push_back(half * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  return points;
}

// A triangle below a cube of 2 mm, tilted about the y axis.
Positions tilted(double angle, double gap) {
  Positions t = {Vec3(-2e-3, -2e-3, 0), Vec3(3e-3, -1e-3, 0), Vec3(0, 3e-3, 0)};
  const Eigen::AngleAxisd turn(angle, Vec3::UnitY());
  for (Vec3 &p : t) p = turn * p + Vec3(0, 0, -1e-3 - gap);
  return t;
}

}  // namespace

TEST_CASE("the_smooth_distance_is_the_least_ratio_over_the_part") {
  Random random(24);
  int apart = 0;
  for (int pair = 0; pair < 60; ++pair) {
    CAPTURE(pair);
    const Positions hull = random.vectors(2 + pair % 20, 3e-3);
    const Vec3 away = random.vector(6e-3);
    Positions part = random.vectors(pair % 3 == 0 ? 2 : 3, 3e-3);
    for (Vec3 &p : part) p += away;
    const double least = convex_distance(hull, part, everywhere).distance;
    if (least < 1e-5) continue;
    ++apart;
    check_minimum(hull, part, 0);
    check_minimum(hull, part, least - 1e-6);
  }
  CHECK(apart > 15);
  for (const double tilt : {0.0, 1e-4, -3e-3}) {
    check_minimum(cube(1e-3), tilted(tilt, 20e-6), 0);
    check_minimum(cube(1e-3), tilted(tilt, 0.3e-3), 0.28e-3);
  }
}

TEST_CASE("the_smooth_distance_is_that_of_a_ball_for_a_hull_of_one_point") {
  Random random(5);
  for (int pair = 0; pair < 200; ++pair) {
    const Positions point = random.vectors(1, 5e-3), part = random.vectors(3, 5e-3);
    const SmoothDistance found = smooth_distance(point, part, 0, lean, everywhere);
    CHECK(found.factor == 1);
    CHECK(found.bend == 0);
    CHECK(found.distance == convex_distance(point, part, everywhere).distance);
  }
}

// The place on the triangle, with the normal, is the gradient. Between two tilts it moves in
// proportion to their difference; that of the least distance jumps by the width of the cube.
TEST_CASE("the_smooth_distance_has_no_kink_where_a_facet_is_parallel") {
  const Positions hull = cube(1e-3);
  std::array<double, 2> smooth{}, plain{};
  for (int fine = 0; fine < 2; ++fine) {
    const int steps = fine == 0 ? 400 : 4000;
    Vec3 before = Vec3::Zero(), before_plain = Vec3::Zero();
    for (int k = 0; k <= steps; ++k) {
      const Positions part = tilted(0.02 * k / steps - 0.01 + 1e-9, 20e-6);
      const SmoothDistance found = smooth_distance(hull, part, 0, lean, everywhere);
      const Vec3 place = point_at(part, place_of(found, 3));
      const ConvexDistance least = convex_distance(hull, part, everywhere);
      Vec3 place_plain = Vec3::Zero();
      for (uint32_t c = 0; c < least.count; ++c)
        place_plain += least.weight[c] * part[least.second[c]];
      if (k > 0) {
        smooth[fine] = std::max(smooth[fine], (place - before).norm());
        plain[fine] = std::max(plain[fine], (place_plain - before_plain).norm());
      }
      before = place;
      before_plain = place_plain;
    }
  }
  MESSAGE("largest move of the place: " << 1e3 * smooth[0] << " and " << 1e3 * smooth[1] << " mm");
  CHECK(smooth[1] <= 0.2 * smooth[0]);  // of 0.1
  CHECK(plain[1] > 1e-3);
}

TEST_CASE("a_search_stops_where_the_smooth_distance_is_above_its_cutoff") {
  Random random(3);
  for (int pair = 0; pair < 300; ++pair) {
    const Positions hull = random.vectors(12, 2e-3);
    Positions part = random.vectors(3, 2e-3);
    for (Vec3 &p : part) p += Vec3(5e-3, 0, 0);
    const SmoothDistance found = smooth_distance(hull, part, 1e-4, lean, everywhere);
    const double ratio = ratio_of(found, 1e-4);
    CHECK(smooth_distance(hull, part, 1e-4, lean, 0.999 * ratio).is_beyond);
    const SmoothDistance near = smooth_distance(hull, part, 1e-4, lean, 1.001 * ratio);
    CHECK_FALSE(near.is_beyond);
    CHECK(ratio_of(near, 1e-4) == ratio);
  }
}

TEST_CASE("descent_finds_the_lowest_corner_and_the_same_distances") {
  Random random(8);
  for (int k = 0; k < 100; ++k) {
    const Positions points = k == 0 ? cube(1e-3) : random.vectors(4 + 3 * k, 2e-3);
    const HullEdges edges = hull_edges(convex_hull(points).faces, points.size());
    for (int n = 0; n < 20; ++n) {
      const Vec3 along = random.vector(1);
      double least = everywhere;
      for (const Vec3 &p : points) least = std::min(least, along.dot(p));
      CHECK(along.dot(points[lowest_corner(&edges, points, along, edges.first)]) == least);
      Positions part = random.vectors(3, 2e-3);
      for (Vec3 &p : part) p += 5e-3 * along;
      const double cutoff = random(1e-3, 8e-3);
      const ConvexDistance all = convex_distance(points, part, cutoff),
                           found = convex_distance(points, part, cutoff, &edges);
      CHECK(all.is_beyond == found.is_beyond);
      if (all.is_beyond || all.count == 0) continue;
      CHECK(std::abs(all.distance - found.distance) <= 1e-16);
      CHECK(smooth_distance(points, part, 0, lean, cutoff).distance ==
            about(smooth_distance(points, part, 0, lean, cutoff, &edges).distance, 1e-9));
    }
  }
}
