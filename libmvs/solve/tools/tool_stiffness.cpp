// The stiffness of a tool, from the factorised system.
#include "solve/tools/tool_stiffness.h"

#include <mvs/tool.h>

#include <Eigen/Geometry>
#include <limits>

#include "base/error.h"
#include "linalg/eigenvalues.h"

namespace mvs::core {
namespace {

// What the slack part of a sheet lacks in stiffness its mass gives, over a time in which a hand can
// be said to stand still.
constexpr double quasi_static = 0.1;  // s

// An elimination order serves for patterns that differ little; one that was indefinite stays so for
// a while.
constexpr uint32_t patterns_per_order = 20, wait_after_failure = 8;

uint32_t springs_of(const Tool &tool) {
  return tool.kind == MVS_TOOL_KIND_ROD ? 2 : 1;
}

// The nodes that the hand leads, in a state with nodes for points.
uint32_t led_node(const State &state, size_t nodes, const Tool &tool, uint32_t k) {
  if (tool.kind == MVS_TOOL_KIND_GRASP) return tool.node;
  auto node = static_cast<uint32_t>(nodes);
  for (const Tool &other : state.tools.get()) {
    if (other.id == tool.id) break;
    node += other.points();
  }
  return node + k;
}

}  // namespace

ToolForce force_of(const State &state, const Tool &tool) {
  ToolForce sum;
  for (uint32_t k = 0; k < springs_of(tool); ++k) {
    const Vec3 at = tool.kind == MVS_TOOL_KIND_GRASP ? state.x[tool.node] : tool.proxy[k];
    const Vec3 back = -pull(hold_of(tool, k, 0), at);
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
    total_energy_->prepare(state.x, state.x, 0.1 * model_->valve.contact_thickness, profile_);
  }
  total_energy_->gradient(state.x, g_, profile_);
  for (const Curvature curvature : {Curvature::exact, Curvature::projected}) {
    if (curvature == Curvature::exact && exact_fails_ > 0) {
      --exact_fails_;
      continue;
    }
    if (total_energy_->hessian(state.x, curvature, system_, profile_)) {
      system_.keep_order(++patterns_ % patterns_per_order != 0);
      factor_->analyse(system_.matrix);
    }
    if (try_factorise(1)) return;
    if (curvature == Curvature::exact) exact_fails_ = wait_after_failure;
  }
  double more = 1;
  while (more < 1e18) {
    more *= 4;
    total_energy_->hessian(state.x, Curvature::projected, system_, profile_);
    if (try_factorise(more)) return;
  }
  fail(MVS_E_DIVERGED, "tool", "the stiffness of the valve is not finite; check the materials");
}

bool ToolFeel::try_factorise(double more_mass) {
  for (uint32_t r = 0; r < system_.matrix.size(); ++r) {
    const double m = model_->node_mass[system_.node_of[r]];
    system_.matrix.value[system_.matrix.start[r]].diagonal().array() +=
        more_mass * m / (quasi_static * quasi_static);
  }
  return factor_->factorise(system_.matrix);
}

Mat3 ToolFeel::stiffness(const Model &valve, const State &valve_state, const Tool &tool) {
  const size_t nodes = valve_state.x.size();
  take_model(points_.extend(valve, tool_points(valve_state.tools)));
  const State state = ToolPoints::extended(valve_state);
  factorise(state);
  std::array<uint32_t, 2> row;
  std::array<Mat3, 2> block;
  Mat3 sum = Mat3::Zero();
  const uint32_t springs = springs_of(tool);
  for (uint32_t k = 0; k < springs; ++k) {
    const uint32_t node = led_node(valve_state, nodes, tool, k);
    row[k] = system_.row_of[node];
    block[k] = hold_block(hold_of(tool, k, node), state.x[node]);
    sum += block[k];
  }
  for (int c = 0; c < 3; ++c) {
    rows_.assign(system_.matrix.size(), Vec3::Zero());
    for (uint32_t k = 0; k < springs; ++k) rows_[row[k]] = block[k].col(c);
    factor_->solve(rows_);
    for (uint32_t k = 0; k < springs; ++k) sum.col(c) -= block[k] * rows_[row[k]];
  }
  const Mat3 symmetric = 0.5 * (sum + sum.transpose());
  return with_eigenvalues_in(symmetric, 0, std::numeric_limits<double>::infinity());
}

}  // namespace mvs::core
