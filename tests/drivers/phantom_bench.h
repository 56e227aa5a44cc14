// Fixture: the phantom driver on a stand-in for OpenHaptics, and a servo. Ticks run without pauses,
// and no check depends on their length.
#pragma once

#include <dlfcn.h>

#include <cstring>

#include "openhaptics/stand_in.h"
#include "plugin.h"

const std::string phantom_library = MVS_STAND_INS_DIR "/openhaptics/libHD_watched.so";

inline HdStandIn &phantom_stand_in() {
  void *const library = dlopen(phantom_library.c_str(), RTLD_NOW);
  REQUIRE_MESSAGE(library, dlerror());
  return *reinterpret_cast<hd_stand_in_fn>(dlsym(library, "hd_stand_in"))();
}

// A driver on a stand-in without faults; a test adds its own.
struct PhantomBench {
  HdStandIn &in = phantom_stand_in();
  Plugin plugin{"phantom", {{"library", phantom_library}}};

  PhantomBench() {
    in.period_ns = 20000;
    for (auto *at : {&in.unplug_at, &in.nan_at, &in.silent_at, &in.fail_at})
      *at = HdStandIn::kNever;
    for (auto *zero :
         {&in.init_code, &in.init_times, &in.parked, &in.buttons, &in.hang, &in.misuses,
          &in.fail_code, &in.fail_device, &in.fail_of, &in.frames[0], &in.frames[1]})
      *zero = 0;
    in.calibration = 0x5000;
    in.style = 2;
    in.freedoms_out = 3;
    in.temperature = 20;
  }
  ~PhantomBench() {
    in.hang = 0;
    plugin.close();
    CHECK_MESSAGE(in.misuses == 0, in.misuse.load());
  }
  void start() {
    REQUIRE_MESSAGE(plugin.open() == MVS_DRIVER_OK, plugin.error());
    REQUIRE_MESSAGE(plugin.api.start(plugin.device) == MVS_DRIVER_OK, plugin.error());
  }
  bool was_zero(int device, long frame) const {
    for (const double one : in.forces[device][frame % HdStandIn::kKept])
      if (one != 0) return false;
    return true;
  }
};

// A servo that stores its samples, answers `force`, and stops after `ticks`.
struct PhantomHand {
  size_t ticks = 100;
  mvs_driver_force force = {sizeof(mvs_driver_force), 1, {1, 0.5, -0.25}, {0.01, 0.02, 0.03}, 0};
  mvs_driver_device *stop = nullptr;  // calls stop() of this at the end, returns no request
  const mvs_driver_api *api = nullptr;
  std::vector<mvs_driver_state> seen = {};

  static int32_t servo(void *user, const mvs_driver_state *state, mvs_driver_force *force) {
    PhantomHand &hand = *static_cast<PhantomHand *>(user);
    hand.seen.push_back(*state);
    *force = hand.force;
    if (hand.seen.size() < hand.ticks) return MVS_DRIVER_OK;
    if (hand.stop) return hand.api->stop(hand.stop);
    std::memset(force->force, 0, sizeof force->force);
    return MVS_DRIVER_STOP;
  }
  int32_t run(Plugin &plugin) { return plugin.api.run(plugin.device, servo, this); }
};
