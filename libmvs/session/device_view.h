// The similarity transform between the frame of a device and the scene.
#pragma once

#include <mvs/device.h>

#include <Eigen/Geometry>

#include "haptics/tissue_model.h"

namespace mvs::core {

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
  // Transforms a tissue model of the scene to the device, with a stiffness of at most `most` N/m.
  TissueModel to_device(const TissueModel &scene, double most) const;

 private:
  Vec3 origin_ = Vec3::Zero();
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  double scale_ = 1, force_scale_ = 1;
};

}  // namespace mvs::core
