// All intersecting pairs of triangles of a surface, against brute force and by construction.
#include "geometry/intersect.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "tests/geometry/integer_hulls.h"

using namespace mvs::core;
using namespace mvs::core::integer;

namespace {

std::vector<Vec3> wavy_grid(uint32_t side, double depth) {
  std::vector<Vec3> x;
  for (uint32_t j = 0; j <= side; ++j) {
    for (uint32_t i = 0; i <= side; ++i) {
      const double u = double(i) / side, v = double(j) / side;
      x.push_back({u, v, depth * std::sin(9 * u) * std::cos(7 * v)});
    }
  }
  return x;
}

std::vector<Tri> grid_triangles(uint32_t side, uint32_t first_node) {
  std::vector<Tri> triangles;
  for (uint32_t j = 0; j < side; ++j) {
    for (uint32_t i = 0; i < side; ++i) {
      const uint32_t a = first_node + j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({b, d, c});
    }
  }
  return triangles;
}

}  // namespace

TEST_CASE("crossing_pairs_are_those_of_brute_force") {
  std::mt19937 random(4);
  size_t found = 0;
  for (int round = 0; round < 20; ++round) {
    const int64_t range = round % 2 == 0 ? 40 : 1000;
    std::vector<IntVec> nodes;
    std::vector<Vec3> x;
    std::vector<Tri> triangles;
    for (uint32_t t = 0; t < 60; ++t) {  // no common nodes; one triangle in ten is large
      const IntVec centre = random_point(random, range);
      for (int k = 0; k < 3; ++k) {
        const IntVec off = random_point(random, t % 10 == 0 ? 2 * range : range / 2);
        nodes.push_back({centre[0] + off[0], centre[1] + off[1], centre[2] + off[2]});
        x.push_back(real(nodes.back()));
      }
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    std::vector<Edge> expected;
    const auto corners = [&](uint32_t t) {
      return std::vector<IntVec>{nodes[3 * t], nodes[3 * t + 1], nodes[3 * t + 2]};
    };
    for (uint32_t s = 0; s < triangles.size(); ++s) {
      for (uint32_t t = s + 1; t < triangles.size(); ++t) {
        if (hulls_meet(corners(s), corners(t))) expected.push_back({s, t});
      }
    }
    CHECK(find_intersections(x, triangles) == expected);
    found += expected.size();
  }
  CHECK(found > 400);
}

TEST_CASE("pairs_that_share_nodes_cross_as_each_pair_alone") {
  std::mt19937 random(5);
  std::uniform_int_distribution<uint32_t> node(0, 8);
  size_t found = 0, shared = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Vec3> x;
    x.reserve(9);
    // small lattices have many coplanar and flat triangles
    for (int k = 0; k < 9; ++k) x.push_back(real(random_point(random, 1 + round % 3)));
    std::vector<Tri> triangles;
    while (triangles.size() < 12) {
      const Tri t = {node(random), node(random), node(random)};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    std::vector<Edge> expected;
    for (uint32_t s = 0; s < triangles.size(); ++s) {
      for (uint32_t t = s + 1; t < triangles.size(); ++t) {
        if (!triangles_cross(x, triangles[s], triangles[t])) continue;
        expected.push_back({s, t});
        shared += std::any_of(triangles[s].begin(), triangles[s].end(), [&](uint32_t corner) {
          return std::find(triangles[t].begin(), triangles[t].end(), corner) != triangles[t].end();
        });
      }
    }
    CHECK(find_intersections(x, triangles) == expected);
    found += expected.size();
  }
  CHECK(shared > 1000);
  CHECK(found - shared > 1000);
}

TEST_CASE("a_sheet_does_not_cross_itself") {
  for (const double depth : {0.0, 0.1}) {  // flat: every pair is coplanar
    CHECK(find_intersections(wavy_grid(20, depth), grid_triangles(20, 0)).empty());
  }
}

TEST_CASE("neighbours_over_one_node_cross_when_the_far_side_passes_through") {
  const std::vector<Tri> pair = {{0, 1, 2}, {0, 3, 4}};
  const auto count = [&](const Vec3 &q, const Vec3 &r) {
    return find_intersections({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), q, r}, pair).size();
  };
  CHECK(count({1, 1, -1}, {1, 1, 1}) == 1);    // through the inside
  CHECK(count({2, 2, -1}, {2, 2, 1}) == 1);    // through the far side: touching counts
  CHECK(count({3, 3, -1}, {3, 3, 1}) == 1);    // the far side of the other one passes through
  CHECK(count({-1, 1, -1}, {-1, 1, 1}) == 0);  // beside it
  CHECK(count({0, -4, 0}, {-4, 0, 0}) == 0);   // a flat fan
  CHECK(count({1, 1, 0}, {2, -1, 0}) == 1);    // overlapping in one plane
}

TEST_CASE("neighbours_over_an_edge_cross_only_when_folded_flat") {
  const std::vector<Tri> pair = {{0, 1, 2}, {1, 0, 3}};
  const auto count = [&](const Vec3 &d) {
    return find_intersections({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, 4, 0), d}, pair).size();
  };
  CHECK(count({1, -4, 0}) == 0);
  CHECK(count({1, 4, 1e-60}) == 0);  // folded, 1e-60 apart: exact arithmetic separates them
  CHECK(count({2, 1, 0}) == 1);
  CHECK(count({2, 0, 0}) == 0);  // flat triangle in the fold itself
  CHECK(find_intersections({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, 4, 0)}, {{0, 1, 2}, {2, 1, 0}})
            .size() == 1);
}

TEST_CASE("fifty_thousand_triangles_are_tested_at_interactive_speed") {
  const uint32_t side = 112;  // two sheets that cross along curves
  std::vector<Vec3> x = wavy_grid(side, 0.05);
  const std::vector<Vec3> other = wavy_grid(side, -0.04);
  const uint32_t first = static_cast<uint32_t>(x.size());
  for (const Vec3 &p : other) x.push_back(p + Vec3(0.0031, 0.0017, 0.013));
  std::vector<Tri> triangles = grid_triangles(side, 0);
  for (const Tri &t : grid_triangles(side, first)) triangles.push_back(t);
  double best = 1e300;
  size_t count = 0;
  for (int round = 0; round < 3; ++round) {
    const std::clock_t start = std::clock();  // CPU time of this process: other processes may run
    count = find_intersections(x, triangles).size();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  MESSAGE(triangles.size() << " triangles, " << count << " crossings, " << 1e3 * best << " ms");
  CHECK(count > 500);
#ifdef NDEBUG
  CHECK(best < 0.3);  // the limit set for it, with room for a busy machine
#endif
}
