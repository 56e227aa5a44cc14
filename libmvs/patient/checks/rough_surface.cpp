// The median angle between the normals of neighbouring triangles.
#include "patient/checks/rough_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "base/median.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/manifold.h"

namespace mvs::core {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double rough_cosine = 0.766;  // of 40 degrees

}  // namespace

void doubt_rough_surface(const LeafletSheet &sheet, Findings &findings) {
  std::vector<Vec3> normal;
  normal.reserve(sheet.triangles.size());
  for (const Tri &t : sheet.triangles) {
    const Vec3 &a = sheet.x[t[0]], &b = sheet.x[t[1]], &c = sheet.x[t[2]];
    normal.emplace_back((b - a).cross(c - a).normalized());
  }
  const std::vector<uint32_t> across = join_sides(sheet.x, sheet.triangles).across;
  std::vector<double> cosine;
  for (size_t side = 0; side < across.size(); ++side) {
    if (across[side] == none) continue;
    cosine.push_back(std::clamp(normal[side / 3].dot(normal[across[side] / 3]), -1.0, 1.0));
  }
  const double median = cosine.empty() ? 1 : median_of(std::move(cosine));
  if (median >= rough_cosine) return;
  const double angle = math::atan2(std::sqrt(1 - median * median), median);
  findings.push_back(
      {"rough_surface",
       FindingSource::measured,
       1,
       format("the surface turns by %.0f degrees across half of its edges or more: with so much "
              "noise its leaflets are several percent too large; smooth the surface, or the labels "
              "that it was made from",
              angle / degree),
       {angle},
       ""});
}

}  // namespace mvs::core
