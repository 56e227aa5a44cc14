// Checks, welding, pieces, winding.
#include "patient/surface/clean_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "geometry/aabb.h"
#include "model/sides.h"
#include "patient/checks/displaced_points.h"
#include "patient/checks/input_arrays.h"
#include "patient/findings.h"
#include "patient/mesh/surface_pieces.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Share of the median edge within which points are one vertex: far below any side of use, and above
// the rounding of text STL (1e-3 mm beside edges of 0.3 mm and more).
constexpr double weld_share = 0.01;
// Share of the area below which a separate piece is no leaflet.
constexpr double spur_share = 0.01;
// Share of the median edge within which rims of two pieces are one seam: leaflets that were
// exported one by one, each rounded or smoothed by itself. Far below any gap that a person sees.
constexpr double seam_share = 0.1;
// m: the largest extent of a mitral valve. The smallest annulus of an infant is 10 mm wide; a
// dilated annulus is 60 mm wide, with papillary muscles and a margin 150 mm.
constexpr double least_extent = 10e-3, most_extent = 150e-3;
// m: the range of mvs_build_options.thickness.
constexpr double least_tissue = 0.1e-3, most_tissue = 5e-3;

void check_arrays(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                  const std::vector<LeafletLabel> &label, const std::vector<double> &thickness) {
  MVS_MUST(!triangles.empty(), MVS_E_OP, "triangles",
           "the surface has %zu points and no triangles: give the leaflets as triangles",
           points.size());
  MVS_MUST(label.empty() || label.size() == triangles.size(), MVS_E_ARGUMENT, "triangle_leaflet",
           "%zu labels for %zu triangles: give one for each triangle, or none", label.size(),
           triangles.size());
  MVS_MUST(thickness.empty() || thickness.size() == points.size(), MVS_E_ARGUMENT,
           "point_thickness", "%zu values for %zu points: give one for each point, or none",
           thickness.size(), points.size());
  check_triangles(points, triangles, "points", "triangles");
  for (size_t i = 0; i < thickness.size(); ++i) {
    MVS_MUST(
        thickness[i] >= least_tissue && thickness[i] <= most_tissue, MVS_E_OP, "point_thickness",
        "the thickness at point %zu is %g m: it has to be 0.0001 to 0.005 m; %s", i, thickness[i],
        thickness[i] > 0 && thickness[i] < least_tissue
            ? "multiply by 1000 if it is in m and taken for mm"
            : "divide by 1000 if it is in mm");
  }
}

// The largest extent of the triangles with a mark.
double extent_of(const LeafletSheet &sheet, const std::vector<uint8_t> &marks) {
  Aabb box;
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    if (marks[t] != 0) box.add(aabb_of(sheet.x, sheet.triangles[t]));
  }
  return (box.high - box.low).maxCoeff();
}

// The distance of two points far apart, at most that of the farthest two: in a few sweeps from the
// farthest point of the last. However the surface is turned, it is the same.
double far_apart(const std::vector<Vec3> &x) {
  constexpr int sweeps = 4;
  Vec3 from = x.front();
  double distance = 0;
  for (int k = 0; k < sweeps; ++k) {
    const auto far = std::max_element(x.begin(), x.end(), [&](const Vec3 &a, const Vec3 &b) {
      return (a - from).squaredNorm() < (b - from).squaredNorm();
    });
    distance = std::max(distance, k > 0 ? (*far - from).norm() : 0.0);
    from = *far;
  }
  return distance;
}

void check_extent(double extent) {
  if (extent >= least_extent && extent <= most_extent) return;
  struct Unit {
    double factor;
    const char *sentence;
  };
  constexpr Unit units[] = {
      {1e-3, "its lengths seem to be in mm; divide by 1000 or give --unit mm"},
      {1e-2, "its lengths seem to be in cm; divide by 100 or give --unit cm"},
      {0.1, "its lengths seem to be in mm and taken for cm; divide by 10 or give --unit mm"},
      {1e3, "its lengths seem to be in m and taken for mm; multiply by 1000 or give --unit m"},
      {10, "its lengths seem to be in cm and taken for mm; multiply by 10 or give --unit cm"},
      {1e2, "its lengths seem to be in m and taken for cm; multiply by 100 or give --unit m"},
      {1e-6, "its lengths seem to be in um; divide by 1000000"},
  };
  for (const auto &[factor, sentence] : units) {
    MVS_MUST(extent * factor < least_extent || extent * factor > most_extent, MVS_E_OP, "points",
             "this surface is %.4g m wide: %s", extent, sentence);
  }
  fail(MVS_E_OP, "points",
       "this surface is %.4g m wide; a mitral valve is %.0f to %.0f mm wide: give lengths in m, of "
       "the leaflets alone",
       extent, least_extent * 1e3, most_extent * 1e3);
}

LeafletSheet welded_sheet(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                          const std::vector<LeafletLabel> &label,
                          const std::vector<double> &thickness, Findings &findings) {
  LeafletSheet sheet{points, triangles, label, thickness};
  sheet.label.resize(triangles.size(), LeafletLabel::unknown);
  drop_unused(sheet);
  if (const size_t unused = points.size() - sheet.x.size(); unused > 0) {
    add_measured(findings, "unused_points",
                 format("%zu points are in no triangle and were dropped", unused),
                 {static_cast<double>(unused)}, "");
  }
  const double distance = weld_share * median_edge(sheet.x, sheet.triangles);
  const std::vector<uint32_t> first = weld_map(sheet.x, distance);
  size_t welded = 0;
  for (uint32_t i = 0; i < first.size(); ++i) welded += first[i] != i;
  if (welded == 0) return sheet;
  for (Tri &t : sheet.triangles) {
    for (uint32_t &i : t) i = first[i];
  }
  add_measured(findings, "welded_points",
               format("%zu of %zu points are as near as %.4f mm to another one and became one "
                      "vertex with it",
                      welded, first.size(), distance * 1e3),
               {static_cast<double>(welded)}, "");
  return sheet;
}

// Drops triangles with a repeated corner or without area on one edge, and all but the first of
// those with the same corners.
void drop_collapsed(LeafletSheet &sheet, Findings &findings) {
  const size_t n = sheet.triangles.size();
  std::vector<uint8_t> kept(n, 1);
  size_t collapsed = 0, doubled = 0;
  std::vector<std::pair<Tri, uint32_t>> sorted;
  for (uint32_t t = 0; t < n; ++t) {
    Tri corners = sheet.triangles[t];
    std::sort(corners.begin(), corners.end());
    if (corners[0] == corners[1] || corners[1] == corners[2]) {
      kept[t] = 0;
      ++collapsed;
    } else {
      sorted.push_back({corners, t});
    }
  }
  std::sort(sorted.begin(), sorted.end());
  for (size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k].first != sorted[k - 1].first) continue;
    kept[sorted[k].second] = 0;
    ++doubled;
  }
  if (collapsed + doubled == 0) return;
  keep_triangles(sheet, kept);
  add_measured(findings, "dropped_triangles",
               format("%zu triangles without area and %zu triangles in the place of another one "
                      "were dropped",
                      collapsed, doubled),
               {static_cast<double>(collapsed), static_cast<double>(doubled)}, "");
}

// Keeps the largest piece; rims of two large pieces that meet within rounding are joined before.
void drop_spurs(LeafletSheet &sheet, SurfaceJoin &join, Findings &findings) {
  SurfacePieces pieces = measured_pieces(sheet, join.across);
  const double total = std::accumulate(pieces.area.begin(), pieces.area.end(), 0.0);
  check_extent(extent_of(sheet, pieces.marks_of_largest()));
  const double least = spur_share * total;
  if (pieces.count(least) > 1) {
    const double distance = seam_share * median_edge(sheet.x, sheet.triangles);
    const size_t joined = join_rims(sheet, join.across, pieces, distance);
    if (joined > 0) {
      add_measured(
          findings, "joined_pieces",
          format("rims of separate pieces meet within %.3f mm and were joined at %zu points",
                 distance * 1e3, joined),
          {static_cast<double>(joined)}, "");
      join = join_sides(sheet.x, sheet.triangles);
      pieces = measured_pieces(sheet, join.across);
    }
    if (pieces.count(least) > 1) refuse_pieces(sheet, pieces, least, join);
  }
  MVS_MUST(
      pieces.count(least) == 1, MVS_E_OP, "triangles",
      "the surface is a cloud of %zu pieces that are not connected, none of them above 1 %% of "
      "its area: its triangles do not fit its points, or it has no common points where "
      "triangles meet: weld it",
      pieces.area.size());
  if (pieces.area.size() == 1) return;
  const double dropped = total - pieces.area[pieces.largest];
  keep_triangles(sheet, pieces.marks_of_largest());
  add_measured(findings, "dropped_pieces",
               format("%zu separate pieces of together %.2f mm2, each below 1 %% of the area, were "
                      "dropped",
                      pieces.area.size() - 1, dropped * 1e6),
               {static_cast<double>(pieces.area.size() - 1), dropped}, "");
  join.across = join_sides(sheet.x, sheet.triangles).across;
}

// Makes each edge a border of two triangles, and each vertex the centre of one fan.
void make_manifold(LeafletSheet &sheet, Findings &findings) {
  SurfaceJoin join = join_sides(sheet.x, sheet.triangles);
  drop_spurs(sheet, join, findings);
  if (join.opened > 0) {
    add_measured(findings, "opened_edges",
                 format("at %zu edges more than two triangles meet; the two that continue "
                        "straightest stay joined there",
                        join.opened),
                 {join.opened_at.x(), join.opened_at.y(), join.opened_at.z()}, "m");
  }
  const uint32_t turned = wind_alike(sheet, join.across);
  MVS_MUST(turned != none, MVS_E_OP, "triangles",
           "the surface has one side only, like a Moebius band: the triangles cannot be wound "
           "alike; look for a strip that is joined the wrong way round");
  if (turned > 0) {
    add_measured(
        findings, "turned_triangles",
        format("%u triangles were wound the other way than the rest and were turned", turned),
        {static_cast<double>(turned)}, "");
    join.across = join_sides(sheet.x, sheet.triangles).across;
  }
  const size_t copies = separate_fans(sheet, join.across) + split_shared_edges(sheet);
  join = join_sides(sheet.x, sheet.triangles);
  MVS_MUST(join.opened == 0, MVS_E_OP, "triangles",
           "more than two triangles meet at an edge near (%.1f, %.1f, %.1f) mm, and no rule tells "
           "which of them are one surface: remove the others",
           join.opened_at.x() * 1e3, join.opened_at.y() * 1e3, join.opened_at.z() * 1e3);
  if (copies > 0) {
    add_measured(
        findings, "separated_points",
        format("parts of the surface touched in single points or edges; %zu new points hold "
               "them apart",
               copies),
        {static_cast<double>(copies)}, "");
  }
}

}  // namespace

LeafletSheet clean_surface(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                           const std::vector<LeafletLabel> &label,
                           const std::vector<double> &thickness, Findings &findings) {
  check_arrays(points, triangles, label, thickness);
  LeafletSheet sheet = welded_sheet(points, triangles, label, thickness, findings);
  drop_collapsed(sheet, findings);
  MVS_MUST(!sheet.triangles.empty(), MVS_E_OP, "triangles",
           "all %zu triangles are without area: give the leaflets as triangles", triangles.size());
  make_manifold(sheet, findings);
  if (const size_t flat = remove_flat(sheet); flat > 0) {
    add_measured(findings, "flat_triangles",
                 format("%zu triangles with three corners on one line were joined to their "
                        "neighbours",
                        flat),
                 {static_cast<double>(flat)}, "");
  }
  drop_unused(sheet);
  mend_displaced(sheet, findings);
  const double area = surface_area(sheet.x, sheet.triangles);
  add_measured(findings, "surface",
               format("%zu triangles with sides of %.2f mm, together %.0f mm2 and %.1f mm across",
                      sheet.triangles.size(), median_edge(sheet.x, sheet.triangles) * 1e3,
                      area * 1e6, far_apart(sheet.x) * 1e3),
               {area}, "m2");
  return sheet;
}

}  // namespace mvs::core
