// The affine motion with which a closed curve meets others.
#pragma once

#include <array>
#include <vector>

#include "base/types.h"

namespace mvs::core {

using CurveSide = std::array<Vec3, 2>;

// The sides of a closed polygon.
std::vector<CurveSide> sides_of(const std::vector<Vec3> &polygon);

// p itself if there are no sides.
Vec3 nearest_on_sides(const std::vector<CurveSide> &sides, const Vec3 &p);

struct Affine {
  Mat3 stretch = Mat3::Zero();
  Vec3 shift = Vec3::Zero();
};

// Share of the points that have to lie on the sides.
constexpr double least_on_curve = 0.65;

struct Meeting {
  Affine motion;
  double seen = 0;  // share of the points that lie on the curve
  double rms = 0;   // m, of these from it
};

// Iterative closest points (Besl and McKay 1992) of `points`, whose motion is relative to `centre`,
// with a weak preference for none. Points farther than `reach` (m) from all sides do not count. It
// ends early where fewer points than least_on_curve lie on the sides.
Meeting meet(const std::vector<Vec3> &points, const Vec3 &centre,
             const std::vector<CurveSide> &sides, double reach);

}  // namespace mvs::core
