// The phantom driver: missing libraries, lost devices, warnings, panic, the doctor.
#include <unistd.h>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "phantom_bench.h"
#include "tests/about.h"

using mvs::core::test::about;

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

TEST_CASE("phantom_an_unplugged_device_is_lost_and_later_absent") {
  PhantomBench bench;
  bench.in.unplug_at = 700;
  bench.start();
  PhantomHand hand{100000};
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
  PhantomBench bench;
  bench.in.nan_at = 50;
  bench.start();
  PhantomHand hand{100};
  hand.force.force[1] = std::nan("");
  REQUIRE(hand.run(bench.plugin) == MVS_DRIVER_OK);
  CHECK(std::isnan(hand.seen[50].position[0]));
  CHECK(std::isfinite(hand.seen[51].position[0]));
  for (int frame = 0; frame < 100; ++frame) CHECK(bench.was_zero(0, frame));
}

TEST_CASE("phantom_silence_of_the_scheduler_is_a_loss_and_nothing_hangs") {
  PhantomBench bench;
  bench.in.silent_at = 300;
  bench.start();
  PhantomHand hand{100000};
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
    PhantomBench bench;
    bench.in.fail_at = 200;
    bench.in.fail_code = one.code;
    bench.start();
    PhantomHand hand{1300};
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
  PhantomBench bench;
  bench.in.temperature = 95;
  bench.start();
  PhantomHand hand{10};
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
    PhantomBench bench;
    bench.in.init_code = one.code;
    bench.in.init_times = 100;
    CHECK(bench.plugin.open() == one.result);
    CHECK_MESSAGE(has(bench.plugin.error(), one.word), bench.plugin.error());
    std::string said;
    for (const auto &finding : bench.plugin.doctor())
      if (finding.verdict != 1) said += finding.sentence + "\n";
    CHECK_MESSAGE(has(said, one.word), said);
  }
  PhantomBench bench;
  CHECK(bench.plugin.open("Phantom7") == MVS_DRIVER_E_ABSENT);
  CHECK_MESSAGE(has(bench.plugin.error(), "Phantom7"), bench.plugin.error());
}

TEST_CASE("phantom_opens_a_device_that_a_crashed_program_left_open") {
  PhantomBench bench;
  bench.in.init_code = 0x301;
  bench.in.init_times = 3;
  CHECK_MESSAGE(bench.plugin.open() == MVS_DRIVER_OK, bench.plugin.error());
}

TEST_CASE("phantom_refuses_to_open_while_a_device_runs") {
  PhantomBench bench;
  bench.start();
  Plugin late("phantom", {{"library", phantom_library}});
  PhantomHand hand{100000000};
  std::thread other([&] { hand.run(bench.plugin); });
  while (bench.in.frames[0] < 10) std::this_thread::yield();
  CHECK(late.open("Phantom2") == MVS_DRIVER_E_BUSY);
  CHECK_MESSAGE(has(late.error(), "before the first one runs"), late.error());
  bench.plugin.api.stop(bench.plugin.device);
  other.join();
}

TEST_CASE("phantom_panic_writes_zero_from_the_servo_and_from_other_threads") {
  PhantomBench bench;
  bench.start();
  const auto servo = [](void *user, const mvs_driver_state *, mvs_driver_force *force) -> int32_t {
    *force = PhantomHand().force;
    HdStandIn &in = phantom_stand_in();
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
  PhantomHand hand{100000000};
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
    PhantomBench bench;
    bench.start();
    PhantomHand hand{10};
    CHECK(hand.run(bench.plugin) == MVS_DRIVER_OK);
    CHECK(hand.seen[0].position[0] == about(0.03));
    CHECK(std::string(std::setlocale(LC_NUMERIC, nullptr)) == "de_DE.UTF-8");
    bench.plugin.close();
    bool told = false;
    for (const auto &one : bench.plugin.doctor()) told |= has(one.sentence, "decimal comma");
    CHECK(told);
  }
  std::setlocale(LC_ALL, "C");
}

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
  Plugin plugin("phantom", {{"library", phantom_library}, {"sysroot", root.string()}});
  PhantomBench bench;
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
