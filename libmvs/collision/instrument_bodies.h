// The broad phase of instruments: which parts of the sheet are near each ball or rod.
//
// Points of instruments (the middle of a ball, of both ends of a rod) are nodes like any other.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// What must stay more than `radius` apart: nodes before `split`, and the others; `apart` joins the
// closest points, towards the first. Nodes of one body give way together, by the share of the node
// in `with`.
struct ToolPair {
  std::array<uint32_t, 4> node, with;
  uint32_t split;
  Vec3 apart;
  double radius;
};

// A ball or rod and what is near it.
struct InstrumentBody {
  Tool tool;                                         // as it was when it came: its size
  Edge point;                                        // nodes; the same twice for a ball
  std::vector<uint32_t> vertices, edges, triangles;  // near it
  bool is_rod() const { return point[0] != point[1]; }
};

class InstrumentBodies {
 public:
  explicit InstrumentBodies(const Model &model) : model_(&model) {}

  // Points are nodes from `first` on. Without tools that push, nothing below does anything.
  void set_tools(const std::vector<Tool> &tools, uint32_t first);
  const std::vector<InstrumentBody> &all() const { return bodies_; }

  // Looks for the sheet near each instrument, while every node stays within `slack` of its way.
  void prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack);
  // Whether that was done for the present tools.
  bool is_prepared() const { return prepared_; }

  // Everything near that must not be crossed, for StepBounds.
  const std::vector<ToolPair> &pairs_to_part(const std::vector<Vec3> &x);
  // Shortens the steps of both ends of a rod alike, until neither is longer than that.
  void shorten(std::vector<Vec3> &step, double longest) const;

 private:
  void look_around(InstrumentBody &body, const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                   double slack);

  const Model *model_;
  std::vector<InstrumentBody> bodies_;
  bool prepared_ = true;
  std::vector<ToolPair> pairs_;
  std::vector<uint8_t> beyond_;  // of each node, while one looks around
};

}  // namespace mvs::core
