// Measurements of live steps, one row a scene and phase of the play, as a table and as CSV.
#pragma once

#include <mvs/experimental.h>

#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace bench {

struct StepRow {
  std::string scene, phase;
  std::vector<double> active, resting;  // seconds a step
  std::vector<double> hand;             // of both, while a hand moves
  size_t lowered_linear = 0, lowered_step = 0, broad = 0, orderings = 0, made = 0;
  size_t iterations = 0, served = 0;  // of conjugate gradients; steps without work on a factor
  size_t passes = 0, factors = 0;
  std::array<double, MVS_PHASE_COUNT> phase_s{};  // of active steps, wall time
  size_t crossings = 0;
  double quiet = 0, quiet_by_hand = 0;  // sums of shares over active steps, over those with a hand

  size_t steps() const { return active.size() + resting.size(); }
  void add(const StepRow &other);
};

// The smallest number that at least this share of the numbers do not exceed; 0 without numbers.
double percentile(std::vector<double> of, double share);

void print_head();
void print(const StepRow &row);
// Percentiles of some of the steps of a row.
void print(const StepRow &whole, const char *which, const std::vector<double> &took);
void write_head(std::ostream &csv);
void write(std::ostream &csv, const StepRow &row);

}  // namespace bench
