// Displacements of blocks.
#include "collision/block_motion.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

// A block is wild if a node deviates by more than this share of the contact thickness in half of a
// step; a step is wild if more than a share of the blocks are.
constexpr double wild_deviation = 0.08;
constexpr double wild_blocks = 0.3;
// Steps in a row that must not be wild: a shortened step is soon followed by a long one.
constexpr uint32_t calm_steps_needed = 2;

}  // namespace

BlockMotion::BlockMotion(const Model &model, const BvhTopology &bvh, const LeafParts &parts)
    : parts_(&parts), thickness_(model.valve.contact_thickness), node_start_{0} {
  std::vector<uint32_t> last(model.node_count(), none);
  for (uint32_t block = 0; block < bvh.leaf_count(); ++block) {
    for (uint32_t k = bvh.leaf_start[block]; k < bvh.leaf_start[block + 1]; ++k) {
      for (const uint32_t i : model.valve.triangles[bvh.order[k]]) {
        if (last[i] != block) node_.push_back(i);
        last[i] = block;
      }
    }
    node_start_.push_back(static_cast<uint32_t>(node_.size()));
  }
  total_.resize(bvh.leaf_count());
  half_.resize(bvh.leaf_count());
  longest_half_.resize(bvh.leaf_count());
  for (auto *places : {&middle_, &step_}) places->reserve(model.node_count());
}

bool BlockMotion::advance(const NodeMotion &motion) {
  if (middle_.empty()) middle_ = motion.middle;
  step_.resize(middle_.size());
  for (const uint32_t i : parts_->vertices()) {
    step_[i] = motion.middle[i] - middle_[i];
    if (!std::isfinite(step_[i].sum() + motion.half[i].sum())) {
      middle_.clear();
      return false;
    }
  }
  middle_ = motion.middle;
  is_independent_ = motion.is_independent();
  ++step_count_;
  for (uint32_t block = 0; block < block_count(); ++block) {
    const BlockDisplacement change = displacement_of(block, step_);
    total_[block].common += change.common;
    total_[block].deviation += change.deviation;
    half_[block] = displacement_of(block, motion.half);
    if (is_independent_) longest_half_[block] = half_[block].common.norm() + half_[block].deviation;
  }
  return true;
}

// A wild sheet counts as calm once half as many blocks are wild, so that the list is not made anew
// in every second step.
bool BlockMotion::is_wild() {
  const auto count = std::count_if(half_.begin(), half_.end(), [&](const BlockDisplacement &half) {
    return half.deviation > wild_deviation * thickness_;
  });
  const double most = was_wild_ ? 0.5 * wild_blocks : wild_blocks;
  const bool is_now = static_cast<double>(count) > most * static_cast<double>(half_.size());
  calm_steps_ = is_now ? 0 : calm_steps_ + 1;
  was_wild_ = is_now || (was_wild_ && calm_steps_ < calm_steps_needed);
  return was_wild_;
}

BlockDisplacement BlockMotion::displacement_of(uint32_t block,
                                               const std::vector<Vec3> &nodes) const {
  const uint32_t first = node_start_[block], last = node_start_[block + 1];
  Vec3 low = nodes[node_[first]], high = low;
  for (uint32_t k = first + 1; k < last; ++k) {
    low = low.cwiseMin(nodes[node_[k]]);
    high = high.cwiseMax(nodes[node_[k]]);
  }
  BlockDisplacement displacement{0.5 * (low + high), 0};
  double deviation2 = 0;
  for (uint32_t k = first; k < last; ++k) {
    deviation2 = std::max(deviation2, (nodes[node_[k]] - displacement.common).squaredNorm());
  }
  displacement.deviation = std::sqrt(deviation2);
  return displacement;
}

}  // namespace mvs::core
