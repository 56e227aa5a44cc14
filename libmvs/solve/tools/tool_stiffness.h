// Force of a tool on its hand, and the static stiffness that the hand feels: the derivative of the
// force by the position of the hand while the valve follows in equilibrium.
//
// With E(x, h) the total energy of nodes x and hand h, x(h) in equilibrium and F = -dE/dh the force
// on the hand, dF/dh = -E_hh + E_hx H^-1 E_xh: the springs of hand and tissue in series (a Schur
// complement). H is exact where it is positive definite and projected elsewhere.
//
// For a tool with a torque h has six components: the place of the hand, and the rotation p of
// haptics/tissue_model.h about it. Point k of the tool follows with d h_k = dx + dp x r_k, r_k its
// offset from the hand, so that the stiffness is the sum of J_k' S J_k and of the geometric part of
// the force f_k that turns with the tool, (f_k . r_k) I - (r_k f_k' + f_k r_k') / 2: symmetric in
// this coordinate.
#pragma once

#include <memory>
#include <optional>

#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "model/tool_shape.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {

struct ToolForce {
  Vec3 force = Vec3::Zero();   // N, on the hand
  Vec3 torque = Vec3::Zero();  // N m, about the hand's place
};
ToolForce force_of(const State &state, const Tool &tool);

// Whether tissue acts on the hand with a torque.
bool has_torque(const Tool &tool);

// Blocks of the symmetric 6x6 stiffness of a tool; dF and dg are force and generalised torque.
struct ToolStiffness {
  Mat3 linear = Mat3::Zero();    // -dF/dx, N/m
  Mat3 coupling = Mat3::Zero();  // -dF/dp, N/rad; its transpose is -dg/dx
  Mat3 angular = Mat3::Zero();   // -dg/dp, N m/rad
};

class ToolFeel {
 public:
  explicit ToolFeel(Backend backend) : backend_(backend) {}

  // Returns -dF/dh of a tool in a state, N/m; symmetric positive semidefinite.
  Mat3 stiffness(const Model &model, const State &state, const Tool &tool);
  // Returns the same with rotation; not definite if a force along the tool pushes it.
  ToolStiffness wrench_stiffness(const Model &model, const State &state, const Tool &tool);

 private:
  // The springs of a tool at a factorised state.
  using SpringVectors = std::array<Vec3, frame_points>;
  struct Springs {
    uint32_t count;
    std::array<uint32_t, frame_points> row;
    std::array<Mat3, frame_points> block;
    SpringVectors arm, force;  // from the hand, m; on the hand, N
  };
  Springs springs_at(const Model &model, const State &state, const Tool &tool);
  void follow(const Springs &springs, const SpringVectors &moved, SpringVectors &answer);
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
