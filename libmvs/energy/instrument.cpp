// Measures the distances between instruments and the sheet and evaluates their barrier.
#include "energy/instrument.h"

#include <algorithm>
#include <cmath>

#include "energy/contact.h"
#include "energy/settings.h"

namespace mvs::core {
void InstrumentTerm::collect(const std::vector<Vec3> &x) {
  contact_pairs_.clear();
  for (const InstrumentBody &body : bodies_.all()) {
    for (const uint32_t v : body.vertices) take_vertex(x, body, v);
    for (const uint32_t t : body.triangles) take_triangle(x, body, t);
    if (!body.is_rod()) continue;
    for (const uint32_t e : body.edges) take_edge(x, body, e);
  }
  convex_.collect(x, bodies_.convex());
}

void InstrumentTerm::take_vertex(const std::vector<Vec3> &x, const InstrumentBody &body,
                                 uint32_t v) {
  const auto &[a, b] = body.point;
  const double s = closest_on_segment(x[v], x[a], x[b]).s;
  const ContactPair contact_pair =
      s > 0 && s < 1 ? point_edge(v, a, b, s) : point_point(v, s > 0 ? b : a);
  finish(x, body, contact_pair, tool_range(*model_), model_->vertex_area[v], false);
}

void InstrumentTerm::take_triangle(const std::vector<Vec3> &x, const InstrumentBody &body,
                                   uint32_t t) {
  const Tri &tri = model_->valve.triangles[t];
  for (uint32_t k = 0; k < (body.is_rod() ? 2u : 1u); ++k) {
    const uint32_t v = body.point[k];
    const TrianglePoint p = closest_on_triangle(x[v], x[tri[0]], x[tri[1]], x[tri[2]]);
    finish(x, body, vertex_triangle(v, tri, p), barrier_share * model_->valve.contact_thickness,
           model_->rest_area[t] / 3, true);
  }
}

void InstrumentTerm::take_edge(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t e) {
  const Edge &edge = model_->topology.edges[e], &rod = body.point;
  const SegmentPair p = closest_of_segments(x[rod[0]], x[rod[1]], x[edge[0]], x[edge[1]]);
  double area = 0;
  for (const uint32_t t : model_->topology.edge_triangles[e]) {
    if (t != none) area += model_->rest_area[t] / 3;
  }
  finish(x, body, edge_edge(rod, edge, p), barrier_share * model_->valve.contact_thickness, area,
         true);
}

void InstrumentTerm::finish(const std::vector<Vec3> &x, const InstrumentBody &body, ContactPair s,
                            double range, double area, bool is_barrier) {
  s.range = range;
  s.strength = is_barrier ? tool_barrier_strength(*model_, area, body.tool.max_force)
                          : model_->valve.contact_stiffness * area;
  s.is_barrier = is_barrier;
  s.radius = body.tool.radius;
  if (measure(x, s)) contact_pairs_.push_back(s);
}

double InstrumentTerm::energy(const std::vector<Vec3> &x) const {
  double sum = energy_of(contact_pairs_, barrier);
  for (const InstrumentBody &body : bodies_.all()) {
    if (!body.is_rod()) continue;
    const double longer = (x[body.point[1]] - x[body.point[0]]).norm() - body.tool.length;
    sum += 0.5 * settings::instrument::rod_stiffness * longer * longer;
  }
  return sum + convex_.energy(x);
}

double InstrumentTerm::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  add_gradient(contact_pairs_, barrier, g);
  for (const InstrumentBody &body : bodies_.all()) {
    if (!body.is_rod()) continue;
    const Vec3 d = x[body.point[1]] - x[body.point[0]];
    const Vec3 f = settings::instrument::rod_stiffness * (1 - body.tool.length / d.norm()) * d;
    g[body.point[0]] -= f;
    g[body.point[1]] += f;
  }
  convex_.add_gradient(x, g);
  return energy(x);
}

bool InstrumentTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                             HessianAssembler &assembler) const {
  bool complete = add_hessian(contact_pairs_, barrier, x, curvature, assembler);
  for (const InstrumentBody &body : bodies_.all()) {
    if (!body.is_rod()) continue;
    const auto &[a, b] = body.point;
    const Vec3 d = x[b] - x[a];
    const double length = d.norm();
    const Mat3 block = axial_block(
        d / length, settings::instrument::rod_stiffness,
        settings::instrument::rod_stiffness * (1 - body.tool.length / length), curvature);
    assembler.add_diagonal(a, block);
    assembler.add_diagonal(b, block);
    complete = assembler.add(a, b, -block) && complete;
  }
  return convex_.hessian(x, curvature, assembler) && complete;
}

void InstrumentTerm::add_pairs(std::vector<Edge> &pairs) const {
  mvs::core::add_pairs(contact_pairs_, pairs);
  for (const InstrumentBody &body : bodies_.all()) {
    if (body.is_rod()) pairs.push_back(body.point);
  }
  convex_.add_pairs(pairs);
}

}  // namespace mvs::core
