// Whether Newton's method wanders: it moves on, but neither the energy nor the forces fall any
// more.
//
// The pressure at the free edge has no potential. Each iteration lowers the energy under the edge
// load of its start, and the edge load at its end may raise it again by as much: the free edge then
// moves in a cycle that no iteration leaves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "solve/settings.h"

namespace mvs::core {

class WanderWatch {
 public:
  // To be called after each iteration with the boundary at its target.
  void look(uint32_t iteration, double energy, double residual) {
    if (energy < energy_ || residual < residual_) last_ = iteration;
    energy_ = std::min(energy_, energy);
    residual_ = std::min(residual_, residual);
    wanders_ = iteration >= last_ + settings::newton::wander_iterations;
  }
  bool wanders() const { return wanders_; }

 private:
  double energy_ = std::numeric_limits<double>::infinity();    // J, the lowest so far
  double residual_ = std::numeric_limits<double>::infinity();  // N, the lowest so far
  uint32_t last_ = 0;                                          // iteration that lowered one of them
  bool wanders_ = false;
};

}  // namespace mvs::core
