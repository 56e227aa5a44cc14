// The atrial side of the annulus, and reorientation of triangles towards it.
#include "model/orientation.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "model/checks/check.h"

namespace mvs::core {
namespace {

// A sheet whose depth is below this share of the annulus size does not show the side of the
// ventricle.
constexpr double flat = 1e-3;

Vec3 mean_of_heads(const Valve &valve) {
  Vec3 sum = Vec3::Zero();
  for (const Head &head : valve.heads) sum += valve.rest[head.node];
  return sum / static_cast<double>(valve.heads.size());
}

Vec3 mean_of_sheet(const Valve &valve) {
  Vec3 sum = Vec3::Zero();
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) sum += valve.rest[node];
  }
  return sum / (3.0 * static_cast<double>(valve.triangles.size()));
}

bool in_range(const Valve &valve) {
  const auto exists = [&](uint32_t node) { return node < valve.rest.size(); };
  const auto have_nodes = [&](const Tri &t) {
    return exists(t[0]) && exists(t[1]) && exists(t[2]);
  };
  const auto has_node = [&](const Head &head) { return exists(head.node); };
  const std::vector<Tri> &triangles = valve.triangles;
  const std::vector<uint32_t> &annulus = valve.annulus;
  const std::vector<Head> &heads = valve.heads;
  return std::all_of(triangles.begin(), triangles.end(), have_nodes) &&
         std::all_of(annulus.begin(), annulus.end(), exists) &&
         std::all_of(heads.begin(), heads.end(), has_node);
}

}  // namespace

Vec3 annulus_centre(const Valve &valve) {
  Vec3 sum = Vec3::Zero();
  for (const uint32_t node : valve.annulus) sum += valve.rest[node];
  return sum / static_cast<double>(valve.annulus.size());
}

Vec3 annulus_area(const Valve &valve, const Vec3 &centre) {
  Vec3 area = Vec3::Zero();
  for (size_t k = 0; k < valve.annulus.size(); ++k) {
    const Vec3 p = valve.rest[valve.annulus[k]] - centre;
    const Vec3 q = valve.rest[valve.annulus[(k + 1) % valve.annulus.size()]] - centre;
    area += 0.5 * p.cross(q);
  }
  return area;
}

AtrialSide atrial_side(const Valve &valve) {
  AtrialSide side;
  if (valve.annulus.empty() || valve.triangles.empty()) return side;
  side.centre = annulus_centre(valve);
  const Vec3 area = annulus_area(valve, side.centre);
  const Vec3 ventricle = valve.heads.empty() ? mean_of_sheet(valve) : mean_of_heads(valve);
  const double depth = area.normalized().dot(side.centre - ventricle);
  if (std::abs(depth) > flat * std::sqrt(area.norm())) {
    side.axis = (depth > 0 ? 1 : -1) * area.normalized();
  }
  return side;
}

std::vector<Vec3> faced_areas(const Valve &valve, const std::vector<Side> &sides,
                              const Winding &winding) {
  const std::vector<uint8_t> in_annulus = marks_of(valve.annulus, valve.rest.size());
  const Vec3 centre = atrial_side(valve).centre;
  std::vector<Vec3> areas(winding.component_count, Vec3::Zero());
  for_each_edge(sides, [&](size_t first, size_t last) {
    const Side &side = sides[first];
    if (last - first != 1 || !in_annulus[side.edge[0]] || !in_annulus[side.edge[1]]) return;
    const Vec3 p = valve.rest[side_from(valve.triangles, side)] - centre;
    const Vec3 q = valve.rest[side_to(valve.triangles, side)] - centre;
    areas[winding.component[side.triangle]] += 0.5 * p.cross(q);
  });
  return areas;
}

void orient(Valve &valve) {
  if (!in_range(valve)) return;  // find_faults reports the fault
  const Winding winding = find_winding(valve.triangles, sorted_sides(valve.triangles));
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    if (winding.against[t]) std::swap(valve.triangles[t][1], valve.triangles[t][2]);
  }
  const Vec3 axis = atrial_side(valve).axis;
  const std::vector<Vec3> areas = faced_areas(valve, sorted_sides(valve.triangles), winding);
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const bool turn = areas[winding.component[t]].dot(axis) < 0;
    if (turn) std::swap(valve.triangles[t][1], valve.triangles[t][2]);
  }
}

}  // namespace mvs::core
