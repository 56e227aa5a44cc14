// Reproducible random vectors and rotations for tests of haptics.
#pragma once

#include <Eigen/Geometry>

#include "base/types.h"

namespace mvs::core::test {

struct Numbers {
  uint64_t state = 1;
  // Uniform in -1 .. 1 (xorshift, Marsaglia 2003).
  double next() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;
  }
  Vec3 vector() {
    const double x = next(), y = next();
    return Vec3(x, y, next());
  }
};

inline Eigen::Quaterniond turned(const Vec3 &rotation) {
  const double angle = rotation.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

}  // namespace mvs::core::test
