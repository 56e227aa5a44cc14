// The driver of 3D mice beside the real libspnav: both read the same socket of a stand-in for
// spacenavd, so that driver and stand-in cannot share a mistake.
#include <dlfcn.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <type_traits>

#include "plugin.h"
#include "random.h"
#include "spacenav_daemon.h"

namespace {

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
