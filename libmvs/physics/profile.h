// Where the time of a solver goes.
#pragma once

#include <mvs/sim.h>

#include <array>
#include <chrono>

namespace mvs {

// Seconds by MVS_PHASE_*. Only ever reported, never part of a result.
using Profile = std::array<double, MVS_PHASE_COUNT>;

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds the time it lives to one phase.
class PhaseTimer {
 public:
  PhaseTimer(Profile &profile, uint32_t phase) : seconds_(&profile[phase]), start_(seconds_now()) {}
  PhaseTimer(const PhaseTimer &) = delete;
  PhaseTimer &operator=(const PhaseTimer &) = delete;
  ~PhaseTimer() { *seconds_ += seconds_now() - start_; }

 private:
  double *seconds_;
  double start_;
};

}  // namespace mvs
