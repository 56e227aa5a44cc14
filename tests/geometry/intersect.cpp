// Triangle intersection against exact integer arithmetic and against brute force.
#include "geometry/intersect.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

using namespace mvs::core;

namespace {

// Coordinates below 2^30 keep a 3 x 3 determinant of differences below 2^96.
__extension__ typedef __int128 Int;
using IntVec = std::array<int64_t, 3>;

IntVec minus(const IntVec &a, const IntVec &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 real(const IntVec &a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}
std::array<Int, 3> cross(const IntVec &a, const IntVec &b) {
  return {Int{a[1]} * b[2] - Int{a[2]} * b[1], Int{a[2]} * b[0] - Int{a[0]} * b[2],
          Int{a[0]} * b[1] - Int{a[1]} * b[0]};
}
template <typename A, typename B>
Int dot(const A &a, const B &b) {
  return Int{a[0]} * b[0] + Int{a[1]} * b[1] + Int{a[2]} * b[2];
}
bool is_zero(const std::array<Int, 3> &a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}
Int det(const IntVec &a, const IntVec &b, const IntVec &c) {
  return dot(cross(a, b), c);
}
int sign(Int value) {
  return (value > 0) - (value < 0);
}

// Whether the origin is a convex combination of points. By Caratheodory, four, three, two or one
// independent points suffice; combinations of dependent points are found among fewer points.
bool spans_origin(const IntVec &p) {
  return p == IntVec{0, 0, 0};
}
bool spans_origin(const IntVec &p, const IntVec &q) {
  return is_zero(cross(p, q)) && dot(p, q) <= 0;
}
bool spans_origin(const IntVec &p, const IntVec &q, const IntVec &r) {
  if (det(p, q, r) != 0) return false;
  const std::array<Int, 3> normal = cross(minus(q, p), minus(r, p));
  if (is_zero(normal)) return false;
  return dot(normal, cross(p, q)) >= 0 && dot(normal, cross(q, r)) >= 0 &&
         dot(normal, cross(r, p)) >= 0;
}
bool spans_origin(const IntVec &p, const IntVec &q, const IntVec &r, const IntVec &s) {
  const int whole = sign(det(minus(q, p), minus(r, p), minus(s, p)));
  if (whole == 0) return false;
  return whole * sign(det(q, r, s)) >= 0 && whole * sign(det(p, r, s)) <= 0 &&
         whole * sign(det(p, q, s)) >= 0 && whole * sign(det(p, q, r)) <= 0;
}

// Convex hulls meet when their difference contains the origin.
bool hulls_meet(const std::vector<IntVec> &a, const std::vector<IntVec> &b) {
  std::vector<IntVec> d;
  for (const IntVec &p : a) {
    for (const IntVec &q : b) d.push_back(minus(p, q));
  }
  for (size_t i = 0; i < d.size(); ++i) {
    if (spans_origin(d[i])) return true;
    for (size_t j = 0; j < i; ++j) {
      if (spans_origin(d[i], d[j])) return true;
      for (size_t k = 0; k < j; ++k) {
        if (spans_origin(d[i], d[j], d[k])) return true;
        for (size_t l = 0; l < k; ++l) {
          if (spans_origin(d[i], d[j], d[k], d[l])) return true;
        }
      }
    }
  }
  return false;
}

IntVec random_point(std::mt19937 &random, int64_t range) {
  std::uniform_int_distribution<int64_t> coordinate(-range, range);
  const int64_t i = coordinate(random), j = coordinate(random), k = coordinate(random);
  return {i, j, k};
}

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

TEST_CASE("orientation_has_the_sign_of_integer_arithmetic") {
  std::mt19937 random(1);
  int flat = 0, undecided_by_rounding = 0;
  for (int round = 0; round < 40000; ++round) {
    // points of a plane spanned by small steps, then one unit off it or not
    const IntVec a = random_point(random, 1 << 27);
    const IntVec u = random_point(random, 1000), v = random_point(random, 1000);
    const auto in_plane = [&] {
      std::uniform_int_distribution<int64_t> steps(-100000, 100000);
      const int64_t s = steps(random), t = steps(random);
      IntVec p = a;
      for (int k = 0; k < 3; ++k) p[k] += s * u[k] + t * v[k];
      return p;
    };
    const IntVec b = in_plane(), c = in_plane();
    IntVec d = in_plane();
    if (round % 3 != 0) d[round % 3] += round % 2 == 0 ? 1 : -1;
    const int expected = sign(det(minus(b, a), minus(c, a), minus(d, a)));
    const double ulp = 0x1p-40;  // a power of two: scaling is exact
    const Vec3 ra = ulp * real(a), rb = ulp * real(b), rc = ulp * real(c), rd = ulp * real(d);
    REQUIRE(orient3d_sign(ra, rb, rc, rd) == expected);
    REQUIRE(orient3d_sign(rb, ra, rc, rd) == -expected);
    REQUIRE(orient3d_sign(rd, rc, rb, ra) == expected);
    flat += expected == 0;
    Mat3 rounded;
    rounded << rb - ra, rc - ra, rd - ra;
    const double value = rounded.determinant();
    undecided_by_rounding += (value > 0) - (value < 0) != expected;
  }
  CHECK(flat > 10000);                  // a third of the rounds
  CHECK(undecided_by_rounding > 1000);  // the expansions decided
}

TEST_CASE("orientation_is_exact_where_differences_round") {
  // d is off the plane x = y by the last bit of 1, with the other corners 2^40 away
  const double far = 0x1p40, bit = 0x1p-52;
  const Vec3 a(far, far, 0), b(-far, -far, 1), c(0, 0, far);
  CHECK(orient3d_sign(a, b, c, Vec3(1, 1, 3)) == 0);
  const int above = orient3d_sign(a, b, c, Vec3(1 + bit, 1, 3));
  CHECK(above != 0);
  CHECK(orient3d_sign(a, b, c, Vec3(1, 1 + bit, 3)) == -above);
  CHECK(orient3d_sign(a, b, c, Vec3(2, 1, 3)) == above);
}

TEST_CASE("triangles_cross_exactly_when_their_hulls_meet") {
  std::mt19937 random(2);
  int crossing = 0, degenerate = 0, rounds = 0;
  for (const int64_t range : {1, 2, 3, 6, 1000}) {  // small ranges give every degenerate case
    for (int round = 0; round < 4000; ++round, ++rounds) {
      std::vector<IntVec> a, b;
      for (int k = 0; k < 3; ++k) {
        a.push_back(random_point(random, range));
        b.push_back(random_point(random, range));
      }
      const std::array<Vec3, 3> ra = {real(a[0]), real(a[1]), real(a[2])};
      const std::array<Vec3, 3> rb = {real(b[0]), real(b[1]), real(b[2])};
      const bool expected = hulls_meet(a, b);
      REQUIRE(triangles_cross(ra, rb) == expected);
      REQUIRE(triangles_cross(rb, {ra[2], ra[0], ra[1]}) == expected);
      REQUIRE(segment_crosses_triangle(ra[0], ra[1], rb[0], rb[1], rb[2]) ==
              hulls_meet({a[0], a[1]}, b));
      crossing += expected;
      degenerate += is_zero(cross(minus(a[1], a[0]), minus(a[2], a[0])));
    }
  }
  CHECK(crossing > rounds / 10);
  CHECK(crossing < rounds * 9 / 10);
  CHECK(degenerate > 100);
}

TEST_CASE("coplanar_triangles_of_any_plane_cross_exactly_when_their_hulls_meet") {
  std::mt19937 random(3);
  int crossing = 0;
  for (int round = 0; round < 4000; ++round) {
    const IntVec u = random_point(random, 50), v = random_point(random, 50);
    const auto in_plane = [&] {
      std::uniform_int_distribution<int64_t> steps(-3, 3);
      const int64_t s = steps(random), t = steps(random);
      return IntVec{s * u[0] + t * v[0], s * u[1] + t * v[1], s * u[2] + t * v[2]};
    };
    std::vector<IntVec> a, b;
    for (int k = 0; k < 3; ++k) {
      a.push_back(in_plane());
      b.push_back(in_plane());
    }
    const bool expected = hulls_meet(a, b);
    REQUIRE(triangles_cross({real(a[0]), real(a[1]), real(a[2])},
                            {real(b[0]), real(b[1]), real(b[2])}) == expected);
    crossing += expected;
  }
  CHECK(crossing > 1000);
  CHECK(crossing < 3900);
}

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
