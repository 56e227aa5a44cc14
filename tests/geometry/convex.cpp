// Distances of convex hulls against brute force over their faces and edges, and hulls of points
// against the definition of a hull.
#include "geometry/convex_distance.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "geometry/convex_hull.h"
#include "geometry/distance.h"
#include "geometry/intersect.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

constexpr double everywhere = 1e300;

class Numbers {
 public:
  explicit Numbers(uint64_t seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 vector(double size) {
    const double x = (*this)(-size, size), y = (*this)(-size, size), z = (*this)(-size, size);
    return {x, y, z};
  }
  std::vector<Vec3> cloud(size_t count, const Vec3 &around, double size) {
    std::vector<Vec3> points;
    for (size_t k = 0; k < count; ++k) points.push_back(around + vector(size));
    return points;
  }

 private:
  std::mt19937_64 engine_;
};

// The distance of a hull's surface and a triangle that do not cross, over all pairs of features.
double distance_by_pairs(const std::vector<Vec3> &a, const std::array<Vec3, 3> &t) {
  double least = everywhere;
  for (const Tri &face : convex_hull(a).faces) {
    const Vec3 &p = a[face[0]], &q = a[face[1]], &r = a[face[2]];
    for (int k = 0; k < 3; ++k) {
      least = std::min(least, closest_on_triangle(t[k], p, q, r).distance2);
      least = std::min(least, segment_triangle_distance2(t[k], t[(k + 1) % 3], p, q, r));
    }
    for (int k = 0; k < 3; ++k)
      least = std::min(least, closest_on_triangle(a[face[k]], t[0], t[1], t[2]).distance2);
  }
  return std::sqrt(least);
}

bool cross(const std::vector<Vec3> &a, const std::array<Vec3, 3> &t) {
  for (const Tri &face : convex_hull(a).faces) {
    if (triangles_cross({a[face[0]], a[face[1]], a[face[2]]}, t)) return true;
  }
  return false;
}

// A box, turned by a rotation of exact entries, so that its faces and edges are often parallel to
// those of another.
std::vector<Vec3> box(const Vec3 &centre, const Vec3 &half) {
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int k = 0; k < 8; ++k)
    corners.push_back(centre +
                      half.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return corners;
}

// Closest points and weights agree with the distance, and a plane confirms it.
void check_found(const ConvexDistance &found, std::span<const Vec3> a, std::span<const Vec3> b) {
  Vec3 apart = Vec3::Zero();
  double sum = 0;
  for (uint32_t k = 0; k < found.count; ++k) {
    CHECK(found.weight[k] > 0);
    sum += found.weight[k];
    apart += found.weight[k] * (a[found.first[k]] - b[found.second[k]]);
  }
  CHECK(sum == about(1, 1e-14));
  // positions of 1e-2 m and their rounding, over the heights of the triangles
  CHECK((apart - found.apart).norm() <= 1e-13);
  // the gap of the plane is the distance, up to the square of the error of its direction
  const double gap = plane_gap(a, b, found.apart / found.distance);
  CHECK(gap <= found.distance + 1e-15);
  CHECK(gap >= found.distance - 1e-13);
}

}  // namespace

TEST_CASE("the_distance_of_hull_and_triangle_is_that_of_their_nearest_features") {
  Numbers random(24);
  int apart = 0;
  for (int pair = 0; pair < 3000; ++pair) {
    CAPTURE(pair);
    const size_t corners = 4 + pair % 20;
    const std::vector<Vec3> hull = random.cloud(corners, Vec3::Zero(), 5e-3);
    const std::vector<Vec3> other = random.cloud(3, random.vector(8e-3), 2e-3);
    const std::array<Vec3, 3> t = {other[0], other[1], other[2]};
    const ConvexDistance found = convex_distance(hull, t, everywhere);
    const double wanted = distance_by_pairs(hull, t);
    if (found.count == 0) {
      // the triangle crosses the hull or is inside of it
      const bool is_inside = plane_gap(hull, t, (t[0] - Vec3::Zero()).normalized()) < 0;
      CHECK((cross(hull, t) || is_inside));
      continue;
    }
    ++apart;
    CHECK_FALSE(cross(hull, t));
    CHECK(std::abs(found.distance - wanted) <= 1e-13);
    check_found(found, hull, t);
  }
  CHECK(apart > 1000);
}

TEST_CASE("parallel_faces_and_edges_have_their_distance") {
  Numbers random(7);
  for (int pair = 0; pair < 500; ++pair) {
    CAPTURE(pair);
    const std::vector<Vec3> a = box(Vec3::Zero(), Vec3(4e-3, 2e-3, 1e-3));
    const Vec3 corner = random.vector(5e-3);
    const double gap = random(1e-6, 1e-3);
    const Vec3 low(corner.x(), corner.y(), 1e-3 + gap);
    const std::array<Vec3, 3> t = {low, low + Vec3(2e-3, 0, 0), low + Vec3(0, 3e-3, 0)};
    const ConvexDistance found = convex_distance(a, t, everywhere);
    CHECK(found.distance == about(distance_by_pairs(a, t), 1e-12));
    check_found(found, a, t);
  }
}

TEST_CASE("a_search_stops_at_its_cutoff_and_nowhere_nearer") {
  Numbers random(3);
  for (int pair = 0; pair < 1000; ++pair) {
    const std::vector<Vec3> a = random.cloud(30, Vec3::Zero(), 2e-3);
    const std::vector<Vec3> b = random.cloud(3, random.vector(8e-3), 1e-3);
    const double whole = convex_distance(a, b, everywhere).distance;
    for (const double cutoff : {0.5 * whole, 0.999 * whole, 1.001 * whole}) {
      const ConvexDistance found = convex_distance(a, b, cutoff);
      if (found.is_beyond) {
        CHECK(cutoff < whole);
        CHECK(plane_gap(a, b, found.apart.normalized()) > cutoff);
      } else {
        CHECK(found.distance == whole);
      }
    }
  }
}

TEST_CASE("hulls_are_apart_by_less_than_their_distance_and_by_no_more") {
  Numbers random(5);
  int met = 0;
  for (int pair = 0; pair < 2000; ++pair) {
    const size_t corners = 1 + pair % 8;
    const std::vector<Vec3> a = random.cloud(corners, Vec3::Zero(), 2e-3);
    const std::vector<Vec3> b = random.cloud(1 + pair % 3, random.vector(2e-3), 1e-3);
    const double whole = convex_distance(a, b, everywhere).distance;
    met += whole == 0;
    // above the rounding of positions, and below any of these distances
    for (const Vec3 &guess : {Vec3(Vec3::Zero()), random.vector(1)}) {
      CHECK_FALSE(are_apart(a, b, whole * (1 + 1e-9) + 1e-12, guess));
      if (whole > 0) CHECK(are_apart(a, b, whole * (1 - 1e-9), guess));
    }
  }
  CHECK(met > 20);
}

TEST_CASE("points_and_segments_are_hulls_too") {
  const std::vector<Vec3> point = {Vec3(0, 0, 5e-3)};
  const std::vector<Vec3> segment = {Vec3(-1e-3, 0, 2e-3), Vec3(1e-3, 0, 2e-3)};
  const std::vector<Vec3> other = {Vec3(0, -1e-3, 0), Vec3(0, 1e-3, 0)};
  CHECK(convex_distance(point, segment, 1).distance == about(3e-3));
  const ConvexDistance across = convex_distance(segment, other, 1);
  CHECK(across.distance == about(2e-3));
  CHECK(across.apart.z() == about(2e-3));
  CHECK(convex_distance(segment, segment, 1).count == 0);
}

TEST_CASE("a_hull_is_closed_and_has_all_points_inside") {
  Numbers random(11);
  for (int cloud = 0; cloud < 100; ++cloud) {
    CAPTURE(cloud);
    std::vector<Vec3> points = random.cloud(4 + cloud, Vec3::Zero(), 1e-2);
    // points on faces and edges, and twice the same
    if (cloud % 3 == 0) points = box(random.vector(1e-2), Vec3(1e-3, 2e-3, 3e-3));
    if (cloud % 6 == 0) points.push_back(0.5 * (points[0] + points[1]));
    if (cloud % 6 == 0) points.push_back(points[2]);
    const ConvexHull hull = convex_hull(points);
    std::map<Edge, int> sides;
    for (const Tri &face : hull.faces) {
      for (uint32_t k = 0; k < 3; ++k) ++sides[{face[k], face[(k + 1) % 3]}];
      for (const Vec3 &p : points)
        CHECK(orient3d_sign(points[face[0]], points[face[1]], points[face[2]], p) <= 0);
    }
    for (const auto &[side, count] : sides) {
      CHECK(count == 1);
      CHECK(sides.contains({side[1], side[0]}));
    }
    // Euler: triangles that close a sphere
    CHECK(hull.faces.size() == 2 * hull.corners.size() - 4);
    if (cloud % 3 == 0) CHECK(hull.corners.size() == 8);
  }
}

TEST_CASE("flat_clouds_have_no_hull") {
  Numbers random(5);
  std::vector<Vec3> flat = random.cloud(20, Vec3::Zero(), 1e-2);
  for (Vec3 &p : flat) p.z() = 1e-9 * p.x();
  CHECK(convex_hull(flat).faces.empty());
  CHECK(convex_hull({Vec3::Zero(), Vec3::UnitX()}).faces.empty());
  CHECK(convex_hull(std::vector<Vec3>(5, Vec3::UnitX())).faces.empty());
}
