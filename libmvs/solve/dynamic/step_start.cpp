// Evaluates the start of an implicit step, or takes over the evaluation of the step before.
#include "solve/dynamic/step_start.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "solve/nodes.h"
#include "solve/step_settings.h"

namespace mvs::core {
namespace {

void copy_pushing(const std::vector<Tool> &tools, std::vector<Tool> &pushing) {
  pushing.clear();
  for (const Tool &tool : tools) {
    if (tool.points() > 0) pushing.push_back(tool);
  }
}

// Whether the tools with points of their own are `pushing`, in the same order.
bool are_pushing(const std::vector<Tool> &tools, const std::vector<Tool> &pushing) {
  size_t k = 0;
  for (const Tool &tool : tools) {
    if (tool.points() == 0) continue;
    if (k == pushing.size() || !tool.is_same_as(pushing[k++])) return false;
  }
  return k == pushing.size();
}

}  // namespace

double rest_tolerance_of(const Load &load) {
  namespace set = settings::implicit;
  return std::min(
      set::max_rest_residual,
      set::min_rest_residual + set::rest_residual / MVS_SYSTOLE_PA * std::abs(load.pressure));
}

void StepStart::begin(const Model &model, TotalEnergy &total_energy, const State &state,
                      double slack, SolveStats &stats) {
  is_evaluated = is_evaluated && state.load.pressure == load.pressure &&
                 are_pushing(state.tools, pushing) && same_bits(x, state.x);
  load = state.load;
  x = state.x.get();
  v = state.v.get();
  total_energy.set_pressure(load.pressure);
  total_energy.set_tools(state.tools);
  if (is_evaluated) {
    add_hands(model, total_energy);
  } else {
    copy_pushing(state.tools, pushing);
    evaluate(model, total_energy, slack, stats);
  }
}

void StepStart::evaluate(const Model &model, TotalEnergy &total_energy, double slack,
                         SolveStats &stats) {
  is_evaluated = false;
  if (!total_energy.prepared_for(x)) total_energy.prepare(x, x, slack, stats.work);
  total_energy.sheet_gradient(x, sheet_gradient, stats.work);
  sheet_energy = total_energy.freeze(x);
  add_hands(model, total_energy);
}

void StepStart::accept(const Model &model, TotalEnergy &total_energy, StepTrial &trial) {
  x.swap(trial.x);
  v.swap(trial.v);
  sheet_gradient.swap(trial.sheet_gradient);
  kinetic = trial.kinetic;
  sheet_energy = total_energy.freeze(x);
  add_hands(model, total_energy);
}

void StepStart::stop() {
  std::fill(v.begin(), v.end(), Vec3::Zero());
  kinetic = 0;
}

void StepStart::add_hands(const Model &model, TotalEnergy &total_energy) {
  is_evaluated = false;
  gradient = sheet_gradient;
  energy = sheet_energy + total_energy.add_hands(x, gradient);
  residual = largest_free(model, gradient);
  MVS_MUST(std::isfinite(energy) && std::isfinite(residual), MVS_E_DIVERGED, "step",
           "the forces are not finite: nodes coincide or the material is too stiff");
  is_evaluated = true;
}

bool StepStart::is_at_rest(const Model &model, double dt) const {
  const double most = rest_tolerance_of(load);
  if (residual > most) return false;
  for (size_t i = 0; i < v.size(); ++i) {
    if (model.topology.fixed[i] || v[i].isZero(0)) continue;
    if (!(model.node_mass[i] * v[i].norm() <= most * dt)) return false;
  }
  return true;
}

}  // namespace mvs::core
