// Faulty drivers, which lie, hang or lack a function, are detected, reported with a sentence each,
// and cause no harm.
#include <doctest/doctest.h>
#include <mvs/driver.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "base/error.h"
#include "haptics/device.h"
#include "tests/haptics/asked.h"

using namespace mvs::core;

namespace {

std::string path_of(const std::string &lie) {
  return std::string(MVS_LIARS_DIR) + "/" + lie + ".so";
}

mvs_device_desc desc_of(const std::string &path, uint32_t clock = MVS_CLOCK_VIRTUAL) {
  mvs_device_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.clock = clock;
  desc.driver = path.c_str();
  return desc;
}

// The code and sentence with which opening fails; MVS_OK if it succeeds.
mvs_result why_not(const std::string &path, std::string &sentence) {
  try {
    Device device(desc_of(path), {});
    return MVS_OK;
  } catch (const Error &error) {
    sentence = error.what();
    return error.code;
  }
}

}  // namespace

TEST_CASE("false_statements_of_a_driver_about_itself_are_refused") {
  struct Lie {
    const char *name;
    mvs_result code;
    const char *part;  // of the sentence
  };
  const Lie lies[] = {{"old", MVS_E_VERSION, "no version"},
                      {"version", MVS_E_VERSION, "version 99"},
                      {"size", MVS_E_VERSION, "8 bytes"},
                      {"overruns", MVS_E_DEVICE, "writes behind"},
                      {"no_symbol", MVS_E_DEVICE, "mvs_driver_negotiate"},
                      {"no_close", MVS_E_DEVICE, "close"},
                      {"no_write", MVS_E_DEVICE, "read and write"},
                      {"refuses", MVS_E_DEVICE, "does not say why"},
                      {"no_handle", MVS_E_DEVICE, "returns no device"},
                      {"nan", MVS_E_DEVICE, "peak force"},
                      {"torque_nan", MVS_E_DEVICE, "the peak torque nan"},
                      {"torque_negative", MVS_E_DEVICE, "the peak torque -0.1"},
                      {"turn_nan", MVS_E_DEVICE, "angular stiffness"},
                      {"frame", MVS_E_DEVICE, "frame"},
                      {"workspace", MVS_E_DEVICE, "workspace"}};
  for (const Lie &lie : lies) {
    CAPTURE(lie.name);
    std::string sentence;
    CHECK_EQ(why_not(path_of(lie.name), sentence), lie.code);
    CHECK_NE(sentence.find(lie.part), std::string::npos);
  }
}

TEST_CASE("an_honest_driver_opens_and_an_unterminated_text_is_cut") {
  for (const char *name : {"honest", "text"}) {
    const std::string path = path_of(name);
    Device device(desc_of(path), {});
    const mvs_device_info info = device.info();
    CHECK_LT(std::string(info.model).size(), sizeof info.model);
    CHECK_EQ(info.peak_force, 3.3);  // a missing value becomes that of the weakest device
    CHECK_EQ(info.rate, 1000);
  }
}

TEST_CASE("opening_a_driver_that_hangs_returns_after_some_seconds") {
  std::string sentence;
  CHECK_EQ(why_not(path_of("hangs"), sentence), MVS_E_DEVICE);
  CHECK_NE(sentence.find("does not come back from open()"), std::string::npos);
}

TEST_CASE("a_loop_that_hangs_is_detected_latched_and_abandoned") {
  const std::string path = path_of("loop_hangs");
  Device device(desc_of(path, MVS_CLOCK_REAL), {});
  device.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const ServoStatus now = device.status();
  CHECK_EQ(now.phase, DevicePhase::latched);
  CHECK_EQ(now.cause, Cause::watchdog);
  CHECK_EQ(device.status().phase, DevicePhase::latched);
  CHECK_EQ(test::asked_of(path).panics, 1);
  CHECK_THROWS_AS(device.arm(), Error);
  CHECK_THROWS_AS(device.stop(), Error);
  CHECK_THROWS_AS(device.start(), Error);
  // closing does not free data that the loop still uses: the driver would end the process
}

TEST_CASE("a_loop_that_returns_is_a_lost_device") {
  const std::string path = path_of("leaves");
  Device device(desc_of(path, MVS_CLOCK_REAL), {});
  device.start();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK_EQ(device.status().cause, Cause::unplugged);
  CHECK_THROWS_AS(device.arm(), Error);
  device.stop();
}

TEST_CASE("samples_of_garbage_cause_no_motion") {
  const std::string path = path_of("garbage");
  Device device(desc_of(path), {});
  device.start();
  device.advance(0.1);
  CHECK_THROWS_AS(device.arm(), Error);
  const ServoStatus now = device.status();
  CHECK(now.pose.position.isZero(0));
  CHECK(now.force.isZero(0));
}

TEST_CASE("drivers_are_found_by_plain_name_or_absolute_path_and_must_not_be_writable_by_others") {
  std::string sentence;
  CHECK_EQ(why_not("../honest", sentence), MVS_E_ARGUMENT);
  CHECK_EQ(why_not("honest.so", sentence), MVS_E_ARGUMENT);
  CHECK_EQ(why_not("", sentence), MVS_E_ARGUMENT);
  CHECK_EQ(why_not("nowhere", sentence), MVS_E_IO);
  CHECK_EQ(why_not("/", sentence), MVS_E_IO);
  const std::string copy = path_of("copied_for_writing");
  std::filesystem::copy_file(path_of("honest"), copy,
                             std::filesystem::copy_options::overwrite_existing);
  REQUIRE_EQ(chmod(copy.c_str(), 0777), 0);
  CHECK_EQ(why_not(copy, sentence), MVS_E_IO);
  CHECK_NE(sentence.find("chmod"), std::string::npos);
  REQUIRE_EQ(chmod(copy.c_str(), 0755), 0);
  CHECK_EQ(why_not(copy, sentence), MVS_OK);
}

TEST_CASE("unknown_and_malformed_driver_options_are_refused") {
  const std::string path = std::string(MVS_DRIVERS_DIR) + "/hand.so";
  for (const char *options : {"nonsense=1", "mass", "=1", "mas=1"}) {
    CAPTURE(options);
    mvs_device_desc desc = desc_of(path);
    desc.options = options;
    try {
      Device device(desc, {});
      FAIL("opened");
    } catch (const Error &error) {
      CHECK_EQ(error.code, MVS_E_ARGUMENT);
    }
  }
}
