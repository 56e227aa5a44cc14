// Adds nodes for the points of instruments to a model and a state, and removes them again.
#include "solve/tools/tool_points.h"

#include "solve/step_settings.h"

namespace mvs::core {
namespace {

void add_row(Rows &rows) {
  rows.start.push_back(rows.start.get().back());
}

void add_node(Model &model) {
  Valve &valve = model.valve;
  for (CowVector<Vec3> *places : {&valve.rest, &valve.open, &valve.loaded}) {
    places->push_back(Vec3::Zero());
  }
  valve.origin.push_back(none);
  model.vertex_area.push_back(0);
  model.node_mass.push_back(settings::tools::point_mass);
  model.topology.node_kind.push_back(NodeKind::branch);
  model.topology.fixed.push_back(0);
  add_row(model.topology.node_triangles);
  add_row(model.topology.node_chords);
}

}  // namespace

uint32_t tool_points(const std::vector<Tool> &tools) {
  uint32_t points = 0;
  for (const Tool &tool : tools) points += tool.points();
  return points;
}

const Model &ToolPoints::extend(const Model &model, uint32_t points) {
  if (points == 0) return model;
  // serials are below 2^48 and points at most 256; a model without a serial has 0
  const uint64_t serial = model.serial | uint64_t{points} << 48;
  if (model.serial != 0 && serial == serial_) return model_;
  serial_ = 0;  // until the model is complete
  model_ = model;
  for (uint32_t k = 0; k < points; ++k) add_node(model_);
  model_.serial = serial_ = serial;
  return model_;
}

State ToolPoints::extended(const State &state) {
  State more = state;
  for (const Tool &tool : state.tools.get()) {
    for (uint32_t k = 0; k < tool.points(); ++k) {
      more.x.push_back(tool.proxy[k]);
      more.v.push_back(Vec3::Zero());
    }
  }
  return more;
}

void ToolPoints::take_back(State extended, State &state) {
  const size_t nodes = state.x.size();
  size_t node = nodes;
  for (Tool &tool : extended.tools) {
    for (uint32_t k = 0; k < tool.points(); ++k) tool.proxy[k] = extended.x.get()[node++];
  }
  extended.x.resize(nodes);
  extended.v.resize(nodes);
  state = std::move(extended);
}

}  // namespace mvs::core
