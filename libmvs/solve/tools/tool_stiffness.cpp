// Stiffness of a tool as a Schur complement of the factorised Hessian.
#include "solve/tools/tool_stiffness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "base/error.h"
#include "linalg/eigenvalues.h"
#include "solve/step_settings.h"

namespace mvs::core {
namespace {

// The number of springs between a hand and its tool.
uint32_t springs_of(const Tool &tool) {
  return std::max(1u, tool.points());
}

// The node of spring k of a tool, in a state that has nodes for the points of tools.
uint32_t spring_node(const State &state, size_t nodes, const Tool &tool, uint32_t k) {
  if (tool.kind == ToolKind::grasp) return tool.node;
  auto node = static_cast<uint32_t>(nodes);
  for (const Tool &other : state.tools.get()) {
    if (other.id == tool.id) break;
    node += other.points();
  }
  return node + k;
}

}  // namespace

bool has_torque(const Tool &tool) {
  return springs_of(tool) > 1;
}

ToolForce force_of(const State &state, const Tool &tool) {
  ToolForce sum;
  for (uint32_t k = 0; k < springs_of(tool); ++k) {
    const Vec3 at = tool.kind == ToolKind::grasp ? state.x[tool.node] : tool.proxy[k];
    const Vec3 back = -pull(tool_spring(tool, k, 0), at);
    sum.force += back;
    sum.torque += (tool.target(k) - tool.position).cross(back);
  }
  return sum;
}

void ToolFeel::take_model(const Model &model) {
  model_ = &model;
  if (total_energy_ && serial_ == model.serial) return;
  serial_ = model.serial;
  total_energy_.emplace(model);
  system_ = {};
  if (!factor_) factor_ = make_direct_solver(backend_);
}

void ToolFeel::factorise(const State &state) {
  total_energy_->set_pressure(state.load.pressure);
  total_energy_->set_tools(state.tools);
  if (!total_energy_->prepared_for(state.x)) {
    const double slack = settings::implicit::broad_phase_slack * model_->valve.contact_thickness;
    total_energy_->prepare(state.x, state.x, slack, profile_);
  }
  total_energy_->gradient(state.x, g_, profile_);
  for (const Curvature curvature : {Curvature::exact, Curvature::projected}) {
    if (curvature == Curvature::exact && exact_pause_ > 0) {
      --exact_pause_;
      continue;
    }
    if (total_energy_->hessian(state.x, curvature, system_, profile_)) {
      system_.keep_order(++patterns_ % settings::tools::patterns_per_order != 0);
      factor_->analyse(system_.matrix);
    }
    if (try_factorise(1)) return;
    if (curvature == Curvature::exact) exact_pause_ = settings::tools::pause_after_indefinite;
  }
  double more = 1;
  while (more < settings::tools::max_mass) {
    more *= settings::tools::mass_growth;
    total_energy_->hessian(state.x, Curvature::projected, system_, profile_);
    if (try_factorise(more)) return;
  }
  fail(MVS_E_DIVERGED, "tool", "the stiffness of the valve is not finite; check the materials");
}

bool ToolFeel::try_factorise(double more_mass) {
  for (uint32_t r = 0; r < system_.matrix.size(); ++r) {
    const double m = model_->node_mass[system_.node_of[r]];
    system_.matrix.value[system_.matrix.start[r]].diagonal().array() +=
        more_mass * m / (settings::tools::quasi_static_time * settings::tools::quasi_static_time);
  }
  return factor_->factorise(system_.matrix);
}

ToolFeel::Springs ToolFeel::springs_at(const Model &valve, const State &valve_state,
                                       const Tool &tool) {
  const size_t nodes = valve_state.x.size();
  take_model(points_.extend(valve, tool_points(valve_state.tools)));
  const State state = ToolPoints::extended(valve_state);
  factorise(state);
  Springs out;
  out.count = springs_of(tool);
  for (uint32_t k = 0; k < out.count; ++k) {
    const uint32_t node = spring_node(valve_state, nodes, tool, k);
    const ToolSpring spring = tool_spring(tool, k, node);
    out.row[k] = system_.row_of[node];
    out.block[k] = spring_block(spring, state.x[node]);
    out.arm[k] = tool.target(k) - tool.position;
    out.force[k] = -pull(spring, state.x[node]);
  }
  return out;
}

// The forces against springs whose ends at the hand moved, while the valve follows.
void ToolFeel::follow(const Springs &springs, const SpringVectors &moved, SpringVectors &answer) {
  rows_.assign(system_.matrix.size(), Vec3::Zero());
  for (uint32_t k = 0; k < springs.count; ++k) {
    answer[k] = springs.block[k] * moved[k];
    rows_[springs.row[k]] = answer[k];
  }
  factor_->solve(rows_);
  for (uint32_t k = 0; k < springs.count; ++k)
    answer[k] -= springs.block[k] * rows_[springs.row[k]];
}

Mat3 ToolFeel::stiffness(const Model &valve, const State &valve_state, const Tool &tool) {
  const Springs springs = springs_at(valve, valve_state, tool);
  SpringVectors moved, answer;
  Mat3 sum = Mat3::Zero();
  for (int c = 0; c < 3; ++c) {
    moved.fill(Vec3::Unit(c));
    follow(springs, moved, answer);
    for (uint32_t k = 0; k < springs.count; ++k) sum.col(c) += answer[k];
  }
  const Mat3 symmetric = 0.5 * (sum + sum.transpose());
  return with_eigenvalues_in(symmetric, 0, std::numeric_limits<double>::infinity());
}

ToolStiffness ToolFeel::wrench_stiffness(const Model &valve, const State &valve_state,
                                         const Tool &tool) {
  const Springs springs = springs_at(valve, valve_state, tool);
  SpringVectors moved, answer;
  Mat3 linear = Mat3::Zero(), coupling = Mat3::Zero(), angular = Mat3::Zero();
  for (int c = 0; c < 6; ++c) {
    const Vec3 unit = Vec3::Unit(c % 3);
    for (uint32_t k = 0; k < springs.count; ++k)
      moved[k] = c < 3 ? unit : Vec3(unit.cross(springs.arm[k]));
    follow(springs, moved, answer);
    for (uint32_t k = 0; k < springs.count; ++k) {
      (c < 3 ? linear : coupling).col(c % 3) += answer[k];
      if (c >= 3) angular.col(c % 3) += springs.arm[k].cross(answer[k]);
    }
  }
  for (uint32_t k = 0; k < springs.count; ++k) {
    const Vec3 &arm = springs.arm[k], &force = springs.force[k];
    angular += force.dot(arm) * Mat3::Identity() - arm * force.transpose();
  }
  ToolStiffness out;
  out.linear = 0.5 * (linear + linear.transpose());
  out.coupling = coupling;
  out.angular = 0.5 * (angular + angular.transpose());
  return out;
}

}  // namespace mvs::core
