// Rays towards the atrium, then kinds that spread from side to side.
#include "patient/skin/side_kinds.h"

#include <algorithm>
#include <map>

#include "geometry/triangle_bvh.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

// Rays towards the atrium from each side.
constexpr size_t most_rays = 1000;
// Median thickness, by which a ray begins outside of the tissue.
constexpr double clear_of_skin = 0.1;
// Whether nothing lies on the way of a ray.
bool is_free(const TriangleBvh &tree, const LeafletSheet &skin, const Vec3 &from, const Vec3 &way,
             double length) {
  Aabb box;
  box.add(from);
  box.add(from + length * way);
  bool is_hit = false;
  tree.for_overlapping(box, [&](uint32_t t) {
    const Tri &tri = skin.triangles[t];
    is_hit = is_hit || ray_distance(from, way, skin.x[tri[0]], skin.x[tri[1]], skin.x[tri[2]]) >= 0;
  });
  return !is_hit;
}

// For each side the share of its area that is seen from the atrium.
std::vector<double> shares_seen(const Skin &of, const std::vector<uint32_t> &side_of,
                                const Vec3 &into_atrium) {
  const LeafletSheet &skin = of.sheet;
  constexpr double farthest = 50e-3;  // m: leaflets lie closer to each other
  const TriangleBvh tree(skin.triangles, skin.x);
  std::vector<std::vector<uint32_t>> triangles(side_of.size());
  for (uint32_t t = 0; t < side_of.size(); ++t) {
    if (side_of[t] != none) triangles[side_of[t]].push_back(t);
  }
  std::vector<double> shares(side_of.size(), 0);
  for (size_t side = 0; side < triangles.size(); ++side) {
    const size_t stride = triangles[side].size() / most_rays + 1;
    double seen = 0, all = 0;
    for (size_t k = 0; k < triangles[side].size(); k += stride) {
      const uint32_t t = triangles[side][k];
      const Tri &tri = skin.triangles[t];
      const Vec3 centre = (skin.x[tri[0]] + skin.x[tri[1]] + skin.x[tri[2]]) / 3;
      const Vec3 from = centre + clear_of_skin * of.thickness * of.normal[t];
      const double area = triangle_area(skin.x, tri);
      all += area;
      if (is_free(tree, skin, from, into_atrium, farthest)) seen += area;
    }
    if (all > 0) shares[side] = seen / all;
  }
  return shares;
}

// What lies behind a side: areas by the side there, all of them and those behind one leaflet.
struct Behind {
  std::map<uint32_t, double> all, one_leaflet;  // m2
  double area = 0;
};

std::vector<Behind> areas_behind(const LeafletSheet &skin, const std::vector<uint32_t> &side_of,
                                 const std::vector<TissueBehind> &behind, double thickness) {
  std::vector<Behind> found(side_of.size());
  for (uint32_t t = 0; t < side_of.size(); ++t) {
    if (side_of[t] == none) continue;
    const uint32_t other = side_of[behind[t].triangle];
    if (other == none || other == side_of[t]) continue;
    const double part = triangle_area(skin.x, skin.triangles[t]);
    Behind &mine = found[side_of[t]];
    mine.area += part;
    mine.all[other] += part;
    if (behind[t].thickness <= one_leaflet * thickness) mine.one_leaflet[other] += part;
  }
  return found;
}

// Behind an atrial side lies a ventricular one; behind a ventricular one, within the thickness of
// one leaflet, an atrial one. Where two leaflets are one body, ventricular sides lie behind each
// other.
void spread_kinds(const std::vector<Behind> &behind, std::vector<SideKind> &kind) {
  const auto mostly = [&](const std::map<uint32_t, double> &areas, SideKind wanted, double whole) {
    double sum = 0;
    for (const auto &[other, area] : areas) {
      if (kind[other] == wanted) sum += area;
    }
    return sum > 0.5 * whole;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t side = 0; side < kind.size(); ++side) {
      if (kind[side] != SideKind::unknown || behind[side].area == 0) continue;
      if (mostly(behind[side].all, SideKind::atrial, behind[side].area)) {
        kind[side] = SideKind::ventricular;
      } else if (mostly(behind[side].one_leaflet, SideKind::ventricular, behind[side].area)) {
        kind[side] = SideKind::atrial;
      } else {
        continue;
      }
      changed = true;
    }
  }
}

}  // namespace

std::vector<SideKind> side_kinds(const Skin &skin, const std::vector<uint32_t> &side_of,
                                 const Vec3 &into_atrium) {
  const std::vector<Behind> behind = areas_behind(skin.sheet, side_of, skin.behind, skin.thickness);
  const std::vector<double> seen = shares_seen(skin, side_of, into_atrium);
  constexpr double clearly_more = 0.3;
  std::vector<SideKind> kind(seen.size(), SideKind::unknown);
  for (size_t side = 0; side < seen.size(); ++side) {
    if (behind[side].area > 0 && seen[side] > 0.5) kind[side] = SideKind::atrial;
  }
  spread_kinds(behind, kind);
  for (size_t side = 0; side < seen.size(); ++side) {
    if (kind[side] != SideKind::unknown || behind[side].area == 0) continue;
    double more = 0;
    for (const auto &[other, area] : behind[side].all) more += area * (seen[side] - seen[other]);
    if (more > clearly_more * behind[side].area) kind[side] = SideKind::atrial;
  }
  spread_kinds(behind, kind);
  return kind;
}

}  // namespace mvs::core
