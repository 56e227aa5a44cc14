// The explicit step.
#include "solve/dynamic/explicit_euler.h"

#include <cmath>

#include "base/error.h"
#include "solve/dynamic/stable_step.h"
#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/step_settings.h"

namespace mvs::core {
ExplicitEuler::ExplicitEuler(const Model &model)
    : model_(&model), total_energy_(model, contact_law), stable_dt_(stable_explicit_step(model)) {}

void ExplicitEuler::step(State &state, const StepOptions &how, SolveStats &stats) {
  std::vector<Vec3> &x = state.x.edit(), &v = state.v.edit();
  total_energy_.set_pressure(state.load.pressure);
  total_energy_.set_tools(state.tools.get());
  const double slack =
      settings::explicit_euler::broad_phase_slack * model_->valve.contact_thickness;
  if (!total_energy_.prepared_for(x)) {
    total_energy_.prepare(x, x, slack, stats.work);
  }
  stats.energy = total_energy_.gradient(x, g_, stats.work);
  stats.residual = largest_free(*model_, g_);
  next_boundary_step(*model_, x, state.load.boundary_fraction,
                     settings::boundary::max_speed * how.dt, boundary_);
  bool sane = std::isfinite(stats.residual);
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (model_->topology.fixed[i]) {
      v[i] = boundary_.displacement[i] / how.dt;
      x[i] += boundary_.displacement[i];
      continue;
    }
    v[i] += how.dt * (-g_[i] / model_->node_mass[i] - how.damping * v[i]);
    x[i] += how.dt * v[i];
    sane = sane && how.dt * v[i].norm() < settings::explicit_euler::max_displacement;
  }
  MVS_MUST(sane, MVS_E_DIVERGED, "step",
           "the explicit solver diverged: its time step is too large for this valve");
  stats.kinetic = kinetic_energy(*model_, v);
  stats.contact_pairs = static_cast<uint32_t>(total_energy_.contact().contact_pairs().size());
}

}  // namespace mvs::core
