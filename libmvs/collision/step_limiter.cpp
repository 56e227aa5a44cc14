// Step bounds by separating planes.
#include "collision/step_limiter.h"

#include <algorithm>
#include <cmath>

#include "geometry/distance.h"

namespace mvs::core {
namespace {

// The share of a distance that one step may use up. The rest is what rounding could never cross.
constexpr double usable = 0.9;
// m, nearer than this no instrument comes to the sheet: so far that a pair that was pressed to it
// parts again soon. A Newton step on a logarithm doubles its distance, and from 1e-10 m a ball that
// a hand drew back stuck in the tissue for twenty steps.
constexpr double closest_to_tool = 1e-6;
// Of the range of a pair's guard, 0.2 mm or less: how near two parts of the sheet come. A guard
// that is not given the room to push back is never in balance: where edges are 1 mm long it bears
// 1 N at a share of 5e-3 and 100 N, ten times the systolic force on a valve, at this one. A crease
// under a clip or of a needle presses with more than 1 N. Far above the rounding of places, 1e-17
// m.
constexpr double closest_share = 5e-5;
constexpr double closest_of_all = 1e-11;  // m
// Passes in which a node may follow one that gives way; then each keeps to its own half.
constexpr int lenient_passes = 30;
// Lists made for nodes that go together, before one that holds for each node by itself.
constexpr uint32_t lists_together = 2;

double closest_of_guard(double range) {
  return std::max(closest_share * range, closest_of_all);
}

}  // namespace

uint32_t StepLimiter::limit(const Model &model, const std::vector<Vec3> &x, double slack,
                            BroadPhase &broad_phase, std::vector<Vec3> &dx,
                            InstrumentBodies *tools) {
  static const std::vector<ToolPair> no_pairs;
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
    const auto &apart = tools ? tools->pairs_to_part(x) : no_pairs;
    if (limit(model, x, broad_phase, dx, apart) == 1 || broad_phase.for_itself()) return lists;
  }
}

double StepLimiter::limit(const Model &model, const std::vector<Vec3> &x,
                          const BroadPhase &broad_phase, std::vector<Vec3> &dx,
                          const std::vector<ToolPair> &tools) {
  take_pairs(model, x, broad_phase, dx);
  for (const ToolPair &p : tools) keep(p, p.radius + closest_to_tool, dx);
  if (pairs_.empty()) return 1;
  scale_.assign(dx.size(), 1.0);
  bool changed = true;
  for (int pass = 0; changed; ++pass) {
    changed = false;
    strict_ = pass >= lenient_passes;
    for (const Pair &pair : pairs_) changed = cut(pair, dx) || changed;
  }
  for (const ToolPair &p : tools) {
    for (uint32_t k = 0; k < 4; ++k) scale_[p.node[k]] = scale_[p.with[k]];
  }
  double least = 1;
  for (size_t i = 0; i < dx.size(); ++i) {
    if (scale_[i] < 1) dx[i] *= scale_[i];
    least = std::min(least, scale_[i]);
  }
  return least;
}

// Keeps a pair if its nodes move far enough to matter.
void StepLimiter::keep(const ToolPair &pair, double least, const std::vector<Vec3> &dx) {
  const double length = pair.apart.norm();
  const double room = usable * std::max(0.0, length - least);
  double near = 0, far = 0;
  for (uint32_t k = 0; k < 4; ++k) {
    double &side = k < pair.split ? near : far;
    side = std::max(side, dx[pair.node[k]].squaredNorm());
  }
  if (std::sqrt(near) + std::sqrt(far) <= room) return;
  pairs_.push_back({pair.node, pair.with, pair.split, pair.apart / length, room});
}

void StepLimiter::take_pairs(const Model &model, const std::vector<Vec3> &x,
                             const BroadPhase &broad_phase, const std::vector<Vec3> &dx) {
  pairs_.clear();
  pairs_.reserve(model.node_count());  // rarely more, so that a live step seldom allocates
  for (const VertexTriangle &c : broad_phase.barrier_candidates()) {
    const Tri &t = model.valve.triangles[c.triangle];
    const auto p = closest_on_triangle(x[c.vertex], x[t[0]], x[t[1]], x[t[2]]);
    const Vec3 q = p.weight[0] * x[t[0]] + p.weight[1] * x[t[1]] + p.weight[2] * x[t[2]];
    const std::array<uint32_t, 4> node = {c.vertex, t[0], t[1], t[2]};
    keep({node, node, 1, x[c.vertex] - q, 0}, closest_of_guard(c.guard), dx);
  }
  for (const EdgeEdge &c : broad_phase.barrier_edge_candidates()) {
    const Edge &e = model.topology.edges[c.first], &f = model.topology.edges[c.second];
    const auto p = closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]);
    const Vec3 r = x[e[0]] + p.s * (x[e[1]] - x[e[0]]) - x[f[0]] - p.t * (x[f[1]] - x[f[0]]);
    const std::array<uint32_t, 4> node = {e[0], e[1], f[0], f[1]};
    keep({node, node, 2, r, 0}, closest_of_guard(c.guard), dx);
  }
}

bool StepLimiter::cut(const Pair &pair, const std::vector<Vec3> &dx) {
  std::array<double, 4> approach;
  std::array<double, 2> side{-1e300, -1e300};
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t s = k < pair.split ? 0 : 1;
    const double along = pair.normal.dot(dx[pair.node[k]]) * scale_[pair.with[k]];
    approach[k] = s == 0 ? -along : along;
    side[s] = std::max(side[s], approach[k]);
  }
  if (side[0] + side[1] <= pair.room) return false;
  // what one side gives way, the other may follow; what both want, they share
  const double half = 0.5 * pair.room;
  std::array<double, 2> limit{half, half};
  if (!strict_ && side[0] < half) limit[1] = pair.room - side[0];
  if (!strict_ && side[1] < half) limit[0] = pair.room - side[1];
  bool changed = false;
  for (uint32_t k = 0; k < 4; ++k) {
    const double most = limit[k < pair.split ? 0 : 1];
    if (approach[k] <= most) continue;
    // a hair below, so that rounding does not bring the pair back
    const double share = most / approach[k] * (1 - 1e-12);
    scale_[pair.with[k]] *= share;
    if (k + 1 < pair.split && pair.with[k] == pair.with[k + 1]) approach[k + 1] *= share;
    changed = true;
  }
  return changed;
}

}  // namespace mvs::core
