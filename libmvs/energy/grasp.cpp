// Force, energy and Hessian of the springs of hands.
#include "energy/grasp.h"

#include "energy/term.h"

namespace mvs::core {

ToolSpring tool_spring(const Tool &tool, uint32_t k, uint32_t node) {
  const double share = tool.points() > 1 ? 1.0 / tool.points() : 1;
  return {node, tool.target(k), share * tool.stiffness, share * tool.max_force};
}

Vec3 pull(const ToolSpring &spring, const Vec3 &x) {
  const Vec3 d = spring.target - x;
  const double length = d.norm();
  if (spring.stiffness * length <= spring.force) return spring.stiffness * d;
  return spring.force / length * d;
}

Mat3 spring_block(const ToolSpring &spring, const Vec3 &x) {
  const Vec3 d = x - spring.target;
  const double length = d.norm();
  if (spring.stiffness * length <= spring.force) return spring.stiffness * Mat3::Identity();
  return axial_block(d / length, 0, spring.force / length, Curvature::exact);
}

void GraspTerm::set_tools(const std::vector<Tool> &tools, uint32_t first) {
  springs_.clear();
  for (const Tool &tool : tools) {
    if (tool.kind == ToolKind::grasp) springs_.push_back(tool_spring(tool, 0, tool.node));
    for (uint32_t k = 0; k < tool.points(); ++k) springs_.push_back(tool_spring(tool, k, first++));
  }
}

double GraspTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const ToolSpring &h : springs_) {
    const double d = (x[h.node] - h.target).norm(), bound = h.force / h.stiffness;
    sum += d <= bound ? 0.5 * h.stiffness * d * d : h.force * (d - 0.5 * bound);
  }
  return sum;
}

double GraspTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  for (const ToolSpring &h : springs_) g[h.node] -= pull(h, x[h.node]);
  return energy(x);
}

void GraspTerm::hessian(const std::vector<Vec3> &x, HessianAssembler &assembler) const {
  for (const ToolSpring &h : springs_) assembler.add_diagonal(h.node, spring_block(h, x[h.node]));
}

}  // namespace mvs::core
