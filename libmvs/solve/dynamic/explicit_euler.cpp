#include "solve/dynamic/explicit_euler.h"

#include <cmath>

#include "base/error.h"
#include "solve/nodes.h"

namespace mvs::core {
namespace {

constexpr double farthest_step = 1;  // m; beyond it a step has blown up

}  // namespace

ExplicitEuler::ExplicitEuler(const Model &model)
    : model_(&model), total_energy_(model, ContactLaw::penalty) {}

void ExplicitEuler::step(State &state, const StepOptions &how, SolveStats &stats) {
  std::vector<Vec3> &x = state.x.edit(), &v = state.v.edit();
  total_energy_.set_pressure(state.load.pressure);
  total_energy_.set_tools(state.tools.get());
  if (!total_energy_.prepared_for(x)) {
    total_energy_.prepare(x, x, 0.5 * model_->valve.contact_thickness, stats.work);
  }
  stats.energy = total_energy_.gradient(x, g_, stats.work);
  stats.residual = largest_free(*model_, g_);
  advance_boundary(*model_, state, how.dt, boundary_);
  bool sane = std::isfinite(stats.residual);
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (model_->topology.fixed[i]) {
      v[i] = boundary_[i] / how.dt;
      x[i] += boundary_[i];
      continue;
    }
    v[i] += how.dt * (-g_[i] / model_->node_mass[i] - how.damping * v[i]);
    x[i] += how.dt * v[i];
    sane = sane && how.dt * v[i].norm() < farthest_step;
  }
  MVS_MUST(sane, MVS_E_DIVERGED, "step",
           "the explicit solver blew up: its time step is too large for this valve");
  stats.kinetic = kinetic_energy(*model_, v);
  stats.contact_pairs = static_cast<uint32_t>(total_energy_.contact().contact_pairs().size());
}

}  // namespace mvs::core
