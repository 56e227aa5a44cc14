// Limits of the device families, which DHD does not report.
#pragma once

namespace forcedimension {

// Nominal values of CHAI3D's table; continuous forces are not published.
struct Model {
  double force;      // N
  double torque;     // N m
  double stiffness;  // N/m
  double damping;    // N s/m
  double reach;      // m, half of the edge of the workspace's box
};

// Returns the weakest limits for an unknown type.
Model model_of(int type);

}  // namespace forcedimension
