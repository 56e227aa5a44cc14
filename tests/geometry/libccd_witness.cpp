// Distances of points and triangles and of two segments, and crossings of triangles and segments,
// against libccd (libccd.h) on random and degenerate pairs. MVS_TEST_LONG=1: a million pairs of
// each (a minute); otherwise 20,000.
//
// Pairs on which both disagree are counted, and a third computation in long double has to explain
// each:
//
// - point and triangle: ours is wrong for narrow triangles, by 1e-16 of the longest side over the
//   square of height over longest side: 1 nm at a height of 4e-5 of 2 cm, and wholly for triangles
//   that are flat to rounding. model/checks/check_sheet.cpp refuses a height below 1e-6 at rest;
// - two segments: ours takes segments within 1e-6 rad as parallel, and then is at most that times
//   their length too large. GJK with round bodies ends before it has found a slight overlap:
//   libccd's is too large, by at most 10 um, and by up to 2 mm in 10 of a million, at ties of the
//   lattice;
// - crossings: both agree but for pairs that touch, within 1e-9 m, and ours is exact for these; and
//   some 30 in a million, on the lattice or small, which cross by up to 1 mm (the separating axis
//   test says so) and which libccd finds apart: its GJK ends at a tie.
#include <doctest/doctest.h>

#ifndef MVS_HAS_LIBCCD
TEST_CASE("distances_and_crossings_are_those_of_libccd") {
  MESSAGE("skipped: built with MVS_CCD=OFF, or without Debian's libccd-dev");
}
#else
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "geometry/distance.h"
#include "geometry/intersect.h"
#include "tests/geometry/libccd.h"
#include "tests/geometry/odd_points.h"
#include "tests/geometry/third_computation.h"

using namespace mvs::core;
using libccd::near_enough;

namespace {

// m, of pairs that touch. Rounding of coordinates of 0.1 m moves a corner by 1e-17 m, and the place
// where narrow triangles meet, whose sides are parallel within 1e-5, by up to 1e5 times that for
// each of three factors: 1e-9 m at worst. Seen: 3e-10 m.
constexpr double barely = 1e-9;

const int pairs = libccd::is_long() ? 1000000 : 20000;

double libccd_distance(const Segment &a, const Segment &b) {
  return libccd::distance(libccd::body_of(a), libccd::body_of(b));
}

template <size_t N, size_t M>
bool libccd_meet(const std::array<Vec3, N> &a, const std::array<Vec3, M> &b) {
  return libccd::meet(libccd::body_of(a), libccd::body_of(b));
}

double libccd_distance(const Vec3 &p, const Triangle &t) {
  const ccd_vec3_t point = libccd::to_ccd(p), a = libccd::to_ccd(t[0]), b = libccd::to_ccd(t[1]),
                   c = libccd::to_ccd(t[2]);
  return std::sqrt(ccdVec3PointTriDist2(&point, &a, &b, &c, nullptr)) / libccd::scale;
}

// Pairs on which both disagree, by kind; and those on which one of both is wrong.
struct Disagreements {
  std::array<int, 8> all = {}, ours = {}, libccds = {};
  int unexplained = 0;  // ours wrong without a reason
  int astray = 0;       // libccd wrong beyond rounding and the end of its iteration

  void print(const std::string &what) const {
    int sum = 0;
    for (size_t k = 0; k < all.size(); ++k) {
      sum += all[k];
      if (all[k] == 0) continue;
      MESSAGE(what, ", ", std::string(kind_names[k]), ": ", all[k], " differ, ours wrong in ",
              ours[k], ", libccd in ", libccds[k]);
    }
    MESSAGE(what, ": ", sum, " of ", pairs, " differ; ours wrong without reason in ", unexplained,
            ", libccd astray in ", astray);
  }
};

struct Distances {
  double ours, libccds, third;
};

// The largest errors that are explained: of ours in this pair, and of libccd's, above the true one.
struct Explained {
  double ours, libccds;
};

void take_distance(Disagreements &d, int kind, const Distances &found, const Explained &explained) {
  const auto k = static_cast<size_t>(kind);
  const double our_error = std::abs(found.ours - found.third), more = found.libccds - found.third;
  if (std::abs(found.ours - found.libccds) > near_enough) ++d.all[k];
  if (our_error > near_enough) ++d.ours[k];
  if (std::abs(more) > near_enough) ++d.libccds[k];
  if (our_error > near_enough + explained.ours) ++d.unexplained;
  if (more > near_enough + explained.libccds || more < -near_enough) ++d.astray;
}

double longest_side(const Triangle &t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

// The error of closest_on_triangle() on a narrow triangle, m: its weights are quotients of products
// of four lengths, so that their rounding is divided by the square of height over longest side.
double narrow_error(const Triangle &t) {
  const double longest = longest_side(t);
  const double height = (t[1] - t[0]).cross(t[2] - t[0]).norm() / (longest * longest);
  return longest * std::min(1.0, 1e-16 / (height * height));
}

// closest_of_segments() takes these as parallel.
bool are_parallel(const Segment &a, const Segment &b) {
  const Vec3 u = a[1] - a[0], v = b[1] - b[0];
  return u.cross(v).norm() < 1.01e-6 * u.norm() * v.norm();
}

// Takes crossings on which both disagree. `apart` is the distance of pairs that do not cross,
// `deep` the depth of pairs that do, and negative with a separating axis.
void take_crossing(Disagreements &d, int kind, bool ours, bool theirs,
                   const std::function<double()> &apart, const std::function<double()> &deep) {
  if (ours == theirs) return;
  const auto k = static_cast<size_t>(kind);
  ++d.all[k];
  const double depth = deep();
  if (ours ? std::abs(depth) <= barely : apart() <= barely) return;
  const bool right = ours ? depth > barely : depth < -barely;
  ++(right ? d.libccds : d.ours)[k];
  ++(right ? d.astray : d.unexplained);
}

// Ties, as on the lattice, lead libccd's GJK astray: in 27 of a million pairs of triangles.
void check(const Disagreements &d) {
  CHECK_EQ(d.unexplained, 0);
  CHECK_LE(d.astray, std::max(3, pairs / 10000));
}

}  // namespace

TEST_CASE("distances_of_points_and_triangles_are_those_of_libccd") {
  Points points(11);
  Disagreements d;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto t = points.points<3>();
    const Vec3 p = points.point();
    const double ours = std::sqrt(closest_on_triangle(p, t[0], t[1], t[2]).distance2);
    take_distance(d, points.kind(), {ours, libccd_distance(p, t), third_distance(p, t)},
                  {narrow_error(t), 0});
  }
  d.print("point and triangle");
  CHECK_EQ(d.unexplained, 0);
  CHECK_EQ(d.astray, 0);
}

TEST_CASE("distances_of_segments_are_those_at_which_capsules_of_libccd_meet") {
  Points points(12);
  Disagreements d;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto a = points.points<2>(), b = points.points<2>();
    const double ours = std::sqrt(closest_of_segments(a[0], a[1], b[0], b[1]).distance2);
    const double length = std::max((a[1] - a[0]).norm(), (b[1] - b[0]).norm());
    const double parallel = are_parallel(a, b) ? 1e-6 * length : 0;
    take_distance(d, points.kind(), {ours, libccd_distance(a, b), third_distance(a, b)},
                  {parallel, 1e-5});
  }
  d.print("two segments");
  check(d);
}

TEST_CASE("triangles_cross_where_libccd_finds_that_they_meet") {
  Points points(13);
  Disagreements d;
  int met = 0;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto a = points.points<3>(), b = points.points<3>();
    const bool ours = triangles_cross(a, b);
    met += ours ? 1 : 0;
    take_crossing(
        d, points.kind(), ours, libccd_meet(a, b), [&] { return third_distance(a, b); },
        [&] { return depth(a, b); });
  }
  d.print("two triangles");
  check(d);
  CHECK_GT(met, pairs / 10);
}

TEST_CASE("segments_cross_triangles_where_libccd_finds_that_they_meet") {
  Points points(14);
  Disagreements d;
  int met = 0;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto t = points.points<3>();
    const auto s = points.points<2>();
    const bool ours = segment_crosses_triangle(s[0], s[1], t[0], t[1], t[2]);
    met += ours ? 1 : 0;
    const Triangle flat = {s[0], s[1], s[1]};
    take_crossing(
        d, points.kind(), ours, libccd_meet(s, t), [&] { return third_distance(flat, t); },
        [&] { return depth(s, t); });
  }
  d.print("segment and triangle");
  check(d);
  CHECK_GT(met, pairs / 10);
}
#endif
