// Kinetic energy.
#include "solve/dynamic/time_step.h"

namespace mvs::core {

double kinetic_energy(const Model &model, const std::vector<Vec3> &v) {
  double sum = 0;
  for (size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.node_mass[i] * v[i].squaredNorm();
  return sum;
}

}  // namespace mvs::core
