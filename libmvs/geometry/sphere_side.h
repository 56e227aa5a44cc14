// On which side of the sphere through four lattice points a fifth lies, in doubles with a bound of
// their rounding: a filter before exact arithmetic.
#pragma once

namespace mvs::core {

// Three coordinates and a zero, integers of at most 20 bits.
struct alignas(32) SpherePoint {
  double at[4];
};

enum class SphereSide { inside, outside, unknown };

// Returns on which side of the sphere through a, b, c, d, which have positive volume, p lies. The
// answer depends on the points alone; `unknown` if rounding could change it.
SphereSide sphere_side(const SpherePoint &a, const SpherePoint &b, const SpherePoint &c,
                       const SpherePoint &d, const SpherePoint &p);

}  // namespace mvs::core
