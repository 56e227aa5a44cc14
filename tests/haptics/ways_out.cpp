// Every way in which a driver fails ends in a zero at its motors, in stop(), and in a latch: on the
// real and on the virtual clock, before the application calls anything.
#include <doctest/doctest.h>
#include <mvs/driver.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "base/error.h"
#include "haptics/device.h"
#include "tests/haptics/asked.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

class FailingDevice {
 public:
  FailingDevice(const char *lie, uint32_t clock)
      : path_(std::string(MVS_LIARS_DIR) + "/" + lie + ".so"), device_(description(clock), {}) {
    device_.start();
    mvs_device_limits limits = {};
    limits.ramp_s = 0.01;
    limits.stale_s = 10;
    device_.set_limits(limits);
  }

  Device &device() { return device_; }
  // The calls to the driver.
  Asked asked() const { return asked_of(path_); }
  ServoStatus wait(double seconds) {
    if (device_.info().clock == MVS_CLOCK_VIRTUAL) {
      device_.advance(seconds);
    } else {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }
    return device_.status();
  }
  // Arms the device; the tissue pushes the hand with 1 N.
  void push() {
    wait(0.01);
    device_.arm();
    device_.links().tissue.post({});
    wait(0.05);
    TissueModel tissue;
    tissue.kind = TissueModel::held;
    tissue.contact = 1;
    tissue.origin = Vec3(0.01, 0, 0);
    tissue.stiffness = 100 * Mat3::Identity();
    tissue.most = 100;
    device_.links().tissue.post(tissue);
  }
  ServoStatus wait_for_latch(int most) {
    ServoStatus now = device_.status();
    for (int k = 0; k < most && now.phase != DevicePhase::latched; ++k) now = wait(0.05);
    return now;
  }

 private:
  mvs_device_desc description(uint32_t clock) const {
    mvs_device_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.clock = clock;
    desc.driver = path_.c_str();
    return desc;
  }

  std::string path_;
  Device device_;
};

}  // namespace

TEST_CASE("a_failed_read_or_write_zeroes_and_stops_the_motors_at_once") {
  for (const char *lie : {"read_fails", "write_fails"}) {
    for (const uint32_t clock : {MVS_CLOCK_VIRTUAL, MVS_CLOCK_REAL}) {
      CAPTURE(lie);
      CAPTURE(clock);
      std::unique_ptr<FailingDevice> failing;
      Asked before = {};
      ServoStatus now;
      // on a machine with much other work the watchdog may latch before the driver fails
      for (int tries = 0; tries < 20; ++tries) {
        failing.reset();
        failing = std::make_unique<FailingDevice>(lie, clock);
        failing->push();
        failing->wait(0.2);
        before = failing->asked();
        now = failing->wait_for_latch(100);
        if (now.cause != Cause::watchdog && before.stops == 0) break;
      }
      CHECK_GT(before.last.force[0], 0.9);
      CHECK_EQ(before.stops, 0);
      CHECK_EQ(now.phase, DevicePhase::latched);
      CHECK_EQ(now.cause, Cause::thermal);
      CHECK(now.force.isZero(0));
      const Asked after = failing->asked();
      CHECK_EQ(after.last.on, 0);
      CHECK_EQ(after.last.force[0], 0);
      CHECK_EQ(after.stops, 1);
      CHECK_THROWS_WITH_AS(failing->device().arm(), doctest::Contains("a sentence"), Error);
    }
  }
}

TEST_CASE("a_loop_that_fails_is_stopped_at_once") {
  FailingDevice failing("loop_fails", MVS_CLOCK_REAL);
  const ServoStatus now = failing.wait_for_latch(100);
  CHECK_EQ(now.cause, Cause::unplugged);
  CHECK_EQ(failing.asked().stops, 1);
}

TEST_CASE("a_stop_on_a_virtual_clock_writes_zero_first") {
  FailingDevice failing("honest", MVS_CLOCK_VIRTUAL);
  failing.push();
  failing.wait(0.2);
  CHECK_GT(failing.asked().last.force[0], 0.9);
  failing.device().stop();
  CHECK_EQ(failing.asked().last.on, 0);
  CHECK_EQ(failing.asked().last.force[0], 0);
}

TEST_CASE("a_clock_that_stands_still_latches_and_refuses_to_arm") {
  FailingDevice failing("time_stops", MVS_CLOCK_VIRTUAL);
  failing.push();
  CHECK_GT(failing.wait(0.2).force.norm(), 0.9);
  failing.wait(1);
  const ServoStatus now = failing.device().status();
  CHECK_EQ(now.phase, DevicePhase::latched);
  CHECK_EQ(now.cause, Cause::watchdog);
  CHECK((now.sample_faults & MVS_SAMPLE_FAULT_CLOCK) != 0);
  CHECK_EQ(failing.asked().last.force[0], 0);
  CHECK_THROWS_WITH_AS(failing.device().arm(), doctest::Contains("clock"), Error);
}

TEST_CASE("a_place_out_of_reach_latches_books_no_energy_and_refuses_to_arm_while_it_lasts") {
  FailingDevice once("far_once", MVS_CLOCK_VIRTUAL);
  once.push();
  const double before = once.wait(0.2).energy;
  const ServoStatus now = once.wait(1);
  CHECK_EQ(now.phase, DevicePhase::latched);
  CHECK_EQ(now.cause, Cause::calibration);
  CHECK_LE(now.energy, before);
  CHECK(now.pose.position.isZero(0));
  once.device().arm();

  FailingDevice far("far", MVS_CLOCK_VIRTUAL);
  far.wait(0.1);
  CHECK_THROWS_WITH_AS(far.device().arm(), doctest::Contains("out of reach"), Error);
}
