#include "solve/dynamic/explicit_euler.h"

#include <cmath>

#include "base/error.h"
#include "solve/nodes.h"

namespace mvs::core {
namespace {

constexpr double farthest_step = 1;  // m; beyond it a step has blown up

}  // namespace

ExplicitStepper::ExplicitStepper(const Model &model)
    : model_(&model), potential_(model, ContactLaw::penalty) {}

void ExplicitStepper::step(State &state, const StepOptions &how, SolveStats &stats) {
  std::vector<Vec3> &x = state.x.edit(), &v = state.v.edit();
  potential_.set_pressure(state.load.pressure);
  potential_.set_tools(state.tools.get());
  if (!potential_.prepared_for(x)) {
    potential_.prepare(x, x, 0.5 * model_->valve.contact_thickness, stats.work);
  }
  stats.energy = potential_.gradient(x, g_, stats.work);
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
  stats.contact_pairs = static_cast<uint32_t>(potential_.contact().stencils().size());
}

}  // namespace mvs::core
