// The broad phase.
#include "collision/broad_phase.h"

#include <algorithm>
#include <cmath>

#include "collision/contact_params.h"
#include "collision/pair_distance.h"

namespace mvs::core {
namespace {

// Of the nodes: where fewer go elsewhere, only what they could meet is looked for again.
constexpr double most_changed = 0.25;
// Pairs that are measured at once.
constexpr size_t enough_found = 1024;
// So few are sorted as they are.
constexpr size_t few_pairs = 32;

}  // namespace

BroadPhase::BroadPhase(const Model &model)
    : model_(&model),
      thickness_(model.valve.contact_thickness),
      rest_distance_filter_(model),
      tree_(model.valve.rest, model.valve.triangles),
      parts_(model, tree_),
      lanes_(model, tree_, parts_, contact_rest_distance * thickness_) {
  // more than a closed valve has, so that a live step seldom allocates
  const size_t triangles = model.valve.triangles.size(), edges = model.topology.edges.size();
  for (auto *pairs :
       {&contact_candidates_, &barrier_candidates_, &sorted_, &kept_.facing, &kept_.guarded}) {
    pairs->reserve(16 * parts_.vertices().size());
  }
  for (auto *pairs : {&barrier_edge_candidates_, &kept_.edges}) pairs->reserve(4 * edges);
  for (auto *places : {&kept_.from, &kept_.to, &kept_.half}) places->reserve(model.node_count());
  for (auto *pairs : {&found_triangles_, &found_edges_}) {
    pairs->reserve(enough_found + 2 * LeafSoA::most_pairs);
  }
  triangle_changed_.resize(triangles);
  still_.assign(triangles, 0);
  const auto is_held = [&](uint32_t node) {
    return model.topology.fixed[node] && model.valve.open[node] == model.valve.loaded[node];
  };
  for (uint32_t t = 0; t < triangles; ++t) {
    const auto [i, j, k] = model.valve.triangles[t];
    if (is_held(i) && is_held(j) && is_held(k)) held_.push_back(t);
  }
  changed_.reserve(model.node_count());
  skip_block_.reserve(tree_.block_count());
  count_.reserve(model.node_count() + 1);
}

// The share of their ways at which nodes that go together are nearest to x.
double BroadPhase::share_of(const std::vector<Vec3> &x) const {
  double along = 0, square = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    along += half_[i].dot(x[i] - from_[i]);
    square += half_[i].squaredNorm();
  }
  return square > 0 ? std::clamp(0.5 * along / square, 0.0, 1.0) : 0.0;
}

bool BroadPhase::valid_for(const std::vector<Vec3> &x) const {
  if (from_.size() != x.size()) return false;
  const double share = for_itself() ? 0 : share_of(x);
  for (size_t i = 0; i < x.size(); ++i) {
    const double off2 = for_itself() ? closest_on_segment(x[i], from_[i], to_[i]).distance2
                                     : (x[i] - from_[i] - 2 * share * half_[i]).squaredNorm();
    if (off2 > slack_ * slack_) return false;
  }
  return true;
}

void BroadPhase::build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
                       StepMotion pace) {
  const bool begins = from_ != x || to_ == from_;
  if (!begins && first_) keep_first();
  first_ = begins;
  little_ = find_changed(x, to, slack, pace);
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
  if (keeps_near_ && !near_) near_.emplace(*model_, parts_, lanes_, rest_distance_filter_, tree_);
  if (keeps_near_ && lists_++ >= lists_alone &&
      near_->follow({from_, to_, middle_, half_, slack, pace})) {
    choose();
  } else {
    search();
  }
  sort_pairs(contact_candidates_);
  sort_pairs(barrier_candidates_);
  sort_edges();
}

// Before others take their place.
void BroadPhase::keep_first() {
  kept_.from = from_;
  kept_.to = to_;
  kept_.half = half_;
  kept_.slack = slack_;
  kept_.pace = pace_;
  kept_.facing = contact_candidates_;
  kept_.guarded = barrier_candidates_;
  kept_.edges = barrier_edge_candidates_;
  kept_.first = true;
}

void BroadPhase::exchange() {
  from_.swap(kept_.from);
  to_.swap(kept_.to);
  half_.swap(kept_.half);
  std::swap(slack_, kept_.slack);
  std::swap(pace_, kept_.pace);
  contact_candidates_.swap(kept_.facing);
  barrier_candidates_.swap(kept_.guarded);
  barrier_edge_candidates_.swap(kept_.edges);
  std::swap(first_, kept_.first);
}

bool BroadPhase::recall(const std::vector<Vec3> &x, const std::vector<Vec3> &to) {
  if (!kept_.first || kept_.from != x) return false;
  exchange();
  if (valid_for(x) && valid_for(to)) return true;
  exchange();
  return false;
}

// Marks the nodes that another way leads elsewhere than that of the last lists. True if these were
// made for the same places and most nodes go as they did.
bool BroadPhase::find_changed(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
                              StepMotion pace) {
  if (from_ != x || slack != slack_ || pace != pace_) return false;
  changed_.resize(x.size());
  size_t changed = 0;
  for (size_t i = 0; i < x.size(); ++i) changed += changed_[i] = !(to[i] == to_[i]);
  return static_cast<double>(changed) < most_changed * static_cast<double>(x.size());
}

// From what is kept: what search() would find.
void BroadPhase::choose() {
  forget_changed();
  for (const VerletBlocks &blocks : near_->blocks()) {
    if (skip_block_[blocks.a] && skip_block_[blocks.b]) continue;
    const double reach = blocks.used + blocks.reach;
    for (uint32_t k = blocks.first_triangle; k < blocks.last_triangle; ++k) {
      const VerletTriangle &p = near_->triangles()[k];
      if (p.over <= reach) choose(p, blocks);
    }
    for (uint32_t k = blocks.first_edge; k < blocks.last_edge; ++k) {
      const VerletEdges &p = near_->edges()[k];
      if (p.over <= reach) found_edges_.push_back({p.first, p.second});
    }
    if (found_triangles_.size() >= enough_found) take_triangles();
    if (found_edges_.size() >= enough_found) take_edges();
  }
  take_triangles();
  take_edges();
}

// Of what has hardly moved since it was looked at, that is enough to know.
void BroadPhase::choose(const VerletTriangle &p, const VerletBlocks &blocks) {
  const bool surely_faces = p.faces && p.over + blocks.used <= 2 * slack_;
  const double over_guard = p.over + thickness_ - barrier_share * thickness_;
  if (!surely_faces || !(over_guard > blocks.used + blocks.reach)) {
    found_triangles_.push_back({p.vertex, p.triangle});
  } else if (concerns(p.vertex, p.triangle)) {
    contact_candidates_.push_back({p.vertex, p.triangle, 0});
  }
}

// What changed nodes have no part in stays as it was found.
void BroadPhase::search() {
  forget_changed();
  lanes_.begin(from_, to_, pace_);
  tree_.place(lanes_.place_all(), skip_block_);
  const float facing = lanes_.margin(thickness_ + 2 * slack_);
  const float guard = lanes_.margin(barrier_share * thickness_ + 2 * slack_);
  tree_.for_near_blocks(facing, [&](uint32_t a, uint32_t b) {
    lanes_.meet(a, b, facing, guard, found_triangles_, found_edges_);
    if (found_triangles_.size() >= enough_found) take_triangles();
    if (found_edges_.size() >= enough_found) take_edges();
  });
  take_triangles();
  take_edges();
}

void BroadPhase::forget_changed() {
  skip_block_.assign(tree_.block_count(), 0);
  if (!little_) {
    contact_candidates_.clear();
    barrier_candidates_.clear();
    barrier_edge_candidates_.clear();
  } else {
    const auto &triangles = model_->valve.triangles.get();
    for (uint32_t t = 0; t < triangles.size(); ++t) {
      const auto [i, j, k] = triangles[t];
      triangle_changed_[t] = changed_[i] | changed_[j] | changed_[k];
    }
    forget();
  }
  if (!little_ && !any_still_) return;
  for (uint32_t block = 0; block < skip_block_.size(); ++block) {
    bool skip = true;
    for (uint32_t k = tree_.block_start()[block]; k < tree_.block_start()[block + 1]; ++k) {
      const uint32_t t = tree_.triangles()[k];
      skip = skip && (still_[t] || (little_ && !triangle_changed_[t]));
    }
    skip_block_[block] = skip;
  }
}

void BroadPhase::forget() {
  for (auto *pairs : {&contact_candidates_, &barrier_candidates_}) {
    std::erase_if(*pairs, [&](const VertexTriangle &p) {
      return changed_[p.vertex] || triangle_changed_[p.triangle];
    });
  }
  std::erase_if(barrier_edge_candidates_,
                [&](const EdgeEdge &p) { return edge_changed(p.first) || edge_changed(p.second); });
}

bool BroadPhase::edge_changed(uint32_t edge) const {
  const Edge &e = model_->topology.edges[edge];
  return changed_[e[0]] || changed_[e[1]];
}

// What is prescribed to stay where it is.
bool BroadPhase::stays(uint32_t node) const {
  const Valve &valve = model_->valve;
  return model_->topology.fixed[node] && from_[node] == valve.open[node] &&
         valve.open[node] == valve.loaded[node];
}

void BroadPhase::find_still() {
  any_still_ = false;
  for (const uint32_t t : held_) {
    const auto [i, j, k] = model_->valve.triangles[t];
    still_[t] = stays(i) && stays(j) && stays(k);
    any_still_ = any_still_ || still_[t];
  }
}

// How much nearer than in the middle of their ways points of the hulls of two sets of nodes may
// come. On common shares only what the nodes move against each other counts, and the difference of
// two convex combinations is one of differences.
template <typename A, typename B>
double BroadPhase::reach(const A &a, const B &b) const {
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

// Nothing is between two things that stay, nor to look for between those that go as they did.
bool BroadPhase::concerns(uint32_t vertex, uint32_t triangle) const {
  if (any_still_ && still_[triangle] && stays(vertex)) return false;
  return !little_ || changed_[vertex] || triangle_changed_[triangle];
}

bool BroadPhase::concerns(const Edge &pair) const {
  if (any_still_ && still_[parts_.owner_of(pair[0])] && still_[parts_.owner_of(pair[1])]) {
    return false;
  }
  return !little_ || edge_changed(pair[0]) || edge_changed(pair[1]);
}

void BroadPhase::take_triangles() {
  const auto &triangles = model_->valve.triangles.get();
  if (any_still_ || little_) {
    std::erase_if(found_triangles_, [&](const Edge &p) { return !concerns(p[0], p[1]); });
  }
  for_rows(found_triangles_, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(place_, k, middle_, pair[k][0], triangles[pair[k][1]]);
      set_pair(motion_, k, half_, pair[k][0], triangles[pair[k][1]]);
    }
    measure_triangles(place_, count);
    measure_farthest(motion_, count, 1);
    for (uint32_t k = 0; k < count; ++k) {
      const std::array<uint32_t, 1> alone{pair[k][0]};
      const double near = for_itself() ? reach(alone, triangles[pair[k][1]])
                                       : 2 * slack_ + std::sqrt(motion_.distance2[k]);
      take(pair[k][0], pair[k][1], std::sqrt(place_.distance2[k]), near);
    }
  });
  found_triangles_.clear();
}

// What is apart at rest faces; what is near enough is guarded, whatever it was at rest. Boxes
// around the ends of two ways are no farther apart than the ways are in the middle and come nearer
// until there.
void BroadPhase::take(uint32_t vertex, uint32_t triangle, double middle, double near) {
  const double distance = middle - near;
  if (!(distance <= thickness_)) return;
  const bool faces = rest_distance_filter_(vertex, triangle);
  const double longest = barrier_share * thickness_;
  if (!faces && distance > longest) return;
  const Tri &t = model_->valve.triangles[triangle];
  const double margin = (faces ? thickness_ : longest) + 2 * slack_;
  const bool surely_near = middle + near - 2 * slack_ < margin * (1 - 1e-9);
  if (!surely_near && apart(way_of(std::array<uint32_t, 1>{vertex}), way_of(t), margin)) return;
  if (faces) contact_candidates_.push_back({vertex, triangle, 0});
  if (distance > longest) return;
  const double guard = barrier_range(thickness_, distance_of(model_->valve.rest, vertex, t));
  if (distance <= guard) barrier_candidates_.push_back({vertex, triangle, guard});
}

// By vertex in linear time; the few of each by triangle.
void BroadPhase::sort_pairs(std::vector<VertexTriangle> &pairs) {
  if (pairs.size() < few_pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const VertexTriangle &p, const VertexTriangle &q) {
      return p.vertex != q.vertex ? p.vertex < q.vertex : p.triangle < q.triangle;
    });
    return;
  }
  count_.assign(from_.size() + 1, 0);
  for (const VertexTriangle &p : pairs) ++count_[p.vertex + 1];
  for (size_t v = 0; v < from_.size(); ++v) count_[v + 1] += count_[v];
  sorted_.resize(pairs.size());
  for (const VertexTriangle &p : pairs) sorted_[count_[p.vertex]++] = p;
  std::copy(sorted_.begin(), sorted_.end(), pairs.begin());
  auto first = pairs.begin();
  for (const uint32_t end : count_) {
    const auto last = pairs.begin() + end;
    std::sort(first, last, [](const VertexTriangle &p, const VertexTriangle &q) {
      return p.triangle < q.triangle;
    });
    first = last;
  }
}

void BroadPhase::sort_edges() {
  std::sort(barrier_edge_candidates_.begin(), barrier_edge_candidates_.end(),
            [](const EdgeEdge &p, const EdgeEdge &q) {
              return p.first != q.first ? p.first < q.first : p.second < q.second;
            });
}

void BroadPhase::take_edges() {
  const auto &edges = model_->topology.edges.get();
  if (any_still_ || little_) {
    std::erase_if(found_edges_, [&](const Edge &p) { return !concerns(p); });
  }
  for_rows(found_edges_, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(place_, k, middle_, edges[pair[k][0]], edges[pair[k][1]]);
      set_pair(motion_, k, half_, edges[pair[k][0]], edges[pair[k][1]]);
    }
    measure_segments(place_, count);
    measure_farthest(motion_, count, 2);
    for (uint32_t k = 0; k < count; ++k) {
      const double near = for_itself() ? reach(edges[pair[k][0]], edges[pair[k][1]])
                                       : 2 * slack_ + std::sqrt(motion_.distance2[k]);
      take_edge_pair(pair[k][0], pair[k][1], std::sqrt(place_.distance2[k]) - near);
    }
  });
  found_edges_.clear();
}

void BroadPhase::take_edge_pair(uint32_t i, uint32_t j, double distance) {
  const double longest = barrier_share * thickness_;
  if (!(distance <= longest)) return;
  const Edge &e = model_->topology.edges[i], &f = model_->topology.edges[j];
  const double guard = barrier_range(thickness_, distance_of(model_->valve.rest, e, f));
  if (distance > guard || apart(way_of(e), way_of(f), longest + 2 * slack_)) return;
  barrier_edge_candidates_.push_back({i, j, guard});
}

}  // namespace mvs::core
