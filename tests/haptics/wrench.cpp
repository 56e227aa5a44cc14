// The local model of force and torque is the derivative of an energy at any rotation, within the
// limits of the springs and of the device.
#include <doctest/doctest.h>
#include <mvs/device.h>

#include <cmath>

#include "haptics/tissue_model_builder.h"
#include "linalg/eigenvalues.h"
#include "session/device_view.h"
#include "tests/haptics/numbers.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A grasp of the size of a rod's contact: 200 N/m, 0.1 N m/rad, coupled.
TissueModel coupled(Numbers &numbers) {
  TissueModel tissue;
  tissue.kind = TissueModel::held;
  tissue.turns = 1;
  tissue.most = 100;
  tissue.most_torque = 10;
  tissue.orientation = turned(numbers.vector());
  tissue.force = numbers.vector();
  tissue.torque = 0.02 * numbers.vector();
  Mat6 root;
  for (double &value : root.reshaped()) value = numbers.next();
  Mat6 whole = root * root.transpose();
  tissue.stiffness = 200 * whole.topLeftCorner<3, 3>();
  tissue.coupling = 200 * 0.02 * whole.topRightCorner<3, 3>();
  tissue.turning = 200 * 0.02 * 0.02 * whole.bottomRightCorner<3, 3>();
  return tissue;
}

double work_of_path(const TissueModel &tissue, const Placement &from, const Vec3 &step,
                    const Vec3 &rotation, int parts) {
  double work = 0;
  Placement at = from;
  Wrench before = wrench_at(tissue, at);
  const Eigen::Quaterniond part = turned(rotation / parts);
  for (int k = 0; k < parts; ++k) {
    at.position += step / parts;
    at.orientation = (part * at.orientation).normalized();
    const Wrench now = wrench_at(tissue, at);
    work += 0.5 * (before.force + now.force).dot(step / parts) +
            0.5 * (before.torque + now.torque).dot(rotation / parts);
    before = now;
  }
  return work;
}

}  // namespace

// Over rotations of up to 2 rad. The trapezoidal rule converges with the square of the step: 2000
// parts leave 1e-6 of the energies involved.
TEST_CASE("the work of a coupled model depends on the ends of a path only") {
  Numbers numbers;
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    const TissueModel tissue = coupled(numbers);
    const Placement begin = {tissue.origin, tissue.orientation};
    Placement at = begin;
    double work = 0, size = 0;
    for (int leg = 0; leg < 3; ++leg) {
      const Vec3 step = 0.02 * numbers.vector(), rotation = 0.7 * numbers.vector();
      const double part = work_of_path(tissue, at, step, rotation, 2000);
      work += part;
      size += std::abs(part);
      at.position += step;
      at.orientation = (turned(rotation) * at.orientation).normalized();
    }
    CHECK_LT(std::abs(work - work_to(tissue, at)), 1e-5 * size);
    CHECK_GT(size, 1e-4);
  }
}

TEST_CASE("a plane with an arm does the work of its spring, and none before it is reached") {
  Numbers numbers;
  TissueModel plane;
  plane.kind = TissueModel::near;
  plane.turns = 1;
  plane.normal = Vec3(1, 2, 2) / 3;
  plane.arm = Vec3(0.01, 0.03, -0.02);
  plane.stiffness = 300 * Mat3::Identity();
  plane.gap = 1e-3;
  plane.most = 100;
  plane.most_torque = 10;
  int reached = 0;
  for (int k = 0; k < 50; ++k) {
    const Vec3 step = 3e-3 * numbers.vector(), rotation = 0.1 * numbers.vector();
    const double work = work_of_path(plane, {}, step, rotation, 2000);
    const Placement end = {step, turned(rotation)};
    const Vec3 p = 2 * end.orientation.vec();
    const double depth =
        std::max(0.0, -plane.normal.dot(step) - plane.arm.cross(plane.normal).dot(p) - plane.gap);
    // the kink of the force at the plane costs the rule one part of 2000
    CHECK_LT(std::abs(work + 150 * depth * depth), 1e-3 * (150 * depth * depth + 1e-7));
    reached += depth > 0 ? 1 : 0;
  }
  CHECK_GT(reached, 5);
}

TEST_CASE("force and torque stay within the saturation of the tool's springs") {
  Numbers numbers;
  for (int k = 0; k < 100; ++k) {
    TissueModel tissue = coupled(numbers);
    tissue.most = 0.5;
    tissue.most_torque = 0.01;
    const Placement hand = {0.1 * numbers.vector(), turned(3 * numbers.vector())};
    const Wrench wrench = wrench_at(tissue, hand);
    CHECK_LE(wrench.force.norm(), 0.5 * (1 + 1e-12));
    CHECK_LE(wrench.torque.norm(), 0.01 * (1 + 1e-12));
  }
}

TEST_CASE("a view maps force and torque with the power that they have") {
  Numbers numbers;
  mvs_device_view given = {};
  given.struct_size = sizeof given;
  given.origin[0] = 0.1;
  given.rotation[0] = given.rotation[1] = given.rotation[2] = 0.5;
  given.scale = 0.3;
  given.force_scale = 2;
  const DeviceView view = DeviceView::read(given);
  for (int k = 0; k < 20; ++k) {
    const TissueModel scene = coupled(numbers);
    const TissueModel device = view.to_device(scene, {1e6, 1e6});
    const Placement hand = {0.01 * numbers.vector(), turned(numbers.vector())};
    const Wrench there =
        wrench_at(scene, {view.to_scene(hand.position), view.turned(hand.orientation)});
    const Wrench here = wrench_at(device, hand);
    // one factor for the power of force and torque; rounding of some rotations
    CHECK_LT((view.turned(here.force) - 2 * there.force).norm(), 1e-12 * there.force.norm());
    CHECK_LT((view.turned(here.torque) - 2 / 0.3 * there.torque).norm(),
             1e-12 * here.torque.norm());
  }
}

TEST_CASE("the stiffness of a view is within the limits of translation and rotation together") {
  Numbers numbers;
  mvs_device_view given = {};
  given.struct_size = sizeof given;
  const DeviceView view = DeviceView::read(given);
  const StiffnessLimits most = {100, 0.02};
  for (int k = 0; k < 50; ++k) {
    TissueModel scene = coupled(numbers);
    if (k % 2 == 1) scene.turning -= 0.1 * Mat3::Identity();  // indefinite
    const TissueModel device = view.to_device(scene, most);
    const Vec3 x = numbers.vector(), p = 50 * numbers.vector();
    const double energy = 0.5 * x.dot(device.stiffness * x) + x.dot(device.coupling * p) +
                          0.5 * p.dot(device.turning * p);
    const double bound = 0.5 * (most.linear * x.squaredNorm() + most.angular * p.squaredNorm());
    CHECK_GE(energy, -1e-12 * bound);
    CHECK_LE(energy, bound * (1 + 1e-12));
  }
}
