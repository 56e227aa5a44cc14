// Local tissue model: a first-order expansion of the force on the tool about an origin, which the
// servo evaluates between two steps of the simulation, and the nearest surface. In the frame of the
// device and in forces of its motors: scale and force scale are applied.
//
// A force with its derivative, instead of a constant force, renders stiff tissue at a low
// simulation rate without instability (Mark et al., SIGGRAPH 1996; the force fields of VRPN).
//
// For a tool with a torque the model is one expansion in translation and rotation. With the unit
// quaternion (w, v) of the rotation from the model's orientation to the hand's, w >= 0, its
// coordinate is p = 2 v, the rotation vector to second order. An energy that is quadratic in
// translation and p has the torque w g + v x g, g its negative derivative by p, since p' = w s + s
// x v for an angular velocity s. A closed motion of the hand does no work on it, at any angle, and
// it needs no trigonometric function.
#pragma once

#include <Eigen/Geometry>

#include "base/types.h"

namespace mvs::core {

// Force on the hand, N, and torque about its position, N m.
struct Wrench {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
};

// Position of the hand, and its orientation: from the stylus' axes to those of the frame.
struct Placement {
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

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

  // Torque model of a tool that has one; the members below are unused if `turns` is 0.
  uint32_t turns = 0;
  double lever = 0;        // m, length at which a torque counts as much as a force
  double most_torque = 0;  // N m, largest one of the tool's springs
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of the hand at the origin
  Vec3 torque = Vec3::Zero();
  Mat3 coupling = Mat3::Zero();  // -dF/dp, N/rad; its transpose is -dg/dx
  Mat3 turning = Mat3::Zero();   // -dg/dp, N m/rad, symmetric
  Vec3 arm = Vec3::Zero();       // of a plane: from the hand to the tool's nearest point, m
};

// The model of a share of these forces.
TissueModel scaled(const TissueModel &tissue, double share);

// The force on a hand, for a device without torque: orientation does not act.
Vec3 force_at(const TissueModel &tissue, const Vec3 &hand);

// Force and torque on a hand; the torque is zero if the model has none.
Wrench wrench_at(const TissueModel &tissue, const Placement &hand);

// The work on a hand on the straight path from the origin to `hand`, by the trapezoidal rule; exact
// for a linear force.
double work_to(const TissueModel &tissue, const Placement &hand);

// The rotation vector from one orientation to another, rad, for small angles: relative error
// 3/40 (angle / 2)^4, below 1e-7 at the 0.06 rad that the fastest allowed hand turns in 3 ms.
Vec3 small_rotation(const Eigen::Quaterniond &from, const Eigen::Quaterniond &to);

}  // namespace mvs::core
