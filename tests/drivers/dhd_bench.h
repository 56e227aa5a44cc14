// Fixture: the Force Dimension driver on a stand-in for DHD, polled on a clock of the test.
#pragma once

#include <dlfcn.h>

#include "dhd/stand_in.h"
#include "plugin.h"

const std::string dhd_library = MVS_STAND_INS_DIR "/dhd/libdrd_watched.so";

inline DhdStandIn &dhd_stand_in_of_tests() {
  void *const library = dlopen(dhd_library.c_str(), RTLD_NOW);
  REQUIRE_MESSAGE(library, dlerror());
  return *reinterpret_cast<dhd_stand_in_fn>(dlsym(library, "dhd_stand_in"))();
}

// A driver on a stand-in without faults; a test adds its own.
struct DhdBench {
  using Options = std::map<std::string, std::string>;
  static constexpr uint64_t kTick = 1000000;  // ns

  DhdStandIn &in = dhd_stand_in_of_tests();
  Plugin plugin;
  uint64_t now = 0;
  mvs_driver_state state = {};

  explicit DhdBench(Options options = {})
      : plugin("forcedimension", with_library(std::move(options))) {
    for (auto *at : {&in.unplug_at, &in.deaf_at, &in.nan_at, &in.guard_at, &in.force_off_at})
      *at = DhdStandIn::kNever;
    for (auto *zero :
         {&in.left_handed, &in.deaf_for, &in.cause, &in.reset, &in.stuck, &in.open_error,
          &in.buttons, &in.slow, &in.moved, &in.unsafe, &in.unsimulated})
      *zero = 0;
    for (int i = 0; i < DhdStandIn::kDevices; ++i)
      in.ticks[i] = in.writes[i] = in.enables[i] = in.stops[i] = 0;
    in.count = in.supported = 1;
    in.type = 33;
    in.largest_mn = 12000;
  }
  ~DhdBench() {
    plugin.close();
    CHECK_MESSAGE(in.unsafe == 0, "it touched what keeps the device safe, or sent no number");
    CHECK_MESSAGE(in.unsimulated == 0, "it called what is not simulated");
  }
  void start() {
    REQUIRE_MESSAGE(plugin.open() == MVS_DRIVER_OK, plugin.error());
    REQUIRE_MESSAGE(plugin.api.start(plugin.device) == MVS_DRIVER_OK, plugin.error());
    in.writes[0] = 0;
  }
  // One tick, as libmvs does it: a sample, a force.
  int32_t tick(double x = 1, double y = 0.5, double z = -0.25, bool on = true) {
    const int32_t code = plugin.read(now, state);
    now += kTick;
    if (code != MVS_DRIVER_OK) return code;
    return plugin.write(x, y, z, on);
  }
  int32_t ticks(int count) {
    int32_t code = MVS_DRIVER_OK;
    for (int i = 0; i < count && code == MVS_DRIVER_OK; ++i) code = tick();
    return code;
  }
  const double *given(int device = 0) const {
    return in.forces[device][(in.writes[device] - 1) % DhdStandIn::kKept];
  }

  static Options with_library(Options options) {
    options["library"] = dhd_library;
    return options;
  }
};
