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

}  // namespace

Candidates::Candidates(const Model &model)
    : model_(&model), thickness_(model.valve.contact_thickness) {
  vertex_owner_.assign(model.node_count(), none);
  edge_owner_.assign(model.topology.edges.size(), none);
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      uint32_t &vertex_owner = vertex_owner_[model.valve.triangles[t][k]];
      uint32_t &edge_owner = edge_owner_[model.topology.triangle_edges[t][k]];
      if (vertex_owner == none) vertex_owner = t;
      if (edge_owner == none) edge_owner = t;
    }
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
  make_boxes(x);
  overlapping_boxes(low_, high_, triangle_pairs_);
  vertex_triangles_.clear();
  edge_edges_.clear();
  for (const auto &[a, b] : triangle_pairs_) take_pair(x, a, b);
  std::sort(vertex_triangles_.begin(), vertex_triangles_.end(), [](const auto &p, const auto &q) {
    return p.vertex != q.vertex ? p.vertex < q.vertex : p.triangle < q.triangle;
  });
  std::sort(edge_edges_.begin(), edge_edges_.end(), [](const auto &p, const auto &q) {
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
}

// Each box reaches as far as its corners may go, and half the contact thickness more.
void Candidates::make_boxes(const std::vector<Vec3> &x) {
  const auto &triangles = model_->valve.triangles;
  low_.resize(triangles.size());
  high_.resize(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    const double margin = 0.5 * thickness_ + std::max(reach_[i], std::max(reach_[j], reach_[k]));
    const Vec3 m = Vec3::Constant(margin);
    low_[t] = x[i].cwiseMin(x[j]).cwiseMin(x[k]) - m;
    high_[t] = x[i].cwiseMax(x[j]).cwiseMax(x[k]) + m;
  }
}

void Candidates::take_pair(const std::vector<Vec3> &x, uint32_t a, uint32_t b) {
  take_vertices(x, a, b);
  take_vertices(x, b, a);
  take_edges(x, a, b);
}

void Candidates::take_vertices(const std::vector<Vec3> &x, uint32_t owner, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  const double t_reach = std::max(reach_[t[0]], std::max(reach_[t[1]], reach_[t[2]]));
  for (const uint32_t v : model_->valve.triangles[owner]) {
    if (vertex_owner_[v] != owner || has(t, v)) continue;
    const double distance = vertex_triangle_distance(x, v, t) - reach_[v] - t_reach;
    if (distance > thickness_) continue;
    const double at_rest = vertex_triangle_distance(model_->valve.rest, v, t);
    const bool facing = at_rest >= facing_rest_distance * thickness_;
    const double guard = guard_range(thickness_, at_rest);
    if (distance <= (facing ? thickness_ : guard)) {
      vertex_triangles_.push_back({v, triangle, guard, facing});
    }
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
      const double distance = edge_edge_distance(x, e, f) - edge_reach(e) - edge_reach(f);
      if (distance > guard_share * thickness_) continue;
      const double guard = guard_range(thickness_, edge_edge_distance(model_->valve.rest, e, f));
      if (distance <= guard) edge_edges_.push_back({std::min(i, j), std::max(i, j), guard});
    }
  }
}

}  // namespace mvs
