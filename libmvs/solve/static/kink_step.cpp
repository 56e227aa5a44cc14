// A step along a kink of the energy, where trust-region steps lead uphill: see kink_direction.h.
#include <algorithm>

#include "solve/kink_direction.h"
#include "solve/settings.h"
#include "solve/static/newton.h"

namespace mvs::core {

// Each round adds the force at the last trial, which lies on the other side of a kink. Returns
// false, and moves no node, if the energy falls along none of the directions.
bool Newton::step_along_kink() {
  namespace set = settings::kink;
  system_.assemble(far_, stats_.work);
  double lambda = settings::newton::min_lambda;
  system_.factorise(lambda, stats_);
  std::vector<Vec3> force, step, gradient = at_.gradient;
  KinkDirection kink;
  for (int round = 0; round < set::static_rounds; ++round) {
    force.resize(gradient.size());
    for (size_t i = 0; i < gradient.size(); ++i) force[i] = -gradient[i];
    system_.solve(gradient, true, step, stats_);
    round == 0 ? kink.begin(force, step) : kink.add(force, step);
    if (fall_along(kink.rows())) return true;
    Profile inside{};
    total_energy_.gradient(trial_, gradient, inside);
    ++stats_.work.passes;
    evaluate();  // the total energy is to be frozen at x again
  }
  return false;
}

// Tries ever shorter steps; takes the first that lowers the energy enough.
bool Newton::fall_along(const std::vector<Vec3> &rows) {
  namespace set = settings::kink;
  double share = 1;
  for (int trial = 0; trial < set::static_trials; ++trial) {
    step_.newton = rows;
    for (Vec3 &d : step_.newton) d *= share;
    limit_step();
    double predicted, way = 0;
    for (const Vec3 &d : step_.limited) way = std::max(way, d.norm());
    if (try_step(predicted) > set::least_slope * way) {
      at_.x.swap(trial_);
      evaluate();
      return true;
    }
    share *= set::shortening;
  }
  return false;
}

}  // namespace mvs::core
