// The length of the waves of the annulus beside that of the annulus.
#include "patient/checks/rim_length.h"

#include <algorithm>

#include "base/error.h"
#include "patient/annulus/curve_waves.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

constexpr size_t waves = 6;
constexpr size_t samples = 360;  // of a lap, about 0.3 mm apart
// Annuli of sound surfaces are up to 4 % longer than the smooth curve.
constexpr double rough = 1.08;

}  // namespace

double smooth_length(const std::vector<Vec3> &polygon) {
  const CurveWaves smooth(ClosedCurve(polygon), polygon, waves);
  const auto point = [&](size_t j) {
    return smooth.at(static_cast<double>(j) / samples * smooth.length());
  };
  double length = 0;
  Vec3 last = point(samples - 1);
  for (size_t j = 0; j < samples; ++j) {
    const Vec3 here = point(j);
    length += (here - last).norm();
    last = here;
  }
  return length;
}

void doubt_annulus_length(const LeafletSheet &sheet, const SheetRims &rims, Findings &findings) {
  const std::vector<Vec3> polygon = points_along(rims.annulus, sheet.x);
  const double length = ClosedCurve(polygon).length(), smooth = smooth_length(polygon);
  if (length <= rough * smooth) return;
  findings.push_back(
      {"annulus_length",
       FindingSource::measured,
       1,
       format(
           "the annulus is %.0f mm long, a smooth curve along it %.0f mm: the surface is torn or "
           "noisy there, and the leaflets may be too large by as much; smooth the surface, or "
           "extend it a little beyond the annulus and give six annulus points or more, along "
           "which it is cut off",
           length * 1e3, smooth * 1e3),
       {length, smooth},
       "m"});
  if (Finding *annulus = find_finding(findings, "annulus")) {
    annulus->confidence = std::min(annulus->confidence, smooth / length);
  }
}

}  // namespace mvs::core
