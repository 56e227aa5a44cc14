// Gaps of barrier candidates, and the candidates that remain after the nodes have moved.
#include "collision/near_barriers.h"

#include <algorithm>
#include <cmath>

#include "collision/approach.h"
#include "collision/pair_distance.h"

namespace mvs::core {
namespace {

// As a share of the contact thickness, more than the rounding error of a distance, also of nearly
// parallel edges (verlet_list.cpp), and of motions and gaps in single precision.
constexpr double distance_error = 1e-5;
// Share of the candidates that makes a new measurement pay: one takes about as long as a sixth of
// the candidates in the narrow phase.
constexpr size_t many = 6;

}  // namespace

void NearBarriers::select(const Model &model, const BroadPhase &broad_phase,
                          const std::vector<Vec3> &x, const std::vector<Vec3> *dx) {
  triangles_ = &broad_phase.barrier_candidates();
  edges_ = &broad_phase.barrier_edge_candidates();
  const size_t candidates = triangles_->size() + edges_->size();
  if (candidates < least_) return;
  const bool is_known = serial_ == broad_phase.serial() && at_.size() == x.size();
  if (!is_known) measure(model, broad_phase, x);
  find_motion(model, x, dx);
  const size_t taken = take_near(broad_phase);
  if (is_known && taken * many > candidates && 2 * farthest_ > step_) {
    measure(model, broad_phase, x);
    find_motion(model, x, dx);
    take_near(broad_phase);
  }
  triangles_ = &near_triangles_;
  edges_ = &near_edges_;
}

void NearBarriers::measure(const Model &model, const BroadPhase &broad_phase,
                           const std::vector<Vec3> &x) {
  serial_ = broad_phase.serial();
  at_ = x;
  const double error = distance_error * model.valve.contact_thickness;
  DistanceBatch batch;
  const auto measure_all = [&](const auto &list, std::vector<float> &gap, const auto &set,
                               const auto &measure_batch) {
    gap.resize(list.size());
    for (size_t first = 0; first < list.size(); first += DistanceBatch::most) {
      const auto count =
          static_cast<uint32_t>(std::min<size_t>(DistanceBatch::most, list.size() - first));
      for (uint32_t k = 0; k < count; ++k) set(k, list[first + k]);
      measure_batch(batch, count);
      for (uint32_t k = 0; k < count; ++k) {
        gap[first + k] =
            static_cast<float>(std::sqrt(batch.distance2[k]) - list[first + k].range - error);
      }
    }
  };
  measure_all(
      broad_phase.barrier_candidates(), triangle_gap_,
      [&](uint32_t k, const VertexTriangle &c) {
        set_pair(batch, k, x, c.vertex, model.valve.triangles[c.triangle]);
      },
      measure_triangles);
  measure_all(
      broad_phase.barrier_edge_candidates(), edge_gap_,
      [&](uint32_t k, const EdgeEdge &c) {
        set_pair(batch, k, x, model.topology.edges[c.first], model.topology.edges[c.second]);
      },
      measure_segments);
}

// A pair of the step limiter needs no limit if both sides together move at most usable_share of its
// distance beyond the least one, which is less than its range. The largest motion and the largest
// step of a part may be those of different nodes.
void NearBarriers::find_motion(const Model &model, const std::vector<Vec3> &x,
                               const std::vector<Vec3> *dx) {
  for (auto *of : {&of_node_, &moved_, &ahead_}) of->resize(x.size());
  farthest_ = step_ = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    moved_[i] = static_cast<float>((x[i] - at_[i]).norm());
    ahead_[i] = dx ? static_cast<float>((*dx)[i].norm() / usable_share) : 0.0f;
    farthest_ = std::max(farthest_, moved_[i]);
    step_ = std::max(step_, ahead_[i]);
    of_node_[i] = moved_[i] + ahead_[i];
  }
  const auto &triangles = model.valve.triangles.get();
  of_triangle_.resize(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    of_triangle_[t] =
        std::max({moved_[i], moved_[j], moved_[k]}) + std::max({ahead_[i], ahead_[j], ahead_[k]});
  }
  const auto &edges = model.topology.edges.get();
  of_edge_.resize(edges.size());
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto [i, j] = edges[e];
    of_edge_[e] = std::max(moved_[i], moved_[j]) + std::max(ahead_[i], ahead_[j]);
  }
}

size_t NearBarriers::take_near(const BroadPhase &broad_phase) {
  near_triangles_.clear();
  near_edges_.clear();
  const auto &triangles = broad_phase.barrier_candidates();
  for (size_t k = 0; k < triangles.size(); ++k) {
    const VertexTriangle &c = triangles[k];
    if (triangle_gap_[k] > of_node_[c.vertex] + of_triangle_[c.triangle]) continue;
    near_triangles_.push_back(c);
  }
  const auto &edges = broad_phase.barrier_edge_candidates();
  for (size_t k = 0; k < edges.size(); ++k) {
    const EdgeEdge &c = edges[k];
    if (edge_gap_[k] > of_edge_[c.first] + of_edge_[c.second]) continue;
    near_edges_.push_back(c);
  }
  return near_triangles_.size() + near_edges_.size();
}

}  // namespace mvs::core
