// Cuts the tree where the work of a subtree exceeds a share of the whole.
#include "linalg/subtrees.h"

#include <algorithm>

namespace mvs::core {

void Subtrees::divide(const Supernodes &pattern, const std::vector<double> &work,
                      double largest_share) {
  const auto count = static_cast<uint32_t>(pattern.node.size());
  std::vector<uint32_t> owner, parent(count, none), group(count, none);
  for (uint32_t s = 0; s < count; ++s) owner.resize(pattern.node[s].last, s);
  std::vector<double> below = work;  // of the subtree of each supernode
  double whole = 0;
  for (uint32_t s = 0; s < count; ++s) {
    whole += work[s];
    if (pattern.node[s].below() == 0) continue;
    parent[s] = owner[pattern.row[pattern.node[s].row_start]];
    below[parent[s]] += below[s];
  }
  const double most = largest_share * whole;
  // small subtrees share a group until that is full; a supernode has its parent's group
  uint32_t groups = 0;
  double filled = 0;
  top_.clear();
  for (uint32_t s = count; s-- > 0;) {
    if (below[s] > most) {
      top_.push_back(s);
    } else if (parent[s] != none && group[parent[s]] != none) {
      group[s] = group[parent[s]];
    } else {
      if (groups == 0 || filled + below[s] > most) {
        ++groups;
        filled = 0;
      }
      filled += below[s];
      group[s] = groups - 1;
    }
  }
  std::reverse(top_.begin(), top_.end());
  // the rows of a supernode are columns of its ancestors, those in the subtree first
  outer_rows_.resize(count);
  for (uint32_t s = 0; s < count; ++s) {
    size_t k = pattern.node[s].row_start;
    while (k < pattern.node[s].row_end && group[owner[pattern.row[k]]] != none) ++k;
    outer_rows_[s] = k;
  }
  start_.assign(groups + 1, 0);
  for (const uint32_t g : group) {
    if (g != none) ++start_[g + 1];
  }
  for (uint32_t g = 0; g < groups; ++g) start_[g + 1] += start_[g];
  member_.resize(start_.back());
  std::vector<uint32_t> at(start_.begin(), start_.end() - 1);
  for (uint32_t s = 0; s < count; ++s) {
    if (group[s] != none) member_[at[group[s]]++] = s;
  }
}

}  // namespace mvs::core
