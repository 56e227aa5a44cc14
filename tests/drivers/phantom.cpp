// The phantom driver: samples of the device, and forces at its motors.
#include <dlfcn.h>
#include <cmath>
#include <cstring>
#include <thread>

#include "phantom_bench.h"
#include "tests/about.h"

using mvs::core::test::about;

namespace {

// Tolerance for the last bits: mm to m and back.
constexpr double kRounding = 1e-12;

}  // namespace

TEST_CASE("phantom_accepts_its_own_version_only") {
  mvs_driver_api api = {};
  void *const library = dlopen(MVS_DRIVERS_DIR "/phantom.so", RTLD_NOW);
  const auto negotiate =
      reinterpret_cast<mvs_driver_negotiate_fn>(dlsym(library, "mvs_driver_negotiate"));
  mvs_driver_host newer = {sizeof newer, 2, 3, 0, nullptr, nullptr, nullptr};
  api.struct_size = sizeof api;
  CHECK(negotiate(&newer, &api) == MVS_DRIVER_E_VERSION);
  mvs_driver_host host = {sizeof host, 1, 1, 0, nullptr, nullptr, nullptr};
  api.struct_size = 24;
  CHECK_MESSAGE(negotiate(&host, &api) == MVS_DRIVER_E_VERSION, "no room for the first version");
  CHECK(!api.open);
}

TEST_CASE("phantom_describes_the_device") {
  PhantomBench bench;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  const mvs_driver_info info = bench.plugin.info();
  CHECK(std::string(info.model) == "Stand-in Touch");
  CHECK(std::string(info.serial) == "STAND-IN-1");
  CHECK(info.freedoms_in == 6);
  CHECK(info.freedoms_out == 3);
  CHECK(info.peak_force == about(3.3));
  CHECK(info.continuous_force == about(0.88));
  CHECK(info.max_stiffness == about(500));  // 0.5 N/mm
  CHECK(info.max_damping == about(3));      // 0.003 N s/mm
  CHECK(info.max_speed == about(1));
  CHECK(info.workspace_min[0] == about(-0.08));
  CHECK(info.workspace_max[2] == about(0.035));
  CHECK(info.rate == 1000);
  CHECK(bench.in.enabled[0] == (2 | 4 | 8));  // its protections, not its motors
  CHECK(bench.plugin.list() == std::vector<std::string>{"Default Device"});
}

TEST_CASE("phantom_samples_are_in_metres_and_rotate_with_the_stylus") {
  PhantomBench bench;
  bench.in.buttons = 2;
  bench.in.parked = 1;
  bench.start();
  PhantomHand hand{600};
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  REQUIRE(hand.seen.size() == 600);
  const mvs_driver_state &quarter = hand.seen[250];  // of the circle
  CHECK(quarter.sequence == 251);
  CHECK(std::abs(quarter.position[0] - 0) < kRounding);
  CHECK(std::abs(quarter.position[1] - 0.03) < kRounding);
  CHECK(std::abs(quarter.position[2] - 0.01) < kRounding);
  CHECK(std::abs(quarter.velocity[0] + 0.03 * 2 * 3.14159265358979323846) < kRounding);
  CHECK(std::abs(quarter.orientation[0] - std::sqrt(0.5)) < kRounding);
  CHECK(std::abs(quarter.orientation[3] - std::sqrt(0.5)) < kRounding);
  const mvs_driver_state &half = hand.seen[500];  // where the quaternion's w is zero
  CHECK(std::abs(half.orientation[0]) < kRounding);
  CHECK(std::abs(std::abs(half.orientation[3]) - 1) < kRounding);
  CHECK(quarter.buttons == 2);
  const uint32_t wanted = MVS_DRIVER_FLAG_CALIBRATED | MVS_DRIVER_FLAG_VELOCITY |
                          MVS_DRIVER_FLAG_FORCE_ON | MVS_DRIVER_FLAG_PARKED;
  CHECK(quarter.flags == wanted);
  for (size_t i = 1; i < hand.seen.size(); ++i)
    CHECK(hand.seen[i].time_ns >= hand.seen[i - 1].time_ns);
}

TEST_CASE("phantom_force_reaches_the_motors_and_the_last_one_is_zero") {
  PhantomBench bench;
  bench.in.freedoms_out = 6;
  bench.start();
  PhantomHand hand{300};
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  REQUIRE(bench.in.frames[0] == 300);
  for (int frame = 0; frame < 299; ++frame) {
    const double *const given = bench.in.forces[0][frame];
    CHECK(given[0] == 1);
    CHECK(given[1] == 0.5);
    CHECK(given[2] == -0.25);
    CHECK(given[3] == about(10));  // mN m
    CHECK(given[5] == about(30));
  }
  CHECK(bench.in.forces[0][299][0] == 0);
  CHECK_MESSAGE((bench.in.enabled[0] & 1) == 0, "forces are still enabled");
  CHECK(bench.plugin.info().peak_torque == about(0.188));
}

TEST_CASE("phantom_motors_stay_off_on_request") {
  PhantomBench bench;
  bench.start();
  PhantomHand hand{50};
  hand.force.on = 0;
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  for (int frame = 0; frame < 50; ++frame) CHECK(bench.was_zero(0, frame));
}

TEST_CASE("phantom_stop_ends_the_loop_from_the_servo_and_from_elsewhere") {
  PhantomBench bench;
  bench.start();
  PhantomHand within{200};
  within.stop = bench.plugin.device;
  within.api = &bench.plugin.api;
  CHECK(within.run(bench.plugin) == MVS_DRIVER_OK);
  CHECK(within.seen.size() == 200);
  CHECK_MESSAGE(bench.was_zero(0, 200), "the tick after stop()");
  CHECK(within.run(bench.plugin) == MVS_DRIVER_OK);  // still stopped
  CHECK(within.seen.size() == 200);

  REQUIRE(bench.plugin.api.start(bench.plugin.device) == MVS_DRIVER_OK);
  bench.in.frames[0] = 0;
  PhantomHand hand{100000000};
  std::thread other([&] {
    while (bench.in.frames[0] < 100) std::this_thread::yield();
    bench.plugin.api.stop(bench.plugin.device);
    bench.plugin.api.stop(bench.plugin.device);
  });
  CHECK(hand.run(bench.plugin) == MVS_DRIVER_OK);
  other.join();
  CHECK(bench.was_zero(0, bench.in.frames[0] - 1));
}

TEST_CASE("phantom_close_from_the_servo_waits_for_the_loop") {
  for (const long late_ms : {0, 50}) {  // the servo closes while the scheduler is still starting
    CAPTURE(late_ms);
    PhantomBench bench;
    bench.in.late_start_ms = late_ms;
    bench.start();
    const auto servo = [](void *user, const mvs_driver_state *state,
                          mvs_driver_force *) -> int32_t {
      auto &plugin = *static_cast<Plugin *>(user);
      if (state->sequence == 10) plugin.api.close(plugin.device);
      return MVS_DRIVER_OK;
    };
    CHECK(bench.plugin.api.run(bench.plugin.device, servo, &bench.plugin) == MVS_DRIVER_OK);
    bench.plugin.device = nullptr;
    CHECK(bench.in.open[0] == 0);
    bench.in.late_start_ms = 0;
  }
}

TEST_CASE("phantom_opens_a_device_once") {
  PhantomBench bench;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  Plugin other("phantom", {{"library", phantom_library}});
  CHECK(other.open("Default Device") == MVS_DRIVER_E_BUSY);
  CHECK(other.open() == MVS_DRIVER_E_BUSY);
  CHECK_MESSAGE(bench.in.open[0] == 1, "it switched off a device that is open here");
}

TEST_CASE("phantom_calibrates_where_no_hand_is_needed_and_reports_where_one_is") {
  PhantomBench bench;
  bench.in.calibration = 0x5001;
  bench.start();
  bench.plugin.close();
  bench.in.calibration = 0x5002;
  bench.in.style = 4;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  CHECK(bench.plugin.api.calibrate(bench.plugin.device) == MVS_DRIVER_E_CALIBRATION);
  CHECK_MESSAGE(has(bench.plugin.error(), "inkwell"), bench.plugin.error());
  CHECK(bench.plugin.api.start(bench.plugin.device) == MVS_DRIVER_E_CALIBRATION);
  CHECK(PhantomHand().run(bench.plugin) == MVS_DRIVER_E_INTERNAL);
}

TEST_CASE("phantom_two_devices_run_side_by_side_and_one_may_be_lost") {
  for (const long found_by : {1, 0}) {
    CAPTURE(found_by);
    PhantomBench bench;
    Plugin second("phantom", {{"library", phantom_library}});
    REQUIRE(second.open("Phantom2") == MVS_DRIVER_OK);
    REQUIRE(second.api.start(second.device) == MVS_DRIVER_OK);
    bench.start();
    bench.in.fail_at = 500;
    bench.in.fail_code = 0x302;
    bench.in.fail_device = found_by;
    bench.in.fail_of = 1;
    PhantomHand left{100000}, right{2000};
    left.force.force[0] = 2;
    int32_t lost = 0;
    std::thread other([&] { lost = left.run(second); });
    while (bench.in.frames[1] == 0) std::this_thread::yield();
    CHECK(right.run(bench.plugin) == MVS_DRIVER_OK);
    other.join();
    CHECK(lost == MVS_DRIVER_E_LOST);
    CHECK(right.seen.size() == 2000);
    CHECK(bench.in.forces[0][10][0] == 1);
    CHECK(bench.in.forces[1][10][0] == 2);
    CHECK(left.seen[10].position[1] - 0.03 * std::sin(2 * 3.14159265358979323846 * 0.01) ==
          about(0.005));
  }
}
