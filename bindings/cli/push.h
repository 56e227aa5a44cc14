// The force self-test of `mvs haptics test --force`: small pushes along each axis of a device.
#pragma once

#include <array>
#include <vector>

#include "device.h"
#include "ticks.h"

namespace cli {

// One push along an axis, there and back.
struct Push {
  std::string direction;   // "+x"
  double asked_N = 0;      // at its top
  double told_N = 0;       // along the axis, that the motors were told at the top, on average
  double across_N = 0;     // the largest across the axis at the top
  double moved_m = 0;      // the farthest that the hand went along the axis
  bool motors_on = false;  // the device says at the top that its motors follow
};

// A closed valve, and what its tautest chord pulls with; made before a device starts, as the
// closing keeps a processor busy.
struct TautChord {
  mvs::Sim sim;
  mvs_id id = 0;
  double tension = 0;               // N
  std::array<double, 3> pull = {};  // of length 1, on who feels it
};
TautChord taut_chord();

// What the self-test asks for: 0.5 N, or a quarter of what the motors bear for ever.
double push_of(const mvs_device_info &info);

// Arms the device, with `push` N as its limit, and pushes in six directions; all ticks go into
// `ticks` as well. Throws when forces latch off, or do not begin.
std::vector<Push> push_hand(Session &session, TautChord &chord, double push, Ticks &ticks);

Json pushes_json(const std::vector<Push> &pushes);
std::string pushes_text(const std::vector<Push> &pushes);

}  // namespace cli
