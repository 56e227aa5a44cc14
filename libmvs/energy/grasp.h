// Springs between hands and nodes: held nodes, and the points of instruments.
//
// A spring of stiffness k whose force is at most F has E = k d^2 / 2 up to d0 = F / k, and
// F d - F d0 / 2 beyond, d the distance of the node from its target (the Huber function). E is
// convex and its gradient continuous. A node whose target is too far away stays behind; it does not
// jump.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "model/tool.h"

namespace mvs::core {

struct ToolSpring {
  uint32_t node;
  Vec3 target;
  double stiffness;  // N/m
  double force;      // N, the largest
};

// The spring of point k of a tool, or of a grasp (k = 0), on a node.
ToolSpring tool_spring(const Tool &tool, uint32_t k, uint32_t node);

// The force of a spring on its node at x, N.
Vec3 pull(const ToolSpring &spring, const Vec3 &x);

// The second derivative of its energy at x; positive semidefinite.
Mat3 spring_block(const ToolSpring &spring, const Vec3 &x);

class GraspTerm {
 public:
  // Points of instruments are nodes from `first` on, in the order of the tools.
  void set_tools(const std::vector<Tool> &tools, uint32_t first);

  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  void hessian(const std::vector<Vec3> &x, HessianAssembler &assembler) const;

 private:
  std::vector<ToolSpring> springs_;
};

}  // namespace mvs::core
