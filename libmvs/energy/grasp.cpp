// Force, energy and Hessian of the springs of hands.
#include "energy/grasp.h"

#include "energy/term.h"

namespace mvs::core {

Hold hold_of(const Tool &tool, uint32_t k, uint32_t node) {
  const double share = tool.points() > 1 ? 1.0 / tool.points() : 1;
  return {node, tool.target(k), share * tool.stiffness, share * tool.max_force};
}

Vec3 pull(const Hold &hold, const Vec3 &x) {
  const Vec3 d = hold.target - x;
  const double length = d.norm();
  if (hold.stiffness * length <= hold.force) return hold.stiffness * d;
  return hold.force / length * d;
}

Mat3 hold_block(const Hold &hold, const Vec3 &x) {
  const Vec3 d = x - hold.target;
  const double length = d.norm();
  if (hold.stiffness * length <= hold.force) return hold.stiffness * Mat3::Identity();
  return axial_block(d / length, 0, hold.force / length, Curvature::exact);
}

void GraspTerm::set_tools(const std::vector<Tool> &tools, uint32_t first) {
  holds_.clear();
  for (const Tool &tool : tools) {
    if (tool.kind == ToolKind::grasp) holds_.push_back(hold_of(tool, 0, tool.node));
    for (uint32_t k = 0; k < tool.points(); ++k) holds_.push_back(hold_of(tool, k, first++));
  }
}

double GraspTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const Hold &h : holds_) {
    const double d = (x[h.node] - h.target).norm(), bound = h.force / h.stiffness;
    sum += d <= bound ? 0.5 * h.stiffness * d * d : h.force * (d - 0.5 * bound);
  }
  return sum;
}

double GraspTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  for (const Hold &h : holds_) g[h.node] -= pull(h, x[h.node]);
  return energy(x);
}

void GraspTerm::hessian(const std::vector<Vec3> &x, HessianAssembler &system) const {
  for (const Hold &h : holds_) system.add_diagonal(h.node, hold_block(h, x[h.node]));
}

}  // namespace mvs::core
