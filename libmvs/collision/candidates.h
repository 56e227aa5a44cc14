// Candidate pairs of the broad phase: the lists that contact, barriers and step limits run over.
#pragma once

#include <vector>

#include "base/types.h"
#include "base/workers.h"

namespace mvs::core {

struct VertexTriangle {
  uint32_t vertex, triangle;
  double range;  // m, of the barrier; unused in contact pairs
};

struct EdgeEdge {
  uint32_t first, second;  // edges, first < second
  double range;            // m, of the barrier
};

struct CandidateLists {
  std::vector<VertexTriangle> contact, barrier;
  std::vector<EdgeEdge> barrier_edges;

  bool empty() const { return contact.empty() && barrier.empty() && barrier_edges.empty(); }
  void clear();
};

// Sorts pairs by vertex, then triangle; edges by first, then second. Keeps its memory.
class CandidateSorter {
 public:
  explicit CandidateSorter(size_t node_count) : node_count_(node_count) {
    contact_.count.reserve(node_count + 1);
  }
  void reserve(size_t pairs) { contact_.sorted.reserve(pairs); }
  // Nullable `workers` sort the three lists at the same time.
  void sort(CandidateLists &lists, Workers *workers = nullptr);

 private:
  struct Buffers {
    std::vector<VertexTriangle> sorted;
    std::vector<uint32_t> count;  // where the pairs of each vertex end
  };
  void sort(std::vector<VertexTriangle> &pairs, Buffers &buffers) const;

  size_t node_count_;
  Buffers contact_, barrier_;  // barrier_: of a thread of its own
};

}  // namespace mvs::core
