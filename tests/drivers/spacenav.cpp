// The driver of 3D mice against a stand-in for spacenavd, and beside the real libspnav: both read
// the same socket, so that driver and stand-in cannot share a mistake.
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

#include "plugin.h"
#include "random.h"

namespace {

using Packet = std::array<int32_t, 8>;

// Answers the requests of libspnav (FreeSpacenav/libspnav src/proto.h) and sends events for the
// test.
class FakeDaemon {
 public:
  enum Kind { kNew, kOld, kNoMouse };

  explicit FakeDaemon(Kind kind = kNew) : kind_(kind) {
    char folder[] = "/tmp/mvs_spacenav_XXXXXX";
    REQUIRE(mkdtemp(folder));
    folder_ = folder;
    sockaddr_un address = {};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path().c_str());
    listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
    REQUIRE_EQ(bind(listening_, reinterpret_cast<sockaddr *>(&address), sizeof address), 0);
    REQUIRE_EQ(listen(listening_, 4), 0);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeDaemon() { stop(); }

  std::string path() const { return folder_ + "/socket"; }
  void stop() {
    if (!thread_.joinable()) return;
    stopping_ = true;
    thread_.join();
    for (const pollfd &waiting : sockets_) close(waiting.fd);
    unlink(path().c_str());
    rmdir(folder_.c_str());
  }
  void send(const void *bytes, size_t size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (size_t i = 1; i < sockets_.size(); ++i) ::send(sockets_[i].fd, bytes, size, MSG_NOSIGNAL);
  }
  void send(const Packet &packet) { send(packet.data(), sizeof packet); }
  void motion(const std::array<int32_t, 6> &axes) {
    send({0, axes[0], axes[1], axes[2], axes[3], axes[4], axes[5], 8});
  }

 private:
  void serve() {
    sockets_.push_back({listening_, POLLIN, 0});
    while (!stopping_) {
      if (poll(sockets_.data(), sockets_.size(), 5) <= 0) continue;
      const std::lock_guard<std::mutex> lock(mutex_);
      for (size_t i = sockets_.size(); i-- > 1;)
        if (sockets_[i].revents && !answer(sockets_[i].fd)) {
          close(sockets_[i].fd);
          sockets_.erase(sockets_.begin() + static_cast<std::ptrdiff_t>(i));
        }
      if (sockets_[0].revents)
        sockets_.push_back({accept(listening_, nullptr, nullptr), POLLIN, 0});
    }
  }
  bool answer(int client) const {
    Packet packet = {};
    const ssize_t got = recv(client, packet.data(), sizeof packet, 0);
    if (got <= 0) return false;
    if (kind_ == kOld) return true;  // takes every request for sensitivities
    if (got == 4) return ::send(client, packet.data(), 4, MSG_NOSIGNAL) == 4;
    return reply(client, packet);
  }
  bool reply(int client, Packet packet) const {
    const auto say = [&] { return ::send(client, packet.data(), sizeof packet, MSG_NOSIGNAL) > 0; };
    packet[7] = kind_ == kNoMouse ? -1 : 0;
    if (kind_ == kNoMouse) return say();
    if ((packet[0] & 0xffff) == 0x2003) packet[1] = 15;
    if ((packet[0] & 0xffff) != 0x2000) return say();
    // a name in more than one packet
    const std::string name = "3Dconnexion SpaceMouse Pro Wireless";
    std::memcpy(&packet[1], name.data(), 24);
    packet[7] = static_cast<int32_t>(name.size());
    if (!say()) return false;
    std::memset(&packet[1], 0, 24);
    std::memcpy(&packet[1], name.data() + 24, name.size() - 24);
    packet[7] = static_cast<int32_t>(name.size() - 24) | 0x10000;
    return say();
  }

  Kind kind_;
  std::string folder_;
  int listening_ = -1;
  std::vector<pollfd> sockets_;
  std::mutex mutex_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

constexpr uint64_t kMs = 1000000;

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
  CHECK(state.position[0] == doctest::Approx(0.001));
  CHECK(state.position[2] == doctest::Approx(-0.0005));
  CHECK(state.velocity[0] == doctest::Approx(0.1));
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
  CHECK(state.position[0] == doctest::Approx(0.05 * 0.05));  // one longest step of 50 ms
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
    CHECK(state.position[1] == doctest::Approx(0.0005));
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

// The part of libspnav's interface in use (its manual, doc/manual.md).
struct Libspnav {
  struct Motion {
    int type, x, y, z, rx, ry, rz;
    unsigned period;
    int *data;
  };
  union Event {
    int type;
    Motion motion;
  };
  struct Pose {
    float position[3], rotation[4];  // x y z, x y z w
  };
  int (*open)() = nullptr;
  int (*close)() = nullptr;
  int (*poll_event)(Event *) = nullptr;
  int (*name)(char *, int) = nullptr;
  int (*buttons)() = nullptr;
  void (*pose_init)(Pose *) = nullptr;
  void (*pose_move)(Pose *, const Motion *) = nullptr;

  bool load() {
    void *const library = dlopen("libspnav.so.0", RTLD_NOW | RTLD_LOCAL);
    const auto find = [&](auto &function, const char *symbol) {
      function =
          reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, symbol));
      return function != nullptr;
    };
    return library && find(open, "spnav_open") && find(close, "spnav_close") &&
           find(poll_event, "spnav_poll_event") && find(name, "spnav_dev_name") &&
           find(buttons, "spnav_dev_buttons") && find(pose_init, "spnav_posrot_init") &&
           find(pose_move, "spnav_posrot_moveobj");
  }
};

TEST_CASE("spacenav: the real libspnav reads the same and moves the same way") {
  Libspnav real;
  if (!real.load()) {
    MESSAGE("skipped: no libspnav.so.0 (apt-get install libspnav0)");
    return;
  }
  FakeDaemon daemon;
  setenv("SPNAV_SOCKET", daemon.path().c_str(), 1);
  // 0.001 rad a unit, as spnav_posrot_moveobj has it: 7 rad/s / 350 units over 50 ms
  Plugin plugin("spacenav", {{"turn", "7"}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  REQUIRE_EQ(real.open(), 0);
  char name[64];
  REQUIRE(real.name(name, sizeof name) > 0);
  CHECK_EQ(std::string(plugin.info().model), name);
  CHECK_EQ(plugin.info().buttons, static_cast<uint32_t>(real.buttons()));
  Libspnav::Pose pose;
  real.pose_init(&pose);
  mvs_driver_state state;
  Random random{7};
  for (uint64_t i = 1; i <= 12; ++i) {
    std::array<int32_t, 6> axes;
    for (int32_t &axis : axes) axis = static_cast<int32_t>(random() % 701) - 350;
    daemon.motion(axes);
    REQUIRE_EQ(plugin.read(50 * i * kMs, state), MVS_DRIVER_OK);
    daemon.motion({});  // the deflection is held for 50 ms
    Libspnav::Event event;
    REQUIRE_EQ(real.poll_event(&event), 1);
    real.pose_move(&pose, &event.motion);
    REQUIRE_EQ(real.poll_event(&event), 1);
    REQUIRE_EQ(plugin.read(50 * (i + 1) * kMs, state), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.read(50 * (i + 1) * kMs, state), MVS_DRIVER_OK);
  }
  // libspnav sums 0.001 a unit, the driver 0.05 m/s / 350 units over 50 ms: a 140th; and in float
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    CHECK(std::abs(state.position[axis] * 140 - pose.position[axis]) < 1e-5);
    CHECK(std::abs(state.orientation[axis + 1] - pose.rotation[axis]) < 1e-5);
  }
  CHECK(std::abs(state.orientation[0] - pose.rotation[3]) < 1e-5);
  real.close();
  unsetenv("SPNAV_SOCKET");
}

}  // namespace
