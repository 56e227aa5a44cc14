// Validation of a view, and the transform of tissue models.
#include "session/device_view.h"

#include <cmath>

#include "base/option_checks.h"
#include "linalg/eigenvalues.h"
#include "session/tools.h"

namespace mvs::core {

DeviceView DeviceView::read(const mvs_device_view &given) {
  DeviceView view;
  view.origin_ = Vec3::Map(given.origin);
  MVS_MUST((view.origin_.array().abs() <= max_coordinate).all(), MVS_E_ARGUMENT, "view.origin",
           "view.origin is (%g, %g, %g) m: each has to be a number within %g", given.origin[0],
           given.origin[1], given.origin[2], max_coordinate);
  const double *const q = given.rotation;
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  const double length = rotation.coeffs().stableNorm();
  MVS_MUST(std::isfinite(length), MVS_E_ARGUMENT, "view.rotation",
           "view.rotation is (%g, %g, %g, %g): it has to be a quaternion w x y z", q[0], q[1], q[2],
           q[3]);
  if (length > 0) view.rotation_.coeffs() = rotation.coeffs() / length;
  must_be_in(given.scale, 0.01, 100, "view.scale");
  must_be_in(given.force_scale, 0.001, 1000, "view.force_scale");
  view.scale_ = value_or(given.scale, 1);
  view.force_scale_ = value_or(given.force_scale, 1);
  return view;
}

mvs_device_view DeviceView::get() const {
  mvs_device_view out = {};
  write(origin_, out.origin);
  write(rotation_, out.rotation);
  out.scale = scale_;
  out.force_scale = force_scale_;
  return out;
}

TissueModel DeviceView::to_device(const TissueModel &scene, double most) const {
  const Mat3 turn = rotation_.toRotationMatrix();
  TissueModel out = scene;
  out.origin = to_device(scene.origin);
  out.force = force_scale_ * (turn.transpose() * scene.force);
  const Mat3 felt = stiffness_scale() * (turn.transpose() * scene.stiffness * turn);
  out.stiffness = with_eigenvalues_in(felt, 0, most);
  out.most = force_scale_ * scene.most;
  out.normal = turn.transpose() * scene.normal;
  out.gap = scene.gap / scale_;
  return out;
}

}  // namespace mvs::core
