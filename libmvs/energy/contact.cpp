// Measures the contact pairs of each vertex by inclusion-exclusion over faces, edges and corners.
#include "energy/contact.h"

namespace mvs::core {

ContactTerm::ContactTerm(const Model &model, ContactLaw law)
    : model_(&model),
      thickness_(model.valve.contact_thickness),
      stiffness_(model.valve.contact_stiffness),
      law_(law),
      curve_(law == ContactLaw::barrier ? barrier : penalty) {
  // more pairs than a closed valve has, so that a live step seldom allocates
  contact_pairs_.reserve(model.node_count());
  edges_.touched.reserve(256);
  corners_.touched.reserve(256);
  edges_.count.assign(model.topology.edges.size(), 0);
  edges_.seen.assign(model.topology.edges.size(), 0);
  corners_.count.assign(model.node_count(), 0);
  corners_.seen.assign(model.node_count(), 0);
  for (const Edge &triangles : model.topology.edge_triangles) {
    double area = 0;
    for (const uint32_t t : triangles) area += t == none ? 0 : model.rest_area[t] / 3;
    edge_area_.push_back(area);
  }
  edge_share_.assign(model.topology.edges.size(), -1);
  corner_share_.assign(model.node_count(), 1);
  for (size_t e = 0; e < edge_share_.size(); ++e) {
    if (model.topology.edge_triangles[e][1] != none) continue;
    edge_share_[e] = 0;
    for (const uint32_t i : model.topology.edges[e]) corner_share_[i] = 0;
  }
}

void ContactTerm::collect(const std::vector<Vec3> &x, const BroadPhase &broad_phase) {
  contact_pairs_.clear();
  const auto &list = broad_phase.contact_candidates();
  for (size_t first = 0; first < list.size();) {
    size_t last = first;
    while (last < list.size() && list[last].vertex == list[first].vertex) ++last;
    collect_vertex(x, list.data() + first, list.data() + last);
    first = last;
  }
  if (law_ == ContactLaw::penalty) return;
  for (const VertexTriangle &pair : broad_phase.barrier_candidates()) {
    const double strength = 0.5 * stiffness_ * model_->vertex_area[pair.vertex];
    add_vertex_triangle(x, pair.vertex, model_->valve.triangles[pair.triangle], pair.range,
                        strength, true);
  }
  for (const EdgeEdge &pair : broad_phase.barrier_edge_candidates()) add_barrier(x, pair);
}

bool ContactTerm::Tally::meet(uint32_t index) {
  if (seen[index]) return false;
  seen[index] = 1;
  touched.push_back(index);
  return true;
}

void ContactTerm::Tally::clear() {
  for (const uint32_t i : touched) {
    seen[i] = 0;
    count[i] = 0;
  }
  touched.clear();
}

// Adds the pairs of one vertex. Triangles whose closest point is inside are added at once; edges
// and corners are counted first.
void ContactTerm::collect_vertex(const std::vector<Vec3> &x, const VertexTriangle *first,
                                 const VertexTriangle *last) {
  for (const VertexTriangle *c = first; c != last; ++c) tally(x, c->vertex, c->triangle);
  if (!corners_.touched.empty()) add_tallied(x, first->vertex);
}

void ContactTerm::tally(const std::vector<Vec3> &x, uint32_t v, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  const TrianglePoint p = closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]);
  if (p.distance2 >= thickness_ * thickness_) return;
  const Tri &edges = model_->topology.triangle_edges[triangle];
  // each edge and corner of the surface counts once, for any number of its triangles
  for (const uint32_t k : t) {
    if (corners_.meet(k)) corners_.count[k] += corner_share_[k];
  }
  for (const uint32_t e : edges) {
    if (edges_.meet(e)) edges_.count[e] += edge_share_[e];
  }
  if (p.feature < 3) {
    ++corners_.count[t[p.feature]];
  } else if (p.feature < 6) {
    ++edges_.count[edges[p.feature - 3]];
  } else {
    ContactPair s = point_face(v, t, p.weight);
    s.range = thickness_;
    s.strength = 0.5 * stiffness_ * model_->vertex_area[v];
    finish(x, s);
  }
}

void ContactTerm::add_tallied(const std::vector<Vec3> &x, uint32_t v) {
  const double strength = 0.5 * stiffness_ * model_->vertex_area[v];
  for (const uint32_t index : edges_.touched) {
    const Edge &e = model_->topology.edges[index];
    const double s = closest_on_segment(x[v], x[e[0]], x[e[1]]).s;
    if (!(s > 0 && s < 1)) {
      corners_.count[e[s > 0 ? 1 : 0]] += edges_.count[index];
      continue;
    }
    if (edges_.count[index] == 0) continue;
    ContactPair contact_pair = point_edge(v, e[0], e[1], s);
    contact_pair.range = thickness_;
    contact_pair.strength = strength * edges_.count[index];
    finish(x, contact_pair);
  }
  for (const uint32_t corner : corners_.touched) {
    if (corners_.count[corner] == 0) continue;
    ContactPair contact_pair = point_point(v, corner);
    contact_pair.range = thickness_;
    contact_pair.strength = strength * corners_.count[corner];
    finish(x, contact_pair);
  }
  edges_.clear();
  corners_.clear();
}

void ContactTerm::add_vertex_triangle(const std::vector<Vec3> &x, uint32_t v, const Tri &t,
                                      double range, double strength, bool is_barrier) {
  ContactPair s = vertex_triangle(v, t, closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]));
  s.range = range;
  s.strength = strength;
  s.is_barrier = is_barrier;
  finish(x, s);
}

void ContactTerm::add_barrier(const std::vector<Vec3> &x, const EdgeEdge &pair) {
  const Edge &e = model_->topology.edges[pair.first], &f = model_->topology.edges[pair.second];
  const SegmentPair p = closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]);
  if (p.distance2 >= pair.range * pair.range) return;
  ContactPair s = edge_edge(e, f, p);
  s.range = pair.range;
  s.strength = 0.25 * stiffness_ * (edge_area_[pair.first] + edge_area_[pair.second]);
  finish(x, s);
}

void ContactTerm::finish(const std::vector<Vec3> &x, ContactPair s) {
  if (measure(x, s)) contact_pairs_.push_back(s);
}

double ContactTerm::energy() const {
  return energy_of(contact_pairs_, curve_);
}

double ContactTerm::gradient(std::vector<Vec3> &g) const {
  return add_gradient(contact_pairs_, curve_, g);
}

bool ContactTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                          HessianAssembler &system) const {
  return add_hessian(contact_pairs_, curve_, x, curvature, system);
}

void ContactTerm::add_pairs(std::vector<Edge> &pairs) const {
  mvs::core::add_pairs(contact_pairs_, pairs);
}

}  // namespace mvs::core
