// The devices that the hand can hold; README.md says where each figure comes from.
#pragma once

#include <string>

namespace hand {

struct Device {
  const char *name;
  const char *model;
  double force, continuous_force;   // N; 0: it does not say
  double stiffness, damping, rate;  // N/m, N s/m, Hz: what it is said to render
  double reach;                     // m, half an edge of its workspace
  double resolution;                // m, of its encoders at the tip
  double mass, drag;                // kg, N s/m: what the hand moves along
  unsigned delay;                   // samples from a force's writing to its effect
  unsigned freedoms_in;
};

// Throws a Refusal that names all there are.
const Device &device(const std::string &name);

}  // namespace hand
