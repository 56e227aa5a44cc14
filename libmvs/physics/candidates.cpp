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
  if (from_.size() != x.size()) return false;
  for (size_t i = 0; i < x.size(); ++i) {
    if (closest_on_segment(x[i], from_[i], to_[i]).distance2 > slack_ * slack_) return false;
  }
  return true;
}

void Candidates::build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack) {
  take_ways(x, to, slack);
  find_still();
  find_guarded();
  find_facing();
}

void Candidates::take_ways(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack) {
  from_ = x;
  to_ = to;
  slack_ = slack;
  node_low_.resize(x.size());
  node_high_.resize(x.size());
  middle_.resize(x.size());
  reach_.resize(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    node_low_[i] = x[i].cwiseMin(to[i]).array() - slack;
    node_high_[i] = x[i].cwiseMax(to[i]).array() + slack;
    middle_[i] = 0.5 * (x[i] + to[i]);
    reach_[i] = 0.5 * (to[i] - x[i]).norm() + slack;
  }
}

// What is prescribed to stay where it is.
bool Candidates::stays(uint32_t node) const {
  const Valve &valve = model_->valve;
  return model_->topology.fixed[node] && from_[node] == valve.open[node] &&
         valve.open[node] == valve.loaded[node];
}

void Candidates::find_still() {
  const auto &triangles = model_->valve.triangles;
  still_.resize(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    still_[t] = stays(i) && stays(j) && stays(k);
  }
}

// How far a point of a triangle may be from where it is between its corners' middles.
double Candidates::triangle_reach(uint32_t triangle) const {
  const auto [i, j, k] = model_->valve.triangles[triangle];
  return std::max(reach_[i], std::max(reach_[j], reach_[k]));
}

// As far as the corners may go.
std::array<Vec3, 2> Candidates::box_of(const Tri &t) const {
  return {node_low_[t[0]].cwiseMin(node_low_[t[1]]).cwiseMin(node_low_[t[2]]),
          node_high_[t[0]].cwiseMax(node_high_[t[1]]).cwiseMax(node_high_[t[2]])};
}

void Candidates::make_boxes(double margin) {
  const auto &triangles = model_->valve.triangles;
  low_.resize(triangles.size());
  high_.resize(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [low, high] = box_of(triangles[t]);
    low_[t] = low.array() - margin;
    high_[t] = high.array() + margin;
  }
}

void Candidates::find_guarded() {
  guarded_.clear();
  guarded_edges_.clear();
  make_boxes(0.5 * guard_share * thickness_);
  overlapping_boxes(low_, high_, pairs_);
  for (const auto &[a, b] : pairs_) {
    if (still_[a] && still_[b]) continue;
    take_vertices(a, b);
    take_vertices(b, a);
    take_edges(a, b);
  }
  sort_pairs(guarded_);
  std::sort(guarded_edges_.begin(), guarded_edges_.end(), [](const EdgeEdge &p, const EdgeEdge &q) {
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
}

// What is farther apart than the guard's longest range goes by the boxes, then by the balls.
void Candidates::take_vertices(uint32_t owner, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  const double longest = guard_share * thickness_;
  const auto [low, high] = box_of(t);
  for (const uint32_t v : model_->valve.triangles[owner]) {
    if (vertex_owner_[v] != owner || has(t, v)) continue;
    if (gap2(node_low_[v], node_high_[v], low, high) > longest * longest) continue;
    const double distance =
        vertex_triangle_distance(middle_, v, t) - reach_[v] - triangle_reach(triangle);
    if (distance > longest) continue;
    const double guard =
        guard_range(thickness_, vertex_triangle_distance(model_->valve.rest, v, t));
    if (distance <= guard) guarded_.push_back({v, triangle, guard});
  }
}

void Candidates::take_edges(uint32_t a, uint32_t b) {
  const auto &edges = model_->topology.edges;
  const double longest = guard_share * thickness_;
  auto low = [&](const Edge &e) { return node_low_[e[0]].cwiseMin(node_low_[e[1]]); };
  auto high = [&](const Edge &e) { return node_high_[e[0]].cwiseMax(node_high_[e[1]]); };
  auto reach = [&](const Edge &e) { return std::max(reach_[e[0]], reach_[e[1]]); };
  for (const uint32_t i : model_->topology.triangle_edges[a]) {
    if (edge_owner_[i] != a) continue;
    const Edge &e = edges[i];
    const Vec3 low_e = low(e), high_e = high(e);
    for (const uint32_t j : model_->topology.triangle_edges[b]) {
      const Edge &f = edges[j];
      if (edge_owner_[j] != b || share(e, f)) continue;
      if (gap2(low_e, high_e, low(f), high(f)) > longest * longest) continue;
      const double distance = edge_edge_distance(middle_, e, f) - reach(e) - reach(f);
      if (distance > longest) continue;
      const double guard = guard_range(thickness_, edge_edge_distance(model_->valve.rest, e, f));
      if (distance <= guard) guarded_edges_.push_back({std::min(i, j), std::max(i, j), guard});
    }
  }
}

// The boxes carry the ways of the triangles and the largest reach of a vertex.
void Candidates::find_facing() {
  facing_.clear();
  points_.clear();
  double far = 0;
  for (const uint32_t v : sheet_) {
    points_.push_back(middle_[v]);
    far = std::max(far, reach_[v]);
  }
  make_boxes(thickness_ + far);
  points_in_boxes(points_, low_, high_, pairs_);
  for (const auto &[p, t] : pairs_) {
    const uint32_t v = sheet_[p];
    if (still_[t] && stays(v)) continue;
    const Tri &tri = model_->valve.triangles[t];
    const auto [low, high] = box_of(tri);
    if (gap2(node_low_[v], node_high_[v], low, high) > thickness_ * thickness_) continue;
    if (!apart_at_rest(v, t)) continue;
    const double distance = vertex_triangle_distance(middle_, v, tri);
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
