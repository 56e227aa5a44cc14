// Inserts points one after the other: removes the faces that a point sees and joins it to their
// horizon.
#include "geometry/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "geometry/intersect.h"

namespace mvs::core {
namespace {

template <typename Measure>
uint32_t farthest_by(const std::vector<Vec3> &points, Measure measure) {
  uint32_t best = 0;
  double most = -1;
  for (uint32_t k = 0; k < points.size(); ++k) {
    const double value = measure(points[k]);
    if (value > most) {
      most = value;
      best = k;
    }
  }
  return best;
}

// Returns four points far from one plane, positively oriented; null if all lie in one plane.
std::optional<std::array<uint32_t, 4>> first_tetrahedron(const std::vector<Vec3> &p,
                                                         double thinnest) {
  if (p.size() < 4) return {};
  const uint32_t a = farthest_by(p, [&](const Vec3 &q) { return (q - p[0]).squaredNorm(); });
  const uint32_t b = farthest_by(p, [&](const Vec3 &q) { return (q - p[a]).squaredNorm(); });
  const Vec3 axis = p[b] - p[a];
  const uint32_t c =
      farthest_by(p, [&](const Vec3 &q) { return axis.cross(q - p[a]).squaredNorm(); });
  const Vec3 n = axis.cross(p[c] - p[a]);
  const uint32_t d = farthest_by(p, [&](const Vec3 &q) { return std::abs(n.dot(q - p[a])); });
  const double extent = axis.norm();
  if (!(n.norm() > thinnest * extent * extent)) return {};
  if (!(std::abs(n.dot(p[d] - p[a])) > thinnest * extent * n.norm())) return {};
  if (n.dot(p[d] - p[a]) > 0) return {{a, c, b, d}};
  return {{a, b, c, d}};
}

// The face sees a point if the point is strictly on its outer side.
bool sees(const std::vector<Vec3> &p, const Tri &face, uint32_t k) {
  return orient3d_sign(p[face[0]], p[face[1]], p[face[2]], p[k]) > 0;
}

void insert(const std::vector<Vec3> &p, uint32_t k, std::vector<Tri> &faces) {
  std::set<Edge> sides;  // of the faces that see the point
  std::vector<Tri> kept;
  for (const Tri &face : faces) {
    if (!sees(p, face, k)) {
      kept.push_back(face);
      continue;
    }
    for (uint32_t s = 0; s < 3; ++s) sides.insert({face[s], face[(s + 1) % 3]});
  }
  if (kept.size() == faces.size()) return;
  for (const auto &[a, b] : sides) {
    if (!sides.contains({b, a})) kept.push_back({a, b, k});
  }
  faces.swap(kept);
}

}  // namespace

ConvexHull convex_hull(const std::vector<Vec3> &points, double thinnest) {
  const auto first = first_tetrahedron(points, thinnest);
  if (!first) return {};
  const auto &[a, b, c, d] = *first;
  ConvexHull hull;
  // d is below a b c, so that the normal of a b c points outwards
  hull.faces = {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
  for (uint32_t k = 0; k < points.size(); ++k) {
    if (k != a && k != b && k != c && k != d) insert(points, k, hull.faces);
  }
  for (const Tri &face : hull.faces) {
    hull.corners.insert(hull.corners.end(), face.begin(), face.end());
  }
  std::sort(hull.corners.begin(), hull.corners.end());
  hull.corners.erase(std::unique(hull.corners.begin(), hull.corners.end()), hull.corners.end());
  return hull;
}

// Each edge is a side of two faces, once in each direction.
HullEdges hull_edges(const std::vector<Tri> &faces, size_t points) {
  HullEdges edges;
  if (faces.empty()) return edges;
  edges.first = faces[0][0];
  edges.start.assign(points + 1, 0);
  for (const Tri &face : faces) {
    for (const uint32_t k : face) ++edges.start[k + 1];
  }
  for (size_t k = 0; k < points; ++k) edges.start[k + 1] += edges.start[k];
  std::vector<uint32_t> next(edges.start.begin(), edges.start.end() - 1);
  edges.to.resize(3 * faces.size());
  for (const Tri &face : faces) {
    for (uint32_t s = 0; s < 3; ++s) edges.to[next[face[s]]++] = face[(s + 1) % 3];
  }
  return edges;
}

uint32_t lowest_point(std::span<const Vec3> points, const Vec3 &n) {
  uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t k = 0; k < points.size(); ++k) {
    const double along = n.dot(points[k]);
    if (along < least) {
      least = along;
      best = k;
    }
  }
  return best;
}

uint32_t lowest_corner(const HullEdges *edges, std::span<const Vec3> points, const Vec3 &n,
                       uint32_t from) {
  if (!edges || edges->empty()) return lowest_point(points, n);
  uint32_t best = from;
  double least = n.dot(points[from]);
  for (;;) {
    const uint32_t at = best;
    for (uint32_t e = edges->start[at]; e < edges->start[at + 1]; ++e) {
      const double along = n.dot(points[edges->to[e]]);
      if (along < least) {
        least = along;
        best = edges->to[e];
      }
    }
    if (best == at) return best;
  }
}

}  // namespace mvs::core
