// Triangles near each vertex by a bounding volume hierarchy.
#include "patient/surface/facing_area.h"

#include <cmath>

#include "geometry/triangle_bvh.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

constexpr double opposite = -0.5, ahead = 0.6;  // cosines

}  // namespace

double facing_share(const LeafletSheet &sheet, double reach) {
  std::vector<Vec3> normals = area_normals(sheet.x, sheet.triangles);
  std::vector<double> area(sheet.x.size(), 0);
  double whole = 0;
  for (const Tri &t : sheet.triangles) {
    const double third = triangle_area(sheet.x, t) / 3;
    for (const uint32_t i : t) area[i] += third;
    whole += 3 * third;
  }
  const TriangleBvh tree(sheet.triangles, sheet.x);
  double facing = 0;
  for (size_t i = 0; i < sheet.x.size(); ++i) {
    if (!(area[i] > 0)) continue;
    const Vec3 &p = sheet.x[i];
    const Vec3 normal = normals[i].normalized();
    double limit2 = reach * reach;
    bool found = false;
    tree.visit_near(p, limit2, [&](uint32_t t) {
      if (area_normal(sheet.x, sheet.triangles[t]).normalized().dot(normal) > opposite) return;
      const TrianglePoint on = tree.closest_on(t, p);
      const double distance = std::sqrt(on.distance2);
      if (distance > reach) return;
      if ((tree.point_at(t, on.weight) - p).dot(normal) < ahead * distance) return;
      found = true;
      limit2 = -1;  // one is enough
    });
    if (found) facing += area[i];
  }
  return whole > 0 ? facing / whole : 0;
}

}  // namespace mvs::core
