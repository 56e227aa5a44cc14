// What the servo knows of the tissue around a tool between two steps of the simulation: the force
// where the hand was, how it changes with the hand's place, what is near. In the frame of the
// device and in the units of its motors: scale and force scale are in it already.
//
// A force with its derivative about an origin, instead of a force, is what lets a slow simulation
// feel stiff without shaking (Mark et al., SIGGRAPH 1996; VRPN's force fields do the same).
#pragma once

#include "base/types.h"

namespace mvs::core {

struct TissueModel {
  enum Kind : uint32_t {
    free,     // nothing to feel
    held,     // pulls in every direction
    touched,  // pushes only: never pulls the hand towards where it pushes from
    near,     // a plane, `gap` away, that pushes when the hand has come to it
    pulled    // the same force wherever the hand is
  };
  uint32_t kind = free;
  uint64_t contact = 0;  // one grasp or tool; models of the same one share it
  Vec3 origin = Vec3::Zero(), force = Vec3::Zero();
  Mat3 stiffness = Mat3::Zero();  // -dF/dx at the origin; of a plane along its normal
  double most = 0;                // N: the spring between hand and tool gives way
  Vec3 normal = Vec3::Zero();     // of a plane, towards the hand
  double gap = 0;                 // m, from the hand to where the plane begins to push
};

// The force on a hand.
Vec3 force_at(const TissueModel &tissue, const Vec3 &hand);

// The work on a hand that goes straight from the origin to `hand`, by the trapezoidal rule: exact
// where the force is linear.
double work_to(const TissueModel &tissue, const Vec3 &hand);

}  // namespace mvs::core
