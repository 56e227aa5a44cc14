// Collects the triangles around each node, and looks at those alone while it stays near.
#include "measure/orifice/rail.h"

#include <algorithm>
#include <cmath>

#include "measure/tissue/surface.h"

namespace mvs::core::orifice {
namespace {

// Radius around a node in which the triangles nearest to it are collected, in spacings of samples.
constexpr double around_of_grain = 0.25;

}  // namespace

Rail::Rail(const Sheet &sheet, const TriangleBvh &sheet_tree)
    : mesh(sheet.mesh),
      grain(sheet.grain),
      tree(sheet_tree),
      rim_edges(as_triangles(sheet.rim)),
      rim_tree(rim_edges, mesh.x),
      normal(surface_of(mesh.triangles, mesh.x).node_normal) {}

Vec3 Rail::normal_at(uint32_t triangle, const Vec3 &p) const {
  const TrianglePoint where = tree.closest_on(triangle, p);
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) sum += where.weight[k] * normal[mesh.triangles[triangle][k]];
  return sum;
}

// Lists the triangles of a tree whose boxes are within a distance of the centre.
void RailSearch::collect(const TriangleBvh &tree, double distance, Around &around) {
  const double limit = (1 + 1e-9) * distance, limit2 = limit * limit;
  around.triangles.clear();
  tree.visit_near(around.centre, limit2, [&](uint32_t t) {
    if (tree.box_of(t).distance2(around.centre) <= limit2) around.triangles.push_back(t);
  });
}

TriangleBvh::Hit RailSearch::nearest(uint32_t v, const Vec3 &p) {
  Around &around = around_[v];
  const double radius = around_of_grain * rail_.grain;
  if (nearest_[v] == none) nearest_[v] = rail_.tree.closest(p).triangle;
  if (!((p - around.centre).squaredNorm() <= radius * radius)) {
    // at a distance d from the centre, the sheet is within d + radius of points around it, whose
    // closest triangles are within d + 2 radius of the centre
    const double d = std::sqrt(rail_.tree.closest_on(nearest_[v], p).distance2);
    around.centre = p;
    collect(rail_.tree, d + 2 * radius, around);
  }
  ClosestSoFar best(rail_.tree, p);
  best.look_at(nearest_[v]);
  for (const uint32_t t : around.triangles) best.look_at(t);
  TriangleBvh::Hit hit = best.hit();
  nearest_[v] = hit.triangle;
  return hit;
}

bool RailSearch::is_on_rim(uint32_t v, const Vec3 &p) {
  Around &around = around_rim_[v];
  const double radius = around_of_grain * rail_.grain, on = 1e-3 * rail_.grain;
  if (!((p - around.centre).squaredNorm() <= radius * radius)) {
    around.centre = p;
    collect(rail_.rim_tree, radius + on, around);
  }
  return std::any_of(around.triangles.begin(), around.triangles.end(), [&](uint32_t t) {
    return rail_.rim_tree.closest_on(t, p).distance2 < on * on;
  });
}

}  // namespace mvs::core::orifice
