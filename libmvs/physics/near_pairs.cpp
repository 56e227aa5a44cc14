// Keeping near pairs.
#include "physics/near_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/contact.h"
#include "physics/pair_distance.h"

namespace mvs {
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
// Of the contact thickness: more than distances are wrong by, of near parallel edges too.
constexpr double rounding = 1e-5;

template <typename Nodes>
Way::Box box_of(const Nodes &nodes, const std::vector<Vec3> &x) {
  Way::Box box;
  for (const uint32_t i : nodes) box.add(x[i].data());
  return box;
}

double distance_of(const Way::Box &a, const Way::Box &b) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double gap = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

bool apart(const Way::Box &a, const Way::Box &b, double margin) {
  for (size_t k = 0; k < 3; ++k) {
    if (a.low[k] - b.high[k] > margin || b.low[k] - a.high[k] > margin) return true;
  }
  return false;
}

}  // namespace

NearPairs::NearPairs(const Model &model, const SheetParts &parts, const RestApart &apart_at_rest,
                     MovingTree &tree)
    : model_(&model),
      parts_(&parts),
      apart_at_rest_(&apart_at_rest),
      tree_(&tree),
      thickness_(model.valve.contact_thickness),
      guard_(guard_share * thickness_),
      skin_(skin * thickness_) {
  place_nodes();
  const size_t count = tree.block_start().size() - 1, edges = model.topology.edges.size();
  gone_.resize(count);
  half_.resize(count);
  longest_half_.resize(count);
  place_.resize(count);
  edge_box_.resize(edges);
  still_.assign(model.valve.triangles.size(), 0);
  where_.assign(count, none);
  row_start_.assign(count + 1, 0);
  // as much as a closed valve keeps, so that a live step seldom allocates
  for (auto *pairs : {&triangles_, &old_triangles_}) pairs->reserve(24 * model.node_count());
  for (auto *pairs : {&edges_, &old_edges_}) pairs->reserve(8 * edges);
  for (auto *pairs : {&blocks_, &old_blocks_}) pairs->reserve(24 * count);
  found_.reserve(24 * count);
  worn_.reserve(24 * count);
}

void NearPairs::place_nodes() {
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

bool NearPairs::follow(const NodeWays &ways) {
  if (!move(ways) || is_wild()) return false;
  if (!holds(ways)) find_blocks(ways);
  if (find_used(ways)) look_again();
  return true;
}

// How each block has moved since the last round, and will on the way ahead.
bool NearPairs::move(const NodeWays &ways) {
  if (middle_.empty()) middle_ = ways.middle;
  step_.resize(middle_.size());
  double farthest = 0;
  for (const uint32_t i : parts_->vertices()) {
    step_[i] = ways.middle[i] - middle_[i];
    farthest = std::max(farthest, ways.middle[i].cwiseAbs().maxCoeff());
    if (!std::isfinite(step_[i].sum() + ways.half[i].sum())) {
      middle_.clear();
      from_.clear();
      blocks_.clear();
      return false;
    }
  }
  middle_ = ways.middle;
  error_ = 4 * 0x1p-24 * farthest;
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
bool NearPairs::is_wild() {
  const auto count = std::count_if(half_.begin(), half_.end(), [&](const Motion &half) {
    return half.beside > wild * thickness_;
  });
  const double many = wild_ ? 0.5 * many_wild : many_wild;
  wild_ = static_cast<double>(count) > many * static_cast<double>(half_.size());
  return wild_;
}

NearPairs::Motion NearPairs::motion_of(uint32_t block, const std::vector<Vec3> &nodes) const {
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
bool NearPairs::holds(const NodeWays &ways) const {
  if (from_.empty() || (pace_ != ways.pace && pace_ != Pace::each_for_itself)) return false;
  const double needed = thickness_ * (1 + rounding) + 2 * ways.slack;
  if (!(needed <= margin_)) return false;
  const double most = 0.25 * (margin_ - needed) * (margin_ - needed);
  for (const uint32_t i : parts_->vertices()) {
    if ((ways.from[i] - from_[i]).squaredNorm() > most) return false;
    if ((ways.to[i] - to_[i]).squaredNorm() > most) return false;
  }
  return true;
}

void NearPairs::find_blocks(const NodeWays &ways) {
  from_ = ways.from;
  to_ = ways.to;
  pace_ = ways.pace;
  margin_ = (1 + early) * thickness_ + 2 * ways.slack;
  tree_->place(from_, to_, pace_, still_);
  found_.clear();
  tree_->for_near_blocks(margin_, [&](uint32_t a, uint32_t b) {
    found_.push_back({std::min(a, b), std::max(a, b)});
  });
  keep_blocks();
}

// What is known of blocks that are still near is kept: by the rows of the lower ones.
void NearPairs::keep_blocks() {
  row_start_.swap(old_row_start_);
  blocks_.swap(old_blocks_);
  row_start_.assign(where_.size() + 1, 0);
  if (old_row_start_.empty() || old_blocks_.empty()) old_row_start_ = row_start_;
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
bool NearPairs::find_used(const NodeWays &ways) {
  const double error = rounding * thickness_;
  for (size_t block = 0; ways.pace == Pace::each_for_itself && block < half_.size(); ++block) {
    longest_half_[block] = half_[block].common.norm() + half_[block].beside;
  }
  worn_.assign(blocks_.size(), 0);
  bool any = false;
  const size_t turn = round_ % turns * blocks_.size() / turns;
  const size_t next_turn = (round_ % turns + 1) * blocks_.size() / turns;
  for (size_t k = 0; k < blocks_.size(); ++k) {
    NearBlocks &p = blocks_[k];
    const Motion &a = gone_[p.a], &b = gone_[p.b], &to_a = half_[p.a], &to_b = half_[p.b];
    p.reach = 2 * ways.slack + error +
              (ways.pace == Pace::each_for_itself
                   ? longest_half_[p.a] + longest_half_[p.b]
                   : (to_a.common - to_b.common).norm() + to_a.beside + to_b.beside);
    p.used = error + (a.common - b.common - p.between).norm() + (a.beside + b.beside - p.beside);
    const bool its_turn = k >= turn && k < next_turn;
    worn_[k] = !(p.used + p.reach <= p.skin) || (its_turn && p.used > worn * (p.skin - p.reach));
    any = any || worn_[k];
  }
  return any;
}

void NearPairs::look_again() {
  triangles_.swap(old_triangles_);
  edges_.swap(old_edges_);
  triangles_.clear();
  edges_.clear();
  for (size_t k = 0; k < blocks_.size(); ++k) {
    NearBlocks &p = blocks_[k];
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

void NearPairs::look(NearBlocks &p) {
  p.between = gone_[p.a].common - gone_[p.b].common;
  p.beside = gone_[p.a].beside + gone_[p.b].beside;
  p.used = rounding * thickness_;
  p.skin = skin_ + ahead * p.reach;
  const double gap = distance_of(place(p.a).box, place(p.b).box);
  if (gap > thickness_ + p.skin) {
    p.skin = gap - thickness_;
    return;
  }
  take_vertices(p, p.a, p.b);
  if (p.a != p.b) take_vertices(p, p.b, p.a);
  if (gap <= guard_ + p.skin) take_edges(p);
}

// Where a block is in the middle of its way.
const NearPairs::Place &NearPairs::place(uint32_t block) {
  Place &place = place_[block];
  if (place.round == round_) return place;
  place.round = round_;
  place.box = {};
  place.lanes.clear();
  const uint32_t first = tree_->block_start()[block], last = tree_->block_start()[block + 1];
  for (uint32_t k = first; k < last; ++k) {
    const uint32_t t = tree_->triangles()[k];
    const Way::Box box = box_of(model_->valve.triangles[t], middle_);
    place.triangle[k - first] = box;
    place.lanes.set(k - first, {box, box});
    place.box.add(box);
    for (const uint32_t e : parts_->edges_of(t)) {
      edge_box_[e] = box_of(model_->topology.edges[e], middle_);
    }
  }
  return place;
}

void NearPairs::take_vertices(const NearBlocks &p, uint32_t of, uint32_t in) {
  const Place &there = place(in);
  const uint32_t *triangle = tree_->triangles().data() + tree_->block_start()[in];
  const double margin = thickness_ + p.skin, near = guard_ + p.skin;
  for (const uint32_t v : parts_->vertices_of(of)) {
    const Way::Box box = box_of(std::array<uint32_t, 1>{v}, middle_);
    if (apart(box, there.box, margin)) continue;
    uint32_t lanes = there.lanes.near({{box, box}, margin + error_});
    if (lanes == 0) continue;
    const uint32_t guarded = there.lanes.near({{box, box}, near + error_});
    for (; lanes != 0; lanes &= lanes - 1) {
      const uint32_t t = triangle[std::countr_zero(lanes)];
      if ((guarded & lanes & -lanes) != 0) {
        take_guarded(p, v, t);
      } else if ((*apart_at_rest_)(v, t)) {
        take_facing(p, v, t);
      }
    }
  }
}

void NearPairs::take_facing(const NearBlocks &p, uint32_t vertex, uint32_t triangle) {
  const double over = distance_of(middle_, vertex, model_->valve.triangles[triangle]) - thickness_;
  if (over <= p.skin) triangles_.push_back({vertex, triangle, guard_, over, true});
}

void NearPairs::take_guarded(const NearBlocks &p, uint32_t vertex, uint32_t triangle) {
  const Tri &t = model_->valve.triangles[triangle];
  if (has(t, vertex)) return;
  if ((*apart_at_rest_)(vertex, triangle)) {
    take_facing(p, vertex, triangle);
    return;
  }
  const double distance = distance_of(middle_, vertex, t);
  if (distance > guard_ + p.skin) return;
  const double guard = guard_range(thickness_, distance_of(model_->valve.rest, vertex, t));
  if (distance <= guard + p.skin) {
    triangles_.push_back({vertex, triangle, guard, distance - guard, false});
  }
}

void NearPairs::take_edges(const NearBlocks &p) {
  const Place &a = place(p.a), &b = place(p.b);
  const auto &start = tree_->block_start();
  const uint32_t *of_a = tree_->triangles().data() + start[p.a];
  const uint32_t *of_b = tree_->triangles().data() + start[p.b];
  const double margin = guard_ + p.skin;
  for (uint32_t k = 0; k < start[p.a + 1] - start[p.a]; ++k) {
    if (apart(a.triangle[k], b.box, margin)) continue;
    const NarrowWay way({a.triangle[k], a.triangle[k]}, margin + error_);
    for (uint32_t lanes = b.lanes.near(way); lanes != 0; lanes &= lanes - 1) {
      const auto l = static_cast<uint32_t>(std::countr_zero(lanes));
      // of a block and itself each pair of triangles comes up twice
      if (p.a != p.b || of_a[k] < of_b[l]) take_edges(p, of_a[k], of_b[l]);
    }
  }
}

void NearPairs::take_edges(const NearBlocks &p, uint32_t a, uint32_t b) {
  const auto &edges = model_->topology.edges.get();
  for (const uint32_t mine : parts_->edges_of(a)) {
    for (const uint32_t other : parts_->edges_of(b)) {
      if (share(edges[mine], edges[other])) continue;
      if (apart(edge_box_[mine], edge_box_[other], guard_ + p.skin)) continue;
      take_edge_pair(p, std::min(mine, other), std::max(mine, other));
    }
  }
}

// The lower one first: the rounding of their distance depends on it.
void NearPairs::take_edge_pair(const NearBlocks &p, uint32_t i, uint32_t j) {
  const Edge &e = model_->topology.edges[i], &f = model_->topology.edges[j];
  const double distance = distance_of(middle_, e, f);
  if (distance > guard_ + p.skin) return;
  const double guard = guard_range(thickness_, distance_of(model_->valve.rest, e, f));
  if (distance <= guard + p.skin) edges_.push_back({i, j, guard, distance - guard});
}

}  // namespace mvs
