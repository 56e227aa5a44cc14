// Near pairs of leaves first, then their parts by several threads.
#include "collision/shared_search.h"

#include <algorithm>

namespace mvs::core {
namespace {

// Microseconds of a search for a triangle, about.
constexpr double search_us = 0.3;

template <typename T>
void append(const std::vector<T> &from, std::vector<T> &to) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

bool SharedSearch::pays(size_t triangles) const {
  return pay_for(workers_, search_us * static_cast<double>(triangles));
}

void SharedSearch::search(const Input &input, CandidateLists &lists) {
  near_leaves_.clear();
  input.bvh.for_near_leaves(input.contact, [&](uint32_t a, uint32_t b) {
    near_leaves_.push_back({a, b});
  });
  const uint32_t parts = 4 * workers_->width();
  while (parts_.size() < parts) parts_.push_back({input.filter});
  workers_->parallel_for(parts, [&](uint32_t part) { search(input, part, parts); });
  for (uint32_t part = 0; part < parts; ++part) {
    append(parts_[part].lists.contact, lists.contact);
    append(parts_[part].lists.barrier, lists.barrier);
    append(parts_[part].lists.barrier_edges, lists.barrier_edges);
  }
}

void SharedSearch::search(const Input &input, uint32_t part, uint32_t parts) {
  auto &[filter, found, lists] = parts_[part];
  lists.clear();
  const uint32_t end = begin_of_part(part + 1, parts, near_leaves_.size());
  for (uint32_t k = begin_of_part(part, parts, near_leaves_.size()); k < end; ++k) {
    const auto [a, b] = near_leaves_[k];
    input.leaves.find_pairs(a, b, input.contact, input.barrier, found);
    const bool is_last = k + 1 == end;
    if (!is_last && std::max(found.triangles.size(), found.edges.size()) < filter_batch) continue;
    input.mask.remove_skipped(found);
    filter.add(input.motion, found, lists);
    found.clear();
  }
}

}  // namespace mvs::core
