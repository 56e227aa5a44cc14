// The loop of dynamic relaxation, over the energy terms of the library.
#include "tests/bench/relaxation/relaxation.h"

#include <algorithm>
#include <cmath>

#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/stability.h"
#include "solve/static/boundary_ramp.h"
#include "solve/step_settings.h"
#include "tests/bench/relaxation/fictitious_masses.h"

using namespace mvs::core;

namespace bench {
namespace {

// Faster modes than the slowest one share the velocity, so that the quotient is too large at first:
// without a bound the valve creeps.
constexpr double most_viscous = 0.3;
// N. Spikes of 600 N faded, forces above this one only grew.
constexpr double hopeless = 1e4;

FictitiousMasses::Options masses_of(const RelaxationOptions &options) {
  if (options.renews_often) return {options.safety, 0.05, 0.5};
  return {options.safety, 0.1, 0.8};
}

class Relaxation {
 public:
  Relaxation(const Model &model, State &state, const RelaxationOptions &options)
      : model_(&model),
        state_(&state),
        options_(options),
        total_energy_(model, ContactLaw::penalty),
        masses_(model, masses_of(options)),
        v_(model.node_count(), Vec3::Zero()) {
    total_energy_.set_pressure(state.load.pressure);
  }

  SolveStats run() {
    for (; stats_.iterations < options_.most; ++stats_.iterations) {
      std::vector<Vec3> &x = state_->x.edit();
      evaluate(x);
      if (!(stats_.residual < hopeless)) break;
      if (is_at_rest(x)) break;
      step(x);
    }
    return stats_;
  }

 private:
  void evaluate(const std::vector<Vec3> &x) {
    const double slack =
        settings::explicit_euler::broad_phase_slack * model_->valve.contact_thickness;
    if (!total_energy_.prepared_for(x)) total_energy_.prepare(x, x, slack, stats_.work);
    g_.swap(last_g_);
    stats_.energy = total_energy_.gradient(x, g_, stats_.work);
    stats_.residual = largest_free(*model_, g_);
    if (stats_.iterations % (options_.renews_often ? 2 : 10) != 0) return;
    const PhaseTimer timer(stats_.work, MVS_PHASE_ASSEMBLY);
    masses_.renew(x, total_energy_.contact());
  }

  bool is_at_rest(const std::vector<Vec3> &x) {
    const bool is_calm = stats_.residual <= options_.residual &&
                         boundary_is_there(*model_, x, state_->load.boundary_fraction,
                                           settings::settle::boundary_arrival);
    calm_ = is_calm ? calm_ + 1 : 0;
    if (calm_ < settings::settle::calm_steps) return false;
    const Stability found = check_stability(*model_, *state_, ContactLaw::penalty, true, true);
    stats_.converged = stats_.stable = found.is_stable;
    stats_.stiffness_margin = found.stiffness;
    stats_.growth_rate = found.rate;
    calm_ = 0;
    return found.is_stable;
  }

  void step(std::vector<Vec3> &x) {
    if (options_.damping == Damping::viscous) {
      accelerate_damped();
    } else if (accelerate_free()) {
      return_to_peak(x);
      return;
    }
    next_boundary_step(*model_, x, state_->load.boundary_fraction, options_.longest, boundary_);
    for (size_t i = 0; i < x.size(); ++i) {
      if (model_->topology.fixed[i]) {
        x[i] += boundary_.displacement[i];
        continue;
      }
      const double length = v_[i].norm();
      if (length > options_.longest) v_[i] *= options_.longest / length;
      x[i] += v_[i];
    }
  }

  void accelerate_damped() {
    const double c = viscosity();
    for (size_t i = 0; i < v_.size(); ++i) {
      if (model_->topology.fixed[i]) continue;
      v_[i] = ((1 - c / 2) * v_[i] - g_[i] / masses_[i]) / (1 + c / 2);
    }
  }

  // Twice the frequency of the mode that moves: v is the last displacement, so that K v is the
  // change of the forces.
  double viscosity() const {
    if (stats_.iterations == 0) return 0;
    double stiffness = 0, mass = 0;
    for (size_t i = 0; i < v_.size(); ++i) {
      if (model_->topology.fixed[i]) continue;
      stiffness += v_[i].dot(g_[i] - last_g_[i]);
      mass += masses_[i] * v_[i].squaredNorm();
    }
    return stiffness > 0 && mass > 0 ? std::min(most_viscous, 2 * std::sqrt(stiffness / mass)) : 0;
  }

  // Returns whether the kinetic energy has begun to fall.
  bool accelerate_free() {
    const double share = starts_ ? 0.5 : 1;  // the first step after a stop is half a step
    double energy = 0;
    for (size_t i = 0; i < v_.size(); ++i) {
      if (model_->topology.fixed[i]) continue;
      v_[i] -= share / masses_[i] * g_[i];
      energy += masses_[i] * v_[i].squaredNorm();
    }
    const bool falls = energy < kinetic_;
    kinetic_ = falls ? 0 : energy;
    starts_ = falls;
    return falls;
  }

  // The peak was where the last velocity belongs, half a step ago.
  void return_to_peak(std::vector<Vec3> &x) {
    for (size_t i = 0; i < x.size(); ++i) {
      if (model_->topology.fixed[i]) continue;
      x[i] -= 0.5 * (v_[i] + 1 / masses_[i] * g_[i]);
      v_[i].setZero();
    }
  }

  const Model *model_;
  State *state_;
  RelaxationOptions options_;
  TotalEnergy total_energy_;
  FictitiousMasses masses_;
  std::vector<Vec3> v_, g_, last_g_;  // v: displacement of the last step, m
  BoundaryStep boundary_;
  SolveStats stats_;
  double kinetic_ = 0;
  bool starts_ = true;
  int calm_ = 0;  // steps in a row
};

}  // namespace

SolveStats relax(const Model &model, State &state, const RelaxationOptions &options) {
  return Relaxation(model, state, options).run();
}

}  // namespace bench
