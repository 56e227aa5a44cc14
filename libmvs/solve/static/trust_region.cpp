// Trust-region steps of Newton's method on the energy, far from rest.
#include <algorithm>
#include <cmath>

#include "linalg/gmres.h"
#include "solve/settings.h"
#include "solve/static/newton.h"

namespace mvs::core {
namespace {

// Shortens the Newton step as a whole. A step that was limited node by node need not lead downhill:
// it follows the limits of stiff tissue that nearly touches. A shorter Newton step needs less
// limiting.
void shorten(NewtonStep &step) {
  double share = settings::trust_region::max_shortening;
  for (size_t i = 0; i < step.newton.size(); ++i) {
    const double length = step.newton[i].norm();
    if (length > 0) share = std::min(share, step.limited[i].norm() / length);
  }
  for (Vec3 &d : step.newton) d *= std::max(share, settings::trust_region::min_shortening);
}

}  // namespace

// Takes a step whose gain ratio is high enough. Until there is one lambda grows; every second trial
// shortens the Newton step instead, which takes no factorisation. If all trials fail and raise the
// energy the valve stays where it is: such a step may bend stiff triangles so that all following
// steps raise the energy as well.
void Newton::trust_region_step(bool has_exact) {
  namespace set = settings::trust_region;
  const bool exact = at_.residual < exact_below();
  if (!exact || !has_exact) {
    system_.assemble(exact ? Curvature::exact : far_, stats_.work);
  }
  const double kept = lambda_;
  std::vector<StoppedNode> stopped;
  NewtonStep step;
  std::vector<Vec3> tried(at_.x.size());  // m, positions
  bool lower = false;
  for (int trial = 0; trial < set::trials; ++trial) {
    const bool factorises = trial % 2 == 0;
    if (factorises) {
      system_.factorise(lambda_, stats_);
      system_.solve(at_.gradient, true, step.newton, stats_);
    } else {
      shorten(step);
    }
    limit_step(step);
    double predicted_reduction;
    const double reduction = try_step(step.limited, tried, predicted_reduction);
    const double gain = gain_ratio(step.limited, reduction, predicted_reduction);
    adapt_lambda(gain, step.far_share);
    lower = gain > set::accepted_gain || reduction >= 0;
    if (gain > set::accepted_gain || lambda_ >= set::max_lambda) break;
    if (factorises) stopped = stopped_nodes(step);
    // the model itself predicts that the limited step raises the energy
    const bool uphill = system_.curvature() != Curvature::exact && predicted_reduction < 0;
    if (uphill && lambda_ > set::min_stiffening_lambda && !factorises && trial + 1 < set::trials &&
        stiffen(stopped)) {
      lambda_ = kept;
    }
  }
  system_.drop_stiffening();
  const double before = at_.energy;
  if (lower) at_.x.swap(tried);
  evaluate();
  // the load at the free edge differs from the load that the step was computed for
  if (lower && at_.energy >= before) {
    lambda_ = std::max(set::raised_growth * lambda_, set::raised_lambda);
  }
}

// Returns the nodes that the step limiter stopped; an empty list if they are many.
std::vector<StoppedNode> Newton::stopped_nodes(const NewtonStep &step) const {
  namespace set = settings::trust_region;
  std::vector<StoppedNode> stopped;
  for (size_t r = 0; r < system_.rows(); ++r) {
    const uint32_t i = system_.node(r);
    const double whole = step.newton[i].norm(), left = step.limited[i].norm();
    if (left < set::stopped_share * whole) {
      stopped.push_back({r, step.newton[i] / whole, std::min(whole / left, set::max_stiffening)});
    }
  }
  const double nodes = static_cast<double>(at_.x.size());
  if (static_cast<double>(stopped.size()) > set::max_stopped_share * nodes) return {};
  return stopped;
}

// Stiffens the stopped nodes along their direction for the rest of this iteration, so that the
// other nodes take into account how far these go. Lambda, which a few of them would raise until no
// node moves, may then stay. Returns false if no node is stopped.
bool Newton::stiffen(const std::vector<StoppedNode> &stopped) {
  for (const StoppedNode &s : stopped) system_.stiffen(s.row, s.direction, s.times);
  return !stopped.empty();
}

// The trust-region ratio: 1 where the quadratic model is exact. Arguments are reductions of the
// energy, positive where it falls. Projected Hessian: measured over predicted reduction; exact
// Hessian: 1 minus the error of the predicted reduction relative to the slope.
double Newton::gain_ratio(const std::vector<Vec3> &step, double reduction,
                          double predicted_reduction) const {
  if (system_.curvature() != Curvature::exact) {
    return predicted_reduction > 0 ? reduction / predicted_reduction : (reduction > 0 ? 1 : -1);
  }
  // the linear part is common to both, so their difference is the error of the matrix
  const double slope = dot(at_.gradient, step);
  return 1 - std::abs(reduction - predicted_reduction) / (std::abs(slope) + 1e-300);
}

void Newton::adapt_lambda(double gain, double far_share) {
  namespace set = settings::trust_region;
  if (far_share > set::max_far_share) {
    lambda_ = std::max(set::far_growth * lambda_, set::far_lambda);
  } else if (gain > set::good_gain) {
    const double decay = gain > set::very_good_gain ? set::very_good_decay : set::good_decay;
    lambda_ = lambda_ < set::zero_lambda ? 0 : decay * lambda_;
  } else if (!(gain > set::poor_gain)) {
    lambda_ = std::min(std::max(set::poor_growth * lambda_, set::poor_lambda), set::max_lambda);
  }
}

// Returns the reduction of the energy by the limited step, and sets the reduction that the
// quadratic model predicts. Both are positive where the energy falls.
double Newton::try_step(const std::vector<Vec3> &step, std::vector<Vec3> &trial,
                        double &predicted_reduction) {
  const PhaseTimer timer(stats_.work, MVS_PHASE_LINE_SEARCH);
  ++stats_.work.passes;
  predicted_reduction = -(dot(at_.gradient, step) + 0.5 * system_.quadratic_form(step));
  for (size_t i = 0; i < at_.x.size(); ++i) trial[i] = at_.x[i] + step[i];
  return at_.energy - total_energy_.energy(trial);
}

}  // namespace mvs::core
