// Placement of a ring on the annulus: correspondence of points by arc length, and rigid motion.
#pragma once

#include "measure/annulus/landmarks.h"
#include "measure/comparison/register.h"

namespace mvs::core {

// The point at share u of the annulus length from its A point corresponds to the point at start + u
// (start - u if reversed) of the ring length.
struct RingFit {
  Rigid motion;
  double start = 0;  // share of the ring's length
  bool reversed = false;
  double squares = 0;  // m2: mean squared distance of corresponding points
};

// Constraints of a fit.
struct RingSeat {
  const Rigid *motion = nullptr;  // null: optimised
  bool start_is_a = false;        // the ring's first point is its A point
};

// Returns the fit with the least `squares` over both windings, all starts, and rigid motions
// without reflection. The annulus starts at its A point, arc length `a`.
RingFit fit_ring(const Loop &ring, const Loop &annulus, double a, const RingSeat &seat);

// Returns the position of the ring point that corresponds to share u of the annulus.
Vec3 seat_of(const Loop &ring, const RingFit &fit, double u);

}  // namespace mvs::core
