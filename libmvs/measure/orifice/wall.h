// The wall around the valve as a surface: from the annulus straight outwards.
#pragma once

#include <optional>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "measure/orifice/samples.h"

namespace mvs::core::orifice {

// The direction in which the wall leaves the annulus at one of its points.
Vec3 outwards_at(const Vec3 &p);

class Wall {
 public:
  explicit Wall(const Sheet &sheet);
  Wall(const Wall &) = delete;  // the tree refers to the other members
  Wall &operator=(const Wall &) = delete;

  // Whether a segment meets the wall.
  bool is_crossed(const Vec3 &p, const Vec3 &q) const;

 private:
  std::vector<Vec3> x_;
  std::vector<Tri> triangles_;
  double low_, high_;  // m, heights of the annulus and of the wall
  std::optional<TriangleBvh> tree_;
};

}  // namespace mvs::core::orifice
