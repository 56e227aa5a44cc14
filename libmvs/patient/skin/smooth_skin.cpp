// Taubin's filter on skins, Laplace's on boundaries.
#include "patient/skin/smooth_skin.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

Vec3 area_at(const LeafletSheet &sheet, const Tri &t, uint32_t vertex, const Vec3 &place) {
  std::array<Vec3, 3> corner;
  for (size_t k = 0; k < 3; ++k) corner[k] = t[k] == vertex ? place : sheet.x[t[k]];
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

// Whether the triangles around a vertex keep their direction and a third of their area.
bool may_move(const LeafletSheet &sheet, std::span<const uint32_t> star, uint32_t vertex,
              const Vec3 &place) {
  return std::all_of(star.begin(), star.end(), [&](uint32_t t) {
    const Tri &tri = sheet.triangles[t];
    const Vec3 before = area_at(sheet, tri, vertex, sheet.x[vertex]);
    return area_at(sheet, tri, vertex, place).dot(before) > before.squaredNorm() / 3;
  });
}

// The share of the edges at which the skin turns by more than 15 degrees.
double share_of_bends(const LeafletSheet &skin) {
  constexpr double bend = 0.966;
  const std::vector<uint32_t> across = join_sides(skin.x, skin.triangles).across;
  std::vector<Vec3> normal;
  for (const Tri &t : skin.triangles)
    normal.push_back(area_at(skin, t, none, Vec3::Zero()).normalized());
  size_t bends = 0, all = 0;
  for (size_t side = 0; side < across.size(); ++side) {
    if (across[side] == none) continue;
    ++all;
    bends += normal[side / 3].dot(normal[across[side] / 3]) < bend;
  }
  return all == 0 ? 0 : static_cast<double>(bends) / static_cast<double>(all);
}

}  // namespace

int smooth_skin(LeafletSheet &skin, double thickness, const SkinRidges &ridges,
                Findings &findings) {
  constexpr double most_rounds = 40;
  const double fineness = thickness / median_edge(skin.x, skin.triangles);
  const int rounds = static_cast<int>(std::min(most_rounds, 4 * fineness * fineness));
  if (rounds == 0) return 0;
  // Rims of a smooth skin bend at a few edges, and filters would round them off; steps of voxels
  // bend at a quarter of all.
  constexpr double rough = 0.12;
  if (share_of_bends(skin) < rough) return 0;
  std::vector<std::vector<uint32_t>> around(skin.x.size());
  const Rows stars = rows_of(skin.x.size(), skin.triangles);
  for (uint32_t i = 0; i < around.size(); ++i) {
    const auto &[a, b] = ridges.along[i];
    around[i] = a == none || !ridges.at_rims ? neighbours_in(skin.triangles, stars[i], i)
                                             : std::vector<uint32_t>{a, b};
  }
  const std::vector<Vec3> before = skin.x;
  std::vector<Vec3> next(skin.x.size());
  for (int step = 0; step < 2 * rounds; ++step) {
    const double factor = step % 2 == 0 ? 0.33 : -0.34;
    for (size_t i = 0; i < next.size(); ++i) {
      Vec3 mean = Vec3::Zero();
      for (const uint32_t j : around[i]) mean += skin.x[j];
      mean /= static_cast<double>(around[i].size());
      next[i] = skin.x[i] + factor * (mean - skin.x[i]);
    }
    skin.x.swap(next);
  }
  double moved2 = 0;
  for (size_t i = 0; i < before.size(); ++i) moved2 += (skin.x[i] - before[i]).squaredNorm();
  const double moved = std::sqrt(moved2 / static_cast<double>(before.size()));
  add_measured(findings, "smoothed_skin",
               format("the skin is fine beside its thickness; steps and noise of %.2f mm were "
                      "removed in %d rounds",
                      moved * 1e3, rounds),
               {moved}, "m");
  return rounds;
}

void smooth_rims(LeafletSheet &sheet, int rounds) {
  const std::vector<std::vector<uint32_t>> loops = boundary_loops(sheet);
  const Rows stars = rows_of(sheet.x.size(), sheet.triangles);
  for (int round = 0; round < rounds; ++round) {
    for (const std::vector<uint32_t> &loop : loops) {
      const size_t n = loop.size();
      for (size_t k = 0; k < n; ++k) {
        const uint32_t i = loop[k];
        const Vec3 middle = 0.5 * (sheet.x[loop[(k + 1) % n]] + sheet.x[loop[(k + n - 1) % n]]);
        const Vec3 place = 0.5 * (sheet.x[i] + middle);
        if (may_move(sheet, stars[i], i, place)) sheet.x[i] = place;
      }
    }
  }
}

}  // namespace mvs::core
