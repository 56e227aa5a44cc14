// The barrier candidates of a broad phase that may act at a place, without measuring all of them: a
// second Verlet list (Verlet, Phys. Rev. 159, 1967) with the candidates as its pairs.
//
// Where edges are shorter than the slack of the broad phase, nearly all of its barrier candidates
// are neighbours in one sheet, out of range: 0.9 million on 20,000 vertices, of which 4,000 act.
// The gap of each, distance less range, is measured once for a list. At a later place no pair has
// lost more of it than its nodes have moved, so that most pairs are decided by comparing two
// numbers. The pairs that are left out could neither act nor need a limit: no result depends on
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/broad_phase.h"
#include "model/model.h"

namespace mvs::core {

class NearBarriers {
 public:
  // Shorter lists than `least` are taken whole: measuring their pairs costs less than this.
  explicit NearBarriers(size_t least = 20000) : least_(least) {}
  NearBarriers(const NearBarriers &) = delete;  // it points to its own lists
  NearBarriers &operator=(const NearBarriers &) = delete;

  // Selects, in their order, the candidates that may be in range at x or, if there is a step dx,
  // may need a limit there (StepLimiter). `broad_phase` outlives the selection.
  void select(const Model &model, const BroadPhase &broad_phase, const std::vector<Vec3> &x,
              const std::vector<Vec3> *dx = nullptr);
  const std::vector<VertexTriangle> &triangles() const { return *triangles_; }
  const std::vector<EdgeEdge> &edges() const { return *edges_; }

 private:
  void measure(const Model &model, const BroadPhase &broad_phase, const std::vector<Vec3> &x);
  void find_motion(const Model &model, const std::vector<Vec3> &x, const std::vector<Vec3> *dx);
  size_t take_near(const BroadPhase &broad_phase);

  size_t least_;
  uint64_t serial_ = 0;                         // of the lists that were measured; 0: none
  std::vector<Vec3> at_;                        // m, where
  std::vector<float> triangle_gap_, edge_gap_;  // m, of each candidate there
  // m, of each node: motion since then, and length of the step ahead over usable_share
  std::vector<float> moved_, ahead_;
  std::vector<float> of_node_, of_triangle_, of_edge_;  // m, the largest of both, added, by part
  float farthest_ = 0;                                  // m, of any node from at_, without the step
  float step_ = 0;                                      // m, the longest that is to be allowed for
  std::vector<VertexTriangle> near_triangles_;
  std::vector<EdgeEdge> near_edges_;
  const std::vector<VertexTriangle> *triangles_ = &near_triangles_;
  const std::vector<EdgeEdge> *edges_ = &near_edges_;
};

}  // namespace mvs::core
