// Line search of an implicit step on the mechanical energy: returns a trial whose energy is at most
// that of the start, beyond rounding and the work of the boundary, or none.
//
// First shares of the limited step are tried, each from the parabola through the slope at the
// start and both energies. Limits set node by node may turn a step uphill or across the slope; a
// ball that was drawn back stuck in tissue as long as such steps were followed. Then the whole step
// is shortened before it is limited: that leads downhill, and a shorter step is limited less.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/step_matrix.h"
#include "solve/dynamic/step_start.h"
#include "solve/static/boundary_ramp.h"

namespace mvs::core {

// The step of all nodes before the search.
struct ProposedStep {
  const StepMatrix &matrix;
  const std::vector<Vec3> &rows;  // m: solution of the linear system
  const BoundaryStep &boundary;
  double slack;                     // m, of the broad phase
  std::vector<Vec3> &displacement;  // m, by node, after all limits; the search changes it
};

class EnergyLineSearch {
 public:
  EnergyLineSearch(const Model &model, TotalEnergy &total_energy);

  // Returns whether `trial` holds a configuration to accept.
  bool run(const StepStart &start, ProposedStep &step, StepWork &work);

  StepTrial trial;

 private:
  bool search_shorter_step(const StepStart &start, ProposedStep &step, StepWork &work);
  double try_share(double share, const StepStart &start, const ProposedStep &step, StepWork &work);
  void place(double share, const StepStart &start, const ProposedStep &step, double dt);
  double boundary_energy(const StepStart &start, const BoundaryStep &boundary, SolveStats &stats);

  const Model *model_;
  TotalEnergy *total_energy_;
  std::vector<Vec3> boundary_x_, boundary_gradient_;  // of boundary_energy()
  double boundary_energy_ = -1;                       // J, of this step; negative: not known
};

// Sets `displacement` to the boundary step on prescribed nodes and `share` of the rows on free
// ones.
void scatter_step(const StepMatrix &matrix, const std::vector<Vec3> &rows,
                  const BoundaryStep &boundary, std::vector<Vec3> &displacement, double share);

}  // namespace mvs::core
