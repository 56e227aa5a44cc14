// Sorting of candidates: by vertex in linear time (counting sort), the few of each vertex by
// triangle.
#include "collision/candidates.h"

#include <algorithm>

namespace mvs::core {
namespace {

// Shorter lists are sorted by comparisons alone.
constexpr size_t fewest_counted = 32;

}  // namespace

void CandidateLists::clear() {
  contact.clear();
  barrier.clear();
  barrier_edges.clear();
}

void CandidateSorter::sort(CandidateLists &lists) {
  sort(lists.contact);
  sort(lists.barrier);
  std::sort(lists.barrier_edges.begin(), lists.barrier_edges.end(),
            [](const EdgeEdge &p, const EdgeEdge &q) {
              return p.first != q.first ? p.first < q.first : p.second < q.second;
            });
}

void CandidateSorter::sort(std::vector<VertexTriangle> &pairs) {
  if (pairs.size() < fewest_counted) {
    std::sort(pairs.begin(), pairs.end(), [](const VertexTriangle &p, const VertexTriangle &q) {
      return p.vertex != q.vertex ? p.vertex < q.vertex : p.triangle < q.triangle;
    });
    return;
  }
  count_.assign(node_count_ + 1, 0);
  for (const VertexTriangle &p : pairs) ++count_[p.vertex + 1];
  for (size_t v = 0; v < node_count_; ++v) count_[v + 1] += count_[v];
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

}  // namespace mvs::core
