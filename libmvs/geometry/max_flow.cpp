// Growth, augmentation and adoption.
#include "geometry/max_flow.h"

#include <algorithm>

namespace mvs::core {

void MaxFlow::connect() {
  first_.assign(nodes_ + 1, 0);
  for (const FlowEdge &edge : edges_) {
    for (const uint32_t end : edge.ends) ++first_[end + 1];
  }
  for (uint32_t n = 0; n < nodes_; ++n) first_[n + 1] += first_[n];
  next_.assign(first_.begin(), first_.end() - 1);
  arcs_.resize(2 * edges_.size());
  for (const FlowEdge &edge : edges_) {
    const uint32_t there = next_[edge.ends[0]]++, back = next_[edge.ends[1]]++;
    arcs_[there] = {edge.ends[1], back, edge.capacity};
    arcs_[back] = {edge.ends[0], there, edge.capacity};
  }
}

void MaxFlow::activate(uint32_t node) {
  next_[node] = first_[node];
  if (is_active_[node]) return;
  is_active_[node] = 1;
  active_.push_back(node);
}

// Adds free nodes to the trees until they meet. Returns the arc from the source's to the sink's
// tree.
uint32_t MaxFlow::grow() {
  for (; active_head_ < active_.size(); ++active_head_) {
    const uint32_t n = active_[active_head_];
    const Tree tree = tree_[n];
    for (uint32_t &a = next_[n]; tree != Tree::free && a < first_[n + 1]; ++a) {
      if (residual_to_child(a, tree) == 0) continue;
      const uint32_t other = arcs_[a].to;
      if (tree_[other] == Tree::free) {
        tree_[other] = tree;
        parent_[other] = arcs_[a].back;
        distance_[other] = distance_[n] + 1;
        known_[other] = known_[n];
        activate(other);
      } else if (tree_[other] != tree) {
        return tree == Tree::source ? a : arcs_[a].back;
      }
    }
    is_active_[n] = 0;
  }
  return none;
}

// Augments the flow along the path through a bridge between the trees. Nodes below saturated arcs
// become orphans.
int64_t MaxFlow::push_along(uint32_t bridge) {
  const uint32_t ends[2] = {arcs_[arcs_[bridge].back].to, arcs_[bridge].to};
  const Tree trees[2] = {Tree::source, Tree::sink};
  int64_t amount = arcs_[bridge].residual;
  for (int k = 0; k < 2; ++k) {
    for (uint32_t n = ends[k]; parent_[n] != none; n = arcs_[parent_[n]].to) {
      amount = std::min(amount, residual_to_child(arcs_[parent_[n]].back, trees[k]));
    }
  }
  const auto push = [&](uint32_t arc) {
    arcs_[arc].residual -= amount;
    arcs_[arcs_[arc].back].residual += amount;
  };
  push(bridge);
  for (int k = 0; k < 2; ++k) {
    for (uint32_t n = ends[k]; parent_[n] != none; n = arcs_[parent_[n]].to) {
      const uint32_t down = arcs_[parent_[n]].back;
      push(k == 0 ? down : parent_[n]);
      if (residual_to_child(down, trees[k]) == 0) orphans_.push_back(n);
    }
  }
  return amount;
}

// Returns whether the path from a node to the root of its tree has no orphan, and stores distances.
bool MaxFlow::has_root(uint32_t node) {
  uint32_t steps = 0, n = node;
  for (; known_[n] != time_; n = arcs_[parent_[n]].to, ++steps) {
    if (parent_[n] == none) return false;
  }
  steps += distance_[n];
  for (n = node; known_[n] != time_; n = arcs_[parent_[n]].to, --steps) {
    known_[n] = time_;
    distance_[n] = steps;
  }
  return true;
}

// Gives an orphan the new parent in its tree that is nearest to the root, or else makes it free.
void MaxFlow::adopt(uint32_t orphan) {
  const Tree tree = tree_[orphan];
  uint32_t best = none;
  for (uint32_t a = first_[orphan]; a < first_[orphan + 1]; ++a) {
    const uint32_t other = arcs_[a].to;
    if (tree_[other] != tree || residual_to_child(arcs_[a].back, tree) == 0) continue;
    if (!has_root(other)) continue;
    if (best == none || distance_[other] < distance_[arcs_[best].to]) best = a;
  }
  if (best != none) {
    parent_[orphan] = best;
    known_[orphan] = time_;
    distance_[orphan] = distance_[arcs_[best].to] + 1;
    return;
  }
  tree_[orphan] = Tree::free;
  for (uint32_t a = first_[orphan]; a < first_[orphan + 1]; ++a) {
    const uint32_t other = arcs_[a].to;
    if (tree_[other] != tree) continue;
    if (residual_to_child(arcs_[a].back, tree) > 0) activate(other);
    if (parent_[other] == arcs_[a].back) {
      parent_[other] = none;
      orphans_.push_back(other);
    }
  }
}

int64_t MaxFlow::run(uint32_t source, uint32_t sink) {
  connect();
  tree_.assign(nodes_, Tree::free);
  parent_.assign(nodes_, none);
  distance_.assign(nodes_, 0);
  known_.assign(nodes_, 0);
  is_active_.assign(nodes_, 0);
  tree_[source] = Tree::source;
  tree_[sink] = Tree::sink;
  activate(source);
  activate(sink);
  int64_t total = 0;
  for (uint32_t bridge; (bridge = grow()) != none;) {
    total += push_along(bridge);
    known_[source] = known_[sink] = ++time_;
    for (const uint32_t orphan : orphans_) parent_[orphan] = none;
    for (size_t k = 0; k < orphans_.size(); ++k) adopt(orphans_[k]);
    orphans_.clear();
  }
  return total;
}

}  // namespace mvs::core
