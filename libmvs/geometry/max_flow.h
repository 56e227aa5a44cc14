// The largest flow through a network of two-way pipes, and the smallest cut that limits it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// By two trees that grow from source and sink until they meet (Boykov, Kolmogorov, An Experimental
// Comparison of Min-Cut/Max-Flow Algorithms, 2004), which suits short cuts through wide networks.
// In integers: exact and the same everywhere.
class MaxFlow {
 public:
  explicit MaxFlow(uint32_t nodes) : nodes_(nodes) {}

  // A pipe that carries up to `capacity` in either direction.
  void add_pipe(uint32_t a, uint32_t b, int64_t capacity) { pipes_.push_back({{a, b}, capacity}); }

  // Call once, after the last pipe.
  int64_t run(uint32_t source, uint32_t sink);

  // After run(): on the source's side of the smallest cut nearest to the source?
  bool is_on_source_side(uint32_t node) const { return tree_[node] == Tree::source; }

 private:
  enum class Tree : uint8_t { loose, source, sink };
  struct Pipe {
    Edge ends;
    int64_t capacity;
  };
  struct Arc {
    uint32_t to, back;  // `back`: the arc the other way
    int64_t room;
  };

  void connect();
  uint32_t grow();
  int64_t push_along(uint32_t bridge);
  void adopt(uint32_t orphan);
  bool has_root(uint32_t node);
  void activate(uint32_t node);
  int64_t room_to_child(uint32_t arc, Tree tree) const {
    return tree == Tree::source ? arcs_[arc].room : arcs_[arcs_[arc].back].room;
  }

  uint32_t nodes_;
  std::vector<Pipe> pipes_;
  std::vector<uint32_t> first_;  // per node: its arcs are first_[n] .. first_[n + 1]
  std::vector<Arc> arcs_;
  std::vector<Tree> tree_;
  std::vector<uint32_t> parent_;    // per node: the arc to its parent; `none` at a root
  std::vector<uint32_t> next_;      // per node: the arc to look at next when it grows
  std::vector<uint32_t> distance_;  // per node: steps to its root,
  std::vector<uint64_t> known_;     // known to be right at this time
  uint64_t time_ = 0;
  std::vector<uint32_t> active_, orphans_;
  std::vector<uint8_t> is_active_;
  size_t active_head_ = 0;
};

}  // namespace mvs::core
