// Exact distance filter of the broad phase: of the pairs whose boxes come near each other, keeps
// those that come within the range of contact or of a barrier at some time of a step.
#pragma once

#include "collision/candidates.h"
#include "collision/leaf_soa.h"
#include "collision/node_motion.h"
#include "collision/rest_distance_filter.h"
#include "geometry/distance_batch.h"
#include "model/model.h"

namespace mvs::core {

class CandidateFilter {
 public:
  // Both must outlive the filter.
  CandidateFilter(const Model &model, const RestDistanceFilter &rest_distance_filter);

  // Appends to the lists the candidates among pairs that boxes have found. A pair is one if its
  // distance in the middle of the motion, less the bound on its approach, is in range, and its
  // parts do not keep apart (swept_hulls.h). Both are the same in every frame of reference.
  void add(const NodeMotion &motion, const FoundPairs &found, CandidateLists &lists);

 private:
  void add_triangles(const NodeMotion &motion, const std::vector<Edge> &found,
                     CandidateLists &lists);
  void add_edges(const NodeMotion &motion, const std::vector<Edge> &found, CandidateLists &lists);
  void add_triangle(const NodeMotion &motion, const Edge &pair, double middle, double approach,
                    CandidateLists &lists) const;
  void add_edge_pair(const NodeMotion &motion, const Edge &pair, double middle, double approach,
                     CandidateLists &lists) const;

  const Model *model_;
  const RestDistanceFilter *rest_distance_filter_;
  double thickness_, longest_barrier_;
  DistanceBatch middle_, half_;
};

}  // namespace mvs::core
