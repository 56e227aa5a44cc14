// Newton's method: polish steps near rest, the boundary, step limits. trust_region.cpp has the
// steps far from rest, local_settles.cpp the local subproblems, unstable.cpp leaves unstable
// equilibria.
#include "solve/static/newton.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "linalg/gmres.h"
#include "solve/nodes.h"
#include "solve/settings.h"

namespace mvs::core {

bool has_bilinear_tissue(const Model &model) {
  const auto &leaflets = model.valve.leaflets;
  return std::all_of(leaflets.begin(), leaflets.end(), [](const Leaflet &leaflet) {
    return leaflet.law == LeafletLawId::spring || leaflet.law == LeafletLawId::bilinear;
  });
}

// Tissue with an exponential law takes up to half as many iterations more with the balanced
// Hessian.
Newton::Newton(const Model &model, DirectSolver &factor)
    : model_(&model),
      total_energy_(model),
      system_(model, total_energy_, factor, at_.x),
      far_(has_bilinear_tissue(model) ? Curvature::balanced : Curvature::projected) {
  total_energy_.use_verlet_list(false);
  total_energy_.use_workers(factor.workers());
  check_.use_workers(factor.workers());
}

void Newton::begin(const State &state, const LocalStart &local) {
  at_.x = state.x;
  if (local.max_displacement > 0) limit_ = DisplacementLimit(local.max_displacement, state.x);
  lambda_ = local.lambda;
  total_energy_.set_pressure(state.load.pressure);
  total_energy_.set_tools(state.tools);
  pressure_ = scale_of(state.load);
  mean_area_ = mean_area(*model_);
  system_.set_scale(pressure_, mean_area_);
  evaluate();
}

double Newton::exact_below() const {
  namespace set = settings::newton;
  return pressure_ * std::min(set::exact_hessian_area, set::exact_hessian_residual * mean_area_);
}

double Newton::polish_below() const {
  namespace set = settings::newton;
  return pressure_ * std::min(set::polish_area, set::polish_residual * mean_area_);
}

double Newton::slack() const {
  return settings::newton::broad_phase_slack * model_->valve.contact_thickness;
}

SolveStats Newton::finish(State &state) {
  state.x = at_.x;
  state.v.assign(at_.x.size(), Vec3::Zero());
  stats_.residual = at_.residual;
  stats_.energy = at_.energy;
  stats_.contact_pairs = static_cast<uint32_t>(total_energy_.contact().contact_pairs().size());
  stats_.skipped |= total_energy_.skipped();
  return stats_;
}

void Newton::evaluate() {
  if (!total_energy_.prepared_for(at_.x)) {
    total_energy_.prepare(at_.x, at_.x, slack(), stats_.work);
  }
  at_.energy = total_energy_.gradient(at_.x, at_.gradient, stats_.work);
  at_.residual = largest_free(*model_, at_.gradient);
  MVS_MUST(std::isfinite(at_.energy) && std::isfinite(at_.residual), MVS_E_DIVERGED, "settle",
           "the forces are not finite: nodes coincide or the material is too stiff; check the "
           "rest shape and the materials");
}

void Newton::iterate(PolishSchedule &polish) {
  bool has_exact = false;
  if (at_.residual < polish_below() && polish.wait == 0) {
    if (newton_polish_step(polish)) {
      // polish steps and trust-region steps may undo each other: only a smaller force than ever
      // before shows that rest is near
      if (at_.residual < settings::newton::polish_progress * polish.best_residual) {
        polish.best_residual = at_.residual;
        polish.pause = 1;
      }
      return;
    }
    has_exact = true;  // a polish step that fails moves no node
    polish.wait = polish.pause;
    polish.pause = std::min(2 * polish.pause, settings::newton::max_polish_pause);
  }
  polish.wait = std::max(polish.wait - 1, 0);
  trust_region_step(has_exact);
}

// A Newton step on the out-of-balance force with the exact Hessian, or a step that leaves an
// unstable equilibrium. Returns false, and moves no node, unless the force falls or the valve
// leaves.
bool Newton::newton_polish_step(PolishSchedule &polish) {
  system_.assemble(Curvature::exact, stats_.work);
  if (!system_.try_factorise(0, stats_)) {
    ++stats_.shifted;
    // a local subproblem has no masses, and its stability is not that of the valve
    const bool is_local = limit_.is_set();
    if (is_local || at_.residual > settings::stability::early_residual * rest_force()) return false;
    const bool may_leave = polish.early_leaves < settings::stability::most_early_leaves;
    if (may_leave && at_.residual > polish.stable_residual) {
      const Stability found = check_stability(false);
      if (!found.is_stable) {
        ++polish.early_leaves;
        leave(found);
        return true;
      }
      polish.stable_residual = at_.residual;
    }
    double lambda = std::max(polish.lambda, settings::newton::failed_lambda);
    system_.factorise(lambda, stats_);
    polish.lambda = settings::newton::polish_lambda_share * lambda;
  }
  const bool remove_lambda = system_.applied_lambda() < settings::newton::max_removed_lambda;
  NewtonStep step;
  system_.solve(at_.gradient, !remove_lambda, step.newton, stats_);
  limit_step(step);
  // in the cycle around an equilibrium that it returned to, most steps are too long for few trials
  namespace set = settings::newton;
  const int trials = unstable_.count() == 0 ? set::polish_trials : set::patient_trials;
  if (!search_on_force(step.limited, trials)) return false;
  evaluate();
  return true;
}

// Backtracking line search on the norm of the force.
bool Newton::search_on_force(const std::vector<Vec3> &step, int trials) {
  const PhaseTimer timer(stats_.work, MVS_PHASE_LINE_SEARCH);
  Profile inside{};
  const double before = free_norm();
  std::vector<Vec3> kept = at_.gradient, tried(at_.x.size());
  double share = 1;
  for (int trial = 0; trial < trials; ++trial) {
    for (size_t i = 0; i < at_.x.size(); ++i) tried[i] = at_.x[i] + share * step[i];
    total_energy_.gradient(tried, at_.gradient, inside);
    ++stats_.work.passes;
    if (free_norm() <= (1 - settings::newton::polish_decrease * share) * before) {
      at_.x.swap(tried);
      return true;
    }
    share *= settings::newton::polish_backtracking;
  }
  at_.gradient = std::move(kept);
  // the total energy is to be frozen, and contact measured, at x again
  evaluate();
  return false;
}

double Newton::free_norm() const {
  double sum = 0;
  for (size_t i = 0; i < at_.gradient.size(); ++i) {
    if (!model_->topology.fixed[i]) sum += at_.gradient[i].squaredNorm();
  }
  return std::sqrt(sum);
}

// Moves the prescribed nodes by one increment. The free nodes follow as the linearised system says,
// dx_f = -H_ff^-1 H_fb dx_b, so that the sheet is carried along and not crushed.
void Newton::move_boundary(BoundaryRamp &ramp) {
  ramp.advance(at_.x);
  const std::vector<Vec3> &boundary = ramp.step().displacement;
  system_.assemble(far_, boundary, stats_.work);
  system_.factorise(lambda_, stats_);
  NewtonStep step;
  step.newton = boundary;
  system_.carry(step.newton, stats_);
  limit_step(step);
  for (uint32_t i = 0; i < at_.x.size(); ++i) {
    at_.x[i] = ramp.moved(i, at_.x[i], step.limited[i]);
  }
  evaluate();
}

// Shortens the Newton step of each node to the longest displacement of an iteration and to the
// largest step that is safe from collision.
void Newton::limit_step(NewtonStep &step) {
  constexpr double most = settings::newton::max_displacement;
  step.far_share = 0;
  step.limited = step.newton;
  total_energy_.instrument().bodies().shorten(step.limited, most);
  for (Vec3 &d : step.limited) {
    const double length = d.norm();
    if (length > settings::newton::far_factor * most) {
      step.far_share += 1 / static_cast<double>(step.limited.size());
    }
    if (length > most) d *= most / length;
  }
  limit_.stop(at_.x, step.limited);
  total_energy_.limit_step(at_.x, slack(), step.limited, stats_.work);
}

}  // namespace mvs::core
