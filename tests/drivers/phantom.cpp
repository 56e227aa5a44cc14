// The phantom driver on a stand-in for OpenHaptics. Ticks run without pauses, and no check depends
// on their length.
#include <dlfcn.h>
#include <unistd.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "openhaptics/stand_in.h"
#include "plugin.h"

namespace {

const std::string kLibrary = MVS_STAND_INS_DIR "/openhaptics/libHD_watched.so";

// Tolerance for the last bits: mm to m and back.
constexpr double kRounding = 1e-12;

HdStandIn &stand_in() {
  void *const library = dlopen(kLibrary.c_str(), RTLD_NOW);
  REQUIRE_MESSAGE(library, dlerror());
  return *reinterpret_cast<hd_stand_in_fn>(dlsym(library, "hd_stand_in"))();
}

// A driver on a stand-in without faults; a test adds its own.
struct Bench {
  HdStandIn &in = stand_in();
  Plugin plugin{"phantom", {{"library", kLibrary}}};

  Bench() {
    in.period_ns = 20000;
    for (auto *at : {&in.unplug_at, &in.nan_at, &in.silent_at, &in.fail_at})
      *at = HdStandIn::kNever;
    for (auto *zero :
         {&in.init_code, &in.init_times, &in.parked, &in.buttons, &in.hang, &in.misuses,
          &in.fail_code, &in.fail_device, &in.fail_of, &in.frames[0], &in.frames[1]})
      *zero = 0;
    in.calibration = 0x5000;
    in.style = 2;
    in.freedoms_out = 3;
    in.temperature = 20;
  }
  ~Bench() {
    in.hang = 0;
    plugin.close();
    CHECK_MESSAGE(in.misuses == 0, in.misuse.load());
  }
  void start() {
    REQUIRE_MESSAGE(plugin.open() == MVS_DRIVER_OK, plugin.error());
    REQUIRE_MESSAGE(plugin.api.start(plugin.device) == MVS_DRIVER_OK, plugin.error());
  }
  bool was_zero(int device, long frame) const {
    for (const double one : in.forces[device][frame % HdStandIn::kKept])
      if (one != 0) return false;
    return true;
  }
};

// A servo that stores its samples, answers `force`, and stops after `ticks`.
struct Hand {
  size_t ticks = 100;
  mvs_driver_force force = {sizeof(mvs_driver_force), 1, {1, 0.5, -0.25}, {0.01, 0.02, 0.03}, 0};
  mvs_driver_device *stop = nullptr;  // calls stop() of this at the end, returns no request
  const mvs_driver_api *api = nullptr;
  std::vector<mvs_driver_state> seen = {};

  static int32_t servo(void *user, const mvs_driver_state *state, mvs_driver_force *force) {
    Hand &hand = *static_cast<Hand *>(user);
    hand.seen.push_back(*state);
    *force = hand.force;
    if (hand.seen.size() < hand.ticks) return MVS_DRIVER_OK;
    if (hand.stop) return hand.api->stop(hand.stop);
    std::memset(force->force, 0, sizeof force->force);
    return MVS_DRIVER_STOP;
  }
  int32_t run(Plugin &plugin) { return plugin.api.run(plugin.device, servo, this); }
};

bool has(const std::string &sentence, const char *word) {
  return sentence.find(word) != std::string::npos;
}

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

TEST_CASE("phantom_names_the_missing_library") {
  Plugin none("phantom", {{"library", "/nowhere/libHD.so"}});
  CHECK(none.open() == MVS_DRIVER_E_LIBRARY);
  CHECK(has(none.error(), "install the vendor's OpenHaptics"));
  const std::string needy_library = MVS_STAND_INS_DIR "/openhaptics/libHD_needy.so";
  Plugin needy("phantom", {{"library", needy_library}});
  CHECK(needy.open() == MVS_DRIVER_E_LIBRARY);
  CHECK_MESSAGE(has(needy.error(), "apt-get install libncurses5"), needy.error());
  std::string said;
  for (const auto &one : needy.doctor()) said += one.check + ": " + one.sentence + "\n";
  CHECK_MESSAGE(has(said, "library libHD.so: "), said);
  CHECK_MESSAGE(has(said, "library libPhantomIOLib42.so: "), said);
  Plugin relative("phantom", {{"library", "libHD.so"}});
  CHECK(relative.open() == MVS_DRIVER_E_OPTION);
}

TEST_CASE("phantom_describes_the_device") {
  Bench bench;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  const mvs_driver_info info = bench.plugin.info();
  CHECK(std::string(info.model) == "Stand-in Touch");
  CHECK(std::string(info.serial) == "STAND-IN-1");
  CHECK(info.freedoms_in == 6);
  CHECK(info.freedoms_out == 3);
  CHECK(info.peak_force == doctest::Approx(3.3));
  CHECK(info.continuous_force == doctest::Approx(0.88));
  CHECK(info.max_stiffness == doctest::Approx(500));  // 0.5 N/mm
  CHECK(info.max_damping == doctest::Approx(3));      // 0.003 N s/mm
  CHECK(info.max_speed == doctest::Approx(1));
  CHECK(info.workspace_min[0] == doctest::Approx(-0.08));
  CHECK(info.workspace_max[2] == doctest::Approx(0.035));
  CHECK(info.rate == 1000);
  CHECK(bench.in.enabled[0] == (2 | 4 | 8));  // its protections, not its motors
  CHECK(bench.plugin.list() == std::vector<std::string>{"Default Device"});
}

TEST_CASE("phantom_samples_are_in_metres_and_rotate_with_the_stylus") {
  Bench bench;
  bench.in.buttons = 2;
  bench.in.parked = 1;
  bench.start();
  Hand hand{600};
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
  Bench bench;
  bench.in.freedoms_out = 6;
  bench.start();
  Hand hand{300};
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  REQUIRE(bench.in.frames[0] == 300);
  for (int frame = 0; frame < 299; ++frame) {
    const double *const given = bench.in.forces[0][frame];
    CHECK(given[0] == 1);
    CHECK(given[1] == 0.5);
    CHECK(given[2] == -0.25);
    CHECK(given[3] == doctest::Approx(10));  // mN m
    CHECK(given[5] == doctest::Approx(30));
  }
  CHECK(bench.in.forces[0][299][0] == 0);
  CHECK_MESSAGE((bench.in.enabled[0] & 1) == 0, "forces are still enabled");
  CHECK(bench.plugin.info().peak_torque == doctest::Approx(0.188));
}

TEST_CASE("phantom_motors_stay_off_on_request") {
  Bench bench;
  bench.start();
  Hand hand{50};
  hand.force.on = 0;
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  for (int frame = 0; frame < 50; ++frame) CHECK(bench.was_zero(0, frame));
}

TEST_CASE("phantom_an_unplugged_device_is_lost_and_later_absent") {
  Bench bench;
  bench.in.unplug_at = 700;
  bench.start();
  Hand hand{100000};
  CHECK(hand.run(bench.plugin) == MVS_DRIVER_E_LOST);
  CHECK(hand.seen.size() == 700);
  CHECK_MESSAGE(has(bench.plugin.error(), "HD_COMM_ERROR"), bench.plugin.error());
  CHECK(bench.was_zero(0, 700));
  CHECK(hand.run(bench.plugin) != MVS_DRIVER_OK);
  bench.plugin.close();
  CHECK(bench.plugin.open() == MVS_DRIVER_E_ABSENT);
  CHECK_MESSAGE(has(bench.plugin.error(), "USB"), bench.plugin.error());
}

TEST_CASE("phantom_nan_reaches_the_servo_and_never_the_motors") {
  Bench bench;
  bench.in.nan_at = 50;
  bench.start();
  Hand hand{100};
  hand.force.force[1] = std::nan("");
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  CHECK(std::isnan(hand.seen[50].position[0]));
  CHECK(std::isfinite(hand.seen[51].position[0]));
  for (int frame = 0; frame < 100; ++frame) CHECK(bench.was_zero(0, frame));
}

TEST_CASE("phantom_stop_ends_the_loop_from_the_servo_and_from_elsewhere") {
  Bench bench;
  bench.start();
  Hand within{200};
  within.stop = bench.plugin.device;
  within.api = &bench.plugin.api;
  CHECK(within.run(bench.plugin) == MVS_DRIVER_OK);
  CHECK(within.seen.size() == 200);
  CHECK_MESSAGE(bench.was_zero(0, 200), "the tick after stop()");
  CHECK(within.run(bench.plugin) == MVS_DRIVER_OK);  // still stopped
  CHECK(within.seen.size() == 200);

  REQUIRE(bench.plugin.api.start(bench.plugin.device) == MVS_DRIVER_OK);
  bench.in.frames[0] = 0;
  Hand hand{100000000};
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
  Bench bench;
  bench.start();
  const auto servo = [](void *user, const mvs_driver_state *state, mvs_driver_force *) -> int32_t {
    auto &plugin = *static_cast<Plugin *>(user);
    if (state->sequence == 10) plugin.api.close(plugin.device);
    return MVS_DRIVER_OK;
  };
  CHECK(bench.plugin.api.run(bench.plugin.device, servo, &bench.plugin) == MVS_DRIVER_OK);
  bench.plugin.device = nullptr;
  CHECK(bench.in.open[0] == 0);
}

TEST_CASE("phantom_silence_of_the_scheduler_is_a_loss_and_nothing_hangs") {
  Bench bench;
  bench.in.silent_at = 300;
  bench.start();
  Hand hand{100000};
  CHECK(hand.run(bench.plugin) == MVS_DRIVER_E_LOST);
  CHECK(hand.seen.size() == 300);
  CHECK_MESSAGE(has(bench.plugin.error(), "has not called for 100 ms"), bench.plugin.error());
  bench.in.hang = 1;
  bench.plugin.close();
  CHECK(bench.plugin.open() == MVS_DRIVER_E_FAULT);
  CHECK_MESSAGE(has(bench.plugin.error(), "start this program again"), bench.plugin.error());
  bench.in.hang = 0;  // it returns, so that the test can end
  while (bench.plugin.open() == MVS_DRIVER_E_FAULT) std::this_thread::yield();
  CHECK(bench.plugin.device != nullptr);
}

TEST_CASE("phantom_warnings_take_the_force_off_for_a_while") {
  struct Case {
    long code, quiet;
    uint32_t cause, flag;
  };
  for (const Case &one : {Case{0x200, 1000, MVS_CAUSE_THERMAL, MVS_DRIVER_FLAG_WARM},
                          Case{0x201, 100, MVS_CAUSE_NONE, MVS_DRIVER_FLAG_SATURATED},
                          Case{0x203, 100, MVS_CAUSE_VELOCITY, 0}}) {
    CAPTURE(one.code);
    Bench bench;
    bench.in.fail_at = 200;
    bench.in.fail_code = one.code;
    bench.start();
    Hand hand{1300};
    REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
    CHECK(!bench.was_zero(0, 199));
    CHECK(hand.seen[200].cause == one.cause);
    CHECK((hand.seen[200].flags & one.flag) == one.flag);
    CHECK((hand.seen[200].flags & MVS_DRIVER_FLAG_FORCE_ON) == 0);
    for (long frame = 200; frame < 200 + one.quiet; ++frame) CHECK(bench.was_zero(0, frame));
    CHECK(!bench.was_zero(0, 200 + one.quiet));
    CHECK(hand.seen[200 + one.quiet].cause == MVS_CAUSE_NONE);
    CHECK((hand.seen[200 + one.quiet].flags & MVS_DRIVER_FLAG_FORCE_ON) != 0);
  }
}

TEST_CASE("phantom_warm_motors_are_reported_before_they_are_too_warm") {
  Bench bench;
  bench.in.temperature = 95;
  bench.start();
  Hand hand{10};
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  CHECK((hand.seen[5].flags & MVS_DRIVER_FLAG_WARM) != 0);
  CHECK(hand.seen[5].cause == MVS_CAUSE_NONE);
  CHECK(!bench.was_zero(0, 5));
}

TEST_CASE("phantom_open_reports_its_reason_of_failure") {
  struct Case {
    long code;
    int32_t result;
    const char *word;
  };
  for (const Case &one :
       {Case{0x600, MVS_DRIVER_E_LICENCE, "licence"},
        Case{0x300, MVS_DRIVER_E_FAULT, "switch it off"}, Case{0x301, MVS_DRIVER_E_BUSY, "in use"},
        Case{0x302, MVS_DRIVER_E_ABSENT, "does not answer"},
        Case{0x303, MVS_DRIVER_E_ABSENT, "Touch_Setup"}}) {
    Bench bench;
    bench.in.init_code = one.code;
    bench.in.init_times = 100;
    CHECK(bench.plugin.open() == one.result);
    CHECK_MESSAGE(has(bench.plugin.error(), one.word), bench.plugin.error());
    std::string said;
    for (const auto &finding : bench.plugin.doctor())
      if (finding.verdict != 1) said += finding.sentence + "\n";
    CHECK_MESSAGE(has(said, one.word), said);
  }
  Bench bench;
  CHECK(bench.plugin.open("Phantom7") == MVS_DRIVER_E_ABSENT);
  CHECK_MESSAGE(has(bench.plugin.error(), "Phantom7"), bench.plugin.error());
}

TEST_CASE("phantom_opens_a_device_that_a_crashed_program_left_open") {
  Bench bench;
  bench.in.init_code = 0x301;
  bench.in.init_times = 3;
  CHECK_MESSAGE(bench.plugin.open() == MVS_DRIVER_OK, bench.plugin.error());
}

TEST_CASE("phantom_opens_a_device_once") {
  Bench bench;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  Plugin other("phantom", {{"library", kLibrary}});
  CHECK(other.open("Default Device") == MVS_DRIVER_E_BUSY);
  CHECK(other.open() == MVS_DRIVER_E_BUSY);
  CHECK_MESSAGE(bench.in.open[0] == 1, "it switched off a device that is open here");
}

TEST_CASE("phantom_calibrates_where_no_hand_is_needed_and_reports_where_one_is") {
  Bench bench;
  bench.in.calibration = 0x5001;
  bench.start();
  bench.plugin.close();
  bench.in.calibration = 0x5002;
  bench.in.style = 4;
  REQUIRE(bench.plugin.open() == MVS_DRIVER_OK);
  CHECK(bench.plugin.api.calibrate(bench.plugin.device) == MVS_DRIVER_E_CALIBRATION);
  CHECK_MESSAGE(has(bench.plugin.error(), "inkwell"), bench.plugin.error());
  CHECK(bench.plugin.api.start(bench.plugin.device) == MVS_DRIVER_E_CALIBRATION);
  CHECK(Hand().run(bench.plugin) == MVS_DRIVER_E_INTERNAL);
}

// The library has one stack of errors: the callback that runs first may pop those of the other
// device.
TEST_CASE("phantom_two_devices_run_side_by_side_and_one_may_be_lost") {
  for (const long found_by : {1, 0}) {
    CAPTURE(found_by);
    Bench bench;
    Plugin second("phantom", {{"library", kLibrary}});
    REQUIRE(second.open("Phantom2") == MVS_DRIVER_OK);
    REQUIRE(second.api.start(second.device) == MVS_DRIVER_OK);
    bench.start();
    bench.in.fail_at = 500;
    bench.in.fail_code = 0x302;
    bench.in.fail_device = found_by;
    bench.in.fail_of = 1;
    Hand left{100000}, right{2000};
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
          doctest::Approx(0.005));
  }
}

TEST_CASE("phantom_refuses_to_open_while_a_device_runs") {
  Bench bench;
  bench.start();
  Plugin late("phantom", {{"library", kLibrary}});
  Hand hand{100000000};
  std::thread other([&] { hand.run(bench.plugin); });
  while (bench.in.frames[0] < 10) std::this_thread::yield();
  CHECK(late.open("Phantom2") == MVS_DRIVER_E_BUSY);
  CHECK_MESSAGE(has(late.error(), "before the first one runs"), late.error());
  bench.plugin.api.stop(bench.plugin.device);
  other.join();
}

TEST_CASE("phantom_panic_writes_zero_from_the_servo_and_from_other_threads") {
  Bench bench;
  bench.start();
  const auto servo = [](void *user, const mvs_driver_state *, mvs_driver_force *force) -> int32_t {
    *force = Hand().force;
    HdStandIn &in = stand_in();
    auto &plugin = *static_cast<Plugin *>(user);
    if (in.frames[0] != 20) return in.frames[0] < 40 ? MVS_DRIVER_OK : MVS_DRIVER_STOP;
    plugin.api.panic(plugin.device);
    CHECK(in.frames[0] == 21);  // the frame ended at that moment
    return MVS_DRIVER_OK;
  };
  CHECK(bench.plugin.api.run(bench.plugin.device, servo, &bench.plugin) == MVS_DRIVER_OK);
  CHECK(!bench.was_zero(0, 19));
  for (int frame = 20; frame < bench.in.frames[0]; ++frame) CHECK(bench.was_zero(0, frame));
  bench.in.misuses = 0;  // the frame that panic() ended is ended again by the servo's return

  bench.in.frames[0] = 0;
  Hand hand{100000000};
  std::thread other([&] { hand.run(bench.plugin); });
  while (bench.in.frames[0] < 20) std::this_thread::yield();
  bench.plugin.api.panic(bench.plugin.device);
  const long frame = bench.in.frames[0];
  bench.plugin.api.stop(bench.plugin.device);
  other.join();
  CHECK(!bench.was_zero(0, 10));
  CHECK(bench.was_zero(0, frame - 1));
}

TEST_CASE("phantom_reads_its_files_under_a_decimal_comma") {
  setenv("LOCPATH", MVS_STAND_INS_DIR "/openhaptics/locale", 1);
  const bool german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  unsetenv("LOCPATH");  // with it each newlocale() of glibc 2.36 leaks the path
  if (!german) {
    MESSAGE("skipped: localedef could not make de_DE.UTF-8 (Debian: apt-get install locales)");
    return;
  }
  CHECK(std::strtod("0.5", nullptr) == 0);
  {
    Bench bench;
    bench.start();
    Hand hand{10};
    CHECK(hand.run(bench.plugin) == MVS_DRIVER_OK);
    CHECK(hand.seen[0].position[0] == doctest::Approx(0.03));
    CHECK(std::string(std::setlocale(LC_NUMERIC, nullptr)) == "de_DE.UTF-8");
    bench.plugin.close();
    bool told = false;
    for (const auto &one : bench.plugin.doctor()) told |= has(one.sentence, "decimal comma");
    CHECK(told);
  }
  std::setlocale(LC_ALL, "C");
}

// Root may open every file: then only the listing is checked.
TEST_CASE("phantom_doctor_checks_the_usb_bus") {
  namespace fs = std::filesystem;
  const fs::path root = fs::temp_directory_path() / ("mvs_usb_" + std::to_string(getpid()));
  const fs::path usb = root / "sys/bus/usb/devices/1-2";
  fs::create_directories(usb / "1-2:1.0/0003:2988:0304.0001/hidraw/hidraw3");
  fs::create_directories(root / "dev");
  std::ofstream(usb / "idVendor") << "2988\n";
  std::ofstream(usb / "idProduct") << "0304\n";
  std::ofstream(usb / "product") << "Touch\n";
  std::ofstream(root / "dev/hidraw3") << "";
  fs::permissions(root / "dev/hidraw3", fs::perms::none);
  Plugin plugin("phantom", {{"library", kLibrary}, {"sysroot", root.string()}});
  Bench bench;
  std::string said;
  for (const auto &one : plugin.doctor())
    if (one.check == "USB") said += std::to_string(one.verdict) + " " + one.sentence;
  CHECK_MESSAGE(has(said, "Touch (2988:0304)"), said);
  bench.in.init_code = 0x302;
  bench.in.init_times = 100;
  const int32_t code = plugin.open();
  if (geteuid() != 0) {
    CHECK_MESSAGE(has(said, "udev"), said);
    CHECK(code == MVS_DRIVER_E_PERMISSION);
    CHECK_MESSAGE(has(plugin.error(), "/dev/hidraw3"), plugin.error());
  } else {
    CHECK(code == MVS_DRIVER_E_ABSENT);
  }
  fs::remove_all(root);
}
