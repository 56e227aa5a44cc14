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
};

// Returns a device by name; throws a Refusal with all names.
const Device &device(const std::string &name);

}  // namespace hand
