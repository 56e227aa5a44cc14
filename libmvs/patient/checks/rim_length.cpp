// Fourier coefficients by the trapezoidal rule, and the length of their curve.
#include "patient/checks/rim_length.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "patient/closed_curve.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

constexpr size_t waves = 6;
constexpr size_t samples = 360;  // of a lap, about 0.3 mm apart
// Annuli of sound surfaces are up to 4 % longer than the smooth curve.
constexpr double rough = 1.08;

}  // namespace

double smooth_length(const std::vector<Vec3> &polygon) {
  const ClosedCurve curve(polygon);
  constexpr double step = 2 * std::numbers::pi / samples;
  std::array<Vec3, waves> by_cos, by_sin;
  for (size_t k = 0; k < waves; ++k) {
    by_cos[k] = by_sin[k] = Vec3::Zero();
    for (size_t j = 0; j < samples; ++j) {
      const auto share = static_cast<double>(j) / samples;
      const double angle = static_cast<double>((k + 1) * j % samples) * step;
      const Vec3 p = 2.0 / samples * curve.at(share * curve.length());
      by_cos[k] += math::cos(angle) * p;
      by_sin[k] += math::sin(angle) * p;
    }
  }
  const auto point = [&](size_t j) {
    Vec3 sum = Vec3::Zero();
    for (size_t k = 0; k < waves; ++k) {
      const double angle = static_cast<double>((k + 1) * j % samples) * step;
      sum += math::cos(angle) * by_cos[k] + math::sin(angle) * by_sin[k];
    }
    return sum;
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
