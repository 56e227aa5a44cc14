// The limits of the families of devices: DHD does not tell them.
#pragma once

namespace forcedimension {

// Nominal, as CHAI3D's table has them; what the motors bear for ever is nowhere told.
struct Model {
  double force;      // N
  double torque;     // N m
  double stiffness;  // N/m
  double damping;    // N s/m
  double reach;      // m, half of the edge of the workspace's box
};

// Of an unknown type those that are the weakest of all.
Model model_of(int type);

}  // namespace forcedimension
