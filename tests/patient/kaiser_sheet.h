// The leaflets of a valve on a real annulus (alexkaiser/heart_valves), as a patient's sheet.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "model/sides.h"
#include "patient/leaflet_sheet.h"
#include "tests/model/real_valves.h"

namespace mvs::core::test {

struct KaiserSheet {
  LeafletSheet sheet;  // empty: no such file
  SheetRims rims;
  std::vector<Vec3> loaded, heads;  // loaded: the sheet under pressure in that model
};

// A few triangles hang slack as straight lines: a tenth of the way to the loaded shape gives them
// an area.
inline void open_flat_triangles(KaiserSheet &k) {
  std::vector<uint8_t> flat(k.sheet.x.size(), 0);
  for (const Tri &t : k.sheet.triangles) {
    const double side2 = (k.sheet.x[t[1]] - k.sheet.x[t[0]]).squaredNorm() +
                         (k.sheet.x[t[2]] - k.sheet.x[t[0]]).squaredNorm();
    if (triangle_area(k.sheet.x, t) > 1e-6 * side2) continue;
    for (const uint32_t i : t) flat[i] = 1;
  }
  for (size_t i = 0; i < flat.size(); ++i) {
    if (flat[i]) k.sheet.x[i] += 0.1 * (k.loaded[i] - k.sheet.x[i]);
  }
}

// The annulus counter-clockwise seen from the atrium, and triangles that run along it with a side.
inline void wind(KaiserSheet &k) {
  std::vector<uint32_t> &annulus = k.rims.annulus;
  Vec3 area = Vec3::Zero();
  for (size_t i = 0; i < annulus.size(); ++i) {
    const Vec3 &a = k.sheet.x[annulus[i]], &b = k.sheet.x[annulus[(i + 1) % annulus.size()]];
    area += (a - k.sheet.x[annulus[0]]).cross(b - k.sheet.x[annulus[0]]);
  }
  if (area.dot(k.sheet.x[annulus[0]] - k.heads[0]) < 0)
    std::reverse(annulus.begin(), annulus.end());
  const auto runs_along = [&](const Tri &t) {
    for (size_t c = 0; c < 3; ++c) {
      if (t[c] == annulus[0] && t[(c + 1) % 3] == annulus[1]) return true;
    }
    return false;
  };
  if (std::none_of(k.sheet.triangles.begin(), k.sheet.triangles.end(), runs_along)) {
    for (Tri &t : k.sheet.triangles) std::swap(t[1], t[2]);
  }
}

// The rim beside the annulus.
inline std::vector<uint32_t> other_rim(const KaiserSheet &k) {
  const std::vector<uint8_t> at_annulus = marks_of(k.rims.annulus, k.sheet.x.size());
  const std::vector<Side> sides = sorted_sides(k.sheet.triangles);
  std::vector<uint32_t> next(k.sheet.x.size(), none), rim;
  uint32_t start = none;
  for_each_edge(sides, [&](size_t first, size_t last) {
    const Side &side = sides[first];
    if (last - first > 1 || (at_annulus[side.edge[0]] && at_annulus[side.edge[1]])) return;
    start = side_from(k.sheet.triangles, side);
    next[start] = side_to(k.sheet.triangles, side);
  });
  uint32_t at = start;
  do {
    rim.push_back(at);
    at = next[at];
  } while (at != start);
  return rim;
}

// Sheet and rims wound so that normals point into the atrium, away from the heads.
inline KaiserSheet kaiser_sheet(const std::string &file) {
  KaiserSheet k;
  const auto json = read_real_valve("kaiser_mitral_normal_1/" + file);
  if (json.is_null()) return k;
  const size_t count = json["n_leaflet_vertices"];
  for (size_t i = 0; i < count; ++i) {
    k.sheet.x.push_back(in_metres(json["vertices_relaxed"][i]));
    k.loaded.push_back(in_metres(json["vertices_pressurized"][i]));
  }
  for (const auto &t : json["faces"]) k.sheet.triangles.push_back({t[0], t[1], t[2]});
  k.sheet.label.assign(k.sheet.triangles.size(), LeafletLabel::unknown);
  for (const auto &n : json["annulus"]) k.rims.annulus.push_back(n);
  for (const size_t n : json["papillary"])
    k.heads.push_back(in_metres(json["vertices_relaxed"][n]));
  open_flat_triangles(k);
  wind(k);
  k.rims.free_edge = other_rim(k);
  return k;
}

}  // namespace mvs::core::test
