// Single ticks of the servo: the clock of the device, the rate of forces, the gate before a model.
#include <doctest/doctest.h>

#include "tests/about.h"
#include "tests/haptics/bare_servo.h"
#include "tests/haptics/loop.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

const Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
const Vec3 place(1e-3, 0, 0);

double norm(const mvs_driver_force &force) {
  return Vec3::Map(force.force).norm();
}

// A servo that renders a grasp with so many N/m, 1 mm away from its place.
void hold(BareServo &servo, double stiffness) {
  servo.arm();
  servo.links().tissue.post(spring(stiffness));
  for (int k = 0; k < 200; ++k) servo.tick();
}

mvs_device_limits with_force(double force) {
  mvs_device_limits limits = {};
  limits.struct_size = sizeof limits;
  limits.force = force;
  limits.stale_s = 10;
  return limits;
}

}  // namespace

TEST_CASE("a_clock_that_creeps_stands_still_and_latches") {
  // 1 ns a sample, and us where ns are meant
  for (const uint64_t ns : {1u, 1000u}) {
    CAPTURE(ns);
    BareServo servo(3, 3);
    hold(servo, 1000);
    REQUIRE_EQ(norm(servo.tick()), about(1.0, 1e-6));
    for (int k = 0; k < 300; ++k) servo.tick(upright, place, ns);
    CHECK_EQ(servo.status().phase, DevicePhase::latched);
    CHECK_EQ(servo.status().cause, Cause::watchdog);
    CHECK_EQ(norm(servo.tick(upright, place, ns)), 0);
  }
  // samples that come in pairs are no creeping clock
  BareServo servo(3, 3);
  hold(servo, 1000);
  for (int k = 0; k < 600; ++k) servo.tick(upright, place, k % 2 == 0 ? 1999000 : 1000);
  CHECK_EQ(servo.status().phase, DevicePhase::on);
}

TEST_CASE("a_lowered_limit_takes_effect_at_the_rate_of_the_device") {
  BareServo servo(3, 3);
  hold(servo, 1000);
  REQUIRE_EQ(norm(servo.tick()), about(1.0, 1e-6));
  servo.set_limits(with_force(0.1));  // its own rate is 10 N/s
  for (int k = 0; k < 4; ++k) servo.tick();
  // 0.9 N at 330 N/s
  CHECK_LE(norm(servo.tick()), 0.1 + 1e-9);
}

TEST_CASE("a_force_after_a_gap_rises_no_faster_than_after_a_late_sample") {
  BareServo servo(3, 3);
  hold(servo, 100);
  const double before = norm(servo.tick());
  // 95 ms of silence, and the hand 15 mm away; the hand stays below the limit of speed
  const double after = norm(servo.tick(upright, Vec3(16e-3, 0, 0), 95000000));
  CHECK_EQ(servo.status().phase, DevicePhase::on);
  CHECK_LE(after, before + 2e-3 * 330 + 1e-9);
  CHECK_GT(norm(servo.tick(upright, Vec3(16e-3, 0, 0))), after);
}

TEST_CASE("forces_wait_for_a_first_model") {
  BareServo servo(3, 3);
  servo.tick();
  servo.links().requests.arm();
  for (int k = 0; k < 3000; ++k) servo.tick();
  CHECK_EQ(servo.status().phase, DevicePhase::waiting);
  // the first model exceeds the gate: the hand has to move away
  servo.links().tissue.post(spring(1000));
  for (int k = 0; k < 200; ++k) CHECK_EQ(norm(servo.tick()), 0);
  CHECK_EQ(servo.status().phase, DevicePhase::waiting);
  for (int k = 0; k < 30; ++k) servo.tick(upright, Vec3::Zero());
  CHECK_EQ(servo.status().phase, DevicePhase::on);
}

TEST_CASE("the_wall_of_the_workspace_keeps_the_limit_of_stiffness") {
  DeviceTraits traits;
  traits.has_workspace = true;
  for (int k = 0; k < 3; ++k) {
    traits.info.workspace_min[k] = -0.1;
    traits.info.workspace_max[k] = 0.1;
  }
  mvs_device_limits limits = {};
  limits.stiffness = 20;
  const Vec3 at = workspace_wall(traits, limits, Vec3(0.1, 0, 0)),
             deeper = workspace_wall(traits, limits, Vec3(0.101, 0, 0));
  CHECK_EQ((at - deeper).norm() / 1e-3, about(0.5 * limits.stiffness, 1e-9));
}
