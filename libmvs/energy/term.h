// Elements of energy terms, and matrix blocks that several terms share.
#pragma once

#include "base/types.h"

namespace mvs::core {

// Elements of a term with a node that moves, which are all that a solver needs, or those between
// prescribed nodes alone, which pull at them as well.
enum class Elements { moving, prescribed };

inline bool takes(Elements which, bool all_prescribed) {
  return all_prescribed == (which == Elements::prescribed);
}

// The Hessian of a term as it is, or projected: without the part that makes it indefinite.
// Balanced: projected, but with the whole Hessian of contact between sheets. The Hessian of the
// pressure, which has no projected form, is as negative where pressed sheets turn together as that
// of their contact is positive: without the latter a Newton step is several times too long there.
enum class Curvature { exact, projected, balanced };

// d2E/dx_i2 for E(L), L = |x_i - x_j|: stiffness along the unit direction n, tension / L across it.
// A compressed spring buckles sideways (tension < 0); the projected block has 0 there.
inline Mat3 axial_block(const Vec3 &n, double stiffness, double tension_over_length,
                        Curvature curvature) {
  const double across =
      curvature != Curvature::exact && tension_over_length < 0 ? 0.0 : tension_over_length;
  Mat3 block = (stiffness - across) * (n * n.transpose());
  block.diagonal().array() += across;
  return block;
}

// [v]x, the matrix with [v]x a = v x a.
inline Mat3 cross_matrix(const Vec3 &v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace mvs::core
