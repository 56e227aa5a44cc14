// Between the frame of a device and the scene.
#pragma once

#include <mvs/device.h>

#include <Eigen/Geometry>

#include "haptics/tissue_model.h"

namespace mvs::core {

class DeviceView {
 public:
  // Throws MVS_E_ARGUMENT.
  static DeviceView read(const mvs_device_view &given);
  mvs_device_view told() const;

  Vec3 to_scene(const Vec3 &hand) const { return origin_ + scale_ * (rotation_ * hand); }
  Vec3 to_device(const Vec3 &place) const {
    return rotation_.conjugate() * ((place - origin_) / scale_);
  }
  Vec3 turned(const Vec3 &v) const { return rotation_ * v; }
  Eigen::Quaterniond turned(const Eigen::Quaterniond &q) const { return rotation_ * q; }
  double scale() const { return scale_; }
  // N/m of the device for each N/m in the scene.
  double stiffness_scale() const { return scale_ * force_scale_; }
  // A model in the scene, as the device is to render it; no stiffer than `most` N/m of the device.
  TissueModel to_device(const TissueModel &scene, double most) const;

 private:
  Vec3 origin_ = Vec3::Zero();
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  double scale_ = 1, force_scale_ = 1;
};

}  // namespace mvs::core
