// A uniform grid of the triangles of a mesh that changes: which triangles a triangle may cross.
#pragma once

#include <algorithm>

#include "geometry/aabb.h"

namespace mvs::core {

class TriangleGrid {
 public:
  // The triangles of a mesh in cells of about `cell` (m), at most about 2^18 of them. Boxes outside
  // that of the points count to the cells at its sides.
  TriangleGrid(const std::vector<Vec3> &x, const std::vector<Tri> &triangles, double cell);

  void insert(uint32_t triangle, const Aabb &box);
  void remove(uint32_t triangle);

  // Calls visit(triangle, box) once for each triangle whose box overlaps `box`, until one returns
  // true; returns whether one did.
  template <typename Visit>
  bool any_near(const Aabb &box, Visit &&visit) const {
    const Range asked = range_of(box);
    for (uint32_t i = asked.low[0]; i <= asked.high[0]; ++i) {
      for (uint32_t j = asked.low[1]; j <= asked.high[1]; ++j) {
        for (uint32_t k = asked.low[2]; k <= asked.high[2]; ++k) {
          for (const uint32_t t : cells_[index(i, j, k)]) {
            const Entry &entry = entries_[t];
            // of the cells that both are in, the first one reports
            if (std::max(asked.low[0], entry.range.low[0]) != i ||
                std::max(asked.low[1], entry.range.low[1]) != j ||
                std::max(asked.low[2], entry.range.low[2]) != k) {
              continue;
            }
            if (entry.box.overlaps(box) && visit(t, entry.box)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  struct Range {
    std::array<uint32_t, 3> low{}, high{};
  };
  struct Entry {
    Aabb box;
    Range range;
  };
  size_t index(uint32_t i, uint32_t j, uint32_t k) const {
    return (static_cast<size_t>(i) * count_[1] + j) * count_[2] + k;
  }
  Range range_of(const Aabb &box) const;

  Vec3 origin_;
  double cell_;
  std::array<uint32_t, 3> count_{};
  std::vector<std::vector<uint32_t>> cells_;
  std::vector<Entry> entries_;  // of each triangle
};

// Whether two triangles of a mesh cross (geometry/intersect.h), after a quick test in rounded
// arithmetic that recognises most of those that do not.
bool mesh_triangles_cross(const std::vector<Vec3> &x, const Tri &first, const Tri &second);

}  // namespace mvs::core
