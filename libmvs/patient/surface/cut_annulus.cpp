// Distances from the curve, sides, pieces.
#include "patient/surface/cut_annulus.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "geometry/triangle_bvh.h"
#include "model/sides.h"
#include "patient/mesh/surface_walk.h"
#include "patient/surface/annulus_through.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clusters.h"
#include "patient/surface/level_cut.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"
#include "patient/surface/which_rim.h"

namespace mvs::core {
namespace {

constexpr double spacing = 0.5e-3;  // m, of points along the curve
constexpr size_t half_window = 4;   // points: directions are means over 4 mm
// m: how far tissue reaches beyond points that were placed by hand on images of 0.7 mm.
constexpr double least_reach = 2.5e-3;
// m: points farther from the surface in the mean do not show where it is to be cut.
constexpr double farthest_point = 3e-3;
// m: the level passes nearer to the curve than this, unless another wall is in the way.
constexpr double farthest_cut = 3e-3;
// Area of the leaflets over the squared length of the annulus: 0.11 to 0.15 in normal valves. Below
// this share the other side has the leaflets.
constexpr double least_leaflets = 0.05;
constexpr double snap = 0.1;

// The curve on the surface, with the direction across it in the surface.
struct CurveOnSurface {
  std::vector<Vec3> point, across;
  double distance = 0;  // m, of the given curve from the surface in the mean
  double length = 0;    // m
};

CurveOnSurface curve_on(const LeafletSheet &sheet, const std::vector<Vec3> &curve) {
  const TriangleBvh bvh(sheet.triangles, sheet.x);
  const SurfaceWalk walk(sheet.x, sheet.triangles, half_window * spacing);
  const size_t n = curve.size();
  CurveOnSurface on;
  std::vector<Vec3> normal;
  for (const Vec3 &p : curve) {
    const TriangleBvh::Hit hit = bvh.closest(p);
    normal.push_back(walk.normal_at({hit.triangle, bvh.closest_on(hit.triangle, p).weight}));
    on.point.push_back(hit.point);
    on.distance += std::sqrt(hit.distance2) / static_cast<double>(n);
  }
  const auto around = [n](size_t k, size_t step) { return (k + n + step - half_window) % n; };
  std::vector<Vec3> smooth(n, Vec3::Zero());
  for (size_t k = 0; k < n; ++k) {
    for (size_t step = 0; step <= 2 * half_window; ++step) smooth[k] += normal[around(k, step)];
    smooth[k].normalize();
    // beyond a rim the curve stays where it is
    on.point[k] = curve[k] - (curve[k] - on.point[k]).dot(smooth[k]) * smooth[k];
  }
  for (size_t k = 0; k < n; ++k) {
    const Vec3 along = on.point[around(k, 2 * half_window)] - on.point[around(k, 0)];
    on.across.push_back(smooth[k].cross(along).normalized());
    on.length += (on.point[(k + 1) % n] - on.point[k]).norm();
  }
  return on;
}

// The distance of a point from the curve, and its part across it.
struct CurveDistance {
  double distance, across;
};
CurveDistance distance_from(const CurveOnSurface &on, const Vec3 &p) {
  const size_t n = on.point.size();
  size_t nearest = 0;
  SegmentPoint best{0, INFINITY};
  for (size_t k = 0; k < n; ++k) {
    const SegmentPoint at = closest_on_segment(p, on.point[k], on.point[(k + 1) % n]);
    if (at.distance2 >= best.distance2) continue;
    best = at;
    nearest = k;
  }
  const size_t next = nearest + 1 < n ? nearest + 1 : 0;
  const Vec3 q = on.point[nearest] + best.s * (on.point[next] - on.point[nearest]);
  const Vec3 across = (1 - best.s) * on.across[nearest] + best.s * on.across[next];
  return {std::sqrt(best.distance2), (p - q).dot(across)};
}

// The pieces of vertices on one side of the level, connected by edges: of each vertex the first one
// of its piece.
std::vector<uint32_t> pieces_of_sides(const LeafletSheet &sheet, const std::vector<double> &level) {
  std::vector<uint32_t> piece(level.size());
  std::iota(piece.begin(), piece.end(), 0u);
  for (const Tri &t : sheet.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      if ((level[a] > 0) == (level[b] > 0)) join(piece, a, b);
    }
  }
  for (uint32_t i = 0; i < piece.size(); ++i) piece[i] = root_of(piece, i);
  return piece;
}

// The largest loop that lies on a side in the mean; nullptr.
const RimLoop *largest_on_side(const std::vector<RimLoop> &rims, const std::vector<double> &level,
                               double sign) {
  for (const RimLoop &rim : rims) {
    double sum = 0;
    for (const uint32_t i : rim.loop) sum += sign * level[i];
    if (sum > 0) return &rim;
  }
  return nullptr;
}

// The level at the vertices, positive beyond the curve, and their distance from the curve, m.
struct CurveLevel {
  std::vector<double> level, distance;
};

// Whether a rim follows the curve along a tenth of its vertices or more, as that of a wall beside a
// part of the annulus does; free edges are 5 mm away and more.
bool follows_curve(const RimLoop &rim, const CurveLevel &at) {
  constexpr double on_curve = 2e-3;  // m
  const auto count = std::count_if(rim.loop.begin(), rim.loop.end(),
                                   [&](uint32_t i) { return at.distance[i] < on_curve; });
  return 10 * static_cast<size_t>(count) >= rim.loop.size();
}

// Which side has the leaflets, and how sure that is.
struct LeafletSide {
  const RimLoop *free_edge = nullptr;
  double sign = 0;  // of the level there
  double confidence = 0.9;
};

LeafletSide leaflet_side(const std::vector<RimLoop> &rims, const CurveLevel &at,
                         const std::vector<Vec3> &tips) {
  const RimLoop *plus = largest_on_side(rims, at.level, 1);
  const RimLoop *minus = largest_on_side(rims, at.level, -1);
  if (!plus || !minus) return {plus ? plus : minus, plus ? 1.0 : -1.0};
  if (const bool plus_follows = follows_curve(*plus, at);
      plus_follows != follows_curve(*minus, at)) {
    return {plus_follows ? minus : plus, plus_follows ? -1.0 : 1.0};
  }
  if (!tips.empty()) {
    double nearer = 0;
    for (const Vec3 &tip : tips) {
      nearer += (tip - minus->shape.centre).norm() - (tip - plus->shape.centre).norm();
    }
    return {nearer > 0 ? plus : minus, nearer > 0 ? 1.0 : -1.0};
  }
  const double of_minus = annulus_odds(minus->shape, plus->shape);
  const double odds = std::max(of_minus, 1 / of_minus);
  return {of_minus > 1 ? plus : minus, of_minus > 1 ? 1.0 : -1.0,
          std::min(0.9, (odds - 1) / (odds + 1))};
}

// Makes the level negative in pieces beyond the curve that hardly reach there, that have the free
// edge, or that begin far from the curve, as in folds beside it.
void lower_other_pieces(const LeafletSheet &sheet, const std::vector<uint32_t> &free_edge,
                        CurveLevel &at) {
  std::vector<double> &level = at.level;
  const std::vector<uint32_t> piece = pieces_of_sides(sheet, level);
  std::vector<double> reach(level.size(), 0);
  for (size_t i = 0; i < level.size(); ++i) reach[piece[i]] = std::max(reach[piece[i]], level[i]);
  for (const uint32_t i : free_edge) reach[piece[i]] = 0;
  for (const Tri &t : sheet.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      if ((level[a] > 0) == (level[b] > 0)) continue;
      const double share = level[a] / (level[a] - level[b]);
      const double distance = at.distance[a] + share * (at.distance[b] - at.distance[a]);
      if (distance > farthest_cut) reach[piece[level[a] > 0 ? a : b]] = 0;
    }
  }
  for (size_t i = 0; i < level.size(); ++i) {
    if (level[i] > 0 && reach[piece[i]] < least_reach) level[i] = -level[i];
  }
}

// Makes the level positive in all pieces but the one with most of the free edge.
void raise_behind(const LeafletSheet &sheet, const std::vector<uint32_t> &free_edge,
                  std::vector<double> &level) {
  const std::vector<uint32_t> piece = pieces_of_sides(sheet, level);
  std::vector<size_t> count(level.size(), 0);
  for (const uint32_t i : free_edge) count[piece[i]] += level[i] <= 0;
  const size_t leaflets =
      static_cast<size_t>(std::max_element(count.begin(), count.end()) - count.begin());
  constexpr double least = 1e-9;  // m
  for (size_t i = 0; i < level.size(); ++i) {
    if (level[i] <= 0 && piece[i] != leaflets) level[i] = std::max(-level[i], least);
  }
}

// The leaflets, or nothing if the level does not divide the surface along the curve.
bool leaflets_below(const LeafletSheet &sheet, const CurveOnSurface &curve,
                    const std::vector<double> &level, double snapped, LeafletSheet &leaflets) {
  std::vector<uint8_t> on_cut;
  leaflets = part_below(sheet, level, snapped, on_cut);
  for (size_t i = 0; i < on_cut.size(); ++i) {
    if (on_cut[i] != 0 && distance_from(curve, leaflets.x[i]).distance > farthest_cut) return false;
  }
  const std::vector<uint32_t> across = join_sides(leaflets.x, leaflets.triangles).across;
  const std::vector<uint32_t> pieces = pieces_of(across);
  if (pieces.empty() || *std::max_element(pieces.begin(), pieces.end()) > 0) return false;
  LeafletSheet fans = leaflets;
  if (separate_fans(fans, across) > 0) return false;
  size_t cut_loops = 0;
  for (const std::vector<uint32_t> &loop : boundary_loops(leaflets)) {
    cut_loops += std::any_of(loop.begin(), loop.end(), [&](uint32_t i) { return on_cut[i] != 0; });
  }
  drop_unused(leaflets);
  return cut_loops == 1;
}

void add_uncut(Findings &findings) {
  findings.push_back({"atrial_tissue",
                      FindingSource::guessed,
                      0.2,
                      "the surface reaches beyond the given points of the annulus and could not be "
                      "cut along them, as a curve through them does not part it in two: all of it "
                      "counts as leaflet; cut the wall of the atrium off, or give more points",
                      {},
                      ""});
}

}  // namespace

bool cut_along_annulus(LeafletSheet &sheet, const RimLandmarks &landmarks, Findings &findings) {
  const std::vector<Vec3> through = annulus_through(landmarks.annulus, spacing);
  const std::vector<RimLoop> rims = sorted_rims(sheet);
  if (through.empty() || rims.empty()) return false;
  const CurveOnSurface curve = curve_on(sheet, through);
  if (curve.distance > farthest_point) return false;
  CurveLevel at;
  for (const Vec3 &p : sheet.x) {
    const auto [distance, across] = distance_from(curve, p);
    at.distance.push_back(distance);
    at.level.push_back(across);
  }
  const LeafletSide side = leaflet_side(rims, at, landmarks.tips);
  if (!side.free_edge) return false;
  for (double &value : at.level) value *= -side.sign;
  lower_other_pieces(sheet, side.free_edge->loop, at);
  if (*std::max_element(at.level.begin(), at.level.end()) <= 0) return false;
  raise_behind(sheet, side.free_edge->loop, at.level);
  const double reach = *std::max_element(at.level.begin(), at.level.end());
  LeafletSheet leaflets;
  if (!leaflets_below(sheet, curve, at.level, snap, leaflets) &&
      !leaflets_below(sheet, curve, at.level, 0, leaflets)) {
    add_uncut(findings);
    return false;
  }
  const double left = surface_area(leaflets.x, leaflets.triangles);
  const double dropped = surface_area(sheet.x, sheet.triangles) - left;
  if (left < least_leaflets * curve.length * curve.length) return false;
  findings.push_back(
      {"atrial_tissue",
       FindingSource::guessed,
       side.confidence,
       format("%.0f mm2 of tissue, up to %.1f mm beyond a curve through the given points of the "
              "annulus, were taken for wall of the atrium and cut off; %.0f mm2 of leaflets are "
              "left. The points lie %.1f mm from the surface in the mean; if the tissue belongs to "
              "the leaflets, give the points farther out, or none",
              dropped * 1e6, reach * 1e3, left * 1e6, curve.distance * 1e3),
       {dropped},
       "m2"});
  sheet = std::move(leaflets);
  return true;
}

}  // namespace mvs::core
