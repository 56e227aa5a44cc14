// The broad phase of one step: search of the hierarchy, or selection from the Verlet list, then the
// exact distance filter.
#include "collision/broad_phase.h"

#include <atomic>

#include "collision/contact_params.h"

namespace mvs::core {
namespace {

// Found pairs are filtered in batches of about this size.
constexpr size_t filter_batch = SharedSearch::filter_batch;

uint64_t next_serial() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

}  // namespace

BroadPhase::BroadPhase(const Model &model)
    : model_(&model),
      rest_distance_filter_(model),
      bvh_(model.valve.rest, model.valve.triangles),
      parts_(model, bvh_.topology()),
      leaves_(model, bvh_.topology(), parts_,
              contact_rest_distance * model.valve.contact_thickness),
      mask_(model, parts_, bvh_.topology()),
      filter_(model, rest_distance_filter_),
      sorter_(model.node_count()) {
  // more than a closed valve has, so that a live step seldom allocates
  const size_t pairs = 16 * parts_.vertices().size();
  for (StepCandidates *step : {&current_, &first_}) {
    step->lists.contact.reserve(pairs);
    step->lists.barrier.reserve(pairs);
    step->lists.barrier_edges.reserve(4 * model.topology.edges.size());
    for (auto *places :
         {&step->motion.from, &step->motion.to, &step->motion.middle, &step->motion.half}) {
      places->reserve(model.node_count());
    }
  }
  sorter_.reserve(pairs);
  for (auto *found : {&found_.triangles, &found_.edges}) {
    found->reserve(filter_batch + 2 * LeafSoA::most_pairs);
  }
}

void BroadPhase::build(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
                       StepMotion mode) {
  NodeMotion &motion = current_.motion;
  const bool is_first = motion.from != x || motion.to == motion.from;
  if (!is_first && current_.is_first) first_ = current_;
  current_.is_first = is_first;
  current_.serial = next_serial();
  mask_.compare(motion, x, to, slack == motion.slack && mode == motion.mode);
  motion.set(x, to, slack, mode);
  mask_.remove_changed(current_.lists);
  if (uses_verlet_list_ && !verlet_list_) {
    verlet_list_.emplace(*model_, parts_, leaves_, rest_distance_filter_, bvh_);
  }
  if (uses_verlet_list_ && list_count_++ >= lists_without_verlet && verlet_list_->update(motion)) {
    select_from_verlet_list();
  } else {
    search_hierarchy();
  }
  sorter_.sort(current_.lists, shared_.workers());
}

bool BroadPhase::recall(const std::vector<Vec3> &x, const std::vector<Vec3> &to) {
  if (!first_.is_first || first_.motion.from != x) return false;
  std::swap(current_, first_);
  if (valid_for(x) && valid_for(to)) return true;
  std::swap(current_, first_);
  return false;
}

// Gives the lists of search_hierarchy().
void BroadPhase::select_from_verlet_list() {
  const auto &skipped = mask_.skipped_leaves();
  for (const VerletBlocks &blocks : verlet_list_->blocks()) {
    if (skipped[blocks.a] && skipped[blocks.b]) continue;
    const double reached = blocks.drift + blocks.motion_bound;
    for (uint32_t k = blocks.first_triangle; k < blocks.last_triangle; ++k) {
      const VerletTriangle &p = verlet_list_->triangles()[k];
      if (p.gap <= reached) select(p, blocks);
    }
    for (uint32_t k = blocks.first_edge; k < blocks.last_edge; ++k) {
      const VerletEdges &p = verlet_list_->edges()[k];
      if (p.gap <= reached) found_.edges.push_back({p.first, p.second});
    }
    if (std::max(found_.triangles.size(), found_.edges.size()) >= filter_batch) filter_found();
  }
  filter_found();
}

// A pair whose drift is small enough is decided without its distance.
void BroadPhase::select(const VerletTriangle &p, const VerletBlocks &blocks) {
  const double thickness = model_->valve.contact_thickness;
  const bool surely_contact = p.is_contact && p.gap + blocks.drift <= 2 * current_.motion.slack;
  const double barrier_gap = p.gap + thickness - barrier_share * thickness;
  if (!surely_contact || !(barrier_gap > blocks.drift + blocks.motion_bound)) {
    found_.triangles.push_back({p.vertex, p.triangle});
  } else if (!mask_.is_skipped(p.vertex, p.triangle)) {
    current_.lists.contact.push_back({p.vertex, p.triangle, 0});
  }
}

void BroadPhase::search_hierarchy() {
  const NodeMotion &motion = current_.motion;
  const double thickness = model_->valve.contact_thickness;
  leaves_.set_motion(motion.from, motion.to, motion.mode);
  const bool together = shared_.pays(model_->valve.triangles.size());
  bvh_.refit(leaves_.update_all(together ? shared_.workers() : nullptr), mask_.skipped_leaves());
  const float contact = leaves_.margin(thickness + 2 * motion.slack);
  const float barrier = leaves_.margin(barrier_share * thickness + 2 * motion.slack);
  if (together) {
    shared_.search({motion, leaves_, bvh_, mask_, filter_, contact, barrier}, current_.lists);
    return;
  }
  bvh_.for_near_leaves(contact, [&](uint32_t a, uint32_t b) {
    leaves_.find_pairs(a, b, contact, barrier, found_);
    if (std::max(found_.triangles.size(), found_.edges.size()) >= filter_batch) filter_found();
  });
  filter_found();
}

void BroadPhase::filter_found() {
  mask_.remove_skipped(found_);
  filter_.add(current_.motion, found_, current_.lists);
  found_.clear();
}

}  // namespace mvs::core
