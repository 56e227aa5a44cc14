// Delaunay tetrahedra and maximum flow, the two algorithms behind the orifice, against brute force.
#include "geometry/delaunay3d.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>

#include "geometry/intersect.h"
#include "geometry/max_flow.h"
#include "geometry/sphere_side.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

std::vector<LatticePoint> random_points(uint32_t count, int32_t range, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int32_t> coordinate(1, range);
  std::vector<LatticePoint> points(count);
  for (LatticePoint &p : points) {
    for (int32_t &c : p) c = coordinate(random);
  }
  return points;
}

std::vector<LatticePoint> with_corners(std::vector<LatticePoint> points) {
  for (int k = 0; k < 8; ++k) {
    points.push_back(
        {(k & 1) * lattice_size, (k >> 1 & 1) * lattice_size, (k >> 2 & 1) * lattice_size});
  }
  return points;
}

Vec3 real(const LatticePoint &p) {
  return Vec3(p[0], p[1], p[2]);
}

// Six times the volume, exact in the long double of this test (63 bits).
long double volume6(const std::vector<LatticePoint> &p, const Tetrahedron &t) {
  const auto d = [&](int i, int k) {
    return static_cast<long double>(p[t.corner[i]][k] - p[t.corner[0]][k]);
  };
  return d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) -
         d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0)) +
         d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
}

void check_is_a_filling_of_the_box(const std::vector<LatticePoint> &points) {
  const Delaunay made = delaunay(points);
  const std::vector<LatticePoint> p = with_corners(points);
  long double total = 0;
  for (uint32_t t = 0; t < made.tetrahedra.size(); ++t) {
    const Tetrahedron &tet = made.tetrahedra[t];
    const auto corner = [&](int k) { return real(p[tet.corner[k]]); };
    REQUIRE(orient3d_sign(corner(0), corner(1), corner(2), corner(3)) == 1);
    total += volume6(p, tet);
    for (int k = 0; k < 4; ++k) {
      if (tet.neighbour[k] == none) continue;
      const Tetrahedron &other = made.tetrahedra[tet.neighbour[k]];
      CHECK(std::count(other.neighbour.begin(), other.neighbour.end(), t) == 1);
      for (int j = 0; j < 4; ++j) {
        if (j == k) continue;
        CHECK(std::count(other.corner.begin(), other.corner.end(), tet.corner[j]) == 1);
      }
    }
  }
  const long double side = lattice_size;
  CHECK(total == about(double(6 * side * side * side), 1e-12));  // rounding
}

}  // namespace

TEST_CASE("tetrahedra_fill_the_box_and_store_their_neighbours") {
  // 3: every lattice point taken, all cospherical
  for (const int32_t range : {3, 40, lattice_size - 1}) {
    check_is_a_filling_of_the_box(random_points(300, range, 7));
  }
}

TEST_CASE("no_point_is_inside_the_sphere_of_a_tetrahedron") {
  for (const int32_t range : {6, 1 << 9}) {  // small numbers: doubles hold the determinant exactly
    const std::vector<LatticePoint> points = random_points(120, range, 8);
    const Delaunay made = delaunay(points);
    int checked = 0;
    for (const Tetrahedron &tet : made.tetrahedra) {
      const bool has_box_corner = std::any_of(tet.corner.begin(), tet.corner.end(),
                                              [&](uint32_t c) { return c >= points.size(); });
      if (has_box_corner) continue;
      // centre = a + n / (2 det): compare |det2 (p - a) - n|2 with |n|2, all integers below 2^53
      const Vec3 a = real(points[tet.corner[0]]);
      const Vec3 u = real(points[tet.corner[1]]) - a, v = real(points[tet.corner[2]]) - a,
                 w = real(points[tet.corner[3]]) - a;
      const Vec3 n = u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) +
                     w.squaredNorm() * u.cross(v);
      const double det2 = 2 * u.dot(v.cross(w));
      for (const LatticePoint &point : points) {
        const Vec3 q = real(point) - a;
        // |q - n / det2|2 < |n / det2|2  <=>  |q|2 det2 < 2 q n
        REQUIRE(q.squaredNorm() * det2 >= 2 * q.dot(n));
        ++checked;
      }
    }
    CHECK(checked > 10000);
  }
}

// On few small coordinates many points are cospherical, on large ones products are rounded.
TEST_CASE("a_side_of_a_sphere_is_right_or_unknown") {
  __extension__ typedef __int128 Wide;
  size_t known = 0, checked = 0;
  for (const int32_t range : {4, 100, lattice_size - 1}) {
    const std::vector<LatticePoint> points = random_points(25000, range, 11);
    for (size_t i = 0; i + 5 <= points.size(); i += 5) {
      std::array<LatticePoint, 5> p;
      std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(i), 5, p.begin());
      const int orientation = orient3d_sign(real(p[0]), real(p[1]), real(p[2]), real(p[3]));
      if (orientation == 0) continue;
      if (orientation < 0) std::swap(p[0], p[1]);
      // the determinant of rows (q, |q|2), q = p[k] - p[4], by its last column
      std::array<std::array<Wide, 4>, 4> row;
      for (size_t k = 0; k < 4; ++k) {
        row[k][3] = 0;
        for (size_t c = 0; c < 3; ++c) {
          row[k][c] = p[k][c] - p[4][c];
          row[k][3] += row[k][c] * row[k][c];
        }
      }
      Wide determinant = 0;
      for (size_t k = 0; k < 4; ++k) {
        const auto &a = row[k == 0 ? 1 : 0], &b = row[k <= 1 ? 2 : 1], &c = row[k == 3 ? 2 : 3];
        const Wide minor = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                           a[2] * (b[0] * c[1] - b[1] * c[0]);
        determinant += (k % 2 == 0 ? 1 : -1) * minor * row[k][3];
      }
      std::array<SpherePoint, 5> q;
      for (size_t k = 0; k < 5; ++k) {
        q[k] = {{double(p[k][0]), double(p[k][1]), double(p[k][2]), 0}};
      }
      const SphereSide side = sphere_side(q[0], q[1], q[2], q[3], q[4]);
      ++checked;
      if (side == SphereSide::unknown) continue;
      ++known;
      REQUIRE((side == SphereSide::inside) == (determinant > 0));
      REQUIRE(determinant != 0);
    }
  }
  CHECK(checked > 12000);
#if defined(__GNUC__)
  CHECK(static_cast<double>(known) > 0.9 * static_cast<double>(checked));
#endif
}

TEST_CASE("coincident_points_share_a_vertex") {
  std::vector<LatticePoint> points = random_points(50, 1000, 9);
  const size_t n = points.size();
  for (size_t i = 0; i < n; ++i) points.push_back(points[i]);
  const Delaunay made = delaunay(points);
  for (size_t i = 0; i < n; ++i) {
    CHECK(made.stands_for[i] == made.stands_for[i + n]);
    CHECK(points[made.stands_for[i]] == points[i]);
  }
}

TEST_CASE("insertion_takes_microseconds_a_point_on_surfaces") {
  std::vector<LatticePoint> points;  // two flat regular sheets, one of them tilted
  for (int32_t i = 0; i < 100; ++i) {
    for (int32_t j = 0; j < 100; ++j) {
      points.push_back({200000 + 6000 * i, 200000 + 6000 * j, 500000});
      points.push_back({200000 + 6000 * i, 200000 + 6000 * j, 520000 + 1000 * i});
    }
  }
  const auto start = std::chrono::steady_clock::now();
  const size_t count = delaunay(points).tetrahedra.size();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  MESSAGE(points.size() << " points, " << count << " tetrahedra, " << 1e3 * took.count() << " ms");
  CHECK(count > 3 * points.size());
}

TEST_CASE("the_maximum_flow_equals_the_minimum_cut") {
  std::mt19937 random(10);
  for (int round = 0; round < 200; ++round) {
    const uint32_t nodes = 8;
    std::uniform_int_distribution<uint32_t> any(0, nodes - 1);
    std::uniform_int_distribution<int64_t> size(0, 20);
    struct Pipe {
      uint32_t a, b;
      int64_t capacity;
    };
    std::vector<Pipe> pipes;
    MaxFlow network(nodes);
    for (int k = 0; k < 18; ++k) {
      const Pipe pipe = {any(random), any(random), size(random)};
      pipes.push_back(pipe);
      network.add_edge(pipe.a, pipe.b, pipe.capacity);
    }
    const auto cut = [&](const auto &is_in) {
      int64_t total = 0;
      for (const Pipe &p : pipes) total += is_in(p.a) != is_in(p.b) ? p.capacity : 0;
      return total;
    };
    int64_t least = INT64_MAX;
    for (uint32_t set = 0; set < 1u << nodes; ++set) {
      if ((set & 1) == 0 || (set >> 1 & 1) != 0) continue;  // node 0 in, node 1 out
      least = std::min(least, cut([&](uint32_t n) { return (set >> n & 1) != 0; }));
    }
    REQUIRE(network.run(0, 1) == least);
    REQUIRE(cut([&](uint32_t n) { return network.is_on_source_side(n); }) == least);
    CHECK(network.is_on_source_side(0));
    CHECK(!network.is_on_source_side(1));
  }
}
