// Each fault of a device ends in zero force and a named cause. Forces start through gate and ramp,
// stay below their limits, and fade when the tissue model is stale.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "tests/about.h"
#include "tests/haptics/loop.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

// A Touch held at rest 2 mm from the middle, in a spring that pulls it back.
constexpr char at_rest[] = "device=touch\nfrom=0.002,0,0\ntarget=0.002,0,0\nresolution=0\n";

bool can_arm(ServoLoop &loop) {
  try {
    loop.device().arm();
    return true;
  } catch (const Error &error) {
    CHECK_EQ(error.code, MVS_E_DEVICE);
    CHECK_GT(std::string(error.what()).size(), 20);
    return false;
  }
}

void check_felt(const ServoStatus &now) {
  CHECK_EQ(now.phase, DevicePhase::on);
  CHECK_LT(now.force.x(), -0.05);
}

}  // namespace

TEST_CASE("every listed fault latches forces off, and only an arm enables them again") {
  struct Fault {
    const char *name;
    Cause cause;
    bool passes;  // the fault ends after a while, and the device can be armed again
  };
  const Fault faults[] = {{"nan_position", Cause::not_finite, true},
                          {"inf_velocity", Cause::not_finite, true},
                          {"jump", Cause::velocity, true},
                          {"unplug", Cause::unplugged, false},
                          {"silent", Cause::watchdog, true},
                          {"uncalibrated", Cause::calibration, true},
                          {"hot", Cause::thermal, true},
                          {"button", Cause::button, true},
                          {"deadman", Cause::deadman, true},
                          {"clock_back", Cause::watchdog, true},
                          {"clock_jump", Cause::watchdog, true}};
  for (const Fault &fault : faults) {
    CAPTURE(fault.name);
    ServoLoop loop(std::string(at_rest) + "fault=" + fault.name + "\nfault_at=1\nfault_for=0.5");
    loop.arm();
    loop.post(spring(200));
    check_felt(loop.run(0.9));
    const ServoStatus during = loop.run(0.4);
    CHECK_EQ(during.phase, DevicePhase::latched);
    CHECK_EQ(during.cause, fault.cause);
    CHECK(during.force.isZero(0));
    const ServoStatus after = loop.run(0.5);
    CHECK_EQ(after.phase, DevicePhase::latched);
    CHECK_EQ(after.cause, fault.cause);
    CHECK(after.force.isZero(0));
    CHECK_EQ(can_arm(loop), fault.passes);
    if (fault.passes) {
      loop.post({});
      loop.run(0.05);
      loop.post(spring(200));
      check_felt(loop.run(0.2));
    }
  }
}

TEST_CASE("a device cannot be armed during a fault") {
  for (const char *fault : {"nan_position", "silent", "uncalibrated", "hot", "button", "deadman"}) {
    CAPTURE(fault);
    ServoLoop loop(std::string(at_rest) + "fault=" + fault + "\nfault_at=0.2");
    loop.run(0.5);
    CHECK_FALSE(can_arm(loop));
    CHECK(loop.run(0.1).force.isZero(0));
  }
}

TEST_CASE("saturated motors are reported and have no other effect") {
  ServoLoop loop(std::string(at_rest) + "fault=saturated\nfault_at=0.1");
  loop.arm();
  loop.post(spring(200));
  const ServoStatus now = loop.run(0.5);
  check_felt(now);
  CHECK((now.flags & MVS_DRIVER_FLAG_SATURATED) != 0);
}

TEST_CASE("a button stuck from the start is no press, and a bouncing one changes nothing") {
  for (const char *buttons : {"buttons=1", "fault=bounce", "fault=stuck_button"}) {
    CAPTURE(buttons);
    ServoLoop loop(std::string(at_rest) + buttons);
    loop.run(1);
    ButtonEvent event;
    CHECK_FALSE(loop.device().links().buttons.pop(event));
    CHECK_EQ(loop.run(0).buttons, 0);
  }
}

TEST_CASE("a button is reported once when it has settled, and once when it is released") {
  ServoLoop loop(std::string(at_rest) + "fault=stuck_button\nfault_at=0.5\nfault_for=0.5");
  ButtonEvent event;
  loop.run(0.505);
  CHECK_FALSE(loop.device().links().buttons.pop(event));
  loop.run(0.02);
  REQUIRE(loop.device().links().buttons.pop(event));
  CHECK_EQ(event.buttons, 1);
  CHECK_EQ(event.position.x(), about(0.002));
  loop.run(1);
  REQUIRE(loop.device().links().buttons.pop(event));
  CHECK_EQ(event.buttons, 0);
  CHECK_FALSE(loop.device().links().buttons.pop(event));
}

TEST_CASE("forces wait at the gate, then rise along the ramp") {
  ServoLoop loop(at_rest);
  loop.run(0.01);
  mvs_device_limits limits = {};
  limits.ramp_s = 0.5;
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  loop.post(spring(200));  // 0.4 N at 2 mm, above the gate of 0.2
  loop.device().arm();
  const ServoStatus waiting = loop.run(0.5);
  CHECK_EQ(waiting.phase, DevicePhase::waiting);
  CHECK(waiting.force.isZero(0));
  loop.post(spring(80));
  loop.run(0.01);
  double before = 0;
  for (int k = 0; k < 48; ++k) {
    const ServoStatus now = loop.run(0.01);
    const double force = now.force.norm();
    CHECK_EQ(now.phase, DevicePhase::ramping);
    // a fiftieth of the force each 10 ms, and the change by the hand's motion meanwhile
    CHECK_GT(force, before);
    CHECK_LT(force - before, 2.0 / 50 * 80 * 0.002);
    before = force;
  }
  CHECK_EQ(loop.run(0.05).phase, DevicePhase::on);
}

TEST_CASE("a new grasp pulls a still hand along a ramp") {
  ServoLoop loop(at_rest);
  loop.arm();
  loop.post(spring(200));  // 0.4 N at 2 mm
  double before = 0;
  for (int k = 0; k < 40; ++k) {
    const double force = loop.run(1e-3).force.norm();
    CHECK_GT(force, before);
    CHECK_LT(force - before, 1.5 * 0.4 / 50);  // of a ramp of 50 ms
    before = force;
  }
  CHECK_GT(loop.run(0.02).force.norm(), 0.3);  // it has moved the hand
}

TEST_CASE("a force is limited to the user's maximum and to the slew rate") {
  ServoLoop loop(at_rest);
  loop.arm();
  mvs_device_limits limits = {};
  limits.force = 0.3;
  limits.slew = 2;
  limits.ramp_s = 0.01;
  limits.stale_s = 10;
  loop.device().set_limits(limits);
  TissueModel pull;
  pull.kind = TissueModel::pulled;
  pull.contact = 1;
  pull.force = Vec3(0, 50, 0);
  pull.most = 100;
  loop.post(pull);
  Vec3 before = Vec3::Zero();
  uint32_t limited = 0;
  for (int k = 0; k < 400; ++k) {
    const ServoStatus now = loop.run(1e-3);
    CHECK_LE((now.force - before).norm(), 2e-3 * (1 + 1e-9));
    CHECK_LE(now.force.norm(), 0.3 * (1 + 1e-9));
    before = now.force;
    limited |= now.limited;
  }
  CHECK_EQ(before.norm(), about(0.3));
  CHECK((limited & MVS_LIMITED_FORCE) != 0);
  CHECK((limited & MVS_LIMITED_SLEW) != 0);
}

TEST_CASE("motor forces stay within the thermal limit") {
  ServoLoop loop(at_rest);
  loop.arm();
  mvs_device_limits limits = {};
  limits.thermal_s = 1;
  limits.ramp_s = 0.01;
  limits.stale_s = 10;
  limits.speed = 100;
  loop.device().set_limits(limits);
  TissueModel pull;
  pull.kind = TissueModel::pulled;
  pull.contact = 1;
  pull.force = Vec3(-10, 0, 0);
  pull.most = 100;
  loop.post(pull);
  const double at_first = loop.run(0.03).force.norm();
  CHECK_GT(at_first, 2.5);
  // where the limit and the mean square of the force meet: the continuous force, 0.88 N
  ServoStatus hot;
  for (int k = 0; k < 4; ++k) {
    loop.post(pull);
    hot = loop.run(5);
  }
  CHECK_EQ(hot.force.norm(), about(0.88, 0.01));
  CHECK_EQ(hot.heat, about(1, 0.02));
  CHECK((hot.limited & MVS_LIMITED_CONTINUOUS) != 0);
}

TEST_CASE("forces fade when the simulation stops, and return with it") {
  ServoLoop loop(at_rest);
  loop.arm();
  mvs_device_limits limits = {};
  limits.ramp_s = 0.01;
  loop.device().set_limits(limits);  // stale after 0.1 s, faded after 0.05 more
  loop.post(spring(200));
  check_felt(loop.run(0.09));
  const ServoStatus fading = loop.run(0.03);
  CHECK_EQ(fading.phase, DevicePhase::faded);
  CHECK_GT(fading.force.norm(), 0);
  CHECK(loop.run(0.1).force.isZero(1e-12));
  loop.post(spring(200));
  loop.run(0.09);
  loop.post(spring(200));
  loop.run(0.09);
  loop.post(spring(200));
  check_felt(loop.run(0.05));
}

TEST_CASE("a tissue model with NaN latches, and never reaches the motors") {
  for (int where = 0; where < 4; ++where) {
    CAPTURE(where);
    ServoLoop loop(at_rest);
    loop.arm();
    loop.post(spring(200));
    check_felt(loop.run(0.1));
    TissueModel wrong = spring(200);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (where == 0) wrong.force.x() = nan;
    if (where == 1) wrong.stiffness(1, 2) = std::numeric_limits<double>::infinity();
    if (where == 2) wrong.origin.z() = nan;
    if (where == 3) wrong.most = nan;
    loop.post(wrong);
    const ServoStatus now = loop.run(0.01);
    CHECK_EQ(now.phase, DevicePhase::latched);
    CHECK_EQ(now.cause, Cause::not_finite);
    CHECK(now.force.isZero(0));
  }
}

TEST_CASE("the application's cut works in any state, and a stop and start does not undo it") {
  ServoLoop loop(at_rest);
  loop.arm();
  loop.post(spring(200));
  check_felt(loop.run(0.1));
  loop.device().cut();
  const ServoStatus now = loop.run(1e-3);
  CHECK_EQ(now.cause, Cause::software);
  CHECK(now.force.isZero(0));
  loop.device().stop();
  CHECK_EQ(loop.run_stopped().phase, DevicePhase::stopped);
  loop.device().start();
  CHECK(loop.run(0.1).force.isZero(0));
  CHECK_EQ(loop.run(0).phase, DevicePhase::off);
}

TEST_CASE("the edge of the workspace pushes back before the device's mechanical stop") {
  ServoLoop loop("device=touch\nfrom=0.06,0,0\ntarget=0.09,0,0\nresolution=0");
  loop.arm();
  CHECK_EQ(loop.run(0.001).limited & MVS_LIMITED_WALL, 0u);
  const ServoStatus now = loop.run(0.5);
  CHECK_GT(now.pose.position.x(), 0.07);
  CHECK_LT(now.force.x(), -0.1);
  CHECK_NE(now.limited & MVS_LIMITED_WALL, 0u);
}
