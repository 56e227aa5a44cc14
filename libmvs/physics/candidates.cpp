// The broad phase.
#include "physics/candidates.h"

#include <algorithm>
#include <cmath>

#include "base/distance.h"
#include "base/grid.h"
#include "physics/contact.h"

namespace mvs {
namespace {

bool has(const Tri &t, uint32_t node) {
  return t[0] == node || t[1] == node || t[2] == node;
}

bool share(const Edge &a, const Edge &b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

double vertex_triangle_distance(const std::vector<Vec3> &x, uint32_t v, const Tri &t) {
  return std::sqrt(closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]).distance2);
}

double edge_edge_distance(const std::vector<Vec3> &x, const Edge &e, const Edge &f) {
  return std::sqrt(closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]).distance2);
}

// Squared gap between two boxes, 0 where they overlap: a cheap lower bound of any distance inside.
double gap2(const Vec3 &low_a, const Vec3 &high_a, const Vec3 &low_b, const Vec3 &high_b) {
  return (low_b - high_a).cwiseMax(low_a - high_b).cwiseMax(0.0).squaredNorm();
}

void sort_pairs(std::vector<VertexTriangle> &pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const VertexTriangle &p, const VertexTriangle &q) {
    return p.vertex != q.vertex ? p.vertex < q.vertex : p.triangle < q.triangle;
  });
}

}  // namespace

Candidates::Candidates(const Model &model)
    : model_(&model), thickness_(model.valve.contact_thickness) {
  const auto &x = model.valve.rest;
  vertex_owner_.assign(model.node_count(), none);
  edge_owner_.assign(model.topology.edges.size(), none);
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    const Tri &corners = model.valve.triangles[t];
    const Vec3 centre = (x[corners[0]] + x[corners[1]] + x[corners[2]]) / 3;
    double radius = 0;
    for (int k = 0; k < 3; ++k) {
      uint32_t &edge_owner = edge_owner_[model.topology.triangle_edges[t][k]];
      if (vertex_owner_[corners[k]] == none) vertex_owner_[corners[k]] = t;
      if (edge_owner == none) edge_owner = t;
      radius = std::max(radius, (x[corners[k]] - centre).norm());
    }
    rest_centre_.push_back(centre);
    rest_radius_.push_back(radius);
  }
  for (uint32_t i = 0; i < vertex_owner_.size(); ++i) {
    if (vertex_owner_[i] != none) sheet_.push_back(i);
  }
}

bool Candidates::valid_for(const std::vector<Vec3> &x) const {
  if (built_at_.size() != x.size()) return false;
  for (size_t i = 0; i < x.size(); ++i) {
    if ((x[i] - built_at_[i]).squaredNorm() > reach_[i] * reach_[i]) return false;
  }
  return true;
}

void Candidates::build(const std::vector<Vec3> &x, const std::vector<double> &reach) {
  reach_ = reach;
  built_at_ = x;
  find_guarded(x);
  find_facing(x);
}

double Candidates::triangle_reach(uint32_t triangle) const {
  const auto [i, j, k] = model_->valve.triangles[triangle];
  return std::max(reach_[i], std::max(reach_[j], reach_[k]));
}

// Each box reaches as far as its corners may go, and a margin more.
void Candidates::make_boxes(const std::vector<Vec3> &x, double margin) {
  const auto &triangles = model_->valve.triangles;
  low_.resize(triangles.size());
  high_.resize(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    const Vec3 m = Vec3::Constant(margin + triangle_reach(t));
    low_[t] = x[i].cwiseMin(x[j]).cwiseMin(x[k]) - m;
    high_[t] = x[i].cwiseMax(x[j]).cwiseMax(x[k]) + m;
  }
}

void Candidates::find_guarded(const std::vector<Vec3> &x) {
  guarded_.clear();
  guarded_edges_.clear();
  make_boxes(x, 0.5 * guard_share * thickness_);
  overlapping_boxes(low_, high_, pairs_);
  for (const auto &[a, b] : pairs_) {
    take_vertices(x, a, b);
    take_vertices(x, b, a);
    take_edges(x, a, b);
  }
  sort_pairs(guarded_);
  std::sort(guarded_edges_.begin(), guarded_edges_.end(), [](const EdgeEdge &p, const EdgeEdge &q) {
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
}

void Candidates::take_vertices(const std::vector<Vec3> &x, uint32_t owner, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  const double t_reach = triangle_reach(triangle);
  const Vec3 low = x[t[0]].cwiseMin(x[t[1]]).cwiseMin(x[t[2]]);
  const Vec3 high = x[t[0]].cwiseMax(x[t[1]]).cwiseMax(x[t[2]]);
  for (const uint32_t v : model_->valve.triangles[owner]) {
    if (vertex_owner_[v] != owner || has(t, v)) continue;
    const double near = guard_share * thickness_ + reach_[v] + t_reach;
    if (gap2(x[v], x[v], low, high) > near * near) continue;
    const double distance = vertex_triangle_distance(x, v, t) - reach_[v] - t_reach;
    if (distance > guard_share * thickness_) continue;
    const double guard =
        guard_range(thickness_, vertex_triangle_distance(model_->valve.rest, v, t));
    if (distance <= guard) guarded_.push_back({v, triangle, guard});
  }
}

void Candidates::take_edges(const std::vector<Vec3> &x, uint32_t a, uint32_t b) {
  const auto &edges = model_->topology.edges;
  auto edge_reach = [&](const Edge &e) { return std::max(reach_[e[0]], reach_[e[1]]); };
  for (const uint32_t i : model_->topology.triangle_edges[a]) {
    if (edge_owner_[i] != a) continue;
    for (const uint32_t j : model_->topology.triangle_edges[b]) {
      if (edge_owner_[j] != b || share(edges[i], edges[j])) continue;
      const Edge &e = edges[i], &f = edges[j];
      const double near = guard_share * thickness_ + edge_reach(e) + edge_reach(f);
      if (gap2(x[e[0]].cwiseMin(x[e[1]]), x[e[0]].cwiseMax(x[e[1]]), x[f[0]].cwiseMin(x[f[1]]),
               x[f[0]].cwiseMax(x[f[1]])) > near * near) {
        continue;
      }
      const double distance = edge_edge_distance(x, e, f) - edge_reach(e) - edge_reach(f);
      if (distance > guard_share * thickness_) continue;
      const double guard = guard_range(thickness_, edge_edge_distance(model_->valve.rest, e, f));
      if (distance <= guard) guarded_edges_.push_back({std::min(i, j), std::max(i, j), guard});
    }
  }
}

// The boxes carry the reach of the triangles and the largest reach of a vertex.
void Candidates::find_facing(const std::vector<Vec3> &x) {
  facing_.clear();
  points_.clear();
  double far = 0;
  for (const uint32_t v : sheet_) {
    points_.push_back(x[v]);
    far = std::max(far, reach_[v]);
  }
  make_boxes(x, thickness_ + far);
  points_in_boxes(points_, low_, high_, pairs_);
  for (const auto &[p, t] : pairs_) {
    const uint32_t v = sheet_[p];
    if (!apart_at_rest(v, t)) continue;
    const double distance = vertex_triangle_distance(x, v, model_->valve.triangles[t]);
    if (distance <= thickness_ + reach_[v] + triangle_reach(t)) facing_.push_back({v, t, 0});
  }
}

// The exact distance at rest decides; the sphere around the triangle settles most pairs.
bool Candidates::apart_at_rest(uint32_t vertex, uint32_t triangle) const {
  const double needed = facing_rest_distance * thickness_;
  const auto &rest = model_->valve.rest;
  const double centre = (rest[vertex] - rest_centre_[triangle]).norm();
  if (centre < needed) return false;
  if (centre - rest_radius_[triangle] >= needed) return true;
  return vertex_triangle_distance(rest, vertex, model_->valve.triangles[triangle]) >= needed;
}

}  // namespace mvs
