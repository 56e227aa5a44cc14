// Torque of a servo on a device with motors for it (premium6 of haptic_drivers/hand): limits, gate,
// fading, faults; and on devices without.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "tests/about.h"
#include "tests/haptics/bare_servo.h"
#include "tests/haptics/loop.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

void check_torque(const ServoStatus &now) {
  CHECK_EQ(now.phase, DevicePhase::on);
  CHECK_GT(now.torque.norm(), 1e-3);
}

}  // namespace

TEST_CASE("a torque is limited to the user's maximum, to the device's and to its rate") {
  ServoLoop loop("device=premium6\nturn_resolution=0\nresolution=0");
  loop.arm();
  CHECK_EQ(loop.device().info().peak_torque, 0.188);
  // twice the device's own is not more than the device's own
  mvs_device_limits limits = {};
  limits.torque = 0.4;
  loop.device().set_limits(limits);
  CHECK_EQ(loop.device().limits().torque, 0.188);
  limits.torque = 0.05;
  limits.torque_slew = 1;
  limits.thermal_s = 1000;
  limits.ramp_s = 0.01;
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.torque = Vec3(0, 3, 0);
  twist.most_torque = 100;
  loop.post(twist);
  Vec3 before = Vec3::Zero();
  uint32_t limited = 0;
  for (int k = 0; k < 200; ++k) {
    const ServoStatus now = loop.run(1e-3);
    CHECK_LE((now.torque - before).norm(), 1e-3 * (1 + 1e-9));
    CHECK_LE(now.torque.norm(), 0.05 * (1 + 1e-9));
    CHECK(now.force.isZero(1e-12));
    before = now.torque;
    limited |= now.limited;
  }
  // the filter of the output has come within a thousandth of it
  CHECK_EQ(before.norm(), about(0.05, 1e-3));
  CHECK((limited & MVS_LIMITED_TORQUE) != 0);
  CHECK((limited & MVS_LIMITED_SLEW) != 0);
}

// 0.188 N m times the share 1.4 / 8.5 of the force, which the motors bear continuously.
TEST_CASE("a lasting torque falls to what the motors bear") {
  ServoLoop loop("device=premium6\nturn_resolution=0\nwrist_stiffness=20");
  loop.arm();
  mvs_device_limits limits = {};
  limits.thermal_s = 1;
  limits.ramp_s = 0.01;
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.torque = Vec3(-1, 0, 0);
  twist.most_torque = 100;
  loop.post(twist);
  CHECK_GT(loop.run(0.012).torque.norm(), 0.15);
  ServoStatus hot;
  for (int k = 0; k < 4; ++k) {
    loop.post(twist);
    hot = loop.run(5);
  }
  CHECK_EQ(hot.torque.norm(), about(0.188 * 1.4 / 8.5, 0.01));
  CHECK((hot.limited & MVS_LIMITED_CONTINUOUS) != 0);
}

TEST_CASE("a torque waits at the gate as a force does") {
  ServoLoop loop("device=premium6\nturn_resolution=0");
  loop.run(0.01);
  mvs_device_limits limits = {};
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.most_torque = 100;
  twist.torque = Vec3(0, 0, 0.01);  // the gate is 0.2 N of 8.5 N, which is 0.0044 of 0.188 N m
  loop.post(twist);
  loop.device().arm();
  const ServoStatus waiting = loop.run(0.5);
  CHECK_EQ(waiting.phase, DevicePhase::waiting);
  CHECK(waiting.torque.isZero(0));
  twist.torque = Vec3(0, 0, 0.004);
  loop.post(twist);
  CHECK_EQ(loop.run(0.5).phase, DevicePhase::ramping);
}

TEST_CASE("a torque fades when the simulation stops, and is zero after a cut") {
  ServoLoop loop("device=premium6\nturn_resolution=0\nturned=0.05,0,0");
  loop.arm();
  mvs_device_limits limits = {};
  limits.ramp_s = 0.01;
  loop.device().set_limits(limits);
  TissueModel twist = spring(0);
  twist.turns = 1;
  twist.most_torque = 100;
  twist.torque = Vec3(0, 0, 0.02);
  loop.post(twist);
  check_torque(loop.run(0.09));
  CHECK_EQ(loop.run(0.03).phase, DevicePhase::faded);
  CHECK(loop.run(0.1).torque.isZero(1e-12));
  for (int k = 0; k < 3; ++k) {
    loop.post(twist);
    loop.run(0.09);
  }
  check_torque(loop.run(0));
  loop.device().cut();
  CHECK(loop.run(1e-3).torque.isZero(0));
}

TEST_CASE("a torque model with NaN latches, and never reaches the motors") {
  for (int where = 0; where < 6; ++where) {
    CAPTURE(where);
    ServoLoop loop("device=premium6\nturn_resolution=0\nturned=0.05,0,0");
    loop.arm();
    TissueModel twist = spring(100);
    twist.turns = 1;
    twist.most_torque = 100;
    twist.turning = 0.1 * Mat3::Identity();
    twist.torque = Vec3(0.02, 0, 0);
    loop.post(twist);
    check_torque(loop.run(0.02));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (where == 0) twist.torque.x() = nan;
    if (where == 1) twist.turning(1, 2) = std::numeric_limits<double>::infinity();
    if (where == 2) twist.coupling(0, 0) = nan;
    if (where == 3) twist.orientation.x() = nan;
    if (where == 4) twist.most_torque = nan;
    if (where == 5) twist.arm.z() = nan;
    loop.post(twist);
    const ServoStatus now = loop.run(0.01);
    CHECK_EQ(now.phase, DevicePhase::latched);
    CHECK_EQ(now.cause, Cause::not_finite);
    CHECK(now.torque.isZero(0));
    CHECK(now.force.isZero(0));
  }
}

namespace {

mvs_driver_force after_a_ramp(BareServo &bare, const TissueModel &tissue) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  bare.tick(turn);
  bare.links().requests.arm();
  for (int k = 0; k < 30; ++k) bare.tick(turn);
  bare.links().tissue.post({});  // free: forces wait for a model
  for (int k = 0; k < 30; ++k) bare.tick(turn);
  bare.links().tissue.post(tissue);
  mvs_driver_force force = {};
  for (int k = 0; k < 300; ++k) force = bare.tick(turn);
  return force;
}

}  // namespace

TEST_CASE("a device without motors for torque, or without orientation, gets zero torque") {
  TissueModel grasp = spring(300);
  grasp.turns = 1;
  grasp.turning = 0.1 * Mat3::Identity();
  grasp.coupling = Mat3::Identity();
  grasp.most_torque = 100;
  for (const auto &freedoms : {std::array{6u, 3u}, {3u, 3u}, {3u, 6u}, {6u, 6u}}) {
    const uint32_t in = freedoms[0], out = freedoms[1];
    CAPTURE(in);
    CAPTURE(out);
    BareServo bare(in, out);
    const mvs_driver_force force = after_a_ramp(bare, grasp);
    REQUIRE_EQ(force.on, 1);
    const double torque = Vec3::Map(force.torque).norm();
    if (in == 6 && out == 6) {
      // 0.1 N m/rad times 0.1 rad, and the coupling with 1 mm
      CHECK_EQ(torque, about(std::hypot(0.1 * std::sin(0.1), 1e-3), 0.01));
    } else {
      CHECK_EQ(torque, 0);
      CHECK_EQ(force.force[0], about(-0.3));  // and rotation does not change the force
      CHECK_EQ(force.force[1], 0);
    }
  }
}

TEST_CASE("an orientation that jumps or spins too fast latches a device that renders torque") {
  for (const bool jumps : {true, false}) {
    CAPTURE(jumps);
    BareServo bare(6, 6);
    after_a_ramp(bare, {});
    REQUIRE_EQ(bare.status().phase, DevicePhase::on);
    double angle = 0.1;
    for (int k = 0; k < 5; ++k) {
      angle += jumps ? 0.2 : 0.03;  // the limit is 20 rad/s, of a jump 100 rad/s
      bare.tick(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitY())));
      if (k == 0) CHECK_EQ(bare.status().phase == DevicePhase::latched, jumps);
    }
    CHECK_EQ(bare.status().cause, Cause::velocity);
    CHECK(bare.status().torque.isZero(0));
  }
}
