// The scripted play of bench_step: operations and tools on a valve that beats.
#pragma once

#include <mvs/experimental.hpp>

#include <functional>
#include <string>
#include <vector>

namespace bench {

// One phase of the play: an action at its start, and one before each of its steps, called with the
// elapsed share of the phase.
struct Phase {
  enum class Done { nothing, changed, hand_moved };

  std::string name;
  std::function<void(mvs::Simulator &)> begin;
  std::function<Done(mvs::Simulator &, int step, double share)> during = {};
};

// The tool that pushes P2: a ball, or a convex tool of 200 vertices on the same sphere.
enum class Pusher { ball, convex };
inline constexpr const char *push_phase = "push P2";

// The play ends in its initial state, so that it can be repeated: every operation undone, no tools.
std::vector<Phase> play(Pusher pusher = Pusher::ball);

}  // namespace bench
