// Symplectic Euler: v += dt (f / m - c v), x += dt v, with a soft vertex-triangle penalty as
// contact (Tenenholtz et al., IROS 2011). It prevents neither penetration nor too large steps: it
// is the baseline of the founding paper.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/time_step.h"
#include "solve/solver.h"
#include "solve/static/boundary_ramp.h"

namespace mvs::core {

class ExplicitEuler {
 public:
  static constexpr ContactLaw contact_law = ContactLaw::penalty;
  explicit ExplicitEuler(const Model &model);
  // s, the default of the time step (stable_step.h).
  double stable_dt() const { return stable_dt_; }
  void step(State &state, const StepOptions &how, SolveStats &stats);
  // See TotalEnergy.
  void begin_call() { total_energy_.begin_call(); }
  uint32_t skipped() const { return total_energy_.skipped(); }

 private:
  const Model *model_;
  TotalEnergy total_energy_;
  std::vector<Vec3> g_;
  BoundaryStep boundary_;
  double stable_dt_;
};

}  // namespace mvs::core
