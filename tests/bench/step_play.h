// The scripted play of bench_step: what a surgeon does to a valve that beats.
#pragma once

#include <mvs/experimental.hpp>

#include <functional>
#include <string>
#include <vector>

namespace bench {

// One phase of the play: what is done at its start, and before each of its steps, told the share of
// the phase that is over.
struct Phase {
  enum class Done { nothing, changed, hand_moved };

  std::string name;
  std::function<void(mvs::Sim &)> begin;
  std::function<Done(mvs::Sim &, int step, double share)> during = {};
};

// It ends where it began, so that it can be played again: every operation undone, no tools.
std::vector<Phase> play();

}  // namespace bench
