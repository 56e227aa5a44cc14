// Comparison of a step with the one before.
#include "collision/search_mask.h"

#include <algorithm>

namespace mvs::core {
namespace {

// Share of the nodes: if fewer change, only their pairs are searched for again.
constexpr double most_changed = 0.25;

}  // namespace

SearchMask::SearchMask(const Model &model, const LeafParts &parts, const BvhTopology &bvh)
    : model_(&model), parts_(&parts), bvh_(&bvh) {
  const size_t triangles = model.valve.triangles.size();
  triangle_changed_.resize(triangles);
  rests_.assign(triangles, 0);
  node_rests_.assign(model.node_count(), 0);
  const auto is_prescribed = [&](uint32_t node) {
    return model.topology.fixed[node] && model.valve.open[node] == model.valve.loaded[node];
  };
  for (uint32_t i = 0; i < model.node_count(); ++i) {
    if (is_prescribed(i)) prescribed_node_.push_back(i);
  }
  for (uint32_t t = 0; t < triangles; ++t) {
    const auto [i, j, k] = model.valve.triangles[t];
    if (is_prescribed(i) && is_prescribed(j) && is_prescribed(k)) prescribed_.push_back(t);
  }
  node_changed_.reserve(model.node_count());
  skip_leaf_.reserve(bvh.leaf_count());
}

void SearchMask::compare(const NodeMotion &last, const std::vector<Vec3> &from,
                         const std::vector<Vec3> &to, bool is_same_kind) {
  find_resting(from);
  is_partial_ = is_same_kind && last.from == from;
  if (!is_partial_) return;
  node_changed_.resize(to.size());
  size_t changed = 0;
  for (size_t i = 0; i < to.size(); ++i) changed += node_changed_[i] = !(to[i] == last.to[i]);
  is_partial_ = static_cast<double>(changed) < most_changed * static_cast<double>(to.size());
}

void SearchMask::find_resting(const std::vector<Vec3> &from) {
  any_rests_ = false;
  for (const uint32_t i : prescribed_node_) node_rests_[i] = from[i] == model_->valve.open[i];
  for (const uint32_t t : prescribed_) {
    const auto [i, j, k] = model_->valve.triangles[t];
    rests_[t] = node_rests_[i] && node_rests_[j] && node_rests_[k];
    any_rests_ = any_rests_ || rests_[t];
  }
}

void SearchMask::remove_changed(CandidateLists &lists) {
  if (!is_partial_) {
    lists.clear();
  } else {
    const auto &triangles = model_->valve.triangles.get();
    for (uint32_t t = 0; t < triangles.size(); ++t) {
      const auto [i, j, k] = triangles[t];
      triangle_changed_[t] = node_changed_[i] | node_changed_[j] | node_changed_[k];
    }
    for (auto *pairs : {&lists.contact, &lists.barrier}) {
      std::erase_if(*pairs, [&](const VertexTriangle &p) {
        return node_changed_[p.vertex] || triangle_changed_[p.triangle];
      });
    }
    std::erase_if(lists.barrier_edges, [&](const EdgeEdge &p) {
      return edge_changed(p.first) || edge_changed(p.second);
    });
  }
  mark_leaves();
}

void SearchMask::mark_leaves() {
  skip_leaf_.assign(bvh_->leaf_count(), 0);
  if (!is_partial_ && !any_rests_) return;
  for (uint32_t leaf = 0; leaf < skip_leaf_.size(); ++leaf) {
    bool skip = true;
    for (uint32_t k = bvh_->leaf_start[leaf]; k < bvh_->leaf_start[leaf + 1]; ++k) {
      const uint32_t t = bvh_->order[k];
      skip = skip && (rests_[t] || (is_partial_ && !triangle_changed_[t]));
    }
    skip_leaf_[leaf] = skip;
  }
}

bool SearchMask::edge_changed(uint32_t edge) const {
  const Edge &e = model_->topology.edges[edge];
  return node_changed_[e[0]] || node_changed_[e[1]];
}

bool SearchMask::is_skipped(uint32_t vertex, uint32_t triangle) const {
  if (any_rests_ && rests_[triangle] && node_rests_[vertex]) return true;
  return is_partial_ && !node_changed_[vertex] && !triangle_changed_[triangle];
}

bool SearchMask::is_edge_pair_skipped(const Edge &pair) const {
  if (any_rests_ && rests_[parts_->owner_of(pair[0])] && rests_[parts_->owner_of(pair[1])]) {
    return true;
  }
  return is_partial_ && !edge_changed(pair[0]) && !edge_changed(pair[1]);
}

void SearchMask::remove_skipped(FoundPairs &found) const {
  if (!any_rests_ && !is_partial_) return;
  std::erase_if(found.triangles, [&](const Edge &p) { return is_skipped(p[0], p[1]); });
  std::erase_if(found.edges, [&](const Edge &p) { return is_edge_pair_skipped(p); });
}

}  // namespace mvs::core
