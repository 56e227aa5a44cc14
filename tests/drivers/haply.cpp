// The driver of the Haply Inverse3 against a service of our own; tests/drivers/test_haply.py does
// the same with the third-party server `websockets`.
#include "haply_service.h"

#include <cmath>

#include "plugin.h"
#include "random.h"

namespace {

std::string steady(int, const std::string &) {
  return ws_frame(haply_state(0.03125));
}

// Long time-outs: only tests of lateness set shorter ones.
std::map<std::string, std::string> options(const HaplyService &service,
                                           std::map<std::string, std::string> more = {}) {
  more.insert({{"host", "127.0.0.1"}, {"port", service.port()}, {"patience", "2000"}});
  return more;
}

bool has(const std::string &text, const char *part) {
  return text.find(part) != std::string::npos;
}

constexpr char kZero[] = R"({"x":0,"y":0,"z":0})";

TEST_CASE("haply: a state is read, on the clock of the host") {
  HaplyService service(steady);
  Plugin plugin("haply", options(service));
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
  HaplyService service(steady);
  Plugin plugin("haply", options(service));
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
    HaplyService service(steady, one.version);
    Plugin plugin("haply", options(service));
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
  HaplyService service(steady);
  Plugin plugin("haply", options(service));
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
    Plugin plugin("haply", options(service, {{"patience", "1000"}}));
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
    Plugin plugin("haply", options(service, {{"patience", "60"}}));
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
  Plugin plugin("haply", options(service, {{"patience", "200"}}));
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
  Plugin plugin("haply", options(service));
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

TEST_CASE("haply: missing services and devices, and invalid options") {
  HaplyService service(steady);
  const auto opened = [&](std::map<std::string, std::string> more, const char *name = nullptr) {
    Plugin plugin("haply", options(service, std::move(more)));
    const int32_t result = plugin.open(name);
    CHECK_EQ(result != MVS_DRIVER_OK, plugin.device == nullptr);
    return result;
  };
  CHECK_EQ(opened({}, "049D"), MVS_DRIVER_OK);
  CHECK_EQ(opened({}, "049E"), MVS_DRIVER_E_ABSENT);
  CHECK_EQ(opened({{"device", "x"}}), MVS_DRIVER_E_ABSENT);
  CHECK_EQ(opened({{"grip", "x"}}), MVS_DRIVER_E_ABSENT);
  CHECK_EQ(opened({{"grip", "none"}}), MVS_DRIVER_OK);
  CHECK_EQ(opened({{"port", "0"}}), MVS_DRIVER_E_OPTION);
  CHECK_EQ(opened({{"rate", "fast"}}), MVS_DRIVER_E_OPTION);
  CHECK_EQ(opened({{"version", "new"}}), MVS_DRIVER_E_OPTION);
  CHECK_EQ(opened({{"version", "3.0"}}), MVS_DRIVER_E_UNSUPPORTED);
  CHECK_EQ(opened({{"host", "no such host"}}), MVS_DRIVER_E_OPTION);
  Plugin nobody("haply", {{"port", "1"}});
  CHECK_EQ(nobody.open(), MVS_DRIVER_E_LIBRARY);
  CHECK(has(nobody.error(), "haply-inverse-service"));
  CHECK(nobody.list().empty());
  CHECK_EQ(nobody.doctor().at(0).verdict, 0);
  const HaplyService empty(steady, "3.5.0.0", R"({"inverse3":[],"session_id":1})");
  Plugin none("haply", options(empty));
  CHECK_EQ(none.open(), MVS_DRIVER_E_ABSENT);
  CHECK(none.list().empty());
}

TEST_CASE("haply: a version in another notation, or no version") {
  struct Case {
    const char *answer;
    int32_t result;
  };
  for (const Case &one :
       {Case{"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n"
             "11\r\n{\"project_version\r\n9\r\n\":\"3.4.1\"\r\n1\r\n}\r\n0\r\n\r\n",
             MVS_DRIVER_OK},
        Case{"HTTP/1.1 200 OK\r\n\r\n{\"ok\":true,\"data\":{\"git_tag\":\"v3.5.1\"}}",
             MVS_DRIVER_OK},
        Case{"HTTP/1.1 404 Not Found\r\n\r\n", MVS_DRIVER_E_FAULT},
        Case{"HTTP/1.1 200 OK\r\n\r\n{\"project_version\":3.5}", MVS_DRIVER_E_FAULT},
        Case{"HTTP/1.1 200 OK\r\n\r\n[", MVS_DRIVER_E_FAULT},
        Case{"HTTP/1.1 200 OK\r\nContent-Length: 99999999999999999999\r\n\r\n{}",
             MVS_DRIVER_E_FAULT},
        Case{"nonsense", MVS_DRIVER_E_LOST}}) {
    CAPTURE(one.answer);
    HaplyService service(steady);
    service.http = one.answer;
    Plugin plugin("haply", options(service));
    CHECK_EQ(plugin.open(), one.result);
    Plugin told("haply", options(service, {{"version", "3.5"}}));
    CHECK_EQ(told.open(), MVS_DRIVER_OK);
  }
}

TEST_CASE("haply: pings, messages in pieces and long ones") {
  const std::string text = haply_state(0.25);
  const std::string padded =
      haply_state(0.25, (",\"more\":\"" + std::string(70000, 'm') + "\"").c_str());
  const std::string bytes[] = {ws_frame("are you there?", 0x89) + ws_frame(text),
                               ws_frame(text.substr(0, 100), 0x01) + ws_frame("x", 0x89) +
                                   ws_frame(text.substr(100, 50), 0x00) +
                                   ws_frame(text.substr(150), 0x80),
                               ws_frame(padded), ws_frame("", 0x8a) + ws_frame(text)};
  for (const std::string &one : bytes) {
    HaplyService service([&](int, const std::string &) { return one; });
    Plugin plugin("haply", options(service));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    mvs_driver_state state;
    REQUIRE_EQ(plugin.read(0, state), MVS_DRIVER_OK);
    CHECK_EQ(state.position[0], 0.25);
    if (&one == bytes) CHECK(eventually([&] { return service.pong() == "are you there?"; }));
  }
}

// The error of opening when these bytes replace the first state. The patience is short where the
// bytes may be no answer at all; a fault is detected at once if it is read in time, with sanitizers
// too.
int32_t answered(const HaplyService &service, const char *patience = "2000") {
  Plugin plugin("haply",
                options(service, {{"version", "3.5"}, {"patience", patience}, {"rate", "50"}}));
  const int32_t result = plugin.open();
  if (result != MVS_DRIVER_OK) {
    CHECK((result == MVS_DRIVER_E_FAULT || result == MVS_DRIVER_E_LOST));
    CHECK(plugin.error().size() > 20);
    return result;
  }
  mvs_driver_state state = {};
  if (plugin.read(0, state) != MVS_DRIVER_OK) return MVS_DRIVER_E_LOST;
  for (int i = 0; i < 3; ++i) CHECK(std::isfinite(state.position[i] + state.velocity[i]));
  for (const double part : state.orientation) CHECK(std::abs(part) <= 1);
  return result;
}

TEST_CASE("haply: frames that break the protocol are faults") {
  const std::string good = haply_state(0);
  const auto replaced = [&](const char *what, const char *by) {
    std::string text = good;
    return ws_frame(text.replace(text.find(what), std::string(what).size(), by));
  };
  const std::string huge = std::string("\x81\x7f", 2) + std::string("\0\0\0\1\0\0\0\0", 8);
  for (const std::string &bytes : {ws_frame("{"),
                                   ws_frame("[]"),
                                   ws_frame("null"),
                                   ws_frame(""),
                                   ws_frame("\xff\xfe"),
                                   ws_frame(std::string(200000, '[')),
                                   replaced("-0.12", "NaN"),
                                   replaced("-0.12", "1e999"),
                                   replaced("-0.12", "null"),
                                   replaced("-0.12", "\"0.1\""),
                                   replaced("0.5", "[]"),
                                   replaced("cursor_position", "position"),
                                   ws_frame(good, 0x82),
                                   ws_frame(good, 0xc1),
                                   ws_frame(good, 0x80),
                                   ws_frame(good, 0x83),
                                   ws_frame(good, 0x01) + ws_frame(good),
                                   huge,
                                   ws_frame(std::string(126, 'p'), 0x89),
                                   std::string("\x81\x80\0\0\0\0", 6)}) {
    CAPTURE(bytes.substr(0, 40));
    const HaplyService service([&](int, const std::string &) { return bytes; });
    CHECK_EQ(answered(service), MVS_DRIVER_E_FAULT);
  }
}

TEST_CASE("haply: a state that is cut or changed anywhere never crashes") {
  const std::string good = haply_state(0.125);
  std::string bytes;
  std::mutex mutex;
  const HaplyService service([&](int, const std::string &) {
    const std::lock_guard<std::mutex> lock(mutex);
    return bytes;
  });
  const auto put = [&](std::string next) {
    const std::lock_guard<std::mutex> lock(mutex);
    bytes = std::move(next);
  };
  put(ws_frame(good));
  REQUIRE_EQ(answered(service), MVS_DRIVER_OK);
  for (size_t size = 0; size < good.size(); size += 3) {
    put(ws_frame(good.substr(0, size)));
    CHECK_EQ(answered(service), MVS_DRIVER_E_FAULT);
  }
  Random random{11};
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string text = i % 4 ? good : ws_frame(good);
    for (uint32_t k = random() % 3 + 1; k > 0; --k)
      text[random() % text.size()] = static_cast<char>(random());
    put(i % 4 ? ws_frame(text) : text);
    refused += answered(service, "10") != MVS_DRIVER_OK;
  }
  CHECK(refused > 100);
}

TEST_CASE("haply: an inventory that is cut or changed anywhere never crashes") {
  const std::string good = haply_inventory();
  Random random{13};
  for (int i = 0; i < 150; ++i) {
    std::string text = good;
    if (i % 2) text.resize(random() % text.size());
    for (uint32_t k = i % 2 ? 0 : random() % 4 + 1; k > 0; --k)
      text[random() % text.size()] = static_cast<char>(random());
    const HaplyService service(steady, "3.5.0.0", text);
    Plugin plugin("haply", options(service, {{"version", "3.5"}}));
    if (plugin.open() != MVS_DRIVER_OK) CHECK(plugin.error().size() > 20);
    plugin.list();
    CHECK(!plugin.doctor().empty());
  }
}

TEST_CASE("haply: a host at full rate while others call stop") {
  HaplyService service(steady);
  Plugin plugin("haply", options(service, {{"rate", "4000"}}));
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

}  // namespace
