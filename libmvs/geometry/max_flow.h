// Maximum flow and minimum cut of an undirected network, by the method of Boykov and Kolmogorov (An
// Experimental Comparison of Min-Cut/Max-Flow Algorithms, 2004).
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Two trees grow from source and sink until they meet, which suits short cuts through wide
// networks. In integers: exact and the same on every machine.
class MaxFlow {
 public:
  explicit MaxFlow(uint32_t nodes) : nodes_(nodes) {}

  // Adds an edge that carries up to `capacity` in either direction.
  void add_edge(uint32_t a, uint32_t b, int64_t capacity) { edges_.push_back({{a, b}, capacity}); }

  // Returns the maximum flow. To be called once, after the last edge.
  int64_t run(uint32_t source, uint32_t sink);

  // After run(): returns whether a node is on the source's side of the minimum cut nearest to it.
  bool is_on_source_side(uint32_t node) const { return tree_[node] == Tree::source; }

 private:
  enum class Tree : uint8_t { free, source, sink };
  struct FlowEdge {
    Edge ends;
    int64_t capacity;
  };
  struct Arc {
    uint32_t to, back;  // `back`: the opposite arc
    int64_t residual;
  };

  void connect();
  uint32_t grow();
  int64_t push_along(uint32_t bridge);
  void adopt(uint32_t orphan);
  bool has_root(uint32_t node);
  void activate(uint32_t node);
  int64_t residual_to_child(uint32_t arc, Tree tree) const {
    return tree == Tree::source ? arcs_[arc].residual : arcs_[arcs_[arc].back].residual;
  }

  uint32_t nodes_;
  std::vector<FlowEdge> edges_;
  std::vector<uint32_t> first_;  // of each node: its arcs are first_[n] .. first_[n + 1]
  std::vector<Arc> arcs_;
  std::vector<Tree> tree_;
  std::vector<uint32_t> parent_;    // of each node: the arc to its parent; `none` at a root
  std::vector<uint32_t> next_;      // of each node: the next arc to grow along
  std::vector<uint32_t> distance_;  // of each node: steps to its root,
  std::vector<uint64_t> known_;     // valid at this time
  uint64_t time_ = 0;
  std::vector<uint32_t> active_, orphans_;
  std::vector<uint8_t> is_active_;
  size_t active_head_ = 0;
};

}  // namespace mvs::core
