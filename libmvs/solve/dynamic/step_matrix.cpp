// Assembles the matrix of an implicit step, and its diagonal bound.
#include "solve/dynamic/step_matrix.h"

namespace mvs::core {

StepMatrix::StepMatrix(const Model &model) : model_(&model) {
  std::vector<uint32_t> nodes;
  for (uint32_t i = 0; i < model.node_count(); ++i) {
    if (!model.topology.fixed[i]) nodes.push_back(i);
  }
  system_.set_order(model, nodes);
  mass_.resize(nodes.size());
}

void StepMatrix::assemble(TotalEnergy &total_energy, const std::vector<Vec3> &x,
                          const StepOptions &how, const std::vector<Vec3> *boundary,
                          Profile &profile) {
  if (system_.matrix.size() != size()) total_energy.set_pattern(system_);
  system_.boundary_step = boundary;
  total_energy.hessian(x, Curvature::projected, system_, profile);
  system_.boundary_step = nullptr;
  const double per_mass = 1 / (how.dt * how.dt) + how.damping / how.dt;
  for (uint32_t r = 0; r < size(); ++r) {
    mass_[r] = model_->node_mass[node(r)] * per_mass;
    system_.matrix.value[system_.matrix.start[r]].diagonal().array() += mass_[r];
  }
}

void StepMatrix::right_side(const std::vector<Vec3> &gradient, const std::vector<Vec3> &v,
                            double dt, std::vector<Vec3> &rows) const {
  rows.resize(size());
  for (uint32_t r = 0; r < size(); ++r) {
    const uint32_t i = node(r);
    rows[r] = system_.boundary_force[r] - gradient[i] + (model_->node_mass[i] / dt) * v[i];
  }
}

void StepMatrix::divide(std::vector<Vec3> &rows) {
  const BlockMatrix &m = system_.matrix;
  bound_.assign(m.size(), 0);
  for (uint32_t c = 0; c < m.size(); ++c) {
    bound_[c] += m.value[m.start[c]].norm();
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      const double size = m.value[k].norm();
      bound_[c] += size;
      bound_[m.row[k]] += size;
    }
  }
  for (size_t r = 0; r < rows.size(); ++r) rows[r] /= bound_[r];
}

}  // namespace mvs::core
