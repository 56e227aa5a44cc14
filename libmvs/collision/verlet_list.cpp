// Keeping near pairs.
#include "collision/verlet_list.h"

#include <algorithm>
#include <cmath>

#include "collision/contact_params.h"
#include "collision/pair_distance.h"

namespace mvs::core {
namespace {

// Of the contact thickness: the skin between two blocks that do not move against each other. More,
// and more pairs are kept than can act; less, and blocks come up more often.
constexpr double skin = 0.3;
// Of how far they come nearer on one way: what their skin is thicker where they do move.
constexpr double ahead = 1.2;
// Of the contact thickness: how much farther apart blocks are found than is needed now.
constexpr double early = 1;
// In turn a few pairs of blocks, of those that have used up that much of their skin.
constexpr size_t turns = 16;
constexpr double worn = 0.5;
// Of the contact thickness: how far nodes go beside their block where lists are not worth keeping;
// and of how many blocks.
constexpr double wild = 0.08;
constexpr double many_wild = 0.3;
// Until so many rounds in a row were not: a step that is shortened is soon followed by a long one.
constexpr uint32_t calm_rounds = 2;
// Of the contact thickness: more than distances are wrong by, of near parallel edges too.
constexpr double rounding = 1e-5;

double gap_of(const SweptAabbF &a, const SweptAabbF &b) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double above = a.start_low[k] - b.start_high[k], below = b.start_low[k] - a.start_high[k];
    const double gap = std::max({0.0, above, below});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

}  // namespace

VerletList::VerletList(const Model &model, const LeafParts &parts, LeafSoA &lanes,
                       const RestDistanceFilter &rest_distance_filter, SweptBvh &tree)
    : model_(&model),
      parts_(&parts),
      lanes_(&lanes),
      rest_distance_filter_(&rest_distance_filter),
      tree_(&tree),
      thickness_(model.valve.contact_thickness),
      guard_(barrier_share * thickness_),
      skin_(skin * thickness_) {
  place_nodes();
  const size_t count = tree.block_count(), edges = model.topology.edges.size();
  gone_.resize(count);
  half_.resize(count);
  longest_half_.resize(count);
  still_.assign(count, 0);
  where_.assign(count, none);
  row_start_.assign(count + 1, 0);
  old_row_start_ = row_start_;
  for (auto *places : {&middle_, &step_, &from_, &to_}) places->reserve(model.node_count());
  // as much as a closed valve keeps, so that a live step seldom allocates
  for (auto *pairs : {&triangles_, &old_triangles_}) pairs->reserve(24 * model.node_count());
  for (auto *pairs : {&edges_, &old_edges_}) pairs->reserve(8 * edges);
  for (auto *pairs : {&blocks_, &old_blocks_}) pairs->reserve(24 * count);
  found_.reserve(24 * count);
  worn_.reserve(24 * count);
  for (auto *pairs : {&found_triangles_, &found_edges_}) pairs->reserve(2 * LeafSoA::most_pairs);
}

void VerletList::place_nodes() {
  const auto &start = tree_->block_start();
  std::vector<uint32_t> last(model_->node_count(), none);
  node_start_ = {0};
  for (uint32_t block = 0; block + 1 < start.size(); ++block) {
    for (uint32_t k = start[block]; k < start[block + 1]; ++k) {
      for (const uint32_t i : model_->valve.triangles[tree_->triangles()[k]]) {
        if (last[i] != block) node_.push_back(i);
        last[i] = block;
      }
    }
    node_start_.push_back(static_cast<uint32_t>(node_.size()));
  }
}

bool VerletList::follow(const NodeWays &ways) {
  if (!move(ways) || is_wild()) return false;
  if (!holds(ways)) find_blocks(ways);
  if (find_used(ways)) look_again();
  return true;
}

// How each block has moved since the last round, and will on the way ahead.
bool VerletList::move(const NodeWays &ways) {
  if (middle_.empty()) middle_ = ways.middle;
  step_.resize(middle_.size());
  for (const uint32_t i : parts_->vertices()) {
    step_[i] = ways.middle[i] - middle_[i];
    if (!std::isfinite(step_[i].sum() + ways.half[i].sum())) {
      middle_.clear();
      from_.clear();
      blocks_.clear();
      return false;
    }
  }
  middle_ = ways.middle;
  ++round_;
  for (uint32_t block = 0; block < gone_.size(); ++block) {
    const Motion gone = motion_of(block, step_);
    gone_[block].common += gone.common;
    gone_[block].beside += gone.beside;
    half_[block] = motion_of(block, ways.half);
  }
  return true;
}

// Whether blocks are torn about so much that each would be looked at again on every way; until they
// are half as many, so that not all are looked at in between.
bool VerletList::is_wild() {
  const auto count = std::count_if(half_.begin(), half_.end(), [&](const Motion &half) {
    return half.beside > wild * thickness_;
  });
  const double many = wild_ ? 0.5 * many_wild : many_wild;
  const bool is_now = static_cast<double>(count) > many * static_cast<double>(half_.size());
  calm_ = is_now ? 0 : calm_ + 1;
  wild_ = is_now || (wild_ && calm_ < calm_rounds);
  return wild_;
}

VerletList::Motion VerletList::motion_of(uint32_t block, const std::vector<Vec3> &nodes) const {
  const uint32_t first = node_start_[block], last = node_start_[block + 1];
  Vec3 low = nodes[node_[first]], high = low;
  for (uint32_t k = first + 1; k < last; ++k) {
    low = low.cwiseMin(nodes[node_[k]]);
    high = high.cwiseMax(nodes[node_[k]]);
  }
  Motion motion{0.5 * (low + high), 0};
  for (uint32_t k = first; k < last; ++k) {
    motion.beside = std::max(motion.beside, (nodes[node_[k]] - motion.common).squaredNorm());
  }
  motion.beside = std::sqrt(motion.beside);
  return motion;
}

// Whether no other blocks than those found have come near enough to each other to act.
bool VerletList::holds(const NodeWays &ways) const {
  if (from_.empty() || (pace_ != ways.pace && pace_ != StepMotion::independent)) return false;
  const double needed = thickness_ * (1 + rounding) + 2 * ways.slack;
  if (!(needed <= margin_)) return false;
  const double most = 0.25 * (margin_ - needed) * (margin_ - needed);
  for (const uint32_t i : parts_->vertices()) {
    if ((ways.from[i] - from_[i]).squaredNorm() > most) return false;
    if ((ways.to[i] - to_[i]).squaredNorm() > most) return false;
  }
  return true;
}

void VerletList::find_blocks(const NodeWays &ways) {
  from_ = ways.from;
  to_ = ways.to;
  pace_ = ways.pace;
  margin_ = (1 + early) * thickness_ + 2 * ways.slack;
  lanes_->begin(from_, to_, pace_);
  tree_->place(lanes_->place_boxes(), still_);
  found_.clear();
  tree_->for_near_blocks(lanes_->margin(margin_), [&](uint32_t a, uint32_t b) {
    found_.push_back({std::min(a, b), std::max(a, b)});
  });
  keep_blocks();
}

// What is known of blocks that are still near is kept: by the rows of the lower ones.
void VerletList::keep_blocks() {
  row_start_.swap(old_row_start_);
  blocks_.swap(old_blocks_);
  row_start_.assign(where_.size() + 1, 0);
  if (old_blocks_.empty()) old_row_start_ = row_start_;
  for (const auto &[a, b] : found_) ++row_start_[a + 1];
  for (size_t a = 0; a < where_.size(); ++a) row_start_[a + 1] += row_start_[a];
  blocks_.resize(found_.size());
  for (const auto &[a, b] : found_) blocks_[row_start_[a]++] = {a, b};
  for (size_t a = where_.size(); a > 0; --a) row_start_[a] = row_start_[a - 1];
  row_start_[0] = 0;
  for (size_t a = 0; a < where_.size(); ++a) {
    const uint32_t first = old_row_start_[a], last = old_row_start_[a + 1];
    for (uint32_t k = first; k < last; ++k) where_[old_blocks_[k].b] = k;
    for (uint32_t k = row_start_[a]; k < row_start_[a + 1]; ++k) {
      const uint32_t old = where_[blocks_[k].b];
      if (old != none) blocks_[k] = old_blocks_[old];
    }
    for (uint32_t k = first; k < last; ++k) where_[old_blocks_[k].b] = none;
  }
}

// What blocks have used of their skins. True if one has to be looked at.
bool VerletList::find_used(const NodeWays &ways) {
  const double error = rounding * thickness_;
  for (size_t block = 0; ways.pace == StepMotion::independent && block < half_.size(); ++block) {
    longest_half_[block] = half_[block].common.norm() + half_[block].beside;
  }
  worn_.assign(blocks_.size(), 0);
  bool any = false;
  const size_t turn = round_ % turns * blocks_.size() / turns;
  const size_t next_turn = (round_ % turns + 1) * blocks_.size() / turns;
  for (size_t k = 0; k < blocks_.size(); ++k) {
    VerletBlocks &p = blocks_[k];
    const Motion &a = gone_[p.a], &b = gone_[p.b], &to_a = half_[p.a], &to_b = half_[p.b];
    p.reach = 2 * ways.slack + error +
              (ways.pace == StepMotion::independent
                   ? longest_half_[p.a] + longest_half_[p.b]
                   : (to_a.common - to_b.common).norm() + to_a.beside + to_b.beside);
    p.used = error + (a.common - b.common - p.between).norm() + (a.beside + b.beside - p.beside);
    const bool its_turn = k >= turn && k < next_turn;
    worn_[k] = !(p.used + p.reach <= p.skin) || (its_turn && p.used > worn * (p.skin - p.reach));
    any = any || worn_[k];
  }
  return any;
}

void VerletList::look_again() {
  lanes_->begin(middle_, middle_, StepMotion::together);
  triangles_.swap(old_triangles_);
  edges_.swap(old_edges_);
  triangles_.clear();
  edges_.clear();
  for (size_t k = 0; k < blocks_.size(); ++k) {
    VerletBlocks &p = blocks_[k];
    const auto first_triangle = static_cast<uint32_t>(triangles_.size());
    const auto first_edge = static_cast<uint32_t>(edges_.size());
    if (worn_[k]) {
      look(p);
    } else {
      triangles_.insert(triangles_.end(), old_triangles_.begin() + p.first_triangle,
                        old_triangles_.begin() + p.last_triangle);
      edges_.insert(edges_.end(), old_edges_.begin() + p.first_edge,
                    old_edges_.begin() + p.last_edge);
    }
    p.first_triangle = first_triangle;
    p.last_triangle = static_cast<uint32_t>(triangles_.size());
    p.first_edge = first_edge;
    p.last_edge = static_cast<uint32_t>(edges_.size());
  }
}

void VerletList::look(VerletBlocks &p) {
  p.between = gone_[p.a].common - gone_[p.b].common;
  p.beside = gone_[p.a].beside + gone_[p.b].beside;
  p.used = rounding * thickness_;
  p.skin = skin_ + ahead * p.reach;
  lanes_->place(p.a);
  lanes_->place(p.b);
  // rounding makes that no more
  const double gap = gap_of(lanes_->way_of(p.a), lanes_->way_of(p.b)) - lanes_->margin(0);
  if (gap > thickness_ + p.skin) {
    p.skin = gap - thickness_;
    return;
  }
  const float facing = lanes_->margin(thickness_ + p.skin), near = lanes_->margin(guard_ + p.skin);
  lanes_->meet(p.a, p.b, facing, near, found_triangles_, found_edges_);
  take_triangles(p);
  take_edges(p);
}

void VerletList::take_triangles(const VerletBlocks &p) {
  const auto &triangles = model_->valve.triangles.get();
  for_rows(found_triangles_, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(rows_, k, middle_, pair[k][0], triangles[pair[k][1]]);
    }
    measure_triangles(rows_, count);
    for (uint32_t k = 0; k < count; ++k) {
      take(p, pair[k][0], pair[k][1], std::sqrt(rows_.distance2[k]));
    }
  });
  found_triangles_.clear();
}

void VerletList::take(const VerletBlocks &p, uint32_t vertex, uint32_t triangle, double distance) {
  const double over = distance - thickness_;
  if (over > p.skin) return;
  if ((*rest_distance_filter_)(vertex, triangle)) {
    triangles_.push_back({vertex, triangle, guard_, over, true});
    return;
  }
  if (distance > guard_ + p.skin) return;
  const Tri &t = model_->valve.triangles[triangle];
  const double guard = barrier_range(thickness_, distance_of(model_->valve.rest, vertex, t));
  if (distance <= guard + p.skin) {
    triangles_.push_back({vertex, triangle, guard, distance - guard, false});
  }
}

void VerletList::take_edges(const VerletBlocks &p) {
  const auto &edges = model_->topology.edges.get();
  for_rows(found_edges_, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(rows_, k, middle_, edges[pair[k][0]], edges[pair[k][1]]);
    }
    measure_segments(rows_, count);
    for (uint32_t k = 0; k < count; ++k) {
      take_edge_pair(p, pair[k][0], pair[k][1], std::sqrt(rows_.distance2[k]));
    }
  });
  found_edges_.clear();
}

// The lower one first: the rounding of their distance depends on it.
void VerletList::take_edge_pair(const VerletBlocks &p, uint32_t i, uint32_t j, double distance) {
  if (distance > guard_ + p.skin) return;
  const Edge &e = model_->topology.edges[i], &f = model_->topology.edges[j];
  const double guard = barrier_range(thickness_, distance_of(model_->valve.rest, e, f));
  if (distance <= guard + p.skin) edges_.push_back({i, j, guard, distance - guard});
}

}  // namespace mvs::core
