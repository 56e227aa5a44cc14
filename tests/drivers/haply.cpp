// The driver of the Haply Inverse3 against a service of our own; tests/drivers/test_haply.py does
// the same with the third-party server `websockets`.
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include <cmath>

#include "haply_options.h"

namespace {

constexpr char kZero[] = R"({"x":0,"y":0,"z":0})";

}  // namespace

TEST_CASE("haply: a state is read, on the clock of the host") {
  HaplyService service(steady_haply);
  Plugin plugin("haply", haply_options(service));
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(uint64_t{1} << 60, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], 0.03125);
  CHECK_EQ(state.position[1], -0.12);
  CHECK_EQ(state.velocity[2], -0.25);
  CHECK_EQ(state.orientation[0], 0.8);
  CHECK_EQ(state.orientation[3], -0.6);
  CHECK_EQ(state.buttons, 5);
  CHECK_EQ(state.flags, MVS_DRIVER_FLAG_CALIBRATED | MVS_DRIVER_FLAG_VELOCITY);
  CHECK(state.time_ns <= uint64_t{1} << 60);
  CHECK(state.time_ns + 2000000000 > uint64_t{1} << 60);
  const uint64_t sequence = state.sequence;
  CHECK(eventually(
      [&] { return plugin.read(0, state) == MVS_DRIVER_OK && state.sequence > sequence + 5; }));
}

TEST_CASE("haply: the device description") {
  HaplyService service(steady_haply);
  Plugin plugin("haply", haply_options(service));
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  const mvs_driver_info told = plugin.info();
  CHECK_EQ(told.freedoms_in, 6);
  CHECK_EQ(told.freedoms_out, 3);
  CHECK_EQ(told.buttons, 3);
  CHECK_EQ(std::string(told.model), "Haply Inverse3");
  CHECK_EQ(std::string(told.serial), "ED78730C81735607");
  CHECK_EQ(std::string(told.firmware), "8C20FDC8");
  CHECK_EQ(told.workspace_max[0], 0.1);
  // up is Haply's z, towards the user is minus its y
  CHECK_EQ(told.frame[6], 1);
  CHECK_EQ(told.frame[9], -1);
  CHECK_EQ(plugin.list(), std::vector<std::string>{"049D"});
  const std::string hello = service.texts().at(0);
  CHECK(has(hello, R"("preset":{"preset":"arm_front_centered"})"));
  CHECK(has(hello, R"("profile":{"name":"libmvs"})"));
}

TEST_CASE("haply: the field of a force has the name of the service's version") {
  struct Case {
    const char *version, *field;
  };
  for (const Case &one :
       {Case{"3.1.0.0", "values"}, Case{"3.4.9.0", "values"}, Case{"3.5.0.0", "vector"},
        Case{"3.10.0.0", "vector"}, Case{"4.0.0.0", "vector"}}) {
    CAPTURE(one.version);
    HaplyService service(steady_haply, one.version);
    Plugin plugin("haply", haply_options(service));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.write(1.5, -0.25, 1e-7), MVS_DRIVER_OK);
    const bool vector = std::string(one.field) == "vector";
    const std::string wanted = std::string(R"({"inverse3":[{"device_id":"049D","commands":)") +
                               R"({"set_cursor_force":{")" + one.field +
                               R"(":{"x":1.5,"y":-0.25,"z":1e-07})" +
                               (vector ? R"(,"execute":true)" : "") + "}}}]}";
    CHECK(eventually([&] { return service.last() == wanted; }));
    CHECK_EQ(has(service.texts().at(0), "profile"), vector);
    CHECK_EQ(plugin.info().workspace_max[0] > 0, vector);
  }
}

TEST_CASE("haply: no force before start, after stop, when off, at panic, at the end") {
  HaplyService service(steady_haply);
  Plugin plugin("haply", haply_options(service));
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  const auto zero_again = [&] {
    const size_t before = service.texts().size();
    return eventually([&] {
      const auto texts = service.texts();
      return texts.size() > before + 2 && has(texts.back(), kZero);
    });
  };
  const auto pushed = [&] { return eventually([&] { return has(service.last(), "\"x\":2,"); }); };
  mvs_driver_state state;
  REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
  CHECK(zero_again());
  REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
  CHECK(zero_again());  // earlier messages do not count
  REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
  CHECK(pushed());
  CHECK(eventually([&] {
    return plugin.read(0, state) == MVS_DRIVER_OK && (state.flags & MVS_DRIVER_FLAG_FORCE_ON);
  }));
  REQUIRE_EQ(plugin.write(2, 0, 0, false), MVS_DRIVER_OK);
  CHECK(zero_again());
  REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
  CHECK(pushed());
  std::thread other([&] { plugin.api.stop(plugin.device); });
  other.join();
  CHECK_EQ(plugin.api.stop(plugin.device), MVS_DRIVER_OK);
  CHECK(zero_again());
  REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
  REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
  CHECK(pushed());
  CHECK_EQ(plugin.write(2, NAN, 0), MVS_DRIVER_E_INTERNAL);
  CHECK(zero_again());
  REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
  CHECK(pushed());
  plugin.api.panic(plugin.device);
  CHECK(zero_again());
  REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
  REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
  CHECK(pushed());
  plugin.close();
  CHECK(eventually([&] { return service.closed_with() == "\x03\xe8"; }));
  CHECK(has(service.last(), kZero));
}

TEST_CASE("haply: stop and panic reach a service that is slow to answer") {
  std::atomic<bool> silent{false};
  HaplyService service(
      [&](int, const std::string &) { return silent ? std::string() : ws_frame(haply_state(0)); });
  for (const bool panic : {false, true}) {
    CAPTURE(panic);
    silent = false;
    Plugin plugin("haply", haply_options(service, {{"patience", "1000"}}));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.write(2, 0, 0), MVS_DRIVER_OK);
    CHECK(eventually([&] { return has(service.last(), "\"x\":2,"); }));
    silent = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const size_t before = service.texts().size();
    if (panic) plugin.api.panic(plugin.device);
    if (!panic) plugin.api.stop(plugin.device);
    // the thread writes its own zero, and panic wrote one before
    CHECK(eventually([&] { return service.texts().size() > before + (panic ? 1 : 0); }));
    CHECK(has(service.texts().at(before), kZero));
    CHECK(has(service.last(), kZero));
  }
}

TEST_CASE("haply: a service that is silent, gone or says goodbye is lost, after a zero force") {
  mvs_driver_state state;
  for (const char *end : {"silent", "goodbye", "gone"}) {
    CAPTURE(end);
    const std::string how = end;
    HaplyService service([&](int n, const std::string &) {
      if (n < 20) return ws_frame(haply_state(0));
      return how == "goodbye" ? ws_frame("\x03\xe9", 0x88) : std::string();
    });
    Plugin plugin("haply", haply_options(service, {{"patience", "60"}}));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    plugin.write(2, 0, 0);
    if (how == "gone") service.stop();
    CHECK(eventually([&] { return plugin.read(0, state) == MVS_DRIVER_E_LOST; }));
    CHECK(eventually([&] { return plugin.write(2, 0, 0) == MVS_DRIVER_E_LOST; }));
    CHECK(!plugin.error().empty());
    CHECK_EQ(plugin.api.start(plugin.device), MVS_DRIVER_E_LOST);
    if (how == "silent") CHECK(eventually([&] { return has(service.last(), kZero); }));
    if (how == "goodbye") CHECK(has(plugin.error(), "closed the connection"));
  }
}

TEST_CASE("haply: an unplugged device is lost; an unplugged grip releases its buttons") {
  std::atomic<int> scene{0};
  const std::string no_grip = R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":)"
                              R"({"x":0,"y":0,"z":0}}}],"wireless_verse_grip":[]})";
  HaplyService service([&](int, const std::string &) {
    if (scene == 1) return ws_frame(no_grip);
    return ws_frame(scene == 0 ? haply_state(0) : R"({"inverse3":[],"session_id":7})");
  });
  Plugin plugin("haply", haply_options(service, {{"patience", "200"}}));
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(0, state), MVS_DRIVER_OK);
  CHECK_EQ(state.buttons, 5);
  scene = 1;
  CHECK(eventually([&] { return plugin.read(0, state) == MVS_DRIVER_OK && state.buttons == 0; }));
  CHECK_EQ(state.orientation[0], 0.8);  // the last one received
  CHECK((state.flags & MVS_DRIVER_FLAG_CALIBRATED) != 0);
  CHECK((state.flags & MVS_DRIVER_FLAG_VELOCITY) == 0);
  scene = 2;
  CHECK(eventually([&] { return plugin.read(0, state) == MVS_DRIVER_E_LOST; }));
}

TEST_CASE("haply: an uncalibrated device reports it") {
  const auto without = [](std::string text) {
    const std::string good = R"("calibrated":true)";
    return text.replace(text.find(good), good.size(), R"("calibrated":false)");
  };
  HaplyService service([&](int, const std::string &) { return ws_frame(without(haply_state(0))); },
                       "3.5.0.0", without(haply_inventory()));
  Plugin plugin("haply", haply_options(service));
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(0, state), MVS_DRIVER_OK);
  CHECK((state.flags & MVS_DRIVER_FLAG_CALIBRATED) == 0);
  CHECK_EQ(plugin.api.calibrate(plugin.device), MVS_DRIVER_E_CALIBRATION);
  CHECK(has(plugin.error(), "rest"));
  int faults = 0;
  for (const auto &finding : plugin.doctor()) faults += finding.verdict == 0;
  CHECK_EQ(faults, 1);
}

TEST_CASE("haply: a host at full rate while others call stop") {
  HaplyService service(steady_haply);
  Plugin plugin("haply", haply_options(service, {{"rate", "4000"}}));
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  std::atomic<bool> done{false};
  std::thread other([&] {
    while (!done) {
      plugin.api.stop(plugin.device);
      plugin.api.panic(plugin.device);
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
  });
  mvs_driver_state state;
  for (uint64_t i = 0; i < 300; ++i) {
    if (i % 20 == 0) CHECK_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    CHECK_EQ(plugin.read(i * 1000000, state), MVS_DRIVER_OK);
    CHECK_EQ(plugin.write(0.001 * static_cast<double>(i), 0, 0), MVS_DRIVER_OK);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  done = true;
  other.join();
}
