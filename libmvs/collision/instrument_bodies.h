// Broad phase of instruments: the vertices, edges and triangles of the sheet near each ball or rod
// during a step, and the pairs that the step limiter keeps apart.
//
// The points of an instrument (the centre of a ball, the centres of both ends of a rod, the frame
// of a convex tool) are nodes like those of the sheet. convex_bodies.h has the part of convex
// tools.
#pragma once

#include <limits>
#include <vector>

#include "collision/convex_bodies.h"
#include "model/model.h"

namespace mvs::core {

// Nodes before `split` and the others that must stay more than `radius` apart. `separation` joins
// the closest points, towards the nodes before `split`. Nodes of one body are limited together, by
// the share of the node in `with`.
struct ToolPair {
  std::array<uint32_t, 4> node, with;
  uint32_t split;
  Vec3 separation;
  double radius;
};

// A ball or rod with the parts of the sheet near it.
struct InstrumentBody {
  Tool tool;   // at its first step: its size
  Edge point;  // nodes; the same twice for a ball
  std::vector<uint32_t> vertices, edges, triangles;
  bool is_rod() const { return point[0] != point[1]; }
};

class InstrumentBodies {
 public:
  explicit InstrumentBodies(const Model &model) : model_(&model), convex_(model) {}

  // Points are nodes from `first` on. Without tools that push, all functions below have no effect.
  void set_tools(const std::vector<Tool> &tools, uint32_t first);
  const std::vector<InstrumentBody> &all() const { return bodies_; }
  // Points of instruments are the nodes from this one on.
  uint32_t first_point() const { return first_; }
  ConvexBodies &convex() { return convex_; }
  const ConvexBodies &convex() const { return convex_; }
  bool empty() const { return bodies_.empty() && convex_.all().empty(); }

  // Finds the parts of the sheet near each instrument while every node stays within `slack` of its
  // segment from x to `to`.
  void prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack);
  // Returns whether that was done for the present tools.
  bool is_prepared() const { return prepared_; }

  // Returns all pairs near an instrument, for StepLimiter.
  const std::vector<ToolPair> &barrier_pairs(const std::vector<Vec3> &x);
  // Shortens the steps of all points of a rod or convex tool by the same factor, so that none is
  // longer than `longest`.
  void shorten(std::vector<Vec3> &step, double longest) const;

 private:
  void find_near(InstrumentBody &body, const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                 double slack);

  const Model *model_;
  uint32_t first_ = std::numeric_limits<uint32_t>::max();
  std::vector<InstrumentBody> bodies_;
  ConvexBodies convex_;
  bool prepared_ = true;
  std::vector<ToolPair> pairs_;
  std::vector<uint8_t> outside_;  // of each node: sides of the box at hand, see sides_outside()
};

}  // namespace mvs::core
