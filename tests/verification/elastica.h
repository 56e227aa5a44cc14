// The heavy elastica: a clamped beam under its own weight, with large rotations.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/solve/bench.h"

namespace mvs::core::verification {

// One row of shared/data/verification/e_heavy_cantilever.csv.
struct HeavyBeam {
  double g, drop, angle;  // w L^3 / E I, over L, rad
};
inline std::vector<HeavyBeam> heavy_beams() {
  std::vector<HeavyBeam> rows;
  for (const test::Cells &row : test::reference_table("e_heavy_cantilever.csv")) {
    rows.push_back({std::stod(row[0]), std::stod(row[1]), std::stod(row[3])});
  }
  return rows;
}

// x and z over the length along the heavy elastica, from its tip back: theta'' = -g (1 - s) cos
// theta, theta' = 0 at the tip, whose angle the table has.
class Elastica {
 public:
  explicit Elastica(const HeavyBeam &exact) {
    double theta = exact.angle, bend = 0, s = 1;
    angle_.assign(steps + 1, theta);
    for (int k = steps; k > 0; --k) {
      // midpoint: 1e-6 of the length at 1000 steps, and only a start for Newton
      const double h = 1.0 / steps;
      const double middle = theta - 0.5 * h * bend;
      const double half = bend + 0.5 * h * exact.g * (1 - s) * std::cos(theta);
      bend += h * exact.g * (1 - s + 0.5 * h) * std::cos(middle);
      theta -= h * half;
      s -= h;
      angle_[k - 1] = theta;
    }
  }
  double angle(double s) const { return angle_[std::lround(std::clamp(s, 0.0, 1.0) * steps)]; }

 private:
  static constexpr int steps = 1000;
  std::vector<double> angle_;
};

}  // namespace mvs::core::verification
