// Profile of a solver: seconds by phase and counts of operations.
#pragma once

#include <mvs/profile.h>

#include <array>
#include <chrono>

namespace mvs::core {

// Seconds by MVS_PHASE_*, and counts. Reported only; no result depends on it.
struct Profile {
  std::array<double, MVS_PHASE_COUNT> seconds{};
  uint32_t broad_phases = 0, orderings = 0, linear_iterations = 0;
  uint32_t passes = 0;  // evaluations of energy, gradient or Hessian over all terms

  void add(const Profile &other) {
    for (size_t k = 0; k < seconds.size(); ++k) seconds[k] += other.seconds[k];
    broad_phases += other.broad_phases;
    orderings += other.orderings;
    linear_iterations += other.linear_iterations;
    passes += other.passes;
  }
};

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds the time between its construction and destruction to one phase.
class PhaseTimer {
 public:
  PhaseTimer(Profile &profile, uint32_t phase)
      : seconds_(&profile.seconds[phase]), start_(seconds_now()) {}
  PhaseTimer(const PhaseTimer &) = delete;
  PhaseTimer &operator=(const PhaseTimer &) = delete;
  ~PhaseTimer() { *seconds_ += seconds_now() - start_; }

 private:
  double *seconds_;
  double start_;
};

}  // namespace mvs::core
