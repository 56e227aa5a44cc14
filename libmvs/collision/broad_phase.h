// Broad phase: for one step of all nodes, finds every vertex-triangle and edge-edge pair that could
// come within the range of contact or of its barrier, by a bounding volume hierarchy of swept
// boxes.
//
// Contact candidates: a vertex and a triangle that are apart in the rest shape (RestDistanceFilter)
// and come within the contact thickness. Barrier candidates: a vertex and a triangle, or two edges,
// that share no node and come within their barrier's range. Both lists hold while every node stays
// within a slack of its segment from x to `to`: with StepMotion::together at a common share of it,
// with StepMotion::independent anywhere on it. Each edge belongs to one of its triangles, so that
// each pair is reported once (representative triangles: Curtis, Tamstorf, Manocha, I3D 2008).
//
// The lists of successive steps are taken from a VerletList where that is quicker; they are the
// same.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "collision/candidate_filter.h"
#include "collision/candidates.h"
#include "collision/leaf_parts.h"
#include "collision/leaf_soa.h"
#include "collision/node_motion.h"
#include "collision/search_mask.h"
#include "collision/shared_search.h"
#include "collision/verlet_list.h"
#include "geometry/bvh.h"
#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

class BroadPhase {
 public:
  explicit BroadPhase(const Model &model);
  BroadPhase(const BroadPhase &) = delete;
  BroadPhase &operator=(const BroadPhase &) = delete;

  // The hierarchy of the triangles of the sheet.
  const BvhTopology &topology() const { return bvh_.topology(); }

  // Allows the Verlet list (default) or not: it pays in live steps. It is made by the third call of
  // build(), or by the next one after use_verlet_list_at_once().
  void use_verlet_list(bool use) { uses_verlet_list_ = use; }
  void use_verlet_list_at_once() { list_count_ = std::max(list_count_, lists_without_verlet); }

  // Threads that may share a search; they outlive this. Null, the default: none. The lists do not
  // depend on them.
  void use_workers(Workers *workers) { shared_.use_workers(workers); }

  // Makes the lists for nodes that move from x to `to`.
  void build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
             StepMotion mode = StepMotion::together);
  // Returns to the first lists made from the place of the last ones, if they hold for x and `to`:
  // a step that is shortened as a whole after its limits needs no new lists.
  bool recall(const std::vector<Vec3> &x, const std::vector<Vec3> &to);
  // Returns whether the lists hold at x. If they hold at two places, they hold on the segments
  // between them.
  bool valid_for(const std::vector<Vec3> &x) const { return current_.motion.contains(x); }
  bool is_independent() const { return current_.motion.is_independent(); }

  // Not zero, and another one for other lists of any broad phase.
  uint64_t serial() const { return current_.serial; }

  bool empty() const { return current_.lists.empty(); }
  // Sorted by vertex, then triangle; edges by first, then second.
  const std::vector<VertexTriangle> &contact_candidates() const { return current_.lists.contact; }
  const std::vector<VertexTriangle> &barrier_candidates() const { return current_.lists.barrier; }
  const std::vector<EdgeEdge> &barrier_edge_candidates() const {
    return current_.lists.barrier_edges;
  }

 private:
  // The lists of one motion; whether they are the first ones from its start.
  struct StepCandidates {
    NodeMotion motion;
    CandidateLists lists;
    bool is_first = false;
    uint64_t serial = 0;
  };

  void select_from_verlet_list();
  void select(const VerletTriangle &pair, const VerletBlocks &blocks);
  void search_hierarchy();
  void filter_found();

  const Model *model_;
  RestDistanceFilter rest_distance_filter_;
  SweptBvh bvh_;
  LeafParts parts_;
  LeafSoA leaves_;
  SearchMask mask_;
  CandidateFilter filter_;
  CandidateSorter sorter_;
  FoundPairs found_;
  StepCandidates current_, first_;  // first_: of the same start, while current_ are later ones
  // Lists before the Verlet list is made, which takes longer than a search: a single step does not
  // need it, and the first step takes longest already.
  static constexpr uint64_t lists_without_verlet = 2;
  bool uses_verlet_list_ = true;
  uint64_t list_count_ = 0;
  std::optional<VerletList> verlet_list_;
  SharedSearch shared_;
};

}  // namespace mvs::core
