// A valve whose last nodes are the points of its instruments, so that every solver moves them as it
// moves any node.
#pragma once

#include "model/model.h"

namespace mvs::core {

// The number of points of all tools; a grasp has 0.
uint32_t tool_points(const std::vector<Tool> &tools);

// Kept between calls for one model and number of points.
class ToolPoints {
 public:
  // The model with so many more nodes, free, in no triangle.
  const Model &extend(const Model &model, uint32_t points);
  // The state with a position for each point.
  static State extended(const State &state);
  // Back to the nodes of the valve, the points into their tools.
  static void take_back(State extended, State &state);

 private:
  Model model_;
  uint64_t serial_ = 0;
};

}  // namespace mvs::core
