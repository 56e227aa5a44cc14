// Motion of blocks (leaves of the hierarchy) from step to step: the displacement that the nodes of
// a block have in common, and the largest deviation of a node from it. Both add up over the steps,
// so that they bound how much the distance of two blocks has changed.
#pragma once

#include <vector>

#include "collision/leaf_parts.h"
#include "collision/node_motion.h"
#include "geometry/bvh.h"
#include "model/model.h"

namespace mvs::core {

struct BlockDisplacement {
  Vec3 common = Vec3::Zero();
  double deviation = 0;
};

class BlockMotion {
 public:
  // `parts` must outlive this.
  BlockMotion(const Model &model, const BvhTopology &bvh, const LeafParts &parts);

  // Adds the displacements since the last step, from middle to middle. Returns false, and forgets
  // all steps, if a place is not finite.
  bool advance(const NodeMotion &motion);
  // Returns whether so many blocks deform so much in this step, or did in the last ones, that a
  // Verlet list would be made anew each time.
  bool is_wild();

  uint32_t block_count() const { return static_cast<uint32_t>(total_.size()); }
  uint64_t step_count() const { return step_count_; }
  // The middles of the last step.
  const std::vector<Vec3> &middle() const { return middle_; }
  // Displacement since the first step.
  const BlockDisplacement &total(uint32_t block) const { return total_[block]; }
  // Bound on how much nearer two blocks come during this step than in its middle.
  double max_approach(uint32_t a, uint32_t b) const {
    if (is_independent_) return longest_half_[a] + longest_half_[b];
    return (half_[a].common - half_[b].common).norm() + half_[a].deviation + half_[b].deviation;
  }

 private:
  BlockDisplacement displacement_of(uint32_t block, const std::vector<Vec3> &nodes) const;

  const LeafParts *parts_;
  double thickness_;
  std::vector<uint32_t> node_start_, node_;      // of the triangles of each block
  std::vector<Vec3> middle_, step_;              // of each node in this step; its change
  std::vector<BlockDisplacement> total_, half_;  // of each block; half of this step
  std::vector<double> longest_half_;             // of any node of a block, if all are independent
  bool is_independent_ = false, was_wild_ = false;
  uint32_t calm_steps_ = 0;  // in a row
  uint64_t step_count_ = 0;
};

}  // namespace mvs::core
