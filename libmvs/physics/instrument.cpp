// Balls and rods: what is near, what touches, what it does.
#include "physics/instrument.h"

#include <algorithm>
#include <cmath>

#include "base/box_tree.h"
#include "physics/contact.h"

namespace mvs::core {
namespace {

// A rod gives in length by a quarter of a millimetre where its ends are pushed together with 5 N.
constexpr double axial_stiffness = 2e4;  // N/m

Box around(const Vec3 &from, const Vec3 &to, double margin) {
  Box box;
  box.add(from);
  box.add(to);
  box.low.array() -= margin;
  box.high.array() += margin;
  return box;
}

// The sides of a box that a place is beyond, one bit each.
uint8_t sides(const Box &box, const Vec3 &place) {
  uint32_t bits = 0;
  for (int k = 0; k < 3; ++k) {
    bits |= static_cast<uint32_t>(place[k] < box.low[k]) << (2 * k);
    bits |= static_cast<uint32_t>(place[k] > box.high[k]) << (2 * k + 1);
  }
  return static_cast<uint8_t>(bits);
}

void make_unique(std::vector<uint32_t> &numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

void InstrumentTerm::set_tools(const std::vector<Tool> &tools, uint32_t first) {
  size_t k = 0;
  for (const Tool &tool : tools) {
    if (tool.points() == 0) continue;
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

bool InstrumentTerm::is_near() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const Body &body) { return !body.triangles.empty(); });
}

void InstrumentTerm::prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                             double slack) {
  for (Body &body : bodies_) look_around(body, x, to, slack);
  prepared_ = true;
}

// By boxes around the ways of the triangles' corners and of the instrument: apart where all corners
// are, at both ends, beyond the same side.
void InstrumentTerm::look_around(Body &body, const std::vector<Vec3> &x,
                                 const std::vector<Vec3> &to, double slack) {
  const double margin = body.tool.radius + tool_range(*model_) + 2 * slack;
  Box box = around(x[body.point[0]], to[body.point[0]], margin);
  box.add(around(x[body.point[1]], to[body.point[1]], margin));
  beyond_.resize(x.size());
  for (size_t i = 0; i < x.size(); ++i) beyond_[i] = sides(box, x[i]) & sides(box, to[i]);
  body.vertices.clear();
  body.edges.clear();
  body.triangles.clear();
  const auto &triangles = model_->valve.triangles.get();
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    if ((beyond_[i] & beyond_[j] & beyond_[k]) != 0) continue;
    body.triangles.push_back(t);
    for (const uint32_t v : triangles[t]) body.vertices.push_back(v);
    for (const uint32_t e : model_->topology.triangle_edges[t]) body.edges.push_back(e);
  }
  make_unique(body.vertices);
  make_unique(body.edges);
}

void InstrumentTerm::collect(const std::vector<Vec3> &x) {
  stencils_.clear();
  for (const Body &body : bodies_) {
    for (const uint32_t v : body.vertices) take_vertex(x, body, v);
    for (const uint32_t t : body.triangles) take_triangle(x, body, t);
    if (!body.is_rod()) continue;
    for (const uint32_t e : body.edges) take_edge(x, body, e);
  }
}

void InstrumentTerm::take_vertex(const std::vector<Vec3> &x, const Body &body, uint32_t v) {
  const auto &[a, b] = body.point;
  const double s = closest_on_segment(x[v], x[a], x[b]).s;
  const ContactStencil stencil =
      s > 0 && s < 1 ? point_edge(v, a, b, s) : point_point(v, s > 0 ? b : a);
  finish(x, body, stencil, tool_range(*model_), model_->vertex_area[v], false);
}

void InstrumentTerm::take_triangle(const std::vector<Vec3> &x, const Body &body, uint32_t t) {
  const Tri &tri = model_->valve.triangles[t];
  for (uint32_t k = 0; k < (body.is_rod() ? 2u : 1u); ++k) {
    const uint32_t v = body.point[k];
    const TrianglePoint p = closest_on_triangle(x[v], x[tri[0]], x[tri[1]], x[tri[2]]);
    finish(x, body, vertex_triangle(v, tri, p), guard_share * model_->valve.contact_thickness,
           model_->rest_area[t] / 3, true);
  }
}

void InstrumentTerm::take_edge(const std::vector<Vec3> &x, const Body &body, uint32_t e) {
  const Edge &edge = model_->topology.edges[e], &rod = body.point;
  const SegmentPair p = closest_of_segments(x[rod[0]], x[rod[1]], x[edge[0]], x[edge[1]]);
  double area = 0;
  for (const uint32_t t : model_->topology.edge_triangles[e]) {
    if (t != none) area += model_->rest_area[t] / 3;
  }
  finish(x, body, edge_edge(rod, edge, p), guard_share * model_->valve.contact_thickness, area,
         true);
}

void InstrumentTerm::finish(const std::vector<Vec3> &x, const Body &body, ContactStencil s,
                            double range, double area, bool guard) {
  s.range = range;
  s.strength = (guard ? 0.5 : 1) * model_->valve.contact_stiffness * area;
  s.guard = guard;
  s.radius = body.tool.radius;
  if (measure(x, s)) stencils_.push_back(s);
}

double InstrumentTerm::energy(const std::vector<Vec3> &x) const {
  double sum = energy_of(stencils_, barrier);
  for (const Body &body : bodies_) {
    if (!body.is_rod()) continue;
    const double longer = (x[body.point[1]] - x[body.point[0]]).norm() - body.tool.length;
    sum += 0.5 * axial_stiffness * longer * longer;
  }
  return sum;
}

double InstrumentTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  add_gradient(stencils_, barrier, g);
  for (const Body &body : bodies_) {
    if (!body.is_rod()) continue;
    const Vec3 d = x[body.point[1]] - x[body.point[0]];
    const Vec3 f = axial_stiffness * (1 - body.tool.length / d.norm()) * d;
    g[body.point[0]] -= f;
    g[body.point[1]] += f;
  }
  return energy(x);
}

bool InstrumentTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                             System &system) const {
  bool complete = add_hessian(stencils_, barrier, x, curvature, system);
  for (const Body &body : bodies_) {
    if (!body.is_rod()) continue;
    const auto &[a, b] = body.point;
    const Vec3 d = x[b] - x[a];
    const double length = d.norm();
    const Mat3 block = axial_block(d / length, axial_stiffness,
                                   axial_stiffness * (1 - body.tool.length / length), curvature);
    system.add_diagonal(a, block);
    system.add_diagonal(b, block);
    complete = system.add(a, b, -block) && complete;
  }
  return complete;
}

void InstrumentTerm::add_pairs(std::vector<Edge> &pairs) const {
  mvs::core::add_pairs(stencils_, pairs);
  for (const Body &body : bodies_) {
    if (body.is_rod()) pairs.push_back(body.point);
  }
}

const std::vector<ToolPair> &InstrumentTerm::pairs_to_part(const std::vector<Vec3> &x) {
  pairs_.clear();
  for (const Body &body : bodies_) {
    const auto &[p, q] = body.point;
    for (const uint32_t t : body.triangles) {
      const auto [i, j, k] = model_->valve.triangles[t];
      for (uint32_t end = 0; end < (body.is_rod() ? 2u : 1u); ++end) {
        const uint32_t v = body.point[end];
        const auto w = closest_on_triangle(x[v], x[i], x[j], x[k]).weight;
        const Vec3 apart = x[v] - (w[0] * x[i] + w[1] * x[j] + w[2] * x[k]);
        pairs_.push_back({{v, i, j, k}, {p, i, j, k}, 1, apart, body.tool.radius});
      }
    }
    if (!body.is_rod()) continue;
    for (const uint32_t e : body.edges) {
      const auto [i, j] = model_->topology.edges[e];
      const SegmentPair s = closest_of_segments(x[p], x[q], x[i], x[j]);
      const Vec3 apart = x[p] + s.s * (x[q] - x[p]) - x[i] - s.t * (x[j] - x[i]);
      pairs_.push_back({{p, q, i, j}, {p, p, i, j}, 2, apart, body.tool.radius});
    }
  }
  return pairs_;
}

void InstrumentTerm::shorten(std::vector<Vec3> &step, double longest) const {
  for (const Body &body : bodies_) {
    const double length = std::max(step[body.point[0]].norm(), step[body.point[1]].norm());
    if (!body.is_rod() || length <= longest) continue;
    for (const uint32_t p : body.point) step[p] *= longest / length;
  }
}

}  // namespace mvs::core
