// The driver of the Haply Inverse3: valid and invalid answers of its service.
#include <cmath>
#include <cstring>

#include "haply_options.h"
#include "random.h"

namespace {

// The error of opening when these bytes replace the first state. The patience is short where the
// bytes may be no answer at all; a fault is detected at once if it is read in time, with sanitizers
// too.
int32_t answered(const HaplyService &service, const char *patience = "2000") {
  Plugin plugin(
      "haply",
      haply_options(service, {{"version", "3.5"}, {"patience", patience}, {"rate", "50"}}));
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

}  // namespace

TEST_CASE("haply: missing services and devices, and invalid options") {
  HaplyService service(steady_haply);
  const auto opened = [&](std::map<std::string, std::string> more, const char *name = nullptr) {
    Plugin plugin("haply", haply_options(service, std::move(more)));
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
  const HaplyService empty(steady_haply, "3.5.0.0", R"({"inverse3":[],"session_id":1})");
  Plugin none("haply", haply_options(empty));
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
    HaplyService service(steady_haply);
    service.http = one.answer;
    Plugin plugin("haply", haply_options(service));
    CHECK_EQ(plugin.open(), one.result);
    Plugin told("haply", haply_options(service, {{"version", "3.5"}}));
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
    Plugin plugin("haply", haply_options(service));
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    mvs_driver_state state;
    REQUIRE_EQ(plugin.read(0, state), MVS_DRIVER_OK);
    CHECK_EQ(state.position[0], 0.25);
    if (&one == bytes) CHECK(eventually([&] { return service.pong() == "are you there?"; }));
  }
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
    const HaplyService service(steady_haply, "3.5.0.0", text);
    Plugin plugin("haply", haply_options(service, {{"version", "3.5"}}));
    if (plugin.open() != MVS_DRIVER_OK) CHECK(plugin.error().size() > 20);
    plugin.list();
    CHECK(!plugin.doctor().empty());
  }
}
