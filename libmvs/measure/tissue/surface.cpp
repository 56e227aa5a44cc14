// Areas and normals of triangles and nodes.
#include "measure/tissue/surface.h"

#include <Eigen/Geometry>

namespace mvs::core {
namespace {

void normalise(Vec3 &v) {
  const double length = v.norm();
  if (length > 0) v /= length;
}

}  // namespace

Surface surface_of(const std::vector<Tri> &triangles, const std::vector<Vec3> &x) {
  Surface surface;
  surface.area.reserve(triangles.size());
  surface.normal.reserve(triangles.size());
  surface.node_normal.assign(x.size(), Vec3::Zero());
  for (const Tri &t : triangles) {
    Vec3 normal = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (const uint32_t node : t) surface.node_normal[node] += normal;
    surface.area.push_back(0.5 * normal.norm());
    normalise(normal);
    surface.normal.push_back(normal);
  }
  for (Vec3 &normal : surface.node_normal) normalise(normal);
  return surface;
}

}  // namespace mvs::core
