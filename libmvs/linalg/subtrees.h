// Division of an elimination tree among threads: disjoint subtrees that may be factorised at the
// same time, and the supernodes above them, whose panels are shared one after the other.
//
// The division depends on the pattern alone, not on the number of threads.
#pragma once

#include <vector>

#include "linalg/symbolic.h"

namespace mvs::core {

class Subtrees {
 public:
  // `work`: of each supernode, and in total, in any unit.
  void divide(const Supernodes &pattern, const std::vector<double> &work);

  uint32_t count() const { return static_cast<uint32_t>(start_.size()) - 1; }
  // The supernodes of a group of whole subtrees, ascending.
  const uint32_t *begin(uint32_t group) const { return member_.data() + start_[group]; }
  const uint32_t *end(uint32_t group) const { return member_.data() + start_[group + 1]; }
  // The supernodes above all subtrees, ascending.
  const std::vector<uint32_t> &top() const { return top_; }

 private:
  std::vector<uint32_t> start_{0}, member_, top_;
};

}  // namespace mvs::core
