// Two triangles for each edge of the annulus.
#include "measure/orifice/wall.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/intersect.h"

namespace mvs::core::orifice {
namespace {

// How far the wall extends, in radii of the sheet: the segments end at centres of spheres through
// points that hardly differ from a plane or a circle, and these may be anywhere.
constexpr double wall_of_radius = 100;

}  // namespace

Vec3 outwards_at(const Vec3 &p) {
  return Vec3(p.x(), p.y(), 0).normalized();
}

Wall::Wall(const Sheet &sheet) {
  const std::vector<Vec3> &annulus = sheet.annulus.points();
  const auto n = static_cast<uint32_t>(annulus.size());
  x_ = annulus;
  low_ = high_ = annulus[0].z();
  for (uint32_t k = 0; k < n; ++k) {
    x_.push_back(annulus[k] + wall_of_radius * sheet.radius * outwards_at(annulus[k]));
    low_ = std::min(low_, annulus[k].z());
    high_ = std::max(high_, annulus[k].z());
    const uint32_t next = (k + 1) % n;
    triangles_.push_back({k, next, n + next});
    triangles_.push_back({k, n + next, n + k});
  }
  tree_.emplace(triangles_, x_);
}

bool Wall::is_crossed(const Vec3 &p, const Vec3 &q) const {
  // the wall runs level, so that most segments are above or below all of it
  if (std::min(p.z(), q.z()) > high_ || std::max(p.z(), q.z()) < low_) return false;
  Aabb box;
  box.add(p);
  box.add(q);
  bool crossed = false;
  tree_->for_overlapping(box, [&](uint32_t k) {
    const Tri &t = triangles_[k];
    crossed = crossed || segment_crosses_triangle(p, q, x_[t[0]], x_[t[1]], x_[t[2]]);
  });
  return crossed;
}

}  // namespace mvs::core::orifice
