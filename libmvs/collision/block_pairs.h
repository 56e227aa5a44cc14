// Pairs of blocks (leaves of the hierarchy) that are within a margin of each other during a step.
// They are found anew only when nodes have used up the margin; pairs that stay near keep their
// data.
#pragma once

#include <vector>

#include "collision/leaf_parts.h"
#include "collision/leaf_soa.h"
#include "collision/node_motion.h"
#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

// The Verlet list of two blocks: from the first to before the last entry of VerletList. No distance
// between parts of theirs has changed by more than `drift` since the entries were made, and none
// falls by more than `motion_bound` below that in the middle of this step, slack included.
struct VerletBlocks {
  uint32_t a = 0, b = 0;               // a <= b
  double drift = 0, motion_bound = 0;  // m
  uint32_t first_triangle = 0, last_triangle = 0, first_edge = 0, last_edge = 0;
  double skin = -1;                      // m, for both blocks; negative: entries never made
  Vec3 reference_offset = Vec3::Zero();  // then: displacement of a, less that of b,
  double reference_deviation = 0;        // and the sum of their deviations
};

class BlockPairs {
 public:
  // `parts` must outlive this.
  BlockPairs(const Model &model, const LeafParts &parts, uint32_t block_count);

  // Makes blocks() hold every pair that comes within the contact thickness in this step, with
  // `error` (m) for rounding.
  void update(const NodeMotion &motion, double error, LeafSoA &leaves, SweptBvh &bvh);
  // Forgets all pairs.
  void clear();

  std::vector<VerletBlocks> &blocks() { return blocks_; }
  const std::vector<VerletBlocks> &blocks() const { return blocks_; }

 private:
  bool holds(const NodeMotion &motion, double error) const;
  void find(const NodeMotion &motion, LeafSoA &leaves, SweptBvh &bvh);
  void sort_by_row();
  void copy_kept();

  const LeafParts *parts_;
  double thickness_;
  // The motion for which blocks_ are all pairs within a margin of each other.
  std::vector<Vec3> from_, to_;
  StepMotion mode_ = StepMotion::together;
  double margin_ = 0;
  std::vector<uint8_t> rests_;                     // of each block: 0
  std::vector<Edge> found_;                        // pairs of blocks, the lower one first
  std::vector<VerletBlocks> blocks_, old_blocks_;  // by rows of the lower block
  std::vector<uint32_t> row_start_, old_row_start_;
  std::vector<uint32_t> old_index_;  // of the pair with each block in one row
};

}  // namespace mvs::core
