// Extends a model by nodes for the points of instruments, so that every solver moves them like any
// other node.
#pragma once

#include "model/model.h"

namespace mvs::core {

// The number of points of all tools; a grasp has 0.
uint32_t tool_points(const std::vector<Tool> &tools);

// Keeps the extended model of the last call.
class ToolPoints {
 public:
  // Returns the model with `points` more nodes, which are free and belong to no triangle.
  const Model &extend(const Model &model, uint32_t points);
  // Returns the state with a position and a velocity of zero for each point.
  static State extended(const State &state);
  // Writes the nodes of the valve back to `state` and the points to their tools.
  static void take_back(State extended, State &state);

 private:
  Model model_;
  uint64_t serial_ = 0;
};

}  // namespace mvs::core
