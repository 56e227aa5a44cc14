// The broad phase.
#include "physics/candidates.h"

#include <algorithm>
#include <cmath>

#include "base/distance.h"
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

// The pairs of one vertex, from `first` on.
void sort_triangles(std::vector<VertexTriangle> &pairs, size_t first) {
  std::sort(
      pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
      [](const VertexTriangle &p, const VertexTriangle &q) { return p.triangle < q.triangle; });
}

}  // namespace

Candidates::Candidates(const Model &model)
    : model_(&model),
      thickness_(model.valve.contact_thickness),
      tree_(model.valve.rest, model.valve.triangles),
      owner_(model.topology.edges.size(), none),
      near_(model) {
  const auto &x = model.valve.rest;
  std::vector<uint8_t> of_sheet(model.node_count(), 0), taken(model.topology.edges.size(), 0);
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    const Tri &corners = model.valve.triangles[t];
    const Vec3 centre = (x[corners[0]] + x[corners[1]] + x[corners[2]]) / 3;
    double radius = 0;
    Owned owned{};
    for (int k = 0; k < 3; ++k) {
      const uint32_t edge = model.topology.triangle_edges[t][k];
      if (!taken[edge]) {
        owned.edge[owned.count++] = edge;
        owner_[edge] = t;
      }
      taken[edge] = of_sheet[corners[k]] = 1;
      radius = std::max(radius, (x[corners[k]] - centre).norm());
    }
    owned_.push_back(owned);
    rest_centre_.push_back(centre);
    rest_radius_.push_back(radius);
  }
  for (uint32_t i = 0; i < of_sheet.size(); ++i) {
    if (of_sheet[i]) sheet_.push_back(i);
  }
}

// The share of their ways at which nodes that go together are nearest to x.
double Candidates::share_of(const std::vector<Vec3> &x) const {
  double along = 0, square = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    along += half_[i].dot(x[i] - from_[i]);
    square += half_[i].squaredNorm();
  }
  return square > 0 ? std::clamp(0.5 * along / square, 0.0, 1.0) : 0.0;
}

bool Candidates::valid_for(const std::vector<Vec3> &x) const {
  if (from_.size() != x.size()) return false;
  const double share = for_itself() ? 0 : share_of(x);
  for (size_t i = 0; i < x.size(); ++i) {
    const double off2 = for_itself() ? closest_on_segment(x[i], from_[i], to_[i]).distance2
                                     : (x[i] - from_[i] - 2 * share * half_[i]).squaredNorm();
    if (off2 > slack_ * slack_) return false;
  }
  return true;
}

void Candidates::build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
                       Pace pace) {
  from_ = x;
  to_ = to;
  slack_ = slack;
  pace_ = pace;
  middle_.resize(x.size());
  half_.resize(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    middle_[i] = 0.5 * (x[i] + to[i]);
    half_[i] = 0.5 * (to[i] - x[i]);
  }
  find_still();
  if (near_.follow(middle_, half_, slack)) {
    choose();
  } else {
    search();
  }
}

// From what is kept: what search() would find.
void Candidates::choose() {
  facing_.clear();
  guarded_.clear();
  guarded_edges_.clear();
  const double longest = guard_share * thickness_;
  const auto &triangles = model_->valve.triangles.get();
  for (const NearTriangle &p : near_.triangles()) {
    if (still_[p.triangle] && stays(p.vertex)) continue;
    const Tri &t = triangles[p.triangle];
    const std::array<uint32_t, 1> alone{p.vertex};
    const double most = p.faces ? thickness_ : longest;
    if (apart(Way::of(alone, from_, to_, pace_), Way::of(t, from_, to_, pace_), most + 2 * slack_))
      continue;
    const double distance = vertex_triangle_distance(middle_, p.vertex, t) - reach(alone, t);
    if (p.faces && distance <= thickness_) facing_.push_back({p.vertex, p.triangle, 0});
    if (distance <= p.guard) guarded_.push_back({p.vertex, p.triangle, p.guard});
  }
  const auto &edges = model_->topology.edges.get();
  for (const NearEdges &p : near_.edges()) {
    if (still_[owner_[p.first]] && still_[owner_[p.second]]) continue;
    const Edge &e = edges[p.first], &f = edges[p.second];
    if (apart(Way::of(e, from_, to_, pace_), Way::of(f, from_, to_, pace_), longest + 2 * slack_))
      continue;
    const double distance = edge_edge_distance(middle_, e, f) - reach(e, f);
    if (distance <= p.guard) guarded_edges_.push_back({p.first, p.second, p.guard});
  }
}

void Candidates::search() {
  const std::vector<Vec3> &x = from_, &to = to_;
  tree_.place(x, to, pace_, still_);
  vertex_way_.resize(x.size());
  for (uint32_t i = 0; i < x.size(); ++i) {
    vertex_way_[i] = Way::of(std::array<uint32_t, 1>{i}, x, to, pace_);
  }
  const auto &edges = model_->topology.edges;
  edge_way_.resize(edges.size());
  for (size_t i = 0; i < edges.size(); ++i) edge_way_[i] = Way::of(edges[i], x, to, pace_);
  find_vertices();
  find_edges();
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

// How much nearer than in the middle of their ways points of the hulls of two sets of nodes may
// come. On common shares only what the nodes move against each other counts, and the difference of
// two convex combinations is one of differences.
template <typename A, typename B>
double Candidates::reach(const A &a, const B &b) const {
  double together2 = 0, of_a2 = 0, of_b2 = 0;
  for (const uint32_t i : a) {
    of_a2 = std::max(of_a2, half_[i].squaredNorm());
    for (const uint32_t j : b) {
      together2 = std::max(together2, (half_[i] - half_[j]).squaredNorm());
      of_b2 = std::max(of_b2, half_[j].squaredNorm());
    }
  }
  return 2 * slack_ + (for_itself() ? std::sqrt(of_a2) + std::sqrt(of_b2) : std::sqrt(together2));
}

void Candidates::find_vertices() {
  facing_.clear();
  guarded_.clear();
  for (const uint32_t v : sheet_) {
    const size_t facing = facing_.size(), guarded = guarded_.size();
    tree_.for_near(vertex_way_[v], thickness_ + 2 * slack_,
                   [&](uint32_t t, const Way &way) { take(v, t, way); });
    sort_triangles(facing_, facing);
    sort_triangles(guarded_, guarded);
  }
}

// What is apart at rest faces; what is near enough is guarded, whatever it was at rest.
void Candidates::take(uint32_t vertex, uint32_t triangle, const Way &way) {
  const Tri &t = model_->valve.triangles[triangle];
  if (has(t, vertex) || (still_[triangle] && stays(vertex))) return;
  const bool faces = apart_at_rest(vertex, triangle);
  const double longest = guard_share * thickness_;
  const std::array<uint32_t, 1> alone{vertex};
  if (!faces && apart(vertex_way_[vertex], way, longest + 2 * slack_)) return;
  const double distance = vertex_triangle_distance(middle_, vertex, t) - reach(alone, t);
  if (faces && distance <= thickness_) facing_.push_back({vertex, triangle, 0});
  if (distance > longest) return;
  const double guard =
      guard_range(thickness_, vertex_triangle_distance(model_->valve.rest, vertex, t));
  if (distance <= guard) guarded_.push_back({vertex, triangle, guard});
}

void Candidates::find_edges() {
  guarded_edges_.clear();
  tree_.for_near(guard_share * thickness_ + 2 * slack_,
                 [&](uint32_t a, uint32_t b) { take_edges(a, b); });
  std::sort(guarded_edges_.begin(), guarded_edges_.end(), [](const EdgeEdge &p, const EdgeEdge &q) {
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
}

void Candidates::take_edges(uint32_t a, uint32_t b) {
  const auto &edges = model_->topology.edges;
  const double longest = guard_share * thickness_;
  for (const uint32_t i : owned_[a]) {
    const Edge &e = edges[i];
    for (const uint32_t j : owned_[b]) {
      const Edge &f = edges[j];
      if (apart(edge_way_[i], edge_way_[j], longest + 2 * slack_) || share(e, f)) continue;
      const double distance = edge_edge_distance(middle_, e, f) - reach(e, f);
      if (distance > longest) continue;
      const double guard = guard_range(thickness_, edge_edge_distance(model_->valve.rest, e, f));
      if (distance <= guard) guarded_edges_.push_back({std::min(i, j), std::max(i, j), guard});
    }
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
