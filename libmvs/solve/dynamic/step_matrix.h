// The matrix of an implicit step, H + M (1 / dt^2 + c / dt), by free nodes: its rows never change
// their order, so that products have the same bits whatever is eliminated when, or was.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/time_step.h"

namespace mvs::core {

class StepMatrix {
 public:
  explicit StepMatrix(const Model &model);

  // Takes in the projected Hessian at x, the place of the potential's last gradient. `boundary` is
  // the step of the prescribed nodes, null if they stay.
  void assemble(TotalEnergy &total_energy, const std::vector<Vec3> &x, const StepOptions &how,
                const std::vector<Vec3> *boundary, Profile &profile);
  uint32_t size() const { return static_cast<uint32_t>(mass_.size()); }
  uint32_t node(uint32_t row) const { return system_.node_of[row]; }
  // What is on the diagonal of a row beside H, N/m.
  double mass(uint32_t row) const { return mass_[row]; }
  // -H_fb times the step of the boundary, by rows.
  const std::vector<Vec3> &boundary_force() const { return system_.boundary_force; }
  const BlockMatrix &blocks() const { return system_.matrix; }

  // Divides each row by a bound of its sum: a step against the force, short enough for any matrix
  // of these entries.
  void divide(std::vector<Vec3> &rows);

 private:
  const Model *model_;
  HessianAssembler system_;
  std::vector<double> mass_, bound_;
};

}  // namespace mvs::core
