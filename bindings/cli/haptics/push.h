// The force self-test of `mvs haptics test --force`: small pushes along each axis of a device.
#pragma once

#include <array>
#include <vector>

#include "haptics/device.h"
#include "haptics/ticks.h"

namespace cli {

// One push along an axis, there and back.
struct Push {
  std::string direction;   // "+x"
  double asked_N = 0;      // plateau of the push
  double sent_N = 0;       // mean force sent to the motors on the plateau, along the axis
  double across_N = 0;     // largest force across the axis on the plateau
  double moved_m = 0;      // largest displacement of the hand along the axis
  bool motors_on = false;  // the device reports on the plateau that its motors follow
};

// A closed valve and its tautest chord. Made before a device starts, because the closure keeps a
// processor busy.
struct TautChord {
  mvs::Simulator sim;
  mvs_id id = 0;
  double tension = 0;               // N
  std::array<double, 3> pull = {};  // unit vector of the force on the hand
};
TautChord taut_chord();

// Plateau of a push: 0.5 N, or a quarter of the continuous force of the device.
double push_of(const mvs_device_info &info);

// Arms the device with the force limit `push` in N, and pushes in six directions; adds all ticks to
// `ticks`. Throws if forces latch off or do not start.
std::vector<Push> push_hand(Session &session, TautChord &chord, double push, Ticks &ticks);

Json pushes_json(const std::vector<Push> &pushes);
std::string pushes_text(const std::vector<Push> &pushes);

}  // namespace cli
