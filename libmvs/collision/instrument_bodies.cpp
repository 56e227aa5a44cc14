// Boxes around the motions of instruments.
#include "collision/instrument_bodies.h"

#include <algorithm>

#include "collision/near_parts.h"
#include "geometry/aabb.h"
#include "geometry/distance.h"

namespace mvs::core {
namespace {

Aabb box_around(const Vec3 &from, const Vec3 &to, double margin) {
  Aabb box;
  box.add(from);
  box.add(to);
  box.low.array() -= margin;
  box.high.array() += margin;
  return box;
}

}  // namespace

void InstrumentBodies::set_tools(const std::vector<Tool> &tools, uint32_t first) {
  first_ = first;
  if (convex_.set_tools(tools, first)) prepared_ = false;
  size_t k = 0;
  for (const Tool &tool : tools) {
    if (tool.points() == 0) continue;
    if (tool.kind == ToolKind::convex) {
      first += tool.points();
      continue;
    }
    const bool is_known = k < bodies_.size() && bodies_[k].tool.is_same_as(tool);
    if (!is_known) {
      bodies_.resize(k);
      bodies_.push_back({tool, {}, {}, {}, {}});
      prepared_ = false;
    }
    bodies_[k].point = {first, first + tool.points() - 1};
    first += tool.points();
    ++k;
  }
  bodies_.resize(k);
}

void InstrumentBodies::prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                               double slack) {
  for (InstrumentBody &body : bodies_) find_near(body, x, to, slack);
  convex_.prepare(x, to, slack);
  prepared_ = true;
}

// A triangle is far from an instrument if all its corners, at both ends of the step, are outside of
// the same side of the box around the instrument's motion.
void InstrumentBodies::find_near(InstrumentBody &body, const std::vector<Vec3> &x,
                                 const std::vector<Vec3> &to, double slack) {
  const double margin = body.tool.radius + tool_range(*model_) + 2 * slack;
  Aabb box = box_around(x[body.point[0]], to[body.point[0]], margin);
  box.add(box_around(x[body.point[1]], to[body.point[1]], margin));
  outside_.resize(x.size());
  for (size_t i = 0; i < x.size(); ++i)
    outside_[i] = sides_outside(box, x[i]) & sides_outside(box, to[i]);
  body.vertices.clear();
  body.edges.clear();
  body.triangles.clear();
  const auto &triangles = model_->valve.triangles.get();
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    if ((outside_[i] & outside_[j] & outside_[k]) != 0) continue;
    body.triangles.push_back(t);
    for (const uint32_t v : triangles[t]) body.vertices.push_back(v);
    for (const uint32_t e : model_->topology.triangle_edges[t]) body.edges.push_back(e);
  }
  sort_unique(body.vertices);
  sort_unique(body.edges);
}

const std::vector<ToolPair> &InstrumentBodies::barrier_pairs(const std::vector<Vec3> &x) {
  pairs_.clear();
  for (const InstrumentBody &body : bodies_) {
    const auto &[p, q] = body.point;
    for (const uint32_t t : body.triangles) {
      const auto [i, j, k] = model_->valve.triangles[t];
      for (uint32_t end = 0; end < (body.is_rod() ? 2u : 1u); ++end) {
        const uint32_t v = body.point[end];
        const auto w = closest_on_triangle(x[v], x[i], x[j], x[k]).weight;
        const Vec3 separation = x[v] - (w[0] * x[i] + w[1] * x[j] + w[2] * x[k]);
        pairs_.push_back({{v, i, j, k}, {p, i, j, k}, 1, separation, body.tool.radius});
      }
    }
    if (!body.is_rod()) continue;
    for (const uint32_t e : body.edges) {
      const auto [i, j] = model_->topology.edges[e];
      const SegmentPair s = closest_of_segments(x[p], x[q], x[i], x[j]);
      const Vec3 separation = x[p] + s.s * (x[q] - x[p]) - x[i] - s.t * (x[j] - x[i]);
      pairs_.push_back({{p, q, i, j}, {p, p, i, j}, 2, separation, body.tool.radius});
    }
  }
  return pairs_;
}

void InstrumentBodies::shorten(std::vector<Vec3> &step, double longest) const {
  for (const InstrumentBody &body : bodies_) {
    const double length = std::max(step[body.point[0]].norm(), step[body.point[1]].norm());
    if (!body.is_rod() || length <= longest) continue;
    for (const uint32_t p : body.point) step[p] *= longest / length;
  }
  convex_.shorten(step, longest);
}

}  // namespace mvs::core
