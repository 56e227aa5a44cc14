// What touches, and the forces of it.
#include "physics/contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/distance.h"

namespace mvs {
namespace {

ContactStencil point_point(uint32_t v, uint32_t a) {
  return {{v, a, none, none}, {1, -1, 0, 0}, {}, 2, 0, {}, 0, 0, 0, false};
}

ContactStencil point_edge(uint32_t v, uint32_t a, uint32_t b, double s) {
  return {{v, a, b, none}, {1, s - 1, -s, 0}, {{{0, 1, -1, 0}, {}}}, 3, 1, {}, 0, 0, 0, false};
}

ContactStencil point_face(uint32_t v, const Tri &t, const std::array<double, 3> &w) {
  return {{v, t[0], t[1], t[2]},
          {1, -w[0], -w[1], -w[2]},
          {{{0, 1, -1, 0}, {0, 1, 0, -1}}},
          4,
          2,
          {},
          0,
          0,
          0,
          false};
}

// The stencil of a vertex and the feature of a triangle that is closest to it.
ContactStencil vertex_triangle(uint32_t v, const Tri &t, const TrianglePoint &p) {
  if (p.feature < 3) return point_point(v, t[p.feature]);
  if (p.feature == 6) return point_face(v, t, p.weight);
  const uint32_t k = p.feature - 3, l = (k + 1) % 3;
  return point_edge(v, t[k], t[l], p.weight[l]);
}

ContactStencil edge_edge(const Edge &e, const Edge &f, const SegmentPair &p) {
  ContactStencil c{
      {e[0], e[1], f[0], f[1]}, {1 - p.s, p.s, p.t - 1, -p.t}, {}, 4, 0, {}, 0, 0, 0, true};
  if (p.s > 0 && p.s < 1) c.slide[c.slides++] = {-1, 1, 0, 0};
  if (p.t > 0 && p.t < 1) c.slide[c.slides++] = {0, 0, 1, -1};
  return c;
}

}  // namespace

Barrier barrier(double s) {
  if (s >= 1) return {0, 0, 0};
  const double log = std::log(s), q = 1 - s;
  return {-q * q * log, 2 * q * log - q * q / s, -2 * log + 4 * q / s + q * q / (s * s)};
}

Barrier penalty(double s) {
  if (s >= 1) return {0, 0, 0};
  const double q = 1 - s;
  const double scale = -barrier(0.5).first / (3 * 0.25);
  return {scale * q * q * q, -3 * scale * q * q, 6 * scale * q};
}

ContactTerm::ContactTerm(const Model &model, ContactLaw law)
    : model_(&model),
      thickness_(model.valve.contact_thickness),
      stiffness_(model.valve.contact_stiffness),
      law_(law),
      curve_(law == ContactLaw::barrier ? barrier : penalty) {
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

void ContactTerm::collect(const std::vector<Vec3> &x, const Candidates &candidates) {
  stencils_.clear();
  const auto &list = candidates.facing();
  for (size_t first = 0; first < list.size();) {
    size_t last = first;
    while (last < list.size() && list[last].vertex == list[first].vertex) ++last;
    collect_vertex(x, list.data() + first, list.data() + last);
    first = last;
  }
  if (law_ == ContactLaw::penalty) return;
  for (const VertexTriangle &pair : candidates.guarded()) {
    const double strength = 0.5 * stiffness_ * model_->vertex_area[pair.vertex];
    add_vertex_triangle(x, pair.vertex, model_->valve.triangles[pair.triangle], pair.guard,
                        strength, true);
  }
  for (const EdgeEdge &pair : candidates.guarded_edges()) add_guard(x, pair);
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

// Triangles whose closest point is inside act at once; edges and corners are tallied first.
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
  // each edge and corner of the surface counts once, whatever its number of triangles
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
    ContactStencil s = point_face(v, t, p.weight);
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
    ContactStencil stencil = point_edge(v, e[0], e[1], s);
    stencil.range = thickness_;
    stencil.strength = strength * edges_.count[index];
    finish(x, stencil);
  }
  for (const uint32_t corner : corners_.touched) {
    if (corners_.count[corner] == 0) continue;
    ContactStencil stencil = point_point(v, corner);
    stencil.range = thickness_;
    stencil.strength = strength * corners_.count[corner];
    finish(x, stencil);
  }
  edges_.clear();
  corners_.clear();
}

void ContactTerm::add_vertex_triangle(const std::vector<Vec3> &x, uint32_t v, const Tri &t,
                                      double range, double strength, bool guard) {
  ContactStencil s = vertex_triangle(v, t, closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]));
  s.range = range;
  s.strength = strength;
  s.guard = guard;
  finish(x, s);
}

void ContactTerm::add_guard(const std::vector<Vec3> &x, const EdgeEdge &pair) {
  const Edge &e = model_->topology.edges[pair.first], &f = model_->topology.edges[pair.second];
  const SegmentPair p = closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]);
  if (p.distance2 >= pair.guard * pair.guard) return;
  ContactStencil s = edge_edge(e, f, p);
  s.range = pair.guard;
  s.strength = 0.25 * stiffness_ * (edge_area_[pair.first] + edge_area_[pair.second]);
  finish(x, s);
}

void ContactTerm::finish(const std::vector<Vec3> &x, ContactStencil s) {
  Vec3 r = Vec3::Zero();
  for (uint32_t k = 0; k < s.count; ++k) r += s.weight[k] * x[s.node[k]];
  s.distance = r.norm();
  if (s.distance >= s.range) return;
  s.normal = r / s.distance;
  stencils_.push_back(s);
}

double ContactTerm::energy() const {
  double sum = 0;
  for (const ContactStencil &s : stencils_) {
    sum += s.strength * s.range * curve_(s.distance / s.range).value;
  }
  return sum;
}

double ContactTerm::gradient(std::vector<Vec3> &g) const {
  double sum = 0;
  for (const ContactStencil &s : stencils_) {
    const Barrier b = curve_(s.distance / s.range);
    sum += s.strength * s.range * b.value;
    const Vec3 f = s.strength * b.first * s.normal;
    for (uint32_t k = 0; k < s.count; ++k) g[s.node[k]] += s.weight[k] * f;
  }
  return sum;
}

namespace {

// The second derivative of E(d) over the nodes of one stencil. With r = sum w_k x_k, n = r / |r|,
// t_a = sum slide_ak x_k and the closest point sliding freely (n t_a = 0), c = E' / d and
// G_ab = t_a t_b, block (k, l) is
//   w_k w_l (E'' n n^T + c (I - n n^T)) - c sum_ab (G^-1)_ab u_ka u_lb^T,
//   u_ka = w_k t_a + slide_ka d n.
// The projected one keeps E'' n n^T, which is positive where E'' is, and leaves the rest.
class StencilHessian {
 public:
  StencilHessian(const ContactStencil &s, double second, double c, const std::vector<Vec3> &x)
      : stencil_(s), c_(c) {
    const Vec3 &n = s.normal;
    along_ = (second - c) * n * n.transpose();
    along_.diagonal().array() += c;
    if (c != 0 && s.slides > 0) slide(x);
  }

  Mat3 block(uint32_t k, uint32_t l) const {
    Mat3 sum = stencil_.weight[k] * stencil_.weight[l] * along_;
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t b = 0; b < slides_; ++b) {
        sum -= c_ * inverse_(a, b) * u_[a][k] * u_[b][l].transpose();
      }
    }
    return sum;
  }

 private:
  void slide(const std::vector<Vec3> &x) {
    slides_ = stencil_.slides;
    std::array<Vec3, 2> t{Vec3::Zero(), Vec3::Zero()};
    Eigen::Matrix2d gram = Eigen::Matrix2d::Identity();
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t k = 0; k < stencil_.count; ++k)
        t[a] += stencil_.slide[a][k] * x[stencil_.node[k]];
    }
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t b = 0; b < slides_; ++b) gram(a, b) = t[a].dot(t[b]);
      for (uint32_t k = 0; k < stencil_.count; ++k) {
        u_[a][k] =
            stencil_.weight[k] * t[a] + stencil_.slide[a][k] * stencil_.distance * stencil_.normal;
      }
    }
    inverse_ = gram.inverse();
  }

  const ContactStencil &stencil_;
  double c_;
  Mat3 along_;
  uint32_t slides_ = 0;
  std::array<std::array<Vec3, 4>, 2> u_;
  Eigen::Matrix2d inverse_;
};

}  // namespace

bool ContactTerm::hessian(const std::vector<Vec3> &x, Curvature curvature, System &system) const {
  bool complete = true;
  for (const ContactStencil &s : stencils_) {
    const Barrier b = curve_(s.distance / s.range);
    const double second = s.strength / s.range * b.second;
    const bool exact = curvature == Curvature::exact;
    if (!exact && second <= 0) continue;
    const StencilHessian blocks(s, second, exact ? s.strength * b.first / s.distance : 0, x);
    for (uint32_t k = 0; k < s.count; ++k) {
      system.add_diagonal(s.node[k], blocks.block(k, k));
      for (uint32_t l = 0; l < k; ++l) {
        complete = system.add(s.node[k], s.node[l], blocks.block(k, l)) && complete;
      }
    }
  }
  return complete;
}

void ContactTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const ContactStencil &s : stencils_) {
    for (uint32_t k = 0; k < s.count; ++k) {
      for (uint32_t l = 0; l < k; ++l) pairs.push_back({s.node[k], s.node[l]});
    }
  }
}

}  // namespace mvs
