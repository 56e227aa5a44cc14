// Search of the hierarchy for candidates by several threads: each searches some of the near pairs
// of leaves. The candidates are those of a single thread, in another order.
#pragma once

#include <vector>

#include "base/workers.h"
#include "collision/candidate_filter.h"
#include "collision/candidates.h"
#include "collision/leaf_soa.h"
#include "collision/node_motion.h"
#include "collision/search_mask.h"
#include "geometry/swept_bvh.h"

namespace mvs::core {

class SharedSearch {
 public:
  // Found pairs are filtered in batches of about this size.
  static constexpr size_t filter_batch = 1024;
  struct Input {
    const NodeMotion &motion;
    const LeafSoA &leaves;  // updated
    const SweptBvh &bvh;    // refitted
    const SearchMask &mask;
    const CandidateFilter &filter;
    float contact, barrier;  // margins
  };

  void use_workers(Workers *workers) { workers_ = workers; }
  Workers *workers() const { return workers_; }
  bool pays(size_t triangles) const;
  // Appends the candidates to `lists`.
  void search(const Input &input, CandidateLists &lists);

 private:
  struct Part {
    CandidateFilter filter;
    FoundPairs found{};
    CandidateLists lists{};
  };
  void search(const Input &input, uint32_t part, uint32_t parts);

  Workers *workers_ = nullptr;
  std::vector<Edge> near_leaves_;
  std::vector<Part> parts_;
};

}  // namespace mvs::core
