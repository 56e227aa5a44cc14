// Table of simulated devices; README.md gives the sources of the figures.
#pragma once

#include <string>

namespace hand {

struct Device {
  const char *name;
  const char *model;
  double force, continuous_force;   // N; 0: unknown
  double stiffness, damping, rate;  // N/m, N s/m, Hz: rated values
  double reach;                     // m, half an edge of its workspace
  double resolution;                // m, of its encoders at the tip
  double mass, drag;                // kg, N s/m: moved with the hand
  unsigned delay;                   // samples from writing a force to its effect
  unsigned freedoms_in;
  // Limits of the torque of a device with motors for it: N m, N m/rad, N m s/rad; 0: unknown.
  double torque = 0, angular_stiffness = 0, angular_damping = 0;
  double inertia = 5e-5, turn_drag = 0;  // kg m2, N m s/rad: turned with the hand
  double turn_resolution = 0;            // rad, of its encoders

  unsigned freedoms_out() const { return force <= 0 ? 0 : torque <= 0 ? 3 : 6; }
};

// Returns a device by name; throws a Refusal with all names.
const Device &device(const std::string &name);

}  // namespace hand
