// Unstable equilibria that Newton's method converges to, and how the valve leaves them.
#include <limits>
#include <utility>

#include "linalg/gmres.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/static/newton.h"

namespace mvs::core {

void UnstableReturns::record(const Model &model, const std::vector<Vec3> &x) {
  count_ = is_near(model, x) ? count_ + 1 : 0;
  x_ = x;
}

bool UnstableReturns::are_endless() const {
  return count_ == settings::stability::most_returns;
}

// Whether the leaflets are where the last unstable equilibrium was. Branch points of slack chordae
// may be anywhere.
bool UnstableReturns::is_near(const Model &model, const std::vector<Vec3> &x) const {
  constexpr double near = settings::stability::returned_share * settings::stability::leave_by;
  if (x_.empty()) return false;
  for (size_t i = 0; i < x.size(); ++i) {
    if (model.vertex_area[i] == 0) continue;
    if ((x[i] - x_[i]).squaredNorm() > near * near) return false;
  }
  return true;
}

Stability Newton::check_stability(bool margins) {
  return check_.check(*model_, total_energy_, at_.x, system_.hessian(), margins, stats_);
}

bool Newton::is_stable(bool margins) {
  system_.assemble(Curvature::exact, stats_.work);
  const Stability found = check_stability(margins);
  stats_.stable = found.is_stable;
  stats_.stiffness_margin = found.stiffness;
  stats_.growth_rate = found.rate;
  if (found.is_stable) return true;
  unstable_.record(*model_, at_.x);
  if (!always_returns()) leave(found);
  return false;
}

// Along the mode, to the side where the residual forces push, or to the other side where it came
// back from that one, as far as the energy falls. After it came back from both sides another
// displacement is tried.
void Newton::leave(const Stability &unstable) {
  namespace set = settings::stability;
  const double pushed = dot(at_.gradient, unstable.mode) > 0 ? -1 : 1;
  const double turn = unstable_.count() % 2 == 0 ? pushed : -pushed;
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<Vec3> farthest;
  double way = set::leave_shares[unstable_.count() / 2] * set::leave_by;
  NewtonStep step;
  while (way <= set::leave_at_most) {
    step.newton = unstable.mode;
    for (Vec3 &d : step.newton) d *= turn * way;
    limit_step(step);
    std::vector<Vec3> tried = at_.x;
    for (size_t i = 0; i < tried.size(); ++i) tried[i] += step.limited[i];
    const double energy = total_energy_.energy(tried);
    ++stats_.work.passes;
    if (energy >= lowest) break;
    lowest = energy;
    farthest = std::move(tried);
    way *= 2;
  }
  at_.x = std::move(farthest);
  evaluate();
}

}  // namespace mvs::core
