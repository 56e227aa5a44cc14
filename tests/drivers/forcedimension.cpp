// The Force Dimension driver: samples of the device, and forces at its motors.
#include <cmath>
#include <cstring>

#include "dhd_bench.h"
#include "tests/about.h"

using mvs::core::test::about;

namespace {

// Tolerance for the last bits of sine and cosine.
constexpr double kRounding = 1e-12;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

TEST_CASE("forcedimension_describes_the_device") {
  DhdBench bench(DhdBench::Options{{"rate", "2000"}});
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  mvs_driver_info info = bench.plugin.info();
  CHECK(std::string(info.model) == "stand-in omega");
  CHECK(std::string(info.serial) == "4000");
  CHECK(info.freedoms_in == 3);
  CHECK(info.freedoms_out == 3);
  CHECK(info.has_gripper == 0);
  CHECK(info.peak_force == 12);
  CHECK(info.rate == 2000);
  bench.plugin.close();
  bench.in.type = 104;
  REQUIRE(bench.plugin.open("0") == MVS_DRIVER_OK);
  info = bench.plugin.info();
  CHECK(info.freedoms_in == 6);
  CHECK(info.freedoms_out == 6);
  CHECK(info.has_gripper == 1);
  CHECK(info.peak_torque > 0);
  // the device's x, y, z are towards the user, to the right, up
  const double wanted[12] = {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0};
  for (int i = 0; i < 12; ++i) CHECK(info.frame[i] == wanted[i]);
}

TEST_CASE("forcedimension_samples_are_those_of_the_device") {
  DhdBench bench;
  bench.in.type = 104;
  bench.in.buttons = 1;
  bench.start();
  REQUIRE(bench.ticks(251) == MVS_DRIVER_OK);  // a quarter of the circle
  const mvs_driver_state &state = bench.state;
  CHECK(state.sequence == 251);
  CHECK(state.time_ns == 250 * DhdBench::kTick);
  CHECK(std::abs(state.position[0] - 0.01) < kRounding);
  CHECK(std::abs(state.position[1]) < kRounding);
  CHECK(std::abs(state.position[2] - 0.03) < kRounding);
  CHECK(std::abs(state.velocity[1] + 0.03 * 2 * kPi) < kRounding);
  CHECK(std::abs(state.orientation[0] - std::sqrt(0.5)) < kRounding);
  CHECK(std::abs(state.orientation[1] - std::sqrt(0.5)) < kRounding);
  CHECK(state.gripper == 0.5);
  CHECK(state.buttons == 1);
  CHECK(state.flags ==
        (MVS_DRIVER_FLAG_CALIBRATED | MVS_DRIVER_FLAG_VELOCITY | MVS_DRIVER_FLAG_FORCE_ON));
  CHECK(state.cause == MVS_CAUSE_NONE);
}

TEST_CASE("forcedimension_the_time_guard_returns_the_previous_sample") {
  DhdBench bench;
  bench.in.guard_at = 5;
  bench.start();
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  CHECK(bench.state.sequence == 5);
  REQUIRE(bench.tick() == MVS_DRIVER_OK);
  CHECK(bench.state.sequence == 5);
  REQUIRE(bench.tick() == MVS_DRIVER_OK);
  CHECK(bench.state.sequence == 6);
}

TEST_CASE("forcedimension_force_torque_and_grip_reach_the_motors") {
  for (const bool left : {false, true}) {
    CAPTURE(left);
    DhdBench bench;
    bench.in.type = left ? 105 : 104;
    bench.in.left_handed = left;
    bench.start();
    CHECK(bench.in.max_force_mn[0] == 12000);
    REQUIRE(bench.plugin.read(0, bench.state) == MVS_DRIVER_OK);
    CHECK(bench.state.gripper == 0.5);
    const mvs_driver_force force = {sizeof force, 1, {1, 2, 3}, {0.1, 0.2, 0.3}, 0.16};
    REQUIRE(bench.plugin.api.write(bench.plugin.device, &force) == MVS_DRIVER_OK);
    const double wanted[7] = {1, 2, 3, 0.1, 0.2, 0.3, left ? -2.0 : 2.0};  // 0.16 N m by 80 mm
    for (int i = 0; i < 7; ++i) CHECK(bench.given()[i] == about(wanted[i]));
  }
}

TEST_CASE("forcedimension_saturated_motors_are_a_success_and_reported") {
  DhdBench bench;
  bench.in.largest_mn = 1000;
  bench.start();
  REQUIRE(bench.tick(3, 0, 0) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == about(1));
  REQUIRE(bench.tick(0.5, 0, 0) == MVS_DRIVER_OK);
  CHECK((bench.state.flags & MVS_DRIVER_FLAG_SATURATED) != 0);
  REQUIRE(bench.tick(0.5, 0, 0) == MVS_DRIVER_OK);
  CHECK((bench.state.flags & MVS_DRIVER_FLAG_SATURATED) == 0);
}

TEST_CASE("forcedimension_moves_to_calibrate_only_when_it_may") {
  DhdBench bench;
  bench.in.reset = 1;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  CHECK(bench.plugin.api.start(bench.plugin.device) == MVS_DRIVER_E_CALIBRATION);
  CHECK_MESSAGE(has(bench.plugin.error(), "move=yes"), bench.plugin.error());
  CHECK(bench.in.moved == 0);
  bench.plugin.close();
  bench.in.supported = 0;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  CHECK(bench.plugin.api.calibrate(bench.plugin.device) == MVS_DRIVER_E_CALIBRATION);
  CHECK_MESSAGE(has(bench.plugin.error(), "rest position"), bench.plugin.error());
  bench.plugin.close();

  Plugin free("forcedimension", DhdBench::with_library({{"move", "yes"}}));
  bench.in.supported = 1;
  bench.in.stuck = 1;
  REQUIRE(free.open() == MVS_DRIVER_OK);
  CHECK(free.api.calibrate(free.device) == MVS_DRIVER_E_CALIBRATION);
  bench.in.stuck = 0;
  CHECK(free.api.calibrate(free.device) == MVS_DRIVER_OK);
  CHECK(bench.in.moved == 2);
  CHECK(free.api.start(free.device) == MVS_DRIVER_OK);
}

TEST_CASE("forcedimension_two_devices_open_and_each_once") {
  DhdBench bench;
  bench.in.count = 2;
  CHECK(bench.plugin.list() == std::vector<std::string>{"0", "1"});
  bench.start();
  Plugin second("forcedimension", DhdBench::with_library({}));
  CHECK(second.open("0") == MVS_DRIVER_E_BUSY);
  REQUIRE(second.open() == MVS_DRIVER_OK);
  REQUIRE(second.api.start(second.device) == MVS_DRIVER_OK);
  Plugin third("forcedimension", DhdBench::with_library({}));
  CHECK(third.open() == MVS_DRIVER_E_BUSY);
  mvs_driver_state state = {};
  for (int i = 0; i < 10; ++i) {
    REQUIRE(bench.tick(1, 0, 0) == MVS_DRIVER_OK);
    REQUIRE(second.read(i * DhdBench::kTick, state) == MVS_DRIVER_OK);
    REQUIRE(second.write(2, 0, 0) == MVS_DRIVER_OK);
  }
  CHECK(bench.given(0)[0] == 1);
  CHECK(bench.given(1)[0] == 2);
  CHECK(std::string(second.info().serial) == "4001");
}
