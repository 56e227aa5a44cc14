// Fixture: a simulated hand on a clock of its own.
#pragma once

#include <cmath>

#include "plugin.h"

using Options = std::map<std::string, std::string>;

class Hand {
 public:
  explicit Hand(Options options) : plugin("hand", std::move(options)) {
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
    state = after(0);
  }

  // The sample `ns` later.
  mvs_driver_state after(uint64_t ns) {
    now += ns;
    REQUIRE_EQ(plugin.read(now, state), MVS_DRIVER_OK);
    return state;
  }
  mvs_driver_state tick() { return after(1000000); }
  double x() const { return state.position[0]; }
  double v() const { return state.velocity[0]; }

  Plugin plugin;
  uint64_t now = 5000000000;
  mvs_driver_state state;
};

// An ideal hand: a written force acts at once and exactly, and the sample holds the velocity.
inline Options ideal(Options more) {
  more.insert({{"device", "ideal"}, {"velocity", "1"}});
  return more;
}
