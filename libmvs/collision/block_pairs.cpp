// Search of the hierarchy for pairs of blocks, and the transfer of data from the pairs before.
#include "collision/block_pairs.h"

#include <algorithm>

namespace mvs::core {
namespace {

// Extra margin of the search, as a share of the contact thickness.
constexpr double search_margin = 1;

}  // namespace

BlockPairs::BlockPairs(const Model &model, const LeafParts &parts, uint32_t block_count)
    : parts_(&parts), thickness_(model.valve.contact_thickness) {
  rests_.assign(block_count, 0);
  old_index_.assign(block_count, none);
  row_start_.assign(block_count + 1, 0);
  old_row_start_ = row_start_;
  for (auto *places : {&from_, &to_}) places->reserve(model.node_count());
  // as much as a closed valve keeps, so that a live step seldom allocates
  for (auto *pairs : {&blocks_, &old_blocks_}) pairs->reserve(size_t{24} * block_count);
  found_.reserve(size_t{24} * block_count);
}

void BlockPairs::clear() {
  from_.clear();
  blocks_.clear();
}

void BlockPairs::update(const NodeMotion &motion, double error, LeafSoA &leaves, SweptBvh &bvh) {
  if (!holds(motion, error)) find(motion, leaves, bvh);
}

// Returns whether no block pair outside the list has come near enough to act.
bool BlockPairs::holds(const NodeMotion &motion, double error) const {
  if (from_.empty() || (mode_ != motion.mode && mode_ != StepMotion::independent)) return false;
  const double needed = thickness_ * (1 + error) + 2 * motion.slack;
  if (!(needed <= margin_)) return false;
  const double most = 0.25 * (margin_ - needed) * (margin_ - needed);
  for (const uint32_t i : parts_->vertices()) {
    if ((motion.from[i] - from_[i]).squaredNorm() > most) return false;
    if ((motion.to[i] - to_[i]).squaredNorm() > most) return false;
  }
  return true;
}

void BlockPairs::find(const NodeMotion &motion, LeafSoA &leaves, SweptBvh &bvh) {
  from_ = motion.from;
  to_ = motion.to;
  mode_ = motion.mode;
  margin_ = (1 + search_margin) * thickness_ + 2 * motion.slack;
  leaves.set_motion(from_, to_, mode_);
  bvh.refit(leaves.update_boxes(), rests_);
  found_.clear();
  bvh.for_near_leaves(leaves.margin(margin_), [&](uint32_t a, uint32_t b) {
    found_.push_back({std::min(a, b), std::max(a, b)});
  });
  row_start_.swap(old_row_start_);
  blocks_.swap(old_blocks_);
  sort_by_row();
  copy_kept();
}

// Counting sort of the found pairs by the lower block.
void BlockPairs::sort_by_row() {
  const size_t count = old_index_.size();
  row_start_.assign(count + 1, 0);
  if (old_blocks_.empty()) old_row_start_ = row_start_;
  for (const auto &[a, b] : found_) ++row_start_[a + 1];
  for (size_t a = 0; a < count; ++a) row_start_[a + 1] += row_start_[a];
  blocks_.resize(found_.size());
  for (const auto &[a, b] : found_) blocks_[row_start_[a]++] = {a, b};
  for (size_t a = count; a > 0; --a) row_start_[a] = row_start_[a - 1];
  row_start_[0] = 0;
}

void BlockPairs::copy_kept() {
  for (size_t a = 0; a < old_index_.size(); ++a) {
    const uint32_t first = old_row_start_[a], last = old_row_start_[a + 1];
    for (uint32_t k = first; k < last; ++k) old_index_[old_blocks_[k].b] = k;
    for (uint32_t k = row_start_[a]; k < row_start_[a + 1]; ++k) {
      const uint32_t old = old_index_[blocks_[k].b];
      if (old != none) blocks_[k] = old_blocks_[old];
    }
    for (uint32_t k = first; k < last; ++k) old_index_[old_blocks_[k].b] = none;
  }
}

}  // namespace mvs::core
