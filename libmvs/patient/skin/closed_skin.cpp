// The sides of each body as pieces of triangles that face parallel tissue; those that face the
// atrium, and those where leaflets touch, are moved inward.
#include "patient/skin/closed_skin.h"

#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/skin/closed_bodies.h"
#include "patient/skin/side_kinds.h"
#include "patient/skin/smooth_skin.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Rounds in which the depth of a vertex becomes the mean with those of its neighbours.
constexpr int depth_smoothings = 3;

// Adds a surface to another one.
void append(const std::vector<Vec3> &x, const std::vector<Tri> &triangles, std::vector<Vec3> &to_x,
            std::vector<Tri> &to_triangles) {
  const auto first = static_cast<uint32_t>(to_x.size());
  to_x.insert(to_x.end(), x.begin(), x.end());
  for (const Tri &t : triangles) to_triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

std::vector<Vec3> normals_of(const LeafletSheet &skin) {
  std::vector<Vec3> normals;
  for (const Tri &t : skin.triangles) normals.push_back(area_normal(skin.x, t).normalized());
  return normals;
}

// Each body by itself: those of leaflets that touch may overlap.
Skin skin_of(std::vector<LeafletSheet> &bodies) {
  Skin skin;
  for (LeafletSheet &body : bodies) {
    Findings of_smoothing;
    const double rough = median_thickness(tissue_behind(body));
    smooth_skin(body, rough, skin_ridges(body, rough), of_smoothing);
    const auto first = static_cast<uint32_t>(skin.sheet.triangles.size());
    for (TissueBehind b : tissue_behind(body)) {
      if (b.triangle != none) b.triangle += first;
      skin.behind.push_back(b);
    }
    append(body.x, body.triangles, skin.sheet.x, skin.sheet.triangles);
  }
  skin.thickness = median_thickness(skin.behind);
  skin.normal = normals_of(skin.sheet);
  return skin;
}

// A part of the skin that becomes a part of the middle.
struct MidPart {
  std::vector<uint32_t> triangles;
  std::vector<double> depth;  // m, of each of them
  bool is_atrial = false;
};

// Moves the vertices of a part inward and adds it, its normals into the atrium.
void add_part(const LeafletSheet &skin, const MidPart &part, ClosedSurface &middle) {
  LeafletSheet sheet;
  sheet.x = skin.x;
  for (const uint32_t t : part.triangles) sheet.triangles.push_back(skin.triangles[t]);
  std::vector<double> depth(sheet.x.size(), 0), count(sheet.x.size(), 0);
  for (size_t k = 0; k < part.triangles.size(); ++k) {
    for (const uint32_t v : sheet.triangles[k]) {
      depth[v] += part.depth[k];
      count[v] += 1;
    }
  }
  for (size_t v = 0; v < depth.size(); ++v) depth[v] /= std::max(1.0, count[v]);
  for (int round = 0; round < depth_smoothings; ++round) {
    std::vector<double> sum(depth.size(), 0);
    for (const Tri &t : sheet.triangles) {
      for (const uint32_t v : t) sum[v] += (depth[t[0]] + depth[t[1]] + depth[t[2]]) / 3;
    }
    for (size_t v = 0; v < depth.size(); ++v) depth[v] = sum[v] / std::max(1.0, count[v]);
  }
  const std::vector<Vec3> inward = area_normals(sheet.x, sheet.triangles);
  for (size_t v = 0; v < sheet.x.size(); ++v) {
    if (count[v] > 0) sheet.x[v] -= depth[v] * inward[v].normalized();
  }
  if (!part.is_atrial) {
    for (Tri &t : sheet.triangles) std::swap(t[1], t[2]);
  }
  drop_unused(sheet);
  append(sheet.x, sheet.triangles, middle.points, middle.triangles);
}

}  // namespace

ClosedSurface mid_of_closed(const ClosedSurface &given, const Vec3 &into_atrium,
                            Findings &findings) {
  ClosedBodies found = closed_bodies(given);
  if (found.bodies.empty()) return given;
  const Skin skin = skin_of(found.bodies);
  const std::vector<TissueBehind> &behind = skin.behind;
  const std::vector<uint32_t> side_of =
      parallel_pieces(skin.sheet, skin.normal, behind, skin.thickness);
  const std::vector<SideKind> kind = side_kinds(skin, side_of, into_atrium);
  const auto is_atrial = [&](uint32_t side) { return kind[side] == SideKind::atrial; };
  MidPart atrial, touching;
  atrial.is_atrial = true;
  double atrial_area = 0, touching_area = 0;
  for (uint32_t t = 0; t < side_of.size(); ++t) {
    if (side_of[t] == none) continue;
    const double area = triangle_area(skin.sheet.x, skin.sheet.triangles[t]);
    if (is_atrial(side_of[t])) {
      atrial.triangles.push_back(t);
      atrial.depth.push_back(0.5 * behind[t].thickness);
      atrial_area += area;
      continue;
    }
    const uint32_t opposite = side_of[behind[t].triangle];
    if (opposite == none || is_atrial(opposite)) continue;
    touching.triangles.push_back(t);
    touching.depth.push_back(0.25 * behind[t].thickness);
    touching_area += area;
  }
  MVS_MUST(
      !atrial.triangles.empty(), MVS_E_OP, "closed_points",
      "the closed leaflets are a closed body, of which no side with parallel tissue behind it is "
      "seen from the atrium: are they in the frame and the unit of the open ones? Give their "
      "mid-surface or their atrial side instead");
  ClosedSurface middle;
  add_part(skin.sheet, atrial, middle);
  add_part(skin.sheet, touching, middle);
  if (!found.others.triangles.empty()) {
    append(found.others.points, found.others.triangles, middle.points, middle.triangles);
  }
  add_measured(
      findings, "closed_skin",
      format("the closed leaflets are a skin, %.2f mm thick: its middle was taken, %.0f mm2 from "
             "the atrial side and %.0f mm2 from the ventricular side where leaflets touch and are "
             "one body",
             skin.thickness * 1e3, atrial_area * 1e6, touching_area * 1e6),
      {skin.thickness, atrial_area, touching_area}, "");
  return middle;
}

}  // namespace mvs::core
