// Means of neighbours; the farthest vertex from the annulus.
#include "patient/checks/displaced_points.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "patient/annulus/closed_curve.h"
#include "patient/findings.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Times the distance of the farthest neighbour from the mean of all, and times the median edge.
constexpr double needle = 4;
// Times the mean diameter of the annulus, from its middle: an anterior leaflet of 33 mm, which is
// doubted as too tall, reaches as far as 1.1.
constexpr double far = 1.6;

}  // namespace

void mend_displaced(LeafletSheet &sheet, Findings &findings) {
  const size_t n = sheet.x.size();
  std::vector<Vec3> mean(n, Vec3::Zero());
  std::vector<double> count(n, 0), reach(n, 0);
  const auto for_neighbours = [&](auto visit) {
    for (const Tri &t : sheet.triangles) {
      for (size_t k = 0; k < 3; ++k) {
        visit(t[k], t[(k + 1) % 3]);
        visit(t[k], t[(k + 2) % 3]);
      }
    }
  };
  for_neighbours([&](uint32_t i, uint32_t j) {
    mean[i] += sheet.x[j];
    ++count[i];
  });
  for (size_t i = 0; i < n; ++i) mean[i] /= std::max(1.0, count[i]);
  for_neighbours([&](uint32_t i, uint32_t j) {
    reach[i] = std::max(reach[i], (sheet.x[j] - mean[i]).norm());
  });
  const double edge = median_edge(sheet.x, sheet.triangles);
  size_t moved = 0;
  double farthest = 0;
  Vec3 at = Vec3::Zero();
  for (size_t i = 0; i < n; ++i) {
    const double off = (sheet.x[i] - mean[i]).norm();
    if (count[i] == 0 || off <= needle * std::max(reach[i], edge)) continue;
    if (off > farthest) at = mean[i];
    farthest = std::max(farthest, off);
    sheet.x[i] = mean[i];
    ++moved;
  }
  if (moved == 0) return;
  findings.push_back(
      {"displaced_points",
       FindingSource::measured,
       0.9,
       format("%zu %s up to %.1f mm away from all of %s neighbours and moved between "
              "them, the farthest to (%.1f, %.1f, %.1f) mm",
              moved, moved == 1 ? "point lay" : "points lay", farthest * 1e3,
              moved == 1 ? "its" : "their", at.x() * 1e3, at.y() * 1e3, at.z() * 1e3),
       {at.x(), at.y(), at.z()},
       "m"});
}

void doubt_far_tissue(const LeafletSheet &sheet, const SheetRims &rims, Findings &findings) {
  const std::vector<Vec3> annulus = points_along(rims.annulus, sheet.x);
  Vec3 centre = Vec3::Zero();
  for (const Vec3 &p : annulus) centre += p / static_cast<double>(annulus.size());
  const double diameter = ClosedCurve(annulus).length() / std::numbers::pi;
  const auto there =
      std::max_element(sheet.x.begin(), sheet.x.end(), [&](const Vec3 &a, const Vec3 &b) {
        return (a - centre).squaredNorm() < (b - centre).squaredNorm();
      });
  const double distance = (*there - centre).norm();
  if (distance <= far * diameter) return;
  findings.push_back(
      {"far_tissue",
       FindingSource::measured,
       1,
       format("the surface reaches (%.1f, %.1f, %.1f) mm, %.0f mm from the middle of the annulus, "
              "whose mean diameter is %.0f mm: leaflets are shorter; remove the points there, or "
              "the tissue that is no leaflet",
              there->x() * 1e3, there->y() * 1e3, there->z() * 1e3, distance * 1e3, diameter * 1e3),
       {distance, diameter},
       "m"});
}

}  // namespace mvs::core
