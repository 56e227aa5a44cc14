// The atrial side of a skin, with the thickness behind it, moved to the middle.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/intersect.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/skin/mid_surface.h"
#include "patient/skin/skin_sides.h"
#include "patient/skin/smooth_skin.h"
#include "patient/surface/cut_handles.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Rounds that remove the zigzag of single triangles, and leave waves of ten of them.
constexpr int rim_rounds = 10;

// A skin with normals out of the tissue.
void turn_outward(LeafletSheet &skin) {
  double volume = 0;
  for (const Tri &t : skin.triangles) {
    volume += skin.x[t[0]].dot(skin.x[t[1]].cross(skin.x[t[2]])) / 6;
  }
  if (volume >= 0) return;
  for (Tri &t : skin.triangles) std::swap(t[1], t[2]);
}

// A skin is a ring: one handle, the orifice. Small handles beside it are cut.
void make_ring(LeafletSheet &skin, Findings &findings) {
  const size_t handles = cut_handles(skin, 1, findings);
  MVS_MUST(handles != 0, MVS_E_OP, "triangles",
           "the skin is that of a ball without an orifice: are the leaflets closed and joined, or "
           "is this one leaflet only? Both leaflets have to be joined at the commissures");
  MVS_MUST(
      handles == 1, MVS_E_OP, "triangles",
      "the skin has %zu handles beside the orifice that are more than %.0f mm around: leaflets "
      "touch and are joined, or have holes; separate them there (smaller handles are cut)",
      handles - 1, longest_handle * 1e3);
}

// Fills numbers that are not known (zero) with the mean of those of the neighbours, from ring to
// ring, then takes the mean with the neighbours three times.
void spread_and_smooth(const std::vector<Tri> &triangles, std::vector<double> &value) {
  constexpr size_t smoothings = 3;
  for (size_t round = 0, smoothed = 0; smoothed < smoothings && round < value.size(); ++round) {
    const bool full = std::find(value.begin(), value.end(), 0.0) == value.end();
    std::vector<double> sum = value, count(value.size(), 0);
    for (size_t i = 0; i < value.size(); ++i) count[i] = value[i] > 0;
    for (const Tri &t : triangles) {
      for (size_t k = 0; k < 3; ++k) {
        for (const uint32_t j : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
          if (value[j] == 0 || (!full && value[t[k]] > 0)) continue;
          sum[t[k]] += value[j];
          count[t[k]] += 1;
        }
      }
    }
    for (size_t i = 0; i < value.size(); ++i) {
      if (count[i] > 0) value[i] = sum[i] / count[i];
    }
    smoothed += full;
  }
}

// Whether both triangles are parallel. Rays from a bent rim pass the tissue at a slant.
bool faces_parallel(const LeafletSheet &skin, uint32_t t, uint32_t u) {
  const Vec3 a = area_normal(skin.x, skin.triangles[t]), b = area_normal(skin.x, skin.triangles[u]);
  return a.dot(b) < -parallel_cosine * a.norm() * b.norm();
}

// The median thickness behind the triangles of a side around each vertex; 0 where none has any.
std::vector<double> thickness_of(const LeafletSheet &skin, const std::vector<TissueBehind> &behind,
                                 const std::vector<uint32_t> &side_of, uint32_t side) {
  const Rows stars = rows_of(skin.x.size(), skin.triangles);
  std::vector<double> thickness(skin.x.size(), 0);
  std::vector<double> around;
  for (size_t i = 0; i < thickness.size(); ++i) {
    around.clear();
    for (const uint32_t t : stars[i]) {
      const uint32_t u = behind[t].triangle;
      if (side_of[t] == side && u != none && side_of[u] == 1 - side && faces_parallel(skin, t, u)) {
        around.push_back(behind[t].thickness);
      }
    }
    std::sort(around.begin(), around.end());
    if (!around.empty())
      thickness[i] = 0.5 * (around[around.size() / 2] + around[(around.size() - 1) / 2]);
  }
  return thickness;
}

// One side as a sheet, with the thickness of the tissue behind it.
LeafletSheet side_sheet(const LeafletSheet &skin, const std::vector<TissueBehind> &behind,
                        const std::vector<uint32_t> &side_of, uint32_t side) {
  LeafletSheet sheet = skin;
  sheet.thickness = thickness_of(skin, behind, side_of, side);
  std::vector<uint8_t> kept(skin.triangles.size());
  for (size_t t = 0; t < kept.size(); ++t) kept[t] = side_of[t] == side;
  keep_triangles(sheet, kept);
  separate_fans(sheet, join_sides(sheet.x, sheet.triangles).across);
  drop_unused(sheet);
  spread_and_smooth(sheet.triangles, sheet.thickness);
  return sheet;
}

// Smooths rims as often as no triangles cross that did not before.
void smooth_rims_freely(LeafletSheet &sheet, int rounds) {
  const size_t crossings = find_intersections(sheet.x, sheet.triangles).size();
  const std::vector<Vec3> before = sheet.x;
  for (; rounds > 0; rounds /= 2) {
    smooth_rims(sheet, rounds);
    if (find_intersections(sheet.x, sheet.triangles).size() <= crossings) return;
    sheet.x = before;
  }
}

void add_thickness(const LeafletSheet &skin, const LeafletSheet &atrial, Findings &findings) {
  std::vector<double> sorted = atrial.thickness;
  std::sort(sorted.begin(), sorted.end());
  const size_t n = sorted.size();
  const double low = sorted[n / 20], median = sorted[n / 2], high = sorted[n - 1 - n / 20];
  const double all = surface_area(skin.x, skin.triangles);
  const double part = surface_area(atrial.x, atrial.triangles);
  add_measured(findings, "thickness",
               format("%.2f mm between both sides of the skin, %.2f to %.2f mm on 90 %% of it; the "
                      "atrial side is %.0f %% of the skin",
                      median * 1e3, low * 1e3, high * 1e3, 100 * part / all),
               {median, low, high}, "m");
}

}  // namespace

LeafletSheet mid_of_skin(const LeafletSheet &skin, const RimLandmarks &landmarks,
                         Findings &findings) {
  LeafletSheet closed = skin;
  turn_outward(closed);
  make_ring(closed, findings);
  const double thickness = median_thickness(tissue_behind(closed));
  const SkinRidges ridges = skin_ridges(closed, thickness);
  const int rounds = smooth_skin(closed, thickness, ridges, findings);
  const std::vector<TissueBehind> behind = tissue_behind(closed);
  const std::vector<uint32_t> side_of = sides_of(closed, behind, ridges.at_rims);
  std::vector<LeafletSheet> atrial;
  for (const uint32_t side : {0u, 1u}) {
    LeafletSheet sheet = side_sheet(closed, behind, side_of, side);
    Findings made;
    // normals out of the tissue become normals into the atrium
    if (find_rims(sheet, landmarks, made).turned) continue;
    atrial.push_back(std::move(sheet));
    const Finding *cut = find_finding(made, "atrial_tissue");
    if (cut) findings.push_back(*cut);
  }
  MVS_MUST(atrial.size() == 1, MVS_E_OP, "triangles",
           "the sides of the skin do not show which is the atrial one: give the papillary tips and "
           "points along the annulus");
  add_thickness(closed, atrial[0], findings);
  if (!ridges.at_rims) drop_round_rims(atrial[0]);
  move_to_mid(atrial[0], 0, findings);
  smooth_rims_freely(atrial[0], std::min(rounds, rim_rounds));
  return std::move(atrial[0]);
}

}  // namespace mvs::core
