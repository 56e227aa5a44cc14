// The driver of 3D mice against a stand-in for spacenavd.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "plugin.h"
#include "random.h"
#include "spacenav_daemon.h"
#include "tests/about.h"

using mvs::core::test::about;

namespace {

void check_finite(const mvs_driver_state &state) {
  double square = 0;
  for (const double part : state.orientation) square += part * part;
  CHECK(std::abs(square - 1) < 1e-12);
  for (const double coordinate : state.position) CHECK(std::abs(coordinate) <= 0.05);
}

TEST_CASE("spacenav: a deflection is a speed, inside a box") {
  FakeDaemon daemon;
  Plugin plugin("spacenav", {{"socket", daemon.path()}, {"speed", "0.1"}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  const mvs_driver_info told = plugin.info();
  CHECK_EQ(told.freedoms_in, 6);
  CHECK_EQ(told.freedoms_out, 0);
  CHECK_EQ(told.buttons, 15);
  CHECK_EQ(std::string(told.model), "3Dconnexion SpaceMouse Pro Wireless");
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(1000 * kMs, state), MVS_DRIVER_OK);
  // full to the right and half away from the user
  daemon.motion({350, 0, 175, 0, 0, 0});
  REQUIRE_EQ(plugin.read(1000 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], 0);
  REQUIRE_EQ(plugin.read(1010 * kMs, state), MVS_DRIVER_OK);
  CHECK(state.position[0] == about(0.001));
  CHECK(state.position[2] == about(-0.0005));
  CHECK(state.velocity[0] == about(0.1));
  CHECK_EQ(state.time_ns, 1010 * kMs);
  // it stops at the wall, and when the puck is released
  const uint64_t sequence = state.sequence;
  for (uint64_t i = 0; i < 100; ++i)
    REQUIRE_EQ(plugin.read((1020 + 10 * i) * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.sequence, sequence + 100);
  REQUIRE_EQ(plugin.read(2010 * kMs, state), MVS_DRIVER_OK);  // the clock stands
  CHECK_EQ(state.sequence, sequence + 100);
  CHECK_EQ(state.position[0], 0.05);
  CHECK_EQ(state.velocity[0], 0);
  daemon.motion({});
  REQUIRE_EQ(plugin.read(3000 * kMs, state), MVS_DRIVER_OK);
  const double there = state.position[2];
  REQUIRE_EQ(plugin.read(3010 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[2], there);
  // calibration moves it back
  REQUIRE_EQ(plugin.api.calibrate(plugin.device), MVS_DRIVER_OK);
  REQUIRE_EQ(plugin.read(3020 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], 0);
  CHECK_EQ(plugin.write(1, 0, 0), MVS_DRIVER_OK);
}

TEST_CASE("spacenav: a pause, and a clock that jumps back, cause no large motion") {
  FakeDaemon daemon;
  Plugin plugin("spacenav", {{"socket", daemon.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(5000 * kMs, state), MVS_DRIVER_OK);
  daemon.motion({350, 0, 0, 0, 0, 0});
  REQUIRE_EQ(plugin.read(5000 * kMs, state), MVS_DRIVER_OK);
  REQUIRE_EQ(plugin.read(9000 * kMs, state), MVS_DRIVER_OK);
  CHECK(state.position[0] == about(0.05 * 0.05));  // one longest step of 50 ms
  const double before = state.position[0];
  REQUIRE_EQ(plugin.read(100 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.position[0], before);
}

TEST_CASE("spacenav: buttons, and a mouse that is unplugged") {
  FakeDaemon daemon;
  Plugin plugin("spacenav", {{"socket", daemon.path()}});
  REQUIRE_EQ(plugin.open("spacenav"), MVS_DRIVER_OK);
  mvs_driver_state state;
  daemon.send({1, 0});
  daemon.send({1, 3});
  daemon.send({1, 40});  // more buttons than the mask holds
  daemon.send({1, -1});
  REQUIRE_EQ(plugin.read(1 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.buttons, 9);
  daemon.send({2, 0});
  REQUIRE_EQ(plugin.read(2 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.buttons, 8);
  daemon.send({3, 1, 0});
  CHECK_EQ(plugin.read(3 * kMs, state), MVS_DRIVER_E_LOST);
  CHECK(plugin.error().find("unplugged") != std::string::npos);
  daemon.send({3, 0, 0});
  REQUIRE_EQ(plugin.read(4 * kMs, state), MVS_DRIVER_OK);
  CHECK_EQ(state.buttons, 0);
}

TEST_CASE("spacenav: packets in pieces, and packets of nonsense") {
  FakeDaemon daemon;
  Plugin plugin("spacenav", {{"socket", daemon.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  mvs_driver_state state;
  const Packet press = {1, 2};
  for (size_t i = 0; i < sizeof press; ++i) {
    daemon.send(reinterpret_cast<const char *>(press.data()) + i, 1);
    REQUIRE_EQ(plugin.read(i * kMs, state), MVS_DRIVER_OK);
    CHECK_EQ(state.buttons, i + 1 < sizeof press ? 0 : 4);
  }
  Random random{1};
  for (uint64_t i = 0; i < 2000; ++i) {
    Packet packet;
    for (int32_t &word : packet) word = static_cast<int32_t>(random());
    packet[0] = static_cast<int32_t>(random() % 9) - 1;
    if (packet[0] == 3) packet[1] = 0;
    daemon.send(packet);
    REQUIRE_EQ(plugin.read((100 + i) * kMs, state), MVS_DRIVER_OK);
    check_finite(state);
  }
}

TEST_CASE("spacenav: the daemon ends, is old, has no mouse, does not run") {
  mvs_driver_state state;
  {
    FakeDaemon daemon;
    Plugin plugin("spacenav", {{"socket", daemon.path()}});
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    CHECK_EQ(plugin.list(), std::vector<std::string>{"spacenav"});
    daemon.stop();
    CHECK_EQ(plugin.read(1, state), MVS_DRIVER_E_LOST);
    CHECK_EQ(plugin.read(2, state), MVS_DRIVER_E_LOST);
    CHECK(plugin.error().find("is gone") != std::string::npos);
  }
  {
    FakeDaemon daemon(FakeDaemon::kOld);
    Plugin plugin("spacenav", {{"socket", daemon.path()}});
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    daemon.motion({0, 350, 0, 0, 0, 0});
    REQUIRE_EQ(plugin.read(1, state), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.read(1 + 10 * kMs, state), MVS_DRIVER_OK);
    CHECK(state.position[1] == about(0.0005));
  }
  {
    FakeDaemon daemon(FakeDaemon::kNoMouse);
    Plugin plugin("spacenav", {{"socket", daemon.path()}});
    CHECK_EQ(plugin.open(), MVS_DRIVER_E_ABSENT);
    CHECK(plugin.list().empty());
    const auto found = plugin.doctor();
    REQUIRE_EQ(found.size(), 2);
    CHECK_EQ(found[0].verdict, 1);
    CHECK_EQ(found[1].verdict, 0);
  }
  Plugin plugin("spacenav", {{"socket", "/nonexistent/socket"}});
  CHECK_EQ(plugin.open(), MVS_DRIVER_E_LIBRARY);
  CHECK(plugin.error().find("apt-get install spacenavd") != std::string::npos);
  CHECK(plugin.list().empty());
  CHECK_EQ(plugin.doctor().at(0).verdict, 0);
}

TEST_CASE("spacenav: invalid options are refused") {
  FakeDaemon daemon;
  for (const char *speed : {"", "0", "-1", "nan", "1e9", "0.1x", "0,1"}) {
    CAPTURE(speed);
    Plugin plugin("spacenav", {{"socket", daemon.path()}, {"speed", speed}});
    CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
    CHECK(plugin.error().find("speed") != std::string::npos);
  }
  Plugin other("spacenav", {{"socket", daemon.path()}});
  CHECK_EQ(other.open("another"), MVS_DRIVER_E_ABSENT);
  Plugin longer("spacenav", {{"socket", std::string(300, 'a')}});
  CHECK_EQ(longer.open(), MVS_DRIVER_E_OPTION);
}

}  // namespace
