// Renewal of the list.
#include "collision/verlet_list.h"

#include <algorithm>
#include <cmath>

#include "collision/contact_params.h"
#include "collision/pair_distance.h"

namespace mvs::core {
namespace {

// Skin between two blocks at rest to each other, as a share of the contact thickness. A thicker one
// keeps more pairs than can act, a thinner one expires more often.
constexpr double skin_at_rest = 0.3;
// Extra skin of blocks that move, as a share of their motion bound.
constexpr double skin_of_motion = 1.2;
// Every so many steps each pair of blocks has its turn: it is renewed if it has used up this share
// of its skin.
constexpr size_t turns = 16;
constexpr double used_at_turn = 0.5;
// As a share of the contact thickness, more than the rounding error of a distance, also of nearly
// parallel edges.
constexpr double distance_error = 1e-5;

double distance_of_boxes(const SweptAabbF &a, const SweptAabbF &b) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double above = a.start_low[k] - b.start_high[k], below = b.start_low[k] - a.start_high[k];
    const double gap = std::max({0.0, above, below});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

}  // namespace

VerletList::VerletList(const Model &model, const LeafParts &parts, LeafSoA &leaves,
                       const RestDistanceFilter &rest_distance_filter, SweptBvh &bvh)
    : model_(&model),
      leaves_(&leaves),
      rest_distance_filter_(&rest_distance_filter),
      bvh_(&bvh),
      thickness_(model.valve.contact_thickness),
      longest_barrier_(barrier_share * thickness_),
      motion_(model, bvh.topology(), parts),
      pairs_(model, parts, bvh.topology().leaf_count()) {
  // as much as a closed valve keeps, so that a live step seldom allocates
  for (auto *pairs : {&triangles_, &old_triangles_}) pairs->reserve(24 * model.node_count());
  for (auto *pairs : {&edges_, &old_edges_}) pairs->reserve(8 * model.topology.edges.size());
  expired_.reserve(size_t{24} * motion_.block_count());
  for (auto *pairs : {&found_.triangles, &found_.edges}) pairs->reserve(2 * LeafSoA::most_pairs);
}

bool VerletList::update(const NodeMotion &motion) {
  if (!motion_.advance(motion)) {
    pairs_.clear();
    return false;
  }
  if (motion_.is_wild()) return false;
  pairs_.update(motion, distance_error, *leaves_, *bvh_);
  if (find_expired(motion)) renew_expired();
  return true;
}

// Sets the drift and motion bound of each pair of blocks. Returns whether any has expired.
bool VerletList::find_expired(const NodeMotion &motion) {
  const double error = distance_error * thickness_;
  auto &blocks = pairs_.blocks();
  expired_.assign(blocks.size(), 0);
  bool any = false;
  const size_t turn = motion_.step_count() % turns;
  const size_t turn_begin = turn * blocks.size() / turns;
  const size_t turn_end = (turn + 1) * blocks.size() / turns;
  for (size_t k = 0; k < blocks.size(); ++k) {
    VerletBlocks &p = blocks[k];
    const BlockDisplacement &a = motion_.total(p.a), &b = motion_.total(p.b);
    p.motion_bound = 2 * motion.slack + error + motion_.max_approach(p.a, p.b);
    p.drift = error + (a.common - b.common - p.reference_offset).norm() +
              (a.deviation + b.deviation - p.reference_deviation);
    const bool has_turn = k >= turn_begin && k < turn_end;
    expired_[k] = !(p.drift + p.motion_bound <= p.skin) ||
                  (has_turn && p.drift > used_at_turn * (p.skin - p.motion_bound));
    any = any || expired_[k];
  }
  return any;
}

void VerletList::renew_expired() {
  leaves_->set_motion(motion_.middle(), motion_.middle(), StepMotion::together);
  triangles_.swap(old_triangles_);
  edges_.swap(old_edges_);
  triangles_.clear();
  edges_.clear();
  auto &blocks = pairs_.blocks();
  for (size_t k = 0; k < blocks.size(); ++k) {
    VerletBlocks &p = blocks[k];
    const auto first_triangle = static_cast<uint32_t>(triangles_.size());
    const auto first_edge = static_cast<uint32_t>(edges_.size());
    if (expired_[k]) {
      renew(p);
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

void VerletList::renew(VerletBlocks &p) {
  const BlockDisplacement &a = motion_.total(p.a), &b = motion_.total(p.b);
  p.reference_offset = a.common - b.common;
  p.reference_deviation = a.deviation + b.deviation;
  p.drift = distance_error * thickness_;
  p.skin = skin_at_rest * thickness_ + skin_of_motion * p.motion_bound;
  leaves_->update(p.a);
  leaves_->update(p.b);
  // the margin is for rounding, which may only make the gap smaller
  const double gap =
      distance_of_boxes(leaves_->box_of(p.a), leaves_->box_of(p.b)) - leaves_->margin(0);
  if (gap > thickness_ + p.skin) {
    p.skin = gap - thickness_;
    return;
  }
  leaves_->find_pairs(p.a, p.b, leaves_->margin(thickness_ + p.skin),
                      leaves_->margin(longest_barrier_ + p.skin), found_);
  add_triangles(p.skin);
  add_edges(p.skin);
  found_.clear();
}

void VerletList::add_triangles(double skin) {
  const auto &triangles = model_->valve.triangles.get();
  for_batches(found_.triangles, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(batch_, k, motion_.middle(), pair[k][0], triangles[pair[k][1]]);
    }
    measure_triangles(batch_, count);
    for (uint32_t k = 0; k < count; ++k) {
      add_triangle(pair[k], std::sqrt(batch_.distance2[k]), skin);
    }
  });
}

void VerletList::add_triangle(const Edge &pair, double distance, double skin) {
  const auto [vertex, triangle] = pair;
  const double gap = distance - thickness_;
  if (gap > skin) return;
  if ((*rest_distance_filter_)(vertex, triangle)) {
    triangles_.push_back({vertex, triangle, gap, true});
    return;
  }
  if (distance > longest_barrier_ + skin) return;
  const Tri &t = model_->valve.triangles[triangle];
  const double range = barrier_range(thickness_, distance_of(model_->valve.rest, vertex, t));
  if (distance <= range + skin) triangles_.push_back({vertex, triangle, distance - range, false});
}

void VerletList::add_edges(double skin) {
  const auto &edges = model_->topology.edges.get();
  for_batches(found_.edges, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(batch_, k, motion_.middle(), edges[pair[k][0]], edges[pair[k][1]]);
    }
    measure_segments(batch_, count);
    for (uint32_t k = 0; k < count; ++k) {
      add_edge_pair(pair[k], std::sqrt(batch_.distance2[k]), skin);
    }
  });
}

// The lower edge first: the rounding of the distance depends on the order.
void VerletList::add_edge_pair(const Edge &pair, double distance, double skin) {
  if (distance > longest_barrier_ + skin) return;
  const Edge &e = model_->topology.edges[pair[0]], &f = model_->topology.edges[pair[1]];
  const double range = barrier_range(thickness_, distance_of(model_->valve.rest, e, f));
  if (distance <= range + skin) edges_.push_back({pair[0], pair[1], distance - range});
}

}  // namespace mvs::core
