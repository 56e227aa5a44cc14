// Unstable equilibria that Newton's method converges to, and how the valve leaves them.
#include <limits>

#include "linalg/gmres.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/static/newton.h"

namespace mvs::core {

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
  unstable_.returns = has_returned() ? unstable_.returns + 1 : 0;
  unstable_.x = at_.x;
  if (!always_returns()) leave(found);
  return false;
}

bool Newton::always_returns() const {
  return unstable_.returns == settings::stability::most_returns;
}

// Whether the leaflets are where the last unstable equilibrium was. Branch points of slack chordae
// may be anywhere.
bool Newton::has_returned() const {
  constexpr double near = settings::stability::returned_share * settings::stability::leave_by;
  if (unstable_.x.empty()) return false;
  for (size_t i = 0; i < at_.x.size(); ++i) {
    if (model_->vertex_area[i] == 0) continue;
    if ((at_.x[i] - unstable_.x[i]).squaredNorm() > near * near) return false;
  }
  return true;
}

// Along the mode, to the side where the residual forces push, or to the other side where it came
// back from that one, as far as the energy falls.
void Newton::leave(const Stability &unstable) {
  namespace set = settings::stability;
  const double pushed = dot(at_.gradient, unstable.mode) > 0 ? -1 : 1;
  const double turn = unstable_.returns % 2 == 0 ? pushed : -pushed;
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<Vec3> farthest;
  double way = set::leave_by;
  while (way <= set::leave_at_most) {
    step_.newton = unstable.mode;
    for (Vec3 &d : step_.newton) d *= turn * way;
    limit_step();
    for (size_t i = 0; i < at_.x.size(); ++i) trial_[i] = at_.x[i] + step_.limited[i];
    const double energy = total_energy_.energy(trial_);
    ++stats_.work.passes;
    if (energy >= lowest) break;
    lowest = energy;
    farthest = trial_;
    way *= 2;
  }
  at_.x = std::move(farthest);
  evaluate();
}

}  // namespace mvs::core
