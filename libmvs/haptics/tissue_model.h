// Local tissue model: a first-order expansion of the force on the tool about an origin, which the
// servo evaluates between two steps of the simulation, and the nearest surface. In the frame of the
// device and in forces of its motors: scale and force scale are applied.
//
// A force with its derivative, instead of a constant force, renders stiff tissue at a low
// simulation rate without instability (Mark et al., SIGGRAPH 1996; the force fields of VRPN).
#pragma once

#include "base/types.h"

namespace mvs::core {

struct TissueModel {
  enum Kind : uint32_t {
    free,     // no force
    held,     // pulls in every direction
    touched,  // pushes only: zero where the linear force would pull
    near,     // a plane at distance `gap` that pushes the hand once it is reached
    pulled    // a constant force
  };
  uint32_t kind = free;
  uint64_t contact = 0;  // number of the contact; models of one grasp or tool share it
  Vec3 origin = Vec3::Zero(), force = Vec3::Zero();
  Mat3 stiffness = Mat3::Zero();  // -dF/dx at the origin; of a plane along its normal
  double most = 0;                // N, at which the spring between hand and tool saturates
  Vec3 normal = Vec3::Zero();     // of a plane, towards the hand
  double gap = 0;                 // m, from the hand to the plane
};

// The force on a hand.
Vec3 force_at(const TissueModel &tissue, const Vec3 &hand);

// The work on a hand on the straight path from the origin to `hand`, by the trapezoidal rule; exact
// for a linear force.
double work_to(const TissueModel &tissue, const Vec3 &hand);

}  // namespace mvs::core
