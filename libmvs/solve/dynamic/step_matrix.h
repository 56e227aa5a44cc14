// The matrix of an implicit step, H + M (1 / dt^2 + c / dt). Its rows are the free nodes in their
// own order for ever, so that products have the same bits for every elimination order.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/time_step.h"

namespace mvs::core {

class StepMatrix {
 public:
  explicit StepMatrix(const Model &model);

  // Assembles the matrix at x, where the last gradient of the total energy was evaluated.
  // `boundary` is the step of the prescribed nodes, null if they stay.
  void assemble(TotalEnergy &total_energy, const std::vector<Vec3> &x, const StepOptions &how,
                const std::vector<Vec3> *boundary, Profile &profile);
  uint32_t size() const { return static_cast<uint32_t>(mass_.size()); }
  uint32_t node(uint32_t row) const { return system_.node_of[row]; }
  // The mass term on the diagonal of a row, N/m.
  double mass(uint32_t row) const { return mass_[row]; }
  // Sets the right-hand side of the step by rows, N, for dE/dx and velocities at its start:
  // -H_fb times the step of the boundary - dE/dx + M v / dt.
  void right_side(const std::vector<Vec3> &gradient, const std::vector<Vec3> &v, double dt,
                  std::vector<Vec3> &rows) const;
  const BlockMatrix &blocks() const { return system_.matrix; }

  // Divides each row by a bound of its absolute row sum: a step along the force that is short
  // enough for any matrix with entries of this size.
  void divide(std::vector<Vec3> &rows);

 private:
  const Model *model_;
  HessianAssembler system_;
  std::vector<double> mass_, bound_;
};

}  // namespace mvs::core
