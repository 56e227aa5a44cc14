// The motion of a closed curve as a short Fourier series along it.
//
// Curves that an observer places at two phases differ by the motion and by the errors of both,
// half a millimetre and more in each point (landmarks of networks and observers). The motion of an
// annulus is long-waved: size, place and tilt are waves of one lap, the height of the saddle is one
// of half a lap, a radial change of a D shape has two to four waves. Shorter ones would be errors
// that wrinkle the annulus and stretch the leaflets at it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "patient/closed_curve.h"

namespace mvs::core {

class AnnulusWaves {
 public:
  // The series next to `displacement` (m) of the corners of a curve, by least squares over its
  // length.
  AnnulusWaves(ClosedCurve curve, const std::vector<Vec3> &displacement);

  // m, of the point of the curve that is nearest to p.
  Vec3 operator()(const Vec3 &p) const;

 private:
  static constexpr size_t most_waves = 4;
  static constexpr size_t terms = 2 * most_waves + 1;
  std::array<double, terms> waves_at(double place) const;

  ClosedCurve curve_;
  std::array<Vec3, terms> amplitude_;  // m
};

}  // namespace mvs::core
