// Distances of many pairs at a time.
#include "collision/candidate_filter.h"

#include <cmath>

#include "collision/contact_params.h"
#include "collision/pair_distance.h"

namespace mvs::core {

CandidateFilter::CandidateFilter(const Model &model, const RestDistanceFilter &rest_distance_filter)
    : model_(&model),
      rest_distance_filter_(&rest_distance_filter),
      thickness_(model.valve.contact_thickness),
      longest_barrier_(barrier_share * thickness_) {}

void CandidateFilter::add(const NodeMotion &motion, const FoundPairs &found,
                          CandidateLists &lists) {
  add_triangles(motion, found.triangles, lists);
  add_edges(motion, found.edges, lists);
}

void CandidateFilter::add_triangles(const NodeMotion &motion, const std::vector<Edge> &found,
                                    CandidateLists &lists) {
  const auto &triangles = model_->valve.triangles.get();
  for_batches(found, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(middle_, k, motion.middle, pair[k][0], triangles[pair[k][1]]);
      set_pair(half_, k, motion.half, pair[k][0], triangles[pair[k][1]]);
    }
    measure_triangles(middle_, count);
    measure_farthest(half_, count, 1);
    for (uint32_t k = 0; k < count; ++k) {
      const std::array<uint32_t, 1> vertex{pair[k][0]};
      const double approach = motion.is_independent()
                                  ? motion.max_approach(vertex, triangles[pair[k][1]])
                                  : 2 * motion.slack + std::sqrt(half_.distance2[k]);
      add_triangle(motion, pair[k], std::sqrt(middle_.distance2[k]), approach, lists);
    }
  });
}

// A pair that is apart at rest is a contact candidate. A pair in the range of its barrier is a
// barrier candidate, whatever its distance at rest. Boxes around the ends of two motions are no
// farther apart than the motions are in the middle plus their approach.
void CandidateFilter::add_triangle(const NodeMotion &motion, const Edge &pair, double middle,
                                   double approach, CandidateLists &lists) const {
  const auto [vertex, triangle] = pair;
  const double distance = middle - approach;
  if (!(distance <= thickness_)) return;
  const bool is_contact = (*rest_distance_filter_)(vertex, triangle);
  if (!is_contact && distance > longest_barrier_) return;
  const Tri &t = model_->valve.triangles[triangle];
  const double margin = (is_contact ? thickness_ : longest_barrier_) + 2 * motion.slack;
  const bool surely_near = middle + approach - 2 * motion.slack < margin * (1 - 1e-9);
  if (!surely_near &&
      apart(motion.swept_box(std::array<uint32_t, 1>{vertex}), motion.swept_box(t), margin)) {
    return;
  }
  if (is_contact) lists.contact.push_back({vertex, triangle, 0});
  if (distance > longest_barrier_) return;
  const double range = barrier_range(thickness_, distance_of(model_->valve.rest, vertex, t));
  if (distance <= range) lists.barrier.push_back({vertex, triangle, range});
}

void CandidateFilter::add_edges(const NodeMotion &motion, const std::vector<Edge> &found,
                                CandidateLists &lists) {
  const auto &edges = model_->topology.edges.get();
  for_batches(found, [&](const Edge *pair, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      set_pair(middle_, k, motion.middle, edges[pair[k][0]], edges[pair[k][1]]);
      set_pair(half_, k, motion.half, edges[pair[k][0]], edges[pair[k][1]]);
    }
    measure_segments(middle_, count);
    measure_farthest(half_, count, 2);
    for (uint32_t k = 0; k < count; ++k) {
      const double approach = motion.is_independent()
                                  ? motion.max_approach(edges[pair[k][0]], edges[pair[k][1]])
                                  : 2 * motion.slack + std::sqrt(half_.distance2[k]);
      add_edge_pair(motion, pair[k], std::sqrt(middle_.distance2[k]) - approach, lists);
    }
  });
}

void CandidateFilter::add_edge_pair(const NodeMotion &motion, const Edge &pair, double distance,
                                    CandidateLists &lists) const {
  if (!(distance <= longest_barrier_)) return;
  const Edge &e = model_->topology.edges[pair[0]], &f = model_->topology.edges[pair[1]];
  const double range = barrier_range(thickness_, distance_of(model_->valve.rest, e, f));
  if (distance > range ||
      apart(motion.swept_box(e), motion.swept_box(f), longest_barrier_ + 2 * motion.slack)) {
    return;
  }
  lists.barrier_edges.push_back({pair[0], pair[1], range});
}

}  // namespace mvs::core
