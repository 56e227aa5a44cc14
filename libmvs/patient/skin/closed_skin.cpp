// Pieces without rims, their sides as components of triangles that face parallel tissue, and which
// of these sides are seen from the atrium.
#include "patient/skin/closed_skin.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/triangle_bvh.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/skin/skin_pieces.h"
#include "patient/skin/smooth_skin.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Corners that are one vertex, as a share of the median side (fit/closed_pieces.cpp).
constexpr double one_vertex_share = 1e-3;
// The rims of a skin are those of small holes: their length over the root of its area. Rims of a
// sheet of two leaflets have about five.
constexpr double most_rim = 0.5;
// Rays towards the atrium from each side.
constexpr size_t most_rays = 1000;
// Median thickness, by which a ray begins outside of the tissue.
constexpr double clear_of_skin = 0.1;
// Rounds in which the depth of a vertex becomes the mean with those of its neighbours.
constexpr int depth_smoothings = 3;

struct Skin {
  LeafletSheet sheet;    // normals out of the tissue
  ClosedSurface others;  // pieces that are sheets
};

// The triangles with area, welded, wound alike in each piece.
LeafletSheet welded(const ClosedSurface &given) {
  LeafletSheet sheet;
  sheet.x = given.points;
  const std::vector<uint32_t> vertex =
      weld_map(given.points, one_vertex_share * median_edge(given.points, given.triangles));
  for (const Tri &t : given.triangles) {
    const Tri joined = {vertex[t[0]], vertex[t[1]], vertex[t[2]]};
    if (area_normal(sheet.x, joined).squaredNorm() > 0) sheet.triangles.push_back(joined);
  }
  return sheet;
}

struct Piece {
  double area = 0, rim = 0, volume = 0;  // m2, m, m3
  bool is_skin() const { return rim < most_rim * std::sqrt(area); }
};

std::vector<Piece> sizes_of(const LeafletSheet &sheet, const std::vector<uint32_t> &across,
                            const std::vector<uint32_t> &piece_of) {
  std::vector<Piece> pieces;
  for (uint32_t t = 0; t < piece_of.size(); ++t) {
    pieces.resize(std::max<size_t>(pieces.size(), piece_of[t] + 1));
    Piece &piece = pieces[piece_of[t]];
    const Tri &tri = sheet.triangles[t];
    piece.area += triangle_area(sheet.x, tri);
    piece.volume += sheet.x[tri[0]].dot(sheet.x[tri[1]].cross(sheet.x[tri[2]])) / 6;
    for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      if (across[side] != none) continue;
      piece.rim +=
          (sheet.x[side_start(sheet.triangles, side)] - sheet.x[side_end(sheet.triangles, side)])
              .norm();
    }
  }
  return pieces;
}

// Pieces with less than a twentieth of the area are noise, or gaps inside of a skin.
Skin skins_of(const ClosedSurface &given) {
  Skin skin;
  LeafletSheet sheet = welded(given);
  const std::vector<uint32_t> across = join_sides(sheet.x, sheet.triangles).across;
  const bool has_two_sides = wind_alike(sheet, across) != none;
  const std::vector<uint32_t> piece_of = pieces_of(across);
  const std::vector<uint32_t> joined = join_sides(sheet.x, sheet.triangles).across;
  const std::vector<Piece> pieces = sizes_of(sheet, joined, piece_of);
  double area = 0;
  for (const Piece &piece : pieces) area += piece.area;
  skin.others.points = sheet.x;
  skin.sheet.x = sheet.x;
  for (uint32_t t = 0; t < piece_of.size(); ++t) {
    const Piece &piece = pieces[piece_of[t]];
    Tri tri = sheet.triangles[t];
    if (!has_two_sides || !piece.is_skin()) {
      skin.others.triangles.push_back(tri);
    } else if (piece.area > 0.05 * area) {
      if (piece.volume < 0) std::swap(tri[1], tri[2]);
      skin.sheet.triangles.push_back(tri);
    }
  }
  return skin;
}

double median_of(std::vector<double> list) {
  if (list.empty()) return 0;
  const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
  std::nth_element(list.begin(), middle, list.end());
  return *middle;
}

double usual_thickness(const std::vector<TissueBehind> &behind) {
  std::vector<double> all;
  for (const TissueBehind &b : behind) {
    if (b.triangle != none) all.push_back(b.thickness);
  }
  return median_of(std::move(all));
}

std::vector<Vec3> normals_of(const LeafletSheet &skin) {
  std::vector<Vec3> normals;
  for (const Tri &t : skin.triangles) normals.push_back(area_normal(skin.x, t).normalized());
  return normals;
}

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
std::vector<double> shares_seen(const LeafletSheet &skin, const std::vector<Vec3> &normal,
                                const std::vector<uint32_t> &side_of, const Vec3 &into_atrium,
                                double thickness) {
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
      const Vec3 from = centre + clear_of_skin * thickness * normal[t];
      const double area = triangle_area(skin.x, tri);
      all += area;
      if (is_free(tree, skin, from, into_atrium, farthest)) seen += area;
    }
    if (all > 0) shares[side] = seen / all;
  }
  return shares;
}

// An atrial side is seen more than what lies behind it: of a leaflet that touches another one, or
// billows, it may be hidden for the most part. What lies behind two leaflets does not count.
std::vector<uint8_t> atrial_sides(const LeafletSheet &skin, const std::vector<uint32_t> &side_of,
                                  const std::vector<TissueBehind> &behind, double thickness,
                                  const std::vector<double> &seen) {
  constexpr double least_compared = 0.25;  // share of a side, of others nothing is known
  std::vector<double> more(seen.size(), 0), compared(seen.size(), 0), whole(seen.size(), 0);
  for (uint32_t t = 0; t < side_of.size(); ++t) {
    if (side_of[t] == none) continue;
    const double part = triangle_area(skin.x, skin.triangles[t]);
    whole[side_of[t]] += part;
    const uint32_t other = side_of[behind[t].triangle];
    const bool is_one_leaflet = behind[t].thickness <= one_leaflet * thickness;
    if (other == none || other == side_of[t] || !is_one_leaflet) continue;
    more[side_of[t]] += part * (seen[side_of[t]] - seen[other]);
    compared[side_of[t]] += part;
  }
  std::vector<uint8_t> is_atrial(seen.size(), 0);
  for (size_t side = 0; side < seen.size(); ++side) {
    is_atrial[side] = compared[side] > least_compared * whole[side] && more[side] > 0;
  }
  return is_atrial;
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
  const auto first = static_cast<uint32_t>(middle.points.size());
  for (size_t v = 0; v < sheet.x.size(); ++v) {
    if (count[v] > 0) sheet.x[v] -= depth[v] * inward[v].normalized();
  }
  if (!part.is_atrial) {
    for (Tri &t : sheet.triangles) std::swap(t[1], t[2]);
  }
  drop_unused(sheet);
  middle.points.insert(middle.points.end(), sheet.x.begin(), sheet.x.end());
  for (const Tri &t : sheet.triangles) {
    middle.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

}  // namespace

ClosedSurface mid_of_closed(const ClosedSurface &given, const Vec3 &into_atrium,
                            Findings &findings) {
  Skin skins = skins_of(given);
  LeafletSheet &skin = skins.sheet;
  if (skin.triangles.empty()) return given;
  drop_unused(skin);
  Findings of_smoothing;
  const double rough = usual_thickness(tissue_behind(skin));
  smooth_skin(skin, rough, skin_ridges(skin, rough), of_smoothing);
  const std::vector<TissueBehind> behind = tissue_behind(skin);
  const double thickness = usual_thickness(behind);
  const std::vector<Vec3> normal = normals_of(skin);
  const std::vector<uint32_t> side_of = parallel_pieces(skin, normal, behind, thickness);
  const std::vector<double> seen = shares_seen(skin, normal, side_of, into_atrium, thickness);
  const std::vector<uint8_t> is_atrial = atrial_sides(skin, side_of, behind, thickness, seen);
  MidPart atrial, touching;
  atrial.is_atrial = true;
  double atrial_area = 0, touching_area = 0;
  for (uint32_t t = 0; t < side_of.size(); ++t) {
    if (side_of[t] == none) continue;
    const double area = triangle_area(skin.x, skin.triangles[t]);
    if (is_atrial[side_of[t]]) {
      atrial.triangles.push_back(t);
      atrial.depth.push_back(0.5 * behind[t].thickness);
      atrial_area += area;
      continue;
    }
    const uint32_t opposite = side_of[behind[t].triangle];
    if (opposite == none || is_atrial[opposite]) continue;
    touching.triangles.push_back(t);
    touching.depth.push_back(0.25 * behind[t].thickness);
    touching_area += area;
  }
  MVS_MUST(
      !atrial.triangles.empty(), MVS_E_OP, "closed",
      "the closed leaflets are a skin (both sides of the tissue) of which no side is seen from "
      "the atrium: are they in the frame of the open ones? Give their mid-surface or their "
      "atrial side instead");
  ClosedSurface middle;
  add_part(skin, atrial, middle);
  add_part(skin, touching, middle);
  const auto first = static_cast<uint32_t>(middle.points.size());
  if (!skins.others.triangles.empty()) {
    middle.points.insert(middle.points.end(), skins.others.points.begin(),
                         skins.others.points.end());
    for (const Tri &t : skins.others.triangles) {
      middle.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  add_measured(
      findings, "closed_skin",
      format("the closed leaflets are a skin, %.2f mm thick: its middle was taken, %.0f mm2 from "
             "the atrial side and %.0f mm2 from the ventricular side where leaflets touch and are "
             "one body",
             thickness * 1e3, atrial_area * 1e6, touching_area * 1e6),
      {thickness, atrial_area, touching_area}, "");
  return middle;
}

}  // namespace mvs::core
