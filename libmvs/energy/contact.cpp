// Measures the contact pairs of each vertex by inclusion-exclusion over faces, edges and corners.
#include "energy/contact.h"

namespace mvs::core {
namespace {

// Kinds of candidates: contact, barrier, barrier of edges.
constexpr uint32_t kinds = 3;
// Microseconds for one, about.
constexpr double candidate_us = 0.05;

void finish(const std::vector<Vec3> &x, ContactPair s, std::vector<ContactPair> &pairs) {
  if (measure(x, s)) pairs.push_back(s);
}

}  // namespace

double edge_area(const Model &model, uint32_t edge) {
  double area = 0;
  for (const uint32_t t : model.topology.edge_triangles[edge]) {
    area += t == none ? 0 : model.rest_area[t] / 3;
  }
  return area;
}

ContactTerm::ContactTerm(const Model &model, ContactLaw law)
    : model_(&model),
      thickness_(model.valve.contact_thickness),
      law_(law),
      curve_(law == ContactLaw::barrier ? barrier : penalty) {
  // more pairs than a closed valve has, so that a live step seldom allocates
  contact_pairs_.reserve(model.node_count());
  make_room(collected_);
  for (uint32_t e = 0; e < model.topology.edges.size(); ++e) {
    edge_area_.push_back(edge_area(model, e));
  }
  edge_share_.assign(model.topology.edges.size(), -1);
  corner_share_.assign(model.node_count(), 1);
  for (size_t e = 0; e < edge_share_.size(); ++e) {
    if (model.topology.edge_triangles[e][1] != none) continue;
    edge_share_[e] = 0;
    for (const uint32_t i : model.topology.edges[e]) corner_share_[i] = 0;
  }
}

void ContactTerm::make_room(Collected &to) const {
  to.edges.touched.reserve(256);
  to.corners.touched.reserve(256);
  to.edges.count.assign(model_->topology.edges.size(), 0);
  to.edges.seen.assign(model_->topology.edges.size(), 0);
  to.corners.count.assign(model_->node_count(), 0);
  to.corners.seen.assign(model_->node_count(), 0);
}

void ContactTerm::collect(const std::vector<Vec3> &x, const BroadPhase &broad_phase,
                          Workers *workers) {
  if (law_ == ContactLaw::barrier) near_.select(*model_, broad_phase, x);
  const size_t candidates =
      broad_phase.contact_candidates().size() + near_.triangles().size() + near_.edges().size();
  if (pay_for(workers, candidate_us * static_cast<double>(candidates))) {
    collect_together(x, broad_phase, *workers);
    return;
  }
  collected_.pairs.swap(contact_pairs_);
  collected_.pairs.clear();
  for (uint32_t kind = 0; kind < kinds; ++kind) {
    collect_part(x, broad_phase, kind, kinds, collected_);
  }
  collected_.pairs.swap(contact_pairs_);
}

// The parts of successive candidates, joined in their order.
void ContactTerm::collect_together(const std::vector<Vec3> &x, const BroadPhase &broad_phase,
                                   Workers &workers) {
  const uint32_t parts = kinds * 2 * workers.width();
  while (parts_.size() < parts) make_room(parts_.emplace_back());
  workers.parallel_for(parts, [&](uint32_t part) {
    parts_[part].pairs.clear();
    collect_part(x, broad_phase, part, parts, parts_[part]);
  });
  contact_pairs_.clear();
  for (uint32_t part = 0; part < parts; ++part) {
    const auto &pairs = parts_[part].pairs;
    contact_pairs_.insert(contact_pairs_.end(), pairs.begin(), pairs.end());
  }
}

// A third of the parts has the candidates of each kind. All candidates of a vertex belong to the
// part of the first one.
void ContactTerm::collect_part(const std::vector<Vec3> &x, const BroadPhase &broad_phase,
                               uint32_t part, uint32_t parts, Collected &to) const {
  const uint32_t slices = parts / kinds, slice = part % slices;
  if (part < slices) {
    const auto &list = broad_phase.contact_candidates();
    const auto begin_of = [&](uint32_t k) {
      size_t begin = begin_of_part(k, slices, list.size());
      while (begin > 0 && begin < list.size() && list[begin].vertex == list[begin - 1].vertex) {
        ++begin;
      }
      return begin;
    };
    for (size_t first = begin_of(slice), end = begin_of(slice + 1); first < end;) {
      size_t last = first;
      while (last < list.size() && list[last].vertex == list[first].vertex) ++last;
      collect_vertex(x, list.data() + first, list.data() + last, to);
      first = last;
    }
    return;
  }
  if (law_ == ContactLaw::penalty) return;
  const auto for_slice = [&](const auto &list, const auto &use) {
    const size_t end = begin_of_part(slice + 1, slices, list.size());
    for (size_t k = begin_of_part(slice, slices, list.size()); k < end; ++k) use(list[k]);
  };
  if (part < 2 * slices) {
    for_slice(near_.triangles(),
              [&](const VertexTriangle &pair) { add_vertex_triangle(x, pair, to); });
  } else {
    for_slice(near_.edges(), [&](const EdgeEdge &pair) { add_barrier(x, pair, to); });
  }
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
                                 const VertexTriangle *last, Collected &to) const {
  for (const VertexTriangle *c = first; c != last; ++c) tally(x, c->vertex, c->triangle, to);
  if (!to.corners.touched.empty()) add_tallied(x, first->vertex, to);
}

void ContactTerm::tally(const std::vector<Vec3> &x, uint32_t v, uint32_t triangle,
                        Collected &to) const {
  const Tri &t = model_->valve.triangles[triangle];
  const TrianglePoint p = closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]);
  if (p.distance2 >= thickness_ * thickness_) return;
  const Tri &edges = model_->topology.triangle_edges[triangle];
  // each edge and corner of the surface counts once, for any number of its triangles
  for (const uint32_t k : t) {
    if (to.corners.meet(k)) to.corners.count[k] += corner_share_[k];
  }
  for (const uint32_t e : edges) {
    if (to.edges.meet(e)) to.edges.count[e] += edge_share_[e];
  }
  if (p.feature < 3) {
    ++to.corners.count[t[p.feature]];
  } else if (p.feature < 6) {
    ++to.edges.count[edges[p.feature - 3]];
  } else {
    ContactPair s = point_face(v, t, p.weight);
    s.range = thickness_;
    s.strength = vertex_strength(*model_, v);
    finish(x, s, to.pairs);
  }
}

void ContactTerm::add_tallied(const std::vector<Vec3> &x, uint32_t v, Collected &to) const {
  const double strength = vertex_strength(*model_, v);
  for (const uint32_t index : to.edges.touched) {
    const Edge &e = model_->topology.edges[index];
    const double s = closest_on_segment(x[v], x[e[0]], x[e[1]]).s;
    if (!(s > 0 && s < 1)) {
      to.corners.count[e[s > 0 ? 1 : 0]] += to.edges.count[index];
      continue;
    }
    if (to.edges.count[index] == 0) continue;
    ContactPair contact_pair = point_edge(v, e[0], e[1], s);
    contact_pair.range = thickness_;
    contact_pair.strength = strength * to.edges.count[index];
    finish(x, contact_pair, to.pairs);
  }
  for (const uint32_t corner : to.corners.touched) {
    if (to.corners.count[corner] == 0) continue;
    ContactPair contact_pair = point_point(v, corner);
    contact_pair.range = thickness_;
    contact_pair.strength = strength * to.corners.count[corner];
    finish(x, contact_pair, to.pairs);
  }
  to.edges.clear();
  to.corners.clear();
}

void ContactTerm::add_vertex_triangle(const std::vector<Vec3> &x, const VertexTriangle &pair,
                                      Collected &to) const {
  const Tri &t = model_->valve.triangles[pair.triangle];
  const TrianglePoint p = closest_on_triangle(x[pair.vertex], x[t[0]], x[t[1]], x[t[2]]);
  ContactPair s = vertex_triangle(pair.vertex, t, p);
  s.range = pair.range;
  s.strength = vertex_strength(*model_, pair.vertex);
  s.is_barrier = true;
  finish(x, s, to.pairs);
}

void ContactTerm::add_barrier(const std::vector<Vec3> &x, const EdgeEdge &pair,
                              Collected &to) const {
  const Edge &e = model_->topology.edges[pair.first], &f = model_->topology.edges[pair.second];
  const SegmentPair p = closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]);
  if (p.distance2 >= pair.range * pair.range) return;
  ContactPair s = edge_edge(e, f, p);
  s.range = pair.range;
  s.strength = edge_strength(*model_, edge_area_[pair.first], edge_area_[pair.second]);
  finish(x, s, to.pairs);
}

double ContactTerm::energy() const {
  return energy_of(contact_pairs_, curve_);
}

double ContactTerm::gradient(std::vector<Vec3> &g) const {
  return mvs::core::add_gradient(contact_pairs_, curve_, g);
}

void ContactTerm::add_pairs(std::vector<Edge> &pairs) const {
  mvs::core::add_pairs(contact_pairs_, pairs);
}

}  // namespace mvs::core
