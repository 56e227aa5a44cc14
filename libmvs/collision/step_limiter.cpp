// Limits by separating planes.
#include "collision/step_limiter.h"

#include <algorithm>
#include <cmath>

#include "collision/approach.h"
#include "geometry/distance.h"

namespace mvs::core {
namespace {

// Least distance of two parts of the sheet, as a share of their barrier's range (0.2 contact
// thicknesses or less), and in m. A barrier without room to push back never comes to balance: where
// edges are 1 mm long it bears 1 N at a share of 5e-3, and 100 N, ten times the systolic force on a
// valve, at this one. A crease under a clip or of a needle presses with more than 1 N. Both are far
// above the rounding of positions, 1e-17 m.
constexpr double least_barrier_share = 5e-5;
constexpr double least_distance_of_all = 1e-11;
// Passes in which one side may use what the other leaves; then each keeps to its half.
constexpr int sharing_passes = 30;
// Lists built for nodes that move together, before those for independent ones.
constexpr uint32_t lists_together = 2;

double least_distance(double barrier_range) {
  return std::max(least_barrier_share * barrier_range, least_distance_of_all);
}

}  // namespace

uint32_t StepLimiter::limit(const Model &model, const std::vector<Vec3> &x, double slack,
                            BroadPhase &broad_phase, std::vector<Vec3> &dx,
                            InstrumentBodies *tools) {
  static const std::vector<ToolPair> no_pairs;
  static const std::vector<BodyPair> no_body_pairs;
  if (tools) tools->convex().keep_upright(dx);
  for (uint32_t lists = 0;;) {
    to_.resize(x.size());
    for (size_t i = 0; i < x.size(); ++i) to_[i] = x[i] + dx[i];
    const bool is_new = tools && !tools->is_prepared();
    if (is_new || !broad_phase.valid_for(x) || !broad_phase.valid_for(to_)) {
      if (is_new || !broad_phase.recall(x, to_)) {
        broad_phase.build(x, to_, slack,
                          lists < lists_together ? StepMotion::together : StepMotion::independent);
        ++lists;
      }
      if (tools) tools->prepare(x, to_, slack);
    }
    const auto &tool_pairs = tools ? tools->barrier_pairs(x) : no_pairs;
    const auto &body_pairs = tools ? tools->convex().barrier_pairs(x, dx) : no_body_pairs;
    if (limit(model, x, broad_phase, dx, tool_pairs, body_pairs) == 1 ||
        broad_phase.is_independent()) {
      return lists;
    }
  }
}

double StepLimiter::limit(const Model &model, const std::vector<Vec3> &x,
                          const BroadPhase &broad_phase, std::vector<Vec3> &dx,
                          const std::vector<ToolPair> &tools, const std::vector<BodyPair> &bodies) {
  add_pairs(model, x, broad_phase, dx);
  for (const ToolPair &p : tools) add_pair(p, p.radius + least_tool_distance, dx);
  for (const BodyPair &p : bodies) add_pair(p, dx);
  if (pairs_.empty()) return 1;
  max_safe_step_.assign(dx.size(), 1.0);
  bool changed = true;
  for (int pass = 0; changed; ++pass) {
    changed = false;
    for (const Pair &pair : pairs_)
      changed = limit_pair(pair, dx, pass >= sharing_passes) || changed;
  }
  for (const ToolPair &p : tools) {
    for (uint32_t k = 0; k < 4; ++k) max_safe_step_[p.node[k]] = max_safe_step_[p.with[k]];
  }
  for (const BodyPair &p : bodies) {
    for (uint32_t k = 1; k < frame_points; ++k)
      max_safe_step_[p.frame + k] = max_safe_step_[p.frame];
  }
  double least = 1;
  for (size_t i = 0; i < dx.size(); ++i) {
    if (max_safe_step_[i] < 1) dx[i] *= max_safe_step_[i];
    least = std::min(least, max_safe_step_[i]);
  }
  return least;
}

// Adds a pair if its nodes move far enough to need a limit.
void StepLimiter::add_pair(const ToolPair &pair, double least_distance,
                           const std::vector<Vec3> &dx) {
  const double length = pair.separation.norm();
  const double max_approach = usable_share * std::max(0.0, length - least_distance);
  double near = 0, far = 0;
  for (uint32_t k = 0; k < 4; ++k) {
    double &side = k < pair.split ? near : far;
    side = std::max(side, dx[pair.node[k]].squaredNorm());
  }
  if (std::sqrt(near) + std::sqrt(far) <= max_approach) return;
  pairs_.push_back({pair.node, pair.with, pair.split, pair.separation / length, max_approach, {}});
}

void StepLimiter::add_pair(const BodyPair &pair, const std::vector<Vec3> &dx) {
  const double max_approach =
      usable_share * std::max(0.0, pair.gap - pair.radius - least_tool_distance);
  double far = 0;
  for (const uint32_t i : pair.node) far = std::max(far, dx[i].squaredNorm());
  if (pair.body_approach + std::sqrt(far) <= max_approach) return;
  const auto [i, j, k] = pair.node;
  const std::array<uint32_t, 4> node = {pair.frame, i, j, k};
  pairs_.push_back({node, node, 1, pair.normal, max_approach, pair.body_approach});
}

void StepLimiter::add_pairs(const Model &model, const std::vector<Vec3> &x,
                            const BroadPhase &broad_phase, const std::vector<Vec3> &dx) {
  pairs_.clear();
  pairs_.reserve(model.node_count());  // rarely more, so that a live step seldom allocates
  near_.select(model, broad_phase, x, &dx);
  for (const VertexTriangle &c : near_.triangles()) {
    const Tri &t = model.valve.triangles[c.triangle];
    const auto p = closest_on_triangle(x[c.vertex], x[t[0]], x[t[1]], x[t[2]]);
    const Vec3 q = p.weight[0] * x[t[0]] + p.weight[1] * x[t[1]] + p.weight[2] * x[t[2]];
    const std::array<uint32_t, 4> node = {c.vertex, t[0], t[1], t[2]};
    add_pair({node, node, 1, x[c.vertex] - q, 0}, least_distance(c.range), dx);
  }
  for (const EdgeEdge &c : near_.edges()) {
    const Edge &e = model.topology.edges[c.first], &f = model.topology.edges[c.second];
    const auto p = closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]);
    const Vec3 r = x[e[0]] + p.s * (x[e[1]] - x[e[0]]) - x[f[0]] - p.t * (x[f[1]] - x[f[0]]);
    const std::array<uint32_t, 4> node = {e[0], e[1], f[0], f[1]};
    add_pair({node, node, 2, r, 0}, least_distance(c.range), dx);
  }
}

bool StepLimiter::limit_pair(const Pair &pair, const std::vector<Vec3> &dx, bool by_halves) {
  std::array<double, 4> approach;
  std::array<double, 2> side{-1e300, -1e300};
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t s = k < pair.split ? 0 : 1;
    const double whole =
        k == 0 && pair.body_approach ? -*pair.body_approach : pair.normal.dot(dx[pair.node[k]]);
    const double along = whole * max_safe_step_[pair.with[k]];
    approach[k] = s == 0 ? -along : along;
    side[s] = std::max(side[s], approach[k]);
  }
  if (side[0] + side[1] <= pair.max_approach) return false;
  // a side that needs less than its half leaves the rest to the other
  const double half = 0.5 * pair.max_approach;
  std::array<double, 2> most{half, half};
  if (!by_halves && side[0] < half) most[1] = pair.max_approach - side[0];
  if (!by_halves && side[1] < half) most[0] = pair.max_approach - side[1];
  bool changed = false;
  for (uint32_t k = 0; k < 4; ++k) {
    const double allowed = most[k < pair.split ? 0 : 1];
    if (approach[k] <= allowed) continue;
    // slightly less, so that rounding does not bring the pair back
    const double share = allowed / approach[k] * (1 - 1e-12);
    max_safe_step_[pair.with[k]] *= share;
    if (k + 1 < pair.split && pair.with[k] == pair.with[k + 1]) approach[k + 1] *= share;
    changed = true;
  }
  return changed;
}

}  // namespace mvs::core
