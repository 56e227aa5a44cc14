// Sorting of candidates: by vertex in linear time (counting sort), the few of each vertex by
// triangle.
#include "collision/candidates.h"

#include <algorithm>

namespace mvs::core {
namespace {

// Shorter lists are sorted by comparisons alone.
constexpr size_t fewest_counted = 32;
// Microseconds for a pair, about.
constexpr double sort_us = 0.02;

void sort_edges(std::vector<EdgeEdge> &pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const EdgeEdge &p, const EdgeEdge &q) {
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
}

}  // namespace

void CandidateLists::clear() {
  contact.clear();
  barrier.clear();
  barrier_edges.clear();
}

void CandidateSorter::sort(CandidateLists &lists, Workers *workers) {
  const size_t pairs = lists.contact.size() + lists.barrier.size() + lists.barrier_edges.size();
  if (!pay_for(workers, sort_us * static_cast<double>(pairs))) {
    sort(lists.contact, contact_);
    sort(lists.barrier, contact_);
    sort_edges(lists.barrier_edges);
    return;
  }
  workers->parallel_for(3, [&](uint32_t list) {
    if (list == 0) sort(lists.contact, contact_);
    if (list == 1) sort(lists.barrier, barrier_);
    if (list == 2) sort_edges(lists.barrier_edges);
  });
}

void CandidateSorter::sort(std::vector<VertexTriangle> &pairs, Buffers &buffers) const {
  if (pairs.size() < fewest_counted) {
    std::sort(pairs.begin(), pairs.end(), [](const VertexTriangle &p, const VertexTriangle &q) {
      return p.vertex != q.vertex ? p.vertex < q.vertex : p.triangle < q.triangle;
    });
    return;
  }
  auto &count = buffers.count;
  count.assign(node_count_ + 1, 0);
  for (const VertexTriangle &p : pairs) ++count[p.vertex + 1];
  for (size_t v = 0; v < node_count_; ++v) count[v + 1] += count[v];
  buffers.sorted.resize(pairs.size());
  for (const VertexTriangle &p : pairs) buffers.sorted[count[p.vertex]++] = p;
  std::copy(buffers.sorted.begin(), buffers.sorted.end(), pairs.begin());
  auto first = pairs.begin();
  for (const uint32_t end : count) {
    const auto last = pairs.begin() + end;
    std::sort(first, last, [](const VertexTriangle &p, const VertexTriangle &q) {
      return p.triangle < q.triangle;
    });
    first = last;
  }
}

}  // namespace mvs::core
