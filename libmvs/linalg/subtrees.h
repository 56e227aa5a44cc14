// Division of an elimination tree among threads: disjoint subtrees that may be factorised at the
// same time, and the supernodes above them, whose panels are shared one after the other.
#pragma once

#include <vector>

#include "linalg/symbolic.h"

namespace mvs::core {

class Subtrees {
 public:
  // `work`: of each supernode, in any unit; `largest_share`: of the whole work, in a subtree. A
  // small share balances threads better; it moves more supernodes to the top.
  void divide(const Supernodes &pattern, const std::vector<double> &work, double largest_share);

  uint32_t count() const { return static_cast<uint32_t>(start_.size()) - 1; }
  // The supernodes of a group of whole subtrees, ascending.
  const uint32_t *begin(uint32_t group) const { return member_.data() + start_[group]; }
  const uint32_t *end(uint32_t group) const { return member_.data() + start_[group + 1]; }
  // The supernodes above all subtrees, ascending.
  const std::vector<uint32_t> &top() const { return top_; }
  // Index into Supernodes::row of the first row of a subtree's supernode that lies in the top.
  size_t outer_rows(uint32_t supernode) const { return outer_rows_[supernode]; }

 private:
  std::vector<uint32_t> start_{0}, member_, top_;
  std::vector<size_t> outer_rows_;
};

}  // namespace mvs::core
