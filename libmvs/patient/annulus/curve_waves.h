// A vector along a closed curve as a short Fourier series of the length along it.
#pragma once

#include <cstddef>
#include <vector>

#include "patient/annulus/closed_curve.h"

namespace mvs::core {

class CurveWaves {
 public:
  // The series of `waves` waves a lap that is next to the values at the corners of a curve, by
  // least squares over its length.
  CurveWaves(ClosedCurve curve, const std::vector<Vec3> &values, size_t waves);

  // The value at a place, m along the curve.
  Vec3 at(double place) const;
  // The value at the point of the curve that is nearest to p.
  Vec3 near(const Vec3 &p) const { return at(curve_.nearest(p)); }
  double length() const { return curve_.length(); }  // m, of the curve

 private:
  // 1, and cosine and sine of each number of waves.
  std::vector<double> terms_at(double place) const;

  ClosedCurve curve_;
  std::vector<Vec3> amplitude_;  // of each term
};

}  // namespace mvs::core
