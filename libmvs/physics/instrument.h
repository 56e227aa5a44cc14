// Instruments that push: balls, and rods with round ends, against the sheet.
//
// Their points (the middle of a ball, of both ends of a rod) are nodes like any other: led by the
// hand's springs (physics/grasp.h), pushed by the sheet, cut by the step bounds. So what pushes is
// a proxy, in the sense of Zilles & Salisbury's god-object (IROS 1995), that never passes through.
//
// The sheet feels an instrument through its vertices, E_v = kappa A_v r B((d - R) / r), d from the
// vertex to the middle or the axis, R the radius, r half of the contact thickness: a pressure at a
// distance, at any mesh size. Between vertices a guard keeps every triangle and edge out: the same
// barrier over a short range for each end and triangle, and for each axis and edge. All of these
// distances above R means that nothing crosses. An axial spring keeps a rod's length.
#pragma once

#include <vector>

#include "model/model.h"
#include "physics/stencil.h"

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

class InstrumentTerm {
 public:
  explicit InstrumentTerm(const Model &model) : model_(&model) {}

  // Points are nodes from `first` on. Without tools that push, nothing below does anything.
  void set_tools(const std::vector<Tool> &tools, uint32_t first);
  bool empty() const { return bodies_.empty(); }

  // Looks for the sheet near each instrument, while every node stays within `slack` of its way.
  void prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack);
  // Whether that was done for the present tools.
  bool is_prepared() const { return prepared_; }
  // Whether any sheet was near enough to matter.
  bool is_near() const;

  void collect(const std::vector<Vec3> &x);
  const std::vector<ContactStencil> &stencils() const { return stencils_; }

  // These speak of the last collect().
  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  bool hessian(const std::vector<Vec3> &x, Curvature curvature, System &system) const;
  void add_pairs(std::vector<Edge> &pairs) const;

  // Everything near that must not be crossed, for StepBounds.
  const std::vector<ToolPair> &pairs_to_part(const std::vector<Vec3> &x);
  // Shortens the steps of both ends of a rod alike, until neither is longer than that.
  void shorten(std::vector<Vec3> &step, double longest) const;

 private:
  struct Body {
    Tool tool;                                         // as it was when it came: its size
    Edge point;                                        // nodes; the same twice for a ball
    std::vector<uint32_t> vertices, edges, triangles;  // near it
    bool is_rod() const { return point[0] != point[1]; }
  };
  void look_around(Body &body, const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                   double slack);
  void take_vertex(const std::vector<Vec3> &x, const Body &body, uint32_t v);
  void take_triangle(const std::vector<Vec3> &x, const Body &body, uint32_t t);
  void take_edge(const std::vector<Vec3> &x, const Body &body, uint32_t e);
  void finish(const std::vector<Vec3> &x, const Body &body, ContactStencil s, double range,
              double area, bool guard);

  const Model *model_;
  std::vector<Body> bodies_;
  bool prepared_ = true;
  std::vector<ContactStencil> stencils_;
  std::vector<ToolPair> pairs_;
  std::vector<uint8_t> beyond_;  // of each node, while one looks around
};

}  // namespace mvs::core
