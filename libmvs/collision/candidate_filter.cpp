// Distances of many pairs at a time.
#include "collision/candidate_filter.h"

#include <cmath>

#include "collision/contact_params.h"
#include "collision/pair_distance.h"
#include "collision/swept_hulls.h"

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
// barrier candidate, whatever its distance at rest.
void CandidateFilter::add_triangle(const NodeMotion &motion, const Edge &pair, double middle,
                                   double approach, CandidateLists &lists) const {
  const auto [vertex, triangle] = pair;
  const double distance = middle - approach;
  if (!(distance <= thickness_)) return;
  const bool is_contact = (*rest_distance_filter_)(vertex, triangle);
  const bool maybe_barrier = distance <= longest_barrier_;
  if (!is_contact && !maybe_barrier) return;
  const Tri &t = model_->valve.triangles[triangle];
  const double range =
      maybe_barrier ? barrier_range(thickness_, distance_of(model_->valve.rest, vertex, t)) : 0;
  const bool is_barrier = maybe_barrier && distance <= range;
  if (!is_contact && !is_barrier) return;
  const double margin = (is_contact ? thickness_ : range) + 2 * motion.slack;
  if (middle > margin && keep_apart(motion, vertex, t, margin)) return;
  if (is_contact) lists.contact.push_back({vertex, triangle, 0});
  if (is_barrier) lists.barrier.push_back({vertex, triangle, range});
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
      add_edge_pair(motion, pair[k], std::sqrt(middle_.distance2[k]), approach, lists);
    }
  });
}

void CandidateFilter::add_edge_pair(const NodeMotion &motion, const Edge &pair, double middle,
                                    double approach, CandidateLists &lists) const {
  if (!(middle - approach <= longest_barrier_)) return;
  const Edge &e = model_->topology.edges[pair[0]], &f = model_->topology.edges[pair[1]];
  const double range = barrier_range(thickness_, distance_of(model_->valve.rest, e, f));
  if (middle - approach > range) return;
  const double margin = range + 2 * motion.slack;
  if (middle > margin && keep_apart(motion, e, f, margin)) return;
  lists.barrier_edges.push_back({pair[0], pair[1], range});
}

}  // namespace mvs::core
