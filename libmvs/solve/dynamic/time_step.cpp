#include "solve/dynamic/time_step.h"

#include <algorithm>

namespace mvs::core {

double kinetic_energy(const Model &model, const std::vector<Vec3> &v) {
  double sum = 0;
  for (size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.node_mass[i] * v[i].squaredNorm();
  return sum;
}

bool advance_boundary(const Model &model, const State &state, double dt, std::vector<Vec3> &step) {
  const std::vector<Vec3> &x = state.x;
  step.assign(x.size(), Vec3::Zero());
  double farthest = 0;
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (!model.topology.fixed[i]) continue;
    step[i] = model.target(i, state.load.boundary_fraction) - x[i];
    farthest = std::max(farthest, step[i].norm());
  }
  const double share = farthest > boundary_speed * dt ? boundary_speed * dt / farthest : 1.0;
  for (Vec3 &s : step) s *= share;
  return farthest > 0;
}

}  // namespace mvs::core
