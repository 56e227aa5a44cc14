// Steps in time over the same terms: backward Euler, and the founding paper's symplectic Euler.
#pragma once

#include "base/factor.h"
#include "physics/potential.h"
#include "physics/solver.h"

namespace mvs {

// One linearised backward Euler step: (M / dt^2 + c M / dt + H) dx = -g + M v / dt with the
// projected H, then the cut against collisions. The step is halved until the mechanical energy does
// not grow by more than what the load and the moving boundary put in.
class ImplicitStepper {
 public:
  ImplicitStepper(const Model &model, Factor &factor);
  void step(State &state, double dt, double damping, SolveStats &stats);

 private:
  void evaluate(SolveStats &stats);
  void solve(double dt, double damping, SolveStats &stats);
  void move_boundary(const State &state, double dt);
  void limit(SolveStats &stats);

  const Model *model_;
  Factor *factor_;
  Potential potential_;
  System system_;
  std::vector<Vec3> x_, v_, g_, step_, boundary_, rows_;
  double slack_;  // m, for Potential::prepare
  double energy_ = 0, residual_ = 0;
};

// Symplectic Euler: v += dt (f / m - c v), x += dt v, with a soft vertex-triangle penalty as
// contact (Tenenholtz et al. 2011). Nothing guards it against crossings or large steps: it is the
// baseline.
class ExplicitStepper {
 public:
  explicit ExplicitStepper(const Model &model);
  void step(State &state, double dt, double damping, SolveStats &stats);

 private:
  const Model *model_;
  Potential potential_;
  std::vector<Vec3> g_;
};

// The largest speed at which annulus and heads travel to their targets, m/s.
inline constexpr double boundary_speed = 0.1;

// Where the prescribed nodes are after a time dt on their way to the state's targets.
void advance_boundary(const Model &model, const State &state, double dt, std::vector<Vec3> &step);

double kinetic_energy(const Model &model, const std::vector<Vec3> &v);

}  // namespace mvs
