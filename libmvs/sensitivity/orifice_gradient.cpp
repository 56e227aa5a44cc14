// First variation of the area of the orifice, carried from its rim to the nodes of the sheet.
#include "sensitivity/orifice_gradient.h"

#include <Eigen/Geometry>

#include "geometry/bvh.h"
#include "geometry/triangle_bvh.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

// Vertices at edges of one triangle.
std::vector<uint8_t> rim_of(const Orifice &orifice) {
  std::vector<uint8_t> is_rim(orifice.vertices.size(), 0);
  const std::vector<Side> sides = sorted_sides(orifice.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last != first + 1) return;
    for (const uint32_t v : sides[first].edge) is_rim[v] = 1;
  });
  return is_rim;
}

std::vector<Vec3> area_variation(const Orifice &orifice) {
  std::vector<Vec3> variation(orifice.vertices.size(), Vec3::Zero());
  const std::vector<Vec3> &y = orifice.vertices;
  for (const Tri &t : orifice.triangles) {
    const Vec3 twice = area_normal(y, t);
    const double size = twice.norm();
    if (size == 0) continue;
    for (int k = 0; k < 3; ++k) {
      variation[t[k]] += 0.5 / size * twice.cross(y[t[(k + 2) % 3]] - y[t[(k + 1) % 3]]);
    }
  }
  return variation;
}

}  // namespace

double orifice_area_gradient(const Model &model, const std::vector<Vec3> &x, const Orifice &orifice,
                             const BvhTopology *sheet, NodeField &g) {
  if (orifice.triangles.empty()) return 0;
  const TriangleBvh tree = sheet != nullptr ? TriangleBvh(model.valve.triangles, x, *sheet)
                                            : TriangleBvh(model.valve.triangles, x);
  const std::vector<uint8_t> is_rim = rim_of(orifice);
  const std::vector<Vec3> variation = area_variation(orifice);
  const double reach = model.valve.contact_thickness;
  uint32_t near = none;
  for (size_t v = 0; v < is_rim.size(); ++v) {
    if (!is_rim[v]) continue;
    const TriangleBvh::Hit hit = tree.closest(orifice.vertices[v], near);
    near = hit.triangle;
    // on the wall around the annulus, which stands
    if (hit.distance2 > reach * reach) continue;
    const TrianglePoint foot = tree.closest_on(hit.triangle, orifice.vertices[v]);
    for (size_t k = 0; k < 3; ++k) {
      g[model.valve.triangles[hit.triangle][k]] += foot.weight[k] * variation[v];
    }
  }
  return orifice.area;
}

}  // namespace mvs::core
