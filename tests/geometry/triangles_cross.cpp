// Orientation of four points, and the intersection of two triangles, against exact integer
// arithmetic.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <array>
#include <random>
#include <vector>

#include "geometry/intersect.h"
#include "tests/geometry/integer_hulls.h"

using namespace mvs::core;
using namespace mvs::core::integer;

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
