// Validation of a view, and the transform of tissue models.
#include "session/device_view.h"

#include <cmath>

#include "base/option_checks.h"
#include "history/event_limits.h"
#include "linalg/eigenvalues.h"
#include "session/tools.h"

namespace mvs::core {
namespace {

constexpr double small_move = 0.5e-3;  // m, of the device: 0.2 N at the 400 N/m of a Touch
constexpr double small_change = 0.1;   // of the force, as a share of it

}  // namespace

DeviceView DeviceView::read(const mvs_device_view &given) {
  must_be_zero(given.reserved, "view.reserved");
  DeviceView view;
  view.origin_ = Vec3::Map(given.origin);
  MVS_MUST((view.origin_.array().abs() <= limits::coordinate).all(), MVS_E_ARGUMENT, "view.origin",
           "view.origin is (%g, %g, %g) m: each has to be a number within %g", given.origin[0],
           given.origin[1], given.origin[2], limits::coordinate);
  const double *const q = given.rotation;
  Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  scale_up_denormal(rotation.coeffs());
  // the stable norm of a NaN beside numbers may be finite
  const double length = rotation.coeffs().stableNorm();
  MVS_MUST(rotation.coeffs().allFinite() && std::isfinite(length), MVS_E_ARGUMENT, "view.rotation",
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

bool DeviceView::jumps_from(const DeviceView &before, const Vec3 &hand) const {
  const Vec3 moved = (to_scene(hand) - before.to_scene(hand)) / scale_;
  const Mat3 turned = force_scale_ * rotation_.toRotationMatrix() -
                      before.force_scale_ * before.rotation_.toRotationMatrix();
  return moved.norm() > small_move || turned.norm() > small_change * before.force_scale_;
}

TissueModel DeviceView::to_device(const TissueModel &scene, const StiffnessLimits &most) const {
  const Mat3 turn = rotation_.toRotationMatrix();
  TissueModel out = scene;
  out.origin = to_device(scene.origin);
  out.force = force_scale_ * (turn.transpose() * scene.force);
  const Mat3 felt = stiffness_scale() * (turn.transpose() * scene.stiffness * turn);
  out.stiffness = with_eigenvalues_in(felt, 0, most.linear);
  out.most = force_scale_ * scene.most;
  out.normal = turn.transpose() * scene.normal;
  out.gap = scene.gap / scale_;
  if (scene.turns != 0) turn_to_device(scene, most, out);
  return out;
}

// The six components are limited together, in the metric of both limits: the part of the stiffness
// that a force along the tool makes indefinite would generate energy.
void DeviceView::turn_to_device(const TissueModel &scene, const StiffnessLimits &most,
                                TissueModel &out) const {
  const Mat3 turn = rotation_.toRotationMatrix();
  const auto turned = [&](double factor, const Mat3 &m) -> Mat3 {
    return factor * (turn.transpose() * m * turn);
  };
  out.orientation = rotation_.conjugate() * scene.orientation;
  out.torque = torque_scale() * (turn.transpose() * scene.torque);
  out.most_torque = torque_scale() * scene.most_torque;
  out.lever = scene.lever / scale_;
  out.arm = turn.transpose() * scene.arm / scale_;
  if (scene.kind == TissueModel::near) {
    const double tilt2 = out.arm.cross(out.normal).squaredNorm();
    const double limit = 1 / (1 / most.linear + tilt2 / most.angular);
    out.stiffness = std::min(stiffness_scale() * scene.stiffness(0, 0), limit) * Mat3::Identity();
    return;
  }
  const double length = std::sqrt(most.angular / most.linear);
  Mat6 felt;
  felt.topLeftCorner<3, 3>() = turned(stiffness_scale(), scene.stiffness);
  felt.topRightCorner<3, 3>() = turned(force_scale_ / length, scene.coupling);
  felt.bottomLeftCorner<3, 3>() = felt.topRightCorner<3, 3>().transpose();
  felt.bottomRightCorner<3, 3>() = turned(torque_scale() / (length * length), scene.turning);
  felt = with_eigenvalues_in(felt, 0, most.linear);
  out.stiffness = felt.topLeftCorner<3, 3>();
  out.coupling = length * felt.topRightCorner<3, 3>();
  out.turning = length * length * felt.bottomRightCorner<3, 3>();
}

}  // namespace mvs::core
