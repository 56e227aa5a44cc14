// The parts of the surface between which the broad phase need not search: triangles prescribed to
// rest, and, when only a few nodes of a step have changed, those whose motion is that of the last
// candidate lists.
#pragma once

#include <vector>

#include "collision/candidates.h"
#include "collision/leaf_parts.h"
#include "collision/leaf_soa.h"
#include "collision/node_motion.h"
#include "geometry/bvh.h"
#include "model/model.h"

namespace mvs::core {

class SearchMask {
 public:
  SearchMask(const Model &model, const LeafParts &parts, const BvhTopology &bvh);

  // Compares a motion with that of the last lists; its slack and mode are those of `last` if
  // `is_same_kind`.
  void compare(const NodeMotion &last, const std::vector<Vec3> &from, const std::vector<Vec3> &to,
               bool is_same_kind);
  // Removes from the lists of the last motion all pairs that have to be searched for again.
  void remove_changed(CandidateLists &lists);
  // Marks the leaves in which no triangle has to be searched for, two of which have no pairs.
  const std::vector<uint8_t> &skipped_leaves() const { return skip_leaf_; }
  // Removes pairs that rest, and those that the lists have kept.
  void remove_skipped(FoundPairs &found) const;
  bool is_skipped(uint32_t vertex, uint32_t triangle) const;

 private:
  void find_resting(const std::vector<Vec3> &from);
  bool edge_changed(uint32_t edge) const;
  bool is_edge_pair_skipped(const Edge &pair) const;
  void mark_leaves();

  const Model *model_;
  const LeafParts *parts_;
  const BvhTopology *bvh_;
  std::vector<uint32_t> prescribed_node_, prescribed_;  // nodes, triangles that may rest
  std::vector<uint8_t> node_rests_, rests_;             // of each node, each triangle
  bool any_rests_ = false;
  bool is_partial_ = false;  // few nodes have changed: pairs of the others stay in the lists
  std::vector<uint8_t> node_changed_, triangle_changed_, skip_leaf_;
};

}  // namespace mvs::core
