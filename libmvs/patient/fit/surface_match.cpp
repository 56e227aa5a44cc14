// Closest points by a bounding volume hierarchy, among triangles with agreeing normals.
#include "patient/fit/surface_match.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/sides.h"
#include "patient/fit/closed_pieces.h"

namespace mvs::core {
namespace {

// Normals that agree: at most 75 degrees apart.
constexpr double least_cosine = 0.25;
// Points of the given surface that are matched: about four for each node of a fine valve.
constexpr size_t most_samples = 4000;
// m: below it the direction of a match is the normal of the surface.
constexpr double no_distance = 1e-6;

std::vector<Vec3> triangle_normals(const std::vector<Vec3> &x, const std::vector<Tri> &triangles) {
  std::vector<Vec3> normals;
  normals.reserve(triangles.size());
  for (const Tri &t : triangles) {
    normals.push_back(area_normal(x, t).normalized());
  }
  return normals;
}

std::vector<Vec3> point_normals(const std::vector<Vec3> &x, const std::vector<Tri> &triangles) {
  std::vector<Vec3> normals = area_normals(x, triangles);
  for (Vec3 &n : normals) n.normalize();
  return normals;
}

struct Nearest {
  uint32_t triangle = none;
  double distance2 = 1e300;
};
// The nearest triangle whose normal agrees; on equal distance the first.
Nearest nearest_facing(const TriangleBvh &tree, const std::vector<Vec3> &normals, const Vec3 &p,
                       const Vec3 &normal) {
  Nearest best;
  tree.visit_near(p, best.distance2, [&](uint32_t t) {
    if (normals[t].dot(normal) < least_cosine) return;
    const double distance2 = tree.closest_on(t, p).distance2;
    if (distance2 > best.distance2 || (distance2 == best.distance2 && t > best.triangle)) return;
    best = {t, distance2};
  });
  return best;
}

Vec3 direction_of(const Vec3 &way, const Vec3 &normal) {
  const double length = way.norm();
  return length > no_distance ? Vec3(way / length) : normal;
}

}  // namespace

SurfaceMatcher::SurfaceMatcher(const ClosedSurface &given, const Model &model,
                               const std::vector<Vec3> &x)
    : given_(given),
      tree_(given.triangles, given.points),
      normal_(triangle_normals(given.points, given.triangles)) {
  const double area = surface_area(given.points, given.triangles);
  const std::vector<uint8_t> used = vertex_marks(given.triangles, given.points.size());
  const size_t count = static_cast<size_t>(std::count(used.begin(), used.end(), 1));
  const size_t stride = count / most_samples + 1;
  size_t k = 0;
  for (uint32_t i = 0; i < used.size(); ++i) {
    if (used[i] && k++ % stride == 0) sample_.push_back(i);
  }
  sample_area_ = area / static_cast<double>(sample_.size());
  turn_pieces(model.valve.triangles, x);
}

// A piece faces the atrium the way in which its points lie nearer to tissue that faces so, by their
// squared distances.
void SurfaceMatcher::turn_pieces(const std::vector<Tri> &triangles, const std::vector<Vec3> &x) {
  const ClosedPieces pieces = closed_pieces(given_.points, given_.triangles);
  std::vector<uint32_t> piece_of_point(given_.points.size(), 0);
  for (size_t t = 0; t < normal_.size(); ++t) {
    if (pieces.turned[t]) normal_[t] = -normal_[t];
    for (const uint32_t i : given_.triangles[t]) piece_of_point[i] = pieces.of_triangle[t];
  }
  const TriangleBvh tree(triangles, x);
  const std::vector<Vec3> normals = triangle_normals(x, triangles);
  const std::vector<Vec3> at_points = given_point_normals();
  std::vector<double> gain(pieces.count, 0);  // m2, of turning
  for (const uint32_t i : sample_) {
    const Vec3 normal = at_points[i].normalized();
    const Nearest as_given = nearest_facing(tree, normals, given_.points[i], normal);
    const Nearest turned = nearest_facing(tree, normals, given_.points[i], -normal);
    if (as_given.triangle == none || turned.triangle == none) continue;
    gain[piece_of_point[i]] += as_given.distance2 - turned.distance2;
  }
  for (size_t t = 0; t < normal_.size(); ++t) {
    if (gain[pieces.of_triangle[t]] > 0) normal_[t] = -normal_[t];
  }
}

std::vector<Vec3> SurfaceMatcher::given_point_normals() const {
  std::vector<Vec3> normals(given_.points.size(), Vec3::Zero());
  for (size_t t = 0; t < given_.triangles.size(); ++t) {
    for (const uint32_t i : given_.triangles[t]) {
      normals[i] += triangle_area(given_.points, given_.triangles[t]) * normal_[t];
    }
  }
  return normals;
}

std::vector<SurfaceMatch> SurfaceMatcher::match(const Model &model,
                                                const std::vector<Vec3> &x) const {
  const std::vector<Tri> &triangles = model.valve.triangles;
  const std::vector<Vec3> at_nodes = point_normals(x, triangles);
  std::vector<SurfaceMatch> matches;
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (model.topology.node_kind[i] != NodeKind::leaflet) continue;
    const Nearest near = nearest_facing(tree_, normal_, x[i], at_nodes[i]);
    if (near.triangle == none) continue;
    const Vec3 q = tree_.point_at(near.triangle, tree_.closest_on(near.triangle, x[i]).weight);
    matches.push_back({{i, i, i},
                       {1, 0, 0},
                       q,
                       direction_of(x[i] - q, normal_[near.triangle]),
                       std::sqrt(near.distance2),
                       model.vertex_area[i]});
  }
  const TriangleBvh tree(triangles, x);
  const std::vector<Vec3> normals = triangle_normals(x, triangles);
  const std::vector<Vec3> given_normals = given_point_normals();
  for (const uint32_t i : sample_) {
    const Vec3 &p = given_.points[i];
    const Vec3 normal = given_normals[i].normalized();
    const Nearest near = nearest_facing(tree, normals, p, normal);
    if (near.triangle == none) continue;
    const TrianglePoint on = tree.closest_on(near.triangle, p);
    matches.push_back({triangles[near.triangle], on.weight, p,
                       direction_of(tree.point_at(near.triangle, on.weight) - p, normal),
                       std::sqrt(near.distance2), sample_area_});
  }
  return matches;
}

double rms_distance(const std::vector<SurfaceMatch> &matches) {
  double sum = 0, area = 0;
  for (const SurfaceMatch &m : matches) {
    sum += m.area * m.distance * m.distance;
    area += m.area;
  }
  return area > 0 ? std::sqrt(sum / area) : 1;
}

}  // namespace mvs::core
