// The springs between hands and what they lead: held nodes, and the points of instruments.
//
// Each is a spring of stiffness k whose force stops growing at F: E = k d^2 / 2 up to d0 = F / k,
// and F d - F d0 / 2 beyond, d the distance from where the hand wants the node. E is convex and its
// gradient continuous; what is pulled too far slips through the hand's force, not through space.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "model/tool.h"

namespace mvs::core {

struct Hold {
  uint32_t node;
  Vec3 target;
  double stiffness;  // N/m
  double force;      // N, at most
};

// The spring that leads point k of a tool, or the node of a grasp, with the node it leads.
Hold hold_of(const Tool &tool, uint32_t k, uint32_t node);

// The force of a hold on what is at x, N.
Vec3 pull(const Hold &hold, const Vec3 &x);

// The second derivative of its energy there; positive semidefinite.
Mat3 hold_block(const Hold &hold, const Vec3 &x);

class GraspTerm {
 public:
  // Points of instruments are nodes from `first` on, in the order of the tools.
  void set_tools(const std::vector<Tool> &tools, uint32_t first);

  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  void hessian(const std::vector<Vec3> &x, HessianAssembler &system) const;

 private:
  std::vector<Hold> holds_;
};

}  // namespace mvs::core
