// Rotation of the hand with the device in it: one inertia about all axes, on the spring and damper
// of a wrist whose other end is at rest or swings about an axis.
//
// The rotation vector from the rest orientation follows the oscillator of body.h, and its
// increments turn the hand. That is exact for rotations about one axis, and for any rotation
// without a wrist; the work of a held torque is then the change of the kinetic energy, up to
// rounding.
#pragma once

#include <array>

#include "settings.h"

namespace hand {

using Quaternion = std::array<double, 4>;  // w x y z, of length 1

class Wrist {
 public:
  explicit Wrist(const Rotation &rotation);

  const Quaternion &orientation() const { return orientation_; }
  const driver::Vector &spin() const { return spin_; }  // rad/s
  // The orientation as encoders with this resolution, rad, report it; 0: exactly.
  Quaternion encoded(double resolution) const;

  // Advances by `length` s from `begin`, s after the start of the script, under a constant torque,
  // N m. Before the script (negative time) the wrist rests.
  void move(double begin, double length, const driver::Vector &torque);

 private:
  Rotation rotation_;
  Quaternion orientation_;
  driver::Vector spin_ = {};
  double length_ = -1;  // s, interval of step_
  Step step_ = {};
};

}  // namespace hand
