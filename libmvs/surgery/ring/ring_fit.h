// How a ring lies on the annulus: which point of the one belongs to which of the other, and the
// rigid motion between them.
#pragma once

#include "measure/annulus/landmarks.h"
#include "measure/comparison/register.h"

namespace mvs::core {

// The point at share u of the annulus's length from its A point belongs to the point at
// start + u (or start - u, where reversed) of the ring's length.
struct RingFit {
  Rigid motion;
  double start = 0;  // share of the ring's length
  bool reversed = false;
  double squares = 0;  // m2: mean squared distance between the points that belong together
};

// What is known beforehand.
struct RingSeat {
  const Rigid *motion = nullptr;  // null: the best one is looked for
  bool start_is_a = false;        // the ring's first point is its A point
};

// The fit with the least `squares`: over both windings, any start, and rigid motions without a
// reflection. `annulus` is walked from its A point at arc length `a`.
RingFit fit_ring(const Loop &ring, const Loop &annulus, double a, const RingSeat &seat);

// Where the point of the ring that belongs to share u of the annulus comes to lie.
Vec3 seat_of(const Loop &ring, const RingFit &fit, double u);

}  // namespace mvs::core
