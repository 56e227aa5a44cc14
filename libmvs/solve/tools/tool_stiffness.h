// How a tool answers its hand: the force, and how it changes as the hand moves while everything
// else comes to rest again.
//
// With E(x, h) the potential of nodes x and hand h, x(h) at rest and F = -dE/dh the force on the
// hand, dF/dh = -E_hh + E_hx H^-1 E_xh: the stiffness of hand and tissue one after the other. H is
// exact where that is positive definite, projected where it is not.
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
  explicit ToolFeel(uint32_t backend) : backend_(backend) {}

  // -dF/dh of a tool in its state, N/m; symmetric, not negative.
  Mat3 stiffness(const Model &model, const State &state, const Tool &tool);

 private:
  void take_model(const Model &model);
  void factorise(const State &state);
  bool try_factorise(double more_mass);

  uint32_t backend_;
  ToolPoints points_;
  const Model *model_ = nullptr;
  uint64_t serial_ = 0;
  std::unique_ptr<DirectSolver> factor_;
  std::optional<TotalEnergy> total_energy_;
  HessianAssembler system_;
  Profile profile_;
  uint32_t patterns_ = 0;     // of the matrix so far
  uint32_t exact_fails_ = 0;  // calls to come that do not try the exact curvature
  std::vector<Vec3> g_, rows_;
};

}  // namespace mvs::core
