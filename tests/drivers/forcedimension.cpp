// The Force Dimension driver on a stand-in for DHD, polled on a clock of the test.
#include <dlfcn.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "dhd/stand_in.h"
#include "plugin.h"

namespace {

const std::string kLibrary = MVS_STAND_INS_DIR "/dhd/libdrd_watched.so";
constexpr uint64_t kTick = 1000000;  // ns
// Tolerance for the last bits of sine and cosine.
constexpr double kRounding = 1e-12;
constexpr double kPi = 3.14159265358979323846;

DhdStandIn &stand_in() {
  void *const library = dlopen(kLibrary.c_str(), RTLD_NOW);
  REQUIRE_MESSAGE(library, dlerror());
  return *reinterpret_cast<dhd_stand_in_fn>(dlsym(library, "dhd_stand_in"))();
}

using Options = std::map<std::string, std::string>;

Options with_library(Options options) {
  options["library"] = kLibrary;
  return options;
}

// A driver on a stand-in without faults; a test adds its own.
struct Bench {
  DhdStandIn &in = stand_in();
  Plugin plugin;
  uint64_t now = 0;
  mvs_driver_state state = {};

  explicit Bench(Options options = {})
      : plugin("forcedimension", with_library(std::move(options))) {
    for (auto *at : {&in.unplug_at, &in.deaf_at, &in.nan_at, &in.guard_at, &in.force_off_at})
      *at = DhdStandIn::kNever;
    for (auto *zero :
         {&in.left_handed, &in.deaf_for, &in.cause, &in.reset, &in.stuck, &in.open_error,
          &in.buttons, &in.slow, &in.moved, &in.unsafe, &in.unsimulated})
      *zero = 0;
    for (int i = 0; i < DhdStandIn::kDevices; ++i)
      in.ticks[i] = in.writes[i] = in.enables[i] = in.stops[i] = 0;
    in.count = in.supported = 1;
    in.type = 33;
    in.largest_mn = 12000;
  }
  ~Bench() {
    plugin.close();
    CHECK_MESSAGE(in.unsafe == 0, "it touched what keeps the device safe, or sent no number");
    CHECK_MESSAGE(in.unsimulated == 0, "it called what is not simulated");
  }
  void start() {
    REQUIRE_MESSAGE(plugin.open() == MVS_DRIVER_OK, plugin.error());
    REQUIRE_MESSAGE(plugin.api.start(plugin.device) == MVS_DRIVER_OK, plugin.error());
    in.writes[0] = 0;
  }
  // One tick, as libmvs does it: a sample, a force.
  int32_t tick(double x = 1, double y = 0.5, double z = -0.25, bool on = true) {
    const int32_t code = plugin.read(now, state);
    now += kTick;
    if (code != MVS_DRIVER_OK) return code;
    return plugin.write(x, y, z, on);
  }
  int32_t ticks(int count) {
    int32_t code = MVS_DRIVER_OK;
    for (int i = 0; i < count && code == MVS_DRIVER_OK; ++i) code = tick();
    return code;
  }
  const double *given(int device = 0) const {
    return in.forces[device][(in.writes[device] - 1) % DhdStandIn::kKept];
  }
};

bool has(const std::string &sentence, const char *word) {
  return sentence.find(word) != std::string::npos;
}

}  // namespace

TEST_CASE("forcedimension_names_the_missing_library") {
  Plugin none("forcedimension", {{"library", "/nowhere/libdrd.so.3"}});
  CHECK(none.open() == MVS_DRIVER_E_LIBRARY);
  CHECK_MESSAGE(has(none.error(), "FDSDK"), none.error());
  Plugin wrong("forcedimension", {{"library", MVS_STAND_INS_DIR "/openhaptics/libHD.so"}});
  const int32_t code = wrong.open();
  CHECK((code == MVS_DRIVER_E_LIBRARY || code == MVS_DRIVER_E_OPTION));
  Plugin relative("forcedimension", {{"library", "libdrd.so"}});
  CHECK(relative.open() == MVS_DRIVER_E_OPTION);
  std::string said;
  for (const auto &one : none.doctor()) said += one.check + ": " + one.sentence + "\n";
  CHECK_MESSAGE(has(said, "no SDK of Force Dimension here"), said);
}

TEST_CASE("forcedimension_describes_the_device") {
  Bench bench(Options{{"rate", "2000"}});
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
  Bench bench;
  bench.in.type = 104;
  bench.in.buttons = 1;
  bench.start();
  REQUIRE(bench.ticks(251) == MVS_DRIVER_OK);  // a quarter of the circle
  const mvs_driver_state &state = bench.state;
  CHECK(state.sequence == 251);
  CHECK(state.time_ns == 250 * kTick);
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
  Bench bench;
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
    Bench bench;
    bench.in.type = left ? 105 : 104;
    bench.in.left_handed = left;
    bench.start();
    CHECK(bench.in.max_force_mn[0] == 12000);
    REQUIRE(bench.plugin.read(0, bench.state) == MVS_DRIVER_OK);
    CHECK(bench.state.gripper == 0.5);
    const mvs_driver_force force = {sizeof force, 1, {1, 2, 3}, {0.1, 0.2, 0.3}, 0.16};
    REQUIRE(bench.plugin.api.write(bench.plugin.device, &force) == MVS_DRIVER_OK);
    const double wanted[7] = {1, 2, 3, 0.1, 0.2, 0.3, left ? -2.0 : 2.0};  // 0.16 N m by 80 mm
    for (int i = 0; i < 7; ++i) CHECK(bench.given()[i] == doctest::Approx(wanted[i]));
  }
}

TEST_CASE("forcedimension_saturated_motors_are_a_success_and_reported") {
  Bench bench;
  bench.in.largest_mn = 1000;
  bench.start();
  REQUIRE(bench.tick(3, 0, 0) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == doctest::Approx(1));
  REQUIRE(bench.tick(0.5, 0, 0) == MVS_DRIVER_OK);
  CHECK((bench.state.flags & MVS_DRIVER_FLAG_SATURATED) != 0);
  REQUIRE(bench.tick(0.5, 0, 0) == MVS_DRIVER_OK);
  CHECK((bench.state.flags & MVS_DRIVER_FLAG_SATURATED) == 0);
}

TEST_CASE("forcedimension_nan_is_read_and_never_written") {
  Bench bench;
  bench.in.nan_at = 3;
  bench.start();
  REQUIRE(bench.ticks(3) == MVS_DRIVER_OK);
  REQUIRE(bench.tick(std::nan(""), 0, 0) == MVS_DRIVER_OK);
  CHECK(std::isnan(bench.state.position[0]));
  CHECK(bench.given()[0] == 0);
  REQUIRE(bench.tick(0, INFINITY, 0) == MVS_DRIVER_OK);
  CHECK(bench.given()[1] == 0);
}

TEST_CASE("forcedimension_an_unplugged_device_is_lost") {
  Bench bench;
  bench.in.unplug_at = 700;
  bench.start();
  REQUIRE(bench.ticks(700) == MVS_DRIVER_OK);
  CHECK(bench.ticks(100) == MVS_DRIVER_E_LOST);
  CHECK(bench.in.ticks[0] <= 702);  // without the retries for short interruptions
  CHECK_MESSAGE(has(bench.plugin.error(), "does not answer any more"), bench.plugin.error());
}

TEST_CASE("forcedimension_a_short_interruption_is_no_loss_and_long_silence_is") {
  Bench bench;
  bench.in.deaf_at = 100;
  bench.in.deaf_for = 90;
  bench.start();
  REQUIRE(bench.ticks(190) == MVS_DRIVER_OK);
  CHECK(bench.state.sequence == 100);
  REQUIRE(bench.ticks(10) == MVS_DRIVER_OK);
  CHECK(bench.state.sequence == 110);
  bench.in.deaf_at = 200;
  bench.in.deaf_for = 1000;
  int survived = 0;
  while (bench.tick() == MVS_DRIVER_OK) ++survived;
  CHECK(survived == MVS_DRIVER_PATIENCE_MS);
}

TEST_CASE("forcedimension_reports_why_the_device_took_its_forces_off") {
  const uint32_t causes[] = {MVS_CAUSE_BUTTON,   MVS_CAUSE_VELOCITY,  MVS_CAUSE_WATCHDOG,
                             MVS_CAUSE_SOFTWARE, MVS_CAUSE_UNPLUGGED, MVS_CAUSE_DEADMAN};
  for (int dhd_cause = 1; dhd_cause <= 6; ++dhd_cause) {
    CAPTURE(dhd_cause);
    Bench bench;
    bench.in.force_off_at = 200;
    bench.in.cause = dhd_cause;
    bench.start();
    REQUIRE(bench.ticks(200) == MVS_DRIVER_OK);
    CHECK((bench.state.flags & MVS_DRIVER_FLAG_FORCE_ON) != 0);
    REQUIRE(bench.ticks(20) == MVS_DRIVER_OK);
    CHECK(bench.state.cause == causes[dhd_cause - 1]);
    CHECK((bench.state.flags & MVS_DRIVER_FLAG_FORCE_ON) == 0);
    CHECK(bench.in.enables[0] == 1);
    // forces return only after they were disabled and enabled again
    REQUIRE(bench.tick(0, 0, 0, false) == MVS_DRIVER_OK);
    REQUIRE(bench.ticks(20) == MVS_DRIVER_OK);
    CHECK(bench.in.enables[0] == 2);
    CHECK(bench.state.cause == MVS_CAUSE_NONE);
    CHECK((bench.state.flags & MVS_DRIVER_FLAG_FORCE_ON) != 0);
  }
}

TEST_CASE("forcedimension_forces_that_come_on_slowly_are_no_fault") {
  Bench bench;
  bench.in.slow = 30;
  bench.start();
  for (int i = 0; i < 200; ++i) {
    REQUIRE(bench.tick(1, 0, 0, i % 100 > 10) == MVS_DRIVER_OK);
    CHECK(bench.state.cause == MVS_CAUSE_NONE);
  }
  CHECK((bench.state.flags & MVS_DRIVER_FLAG_FORCE_ON) != 0);
}

TEST_CASE("forcedimension_off_writes_zero_force_and_then_brakes") {
  Bench bench;
  bench.start();
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 1);
  REQUIRE(bench.tick(1, 1, 1, false) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 0);
  CHECK(bench.in.stops[0] == 1);
  CHECK(bench.in.on[0] == 0);
}

TEST_CASE("forcedimension_stop_from_another_thread_ends_all_force") {
  Bench bench;
  bench.start();
  std::atomic<bool> go{true};
  std::thread poll([&] {
    while (go) bench.tick();
  });
  while (bench.in.writes[0] < 100) std::this_thread::yield();
  bench.plugin.api.stop(bench.plugin.device);
  bench.plugin.api.stop(bench.plugin.device);
  const long writes = bench.in.ticks[0];
  while (bench.in.ticks[0] < writes + 50) std::this_thread::yield();
  go = false;
  poll.join();
  CHECK(bench.in.on[0] == 0);
  CHECK(bench.given()[0] == 0);
  REQUIRE(bench.plugin.api.start(bench.plugin.device) == MVS_DRIVER_OK);
  REQUIRE(bench.ticks(2) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 1);
}

TEST_CASE("forcedimension_panic_writes_zero") {
  Bench bench;
  bench.start();
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  bench.plugin.api.panic(bench.plugin.device);
  CHECK(bench.given()[0] == 0);
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 0);
}

TEST_CASE("forcedimension_moves_to_calibrate_only_when_it_may") {
  Bench bench;
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

  Plugin free("forcedimension", with_library({{"move", "yes"}}));
  bench.in.supported = 1;
  bench.in.stuck = 1;
  REQUIRE(free.open() == MVS_DRIVER_OK);
  CHECK(free.api.calibrate(free.device) == MVS_DRIVER_E_CALIBRATION);
  bench.in.stuck = 0;
  CHECK(free.api.calibrate(free.device) == MVS_DRIVER_OK);
  CHECK(bench.in.moved == 2);
  CHECK(free.api.start(free.device) == MVS_DRIVER_OK);
}

TEST_CASE("forcedimension_open_reports_its_reason_of_failure") {
  struct Case {
    long error;
    int32_t result;
  };
  for (const Case &one : {Case{20, MVS_DRIVER_E_BUSY}, Case{5, MVS_DRIVER_E_ABSENT},
                          Case{4, MVS_DRIVER_E_ABSENT}, Case{8, MVS_DRIVER_E_FAULT}}) {
    Bench bench;
    bench.in.open_error = one.error;
    CHECK(bench.plugin.open() == one.result);
    CHECK_MESSAGE(has(bench.plugin.error(), "DHD says"), bench.plugin.error());
  }
  Bench bench;
  CHECK(bench.plugin.open("7") == MVS_DRIVER_E_ABSENT);
  bench.in.count = 0;
  CHECK(bench.plugin.open() == MVS_DRIVER_E_ABSENT);
  CHECK(bench.plugin.list().empty());
  Plugin odd("forcedimension", with_library({{"rate", "fast"}}));
  CHECK(odd.open() == MVS_DRIVER_E_OPTION);
}

TEST_CASE("forcedimension_two_devices_open_and_each_once") {
  Bench bench;
  bench.in.count = 2;
  CHECK(bench.plugin.list() == std::vector<std::string>{"0", "1"});
  bench.start();
  Plugin second("forcedimension", with_library({}));
  CHECK(second.open("0") == MVS_DRIVER_E_BUSY);
  REQUIRE(second.open() == MVS_DRIVER_OK);
  REQUIRE(second.api.start(second.device) == MVS_DRIVER_OK);
  Plugin third("forcedimension", with_library({}));
  CHECK(third.open() == MVS_DRIVER_E_BUSY);
  mvs_driver_state state = {};
  for (int i = 0; i < 10; ++i) {
    REQUIRE(bench.tick(1, 0, 0) == MVS_DRIVER_OK);
    REQUIRE(second.read(i * kTick, state) == MVS_DRIVER_OK);
    REQUIRE(second.write(2, 0, 0) == MVS_DRIVER_OK);
  }
  CHECK(bench.given(0)[0] == 1);
  CHECK(bench.given(1)[0] == 2);
  CHECK(std::string(second.info().serial) == "4001");
}

TEST_CASE("forcedimension_doctor_checks_library_bus_and_device") {
  namespace fs = std::filesystem;
  const fs::path root = fs::temp_directory_path() / ("mvs_usb_fd_" + std::to_string(getpid()));
  const fs::path usb = root / "sys/bus/usb/devices/1-3";
  fs::create_directories(usb);
  fs::create_directories(root / "dev/bus/usb/001");
  std::ofstream(usb / "idVendor") << "1451\n";
  std::ofstream(usb / "idProduct") << "0402\n";
  std::ofstream(usb / "product") << "omega.3\n";
  std::ofstream(usb / "busnum") << "1\n";
  std::ofstream(usb / "devnum") << "4\n";
  std::ofstream(root / "dev/bus/usb/001/004") << "";
  fs::permissions(root / "dev/bus/usb/001/004", fs::perms::none);
  Bench bench(Options{{"sysroot", root.string()}});
  bench.in.reset = 1;
  std::string said;
  for (const auto &one : bench.plugin.doctor())
    said += std::to_string(one.verdict) + " " + one.check + ": " + one.sentence + "\n";
  CHECK_MESSAGE(has(said, "omega.3 (1451:0402) is plugged in"), said);
  CHECK_MESSAGE(has(said, "1 device 0: stand-in omega"), said);
  CHECK_MESSAGE(has(said, "0 calibration"), said);
  // root may open every file
  if (geteuid() != 0) CHECK_MESSAGE(has(said, "udev"), said);
  CHECK_MESSAGE(bench.in.moved == 0, "the doctor moved the device");
  fs::remove_all(root);
}
