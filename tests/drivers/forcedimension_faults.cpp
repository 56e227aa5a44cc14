// The Force Dimension driver: missing libraries, lost devices, forces that go off, panic, the
// doctor.
#include <unistd.h>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "dhd_bench.h"

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

TEST_CASE("forcedimension_nan_is_read_and_never_written") {
  DhdBench bench;
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
  DhdBench bench;
  bench.in.unplug_at = 700;
  bench.start();
  REQUIRE(bench.ticks(700) == MVS_DRIVER_OK);
  CHECK(bench.ticks(100) == MVS_DRIVER_E_LOST);
  CHECK(bench.in.ticks[0] <= 702);  // without the retries for short interruptions
  CHECK_MESSAGE(has(bench.plugin.error(), "does not answer any more"), bench.plugin.error());
}

TEST_CASE("forcedimension_a_short_interruption_is_no_loss_and_long_silence_is") {
  DhdBench bench;
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
    DhdBench bench;
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
  DhdBench bench;
  bench.in.slow = 30;
  bench.start();
  for (int i = 0; i < 200; ++i) {
    REQUIRE(bench.tick(1, 0, 0, i % 100 > 10) == MVS_DRIVER_OK);
    CHECK(bench.state.cause == MVS_CAUSE_NONE);
  }
  CHECK((bench.state.flags & MVS_DRIVER_FLAG_FORCE_ON) != 0);
}

TEST_CASE("forcedimension_off_writes_zero_force_and_then_brakes") {
  DhdBench bench;
  bench.start();
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 1);
  REQUIRE(bench.tick(1, 1, 1, false) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 0);
  CHECK(bench.in.stops[0] == 1);
  CHECK(bench.in.on[0] == 0);
}

TEST_CASE("forcedimension_stop_from_another_thread_ends_all_force") {
  DhdBench bench;
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
  DhdBench bench;
  bench.start();
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  bench.plugin.api.panic(bench.plugin.device);
  CHECK(bench.given()[0] == 0);
  REQUIRE(bench.ticks(5) == MVS_DRIVER_OK);
  CHECK(bench.given()[0] == 0);
}

TEST_CASE("forcedimension_open_reports_its_reason_of_failure") {
  struct Case {
    long error;
    int32_t result;
  };
  for (const Case &one : {Case{20, MVS_DRIVER_E_BUSY}, Case{5, MVS_DRIVER_E_ABSENT},
                          Case{4, MVS_DRIVER_E_ABSENT}, Case{8, MVS_DRIVER_E_FAULT}}) {
    DhdBench bench;
    bench.in.open_error = one.error;
    CHECK(bench.plugin.open() == one.result);
    CHECK_MESSAGE(has(bench.plugin.error(), "DHD says"), bench.plugin.error());
  }
  DhdBench bench;
  CHECK(bench.plugin.open("7") == MVS_DRIVER_E_ABSENT);
  bench.in.count = 0;
  CHECK(bench.plugin.open() == MVS_DRIVER_E_ABSENT);
  CHECK(bench.plugin.list().empty());
  Plugin odd("forcedimension", DhdBench::with_library({{"rate", "fast"}}));
  CHECK(odd.open() == MVS_DRIVER_E_OPTION);
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
  DhdBench bench(DhdBench::Options{{"sysroot", root.string()}});
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
