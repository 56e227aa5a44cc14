// Leaflets with wall of the atrium beyond their annulus, as segmentations have it.
#pragma once

#include <algorithm>

#include "patient/mesh/remesh_sheet.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/sheets.h"

namespace mvs::core::test {

struct WalledValve {
  Surface surface;            // leaflets and wall
  LeafletSheet leaflets;      // the leaflets alone
  std::vector<Vec3> annulus;  // where they meet, in order
};

// A wall of `rows` rows of 2 mm that leans outward by 30 degrees, above annulus vertices with
// has_wall(vertex of the annulus, by its number in the loop).
template <typename HasWall>
WalledValve with_wall(uint32_t vertices, uint32_t rows, HasWall &&has_wall) {
  const ParametricSheet p = parametric_sheet(vertices);
  WalledValve made{surface_of(p.sheet), p.sheet, {}};
  const std::vector<uint32_t> &loop = p.rims.annulus;
  const uint32_t n = static_cast<uint32_t>(loop.size());
  for (const uint32_t i : loop) made.annulus.push_back(p.sheet.x[i]);
  const uint32_t first = static_cast<uint32_t>(made.surface.x.size());
  for (uint32_t j = 1; j <= rows; ++j) {
    for (const Vec3 &a : made.annulus) {
      const Vec3 out = Vec3(a.x(), a.y(), 0).normalized();
      made.surface.x.emplace_back(a + 2e-3 * j * (0.5 * out + 0.866 * Vec3::UnitZ()));
    }
  }
  const auto at = [&](uint32_t j, uint32_t k) {
    return j == 0 ? loop[k % n] : first + (j - 1) * n + k % n;
  };
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t k = 0; k < n; ++k) {
      if (!has_wall(k) || !has_wall((k + 1) % n)) continue;
      made.surface.triangles.push_back({at(j, k + 1), at(j, k), at(j + 1, k)});
      made.surface.triangles.push_back({at(j, k + 1), at(j + 1, k), at(j + 1, k + 1)});
    }
  }
  return made;
}

// The same with edges of `edge` that do not follow the annulus.
inline WalledValve remeshed_with_wall(uint32_t vertices, uint32_t rows, double edge) {
  WalledValve made = with_wall(vertices, rows, [](uint32_t) { return true; });
  const LeafletSheet sheet = cleaned(made.surface);
  const auto loops = loops_by_length(sheet);
  const bool first = loop_length(sheet, loops[0]) > loop_length(sheet, loops[1]);
  const SheetRims rims = {loops[first ? 0 : 1], loops[first ? 1 : 0]};
  made.surface = surface_of(remesh_sheet(sheet, rims, {edge}).sheet);
  return made;
}

// Every `step`-th point of the annulus in another order, off by up to `error` m.
inline std::vector<Vec3> annulus_points(const WalledValve &valve, size_t step, double error) {
  std::vector<Vec3> points;
  uint64_t state = 5;
  for (size_t k = 0; k < valve.annulus.size(); k += step) {
    const Vec3 off{next_share(state), next_share(state), next_share(state)};
    points.emplace_back(valve.annulus[k] + error * off);
  }
  for (size_t k = points.size(); k > 1; --k) {
    std::swap(points[k - 1], points[next_random(state) % k]);
  }
  return points;
}

}  // namespace mvs::core::test
