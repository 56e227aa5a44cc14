// Force of a tool on its hand, and the static stiffness that the hand feels: the derivative of the
// force by the position of the hand while the valve follows in equilibrium.
//
// With E(x, h) the total energy of nodes x and hand h, x(h) in equilibrium and F = -dE/dh the force
// on the hand, dF/dh = -E_hh + E_hx H^-1 E_xh: the springs of hand and tissue in series (a Schur
// complement). H is exact where it is positive definite and projected elsewhere.
#pragma once

#include <memory>
#include <optional>

#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {

struct ToolForce {
  Vec3 force = Vec3::Zero();   // N, on the hand
  Vec3 torque = Vec3::Zero();  // N m, about the hand's place
};
ToolForce force_of(const State &state, const Tool &tool);

class ToolFeel {
 public:
  explicit ToolFeel(Backend backend) : backend_(backend) {}

  // Returns -dF/dh of a tool in a state, N/m; symmetric positive semidefinite.
  Mat3 stiffness(const Model &model, const State &state, const Tool &tool);

 private:
  void take_model(const Model &model);
  void factorise(const State &state);
  bool try_factorise(double more_mass);

  Backend backend_;
  ToolPoints points_;
  const Model *model_ = nullptr;
  uint64_t serial_ = 0;
  std::unique_ptr<DirectSolver> factor_;
  std::optional<TotalEnergy> total_energy_;
  HessianAssembler system_;
  Profile profile_;
  uint32_t patterns_ = 0;     // of the matrix so far
  uint32_t exact_pause_ = 0;  // calls until the exact Hessian is tried again
  std::vector<Vec3> g_, rows_;
};

}  // namespace mvs::core
