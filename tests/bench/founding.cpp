// Search for the founding method's step and damping; each trial is a closure.
#include "tests/bench/founding.h"

#include <cmath>

namespace bench {
namespace {

constexpr double rung = 1.189207115002721;  // the fourth root of two
constexpr double usual_damping = 500;       // 1/s
constexpr double longest = 1.0;             // s simulated, after which a trial has failed

// A trial stops when it takes longer than the best so far.
Closing attempt(Case of, const Closing *best) {
  of.most = static_cast<uint32_t>(longest / of.dt);
  if (best != nullptr) of.most = best->stats.iterations + best->stats.iterations / 4;
  return close(of, 1);
}

// The smallest edge, and with it the stable step, is in proportion to 1 / sqrt(vertices).
double first_dt(const Case &of) {
  Closing open;
  open.closed = open_valve(of);
  measure(open);
  return 8e-6 * std::sqrt(425.0 / static_cast<double>(open.vertices));
}

Founding largest_step(Case of) {
  of.dt = first_dt(of);
  Founding best{of, attempt(of, nullptr)};
  for (int k = 0; k < 12 && !best.closing.at_rest(); ++k) {
    best.taken.dt /= rung;
    best.closing = attempt(best.taken, nullptr);
  }
  const bool was_first = best.taken.dt == of.dt;
  while (was_first && best.closing.at_rest()) {
    of.dt *= rung;
    const Closing next = attempt(of, &best.closing);
    if (!next.at_rest()) break;
    best = {of, next};
  }
  return best;
}

void best_damping(Founding &best, double factor) {
  for (;;) {
    Case of = best.taken;
    of.damping *= factor;
    const Closing next = attempt(of, &best.closing);
    if (!next.at_rest() || next.stats.iterations >= best.closing.stats.iterations) return;
    best = {of, next};
  }
}

}  // namespace

Founding close_founding(Case of) {
  const bool seek_step = of.dt == 0, seek_damping = of.damping == 0;
  if (seek_damping) of.damping = usual_damping;
  Founding best = seek_step ? largest_step(of) : Founding{of, attempt(of, nullptr)};
  if (!seek_damping || !best.closing.at_rest()) return best;
  const double started = best.taken.damping;
  best_damping(best, 2);
  if (best.taken.damping == started) best_damping(best, 0.5);
  return best;
}

}  // namespace bench
