// What bench_step holds its steps to, outside of the time it takes: no energy from nothing, nothing
// that crosses.
#pragma once

#include <mvs/experimental.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/stability/edge_work.h"

namespace bench {

class StepWatch {
 public:
  // Load, boundary, valve or tools have changed: what the next step begins with is not known.
  void changed() {
    energy_is_known_ = false;
    edge_work_.reset();
  }
  // Pairs of triangles that cross, by the exact test alone: all measures take as long as many
  // steps.
  static size_t crossings(const mvs::Sim &sim);
  // The share of the free nodes that went less than so far (m) in the last step of dt (s).
  static double quiet(const mvs::Sim &sim, double dt, double least);
  // After a step that was awake. True if it made energy.
  bool makes_energy(const mvs::Sim &sim, const mvs_stats &stats);

 private:
  std::optional<stability::EdgeWork> edge_work_;
  std::vector<double> x_;  // where nodes were before the step
  double energy_ = 0;      // J, potential and kinetic, before it
  bool energy_is_known_ = false;
};

}  // namespace bench
