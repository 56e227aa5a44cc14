// Invariants that bench_step checks outside of the timed steps: no energy from nothing, no crossing
// triangles.
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
  // To be called when load, boundary, valve or tools have changed: the energy before the next step
  // is unknown.
  void changed() {
    energy_is_known_ = false;
    edge_work_.reset();
  }
  // Pairs of triangles that cross, by the exact test alone, which is cheaper than all measures.
  static size_t crossings(const mvs::Simulator &sim);
  // The share of the free nodes that moved less than this distance (m) in the last step of dt (s).
  static double quiet(const mvs::Simulator &sim, double dt, double least);
  // To be called after a step that was awake. Returns true if it created energy.
  bool makes_energy(const mvs::Simulator &sim, const mvs_stats &stats);

 private:
  std::optional<stability::EdgeWork> edge_work_;
  std::vector<double> x_;  // positions before the step
  double energy_ = 0;      // J, potential and kinetic, before it
  bool energy_is_known_ = false;
};

}  // namespace bench
