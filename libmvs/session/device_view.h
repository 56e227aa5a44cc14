// The similarity transform between the frame of a device and the scene.
#pragma once

#include <mvs/device.h>

#include <Eigen/Geometry>

#include "haptics/tissue_model.h"

namespace mvs::core {

// Largest stiffness that a device renders stably, N/m and N m/rad; the latter is 0 without motors
// for torque. Translation and rotation together are limited: the energy of a tissue model is at
// most (linear |x|^2 + angular |p|^2) / 2.
struct StiffnessLimits {
  double linear = 0, angular = 0;
};

class DeviceView {
 public:
  // Throws MVS_E_ARGUMENT.
  static DeviceView read(const mvs_device_view &given);
  mvs_device_view get() const;

  Vec3 to_scene(const Vec3 &hand) const { return origin_ + scale_ * (rotation_ * hand); }
  Vec3 to_device(const Vec3 &place) const {
    return rotation_.conjugate() * ((place - origin_) / scale_);
  }
  Vec3 turned(const Vec3 &v) const { return rotation_ * v; }
  Eigen::Quaterniond turned(const Eigen::Quaterniond &q) const { return rotation_ * q; }
  double scale() const { return scale_; }
  // Device stiffness per scene stiffness.
  double stiffness_scale() const { return scale_ * force_scale_; }
  // Device torque per scene torque: of the scaled forces at levers of the device's size.
  double torque_scale() const { return force_scale_ / scale_; }
  // Whether a hand at rest at this place of the device would feel the change from another view as a
  // jump. A view may follow a camera by small steps.
  bool jumps_from(const DeviceView &before, const Vec3 &hand) const;
  // Transforms a tissue model of the scene to the device, with at most this stiffness.
  TissueModel to_device(const TissueModel &scene, const StiffnessLimits &most) const;

 private:
  Vec3 origin_ = Vec3::Zero();
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  void turn_to_device(const TissueModel &scene, const StiffnessLimits &most,
                      TissueModel &out) const;

  double scale_ = 1, force_scale_ = 1;
};

}  // namespace mvs::core
