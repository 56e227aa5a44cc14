// Areas and normals of the deformed sheet.
#pragma once

#include <algorithm>
#include <vector>

#include "model/model.h"

namespace mvs::core {

struct Surface {
  std::vector<double> area;       // m2 per triangle
  std::vector<Vec3> normal;       // unit, per triangle, into the atrium; zero where it has no area
  std::vector<Vec3> node_normal;  // unit, per node: by the areas around it; zero off the sheet
};
Surface surface_of(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

inline bool share_a_node(const Tri &l, const Tri &r) {
  return std::any_of(l.begin(), l.end(),
                     [&](uint32_t n) { return n == r[0] || n == r[1] || n == r[2]; });
}

}  // namespace mvs::core
