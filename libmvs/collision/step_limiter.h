// Conservative continuous collision detection: shortens the step of each node so that no motion
// x .. x + dx along straight lines brings a pair of the broad phase to less than a tenth of its
// present distance, or nearer than its barrier can hold it.
//
// The plane across the closest points of a pair separates it. The pair stays apart during the whole
// motion if its corners, moving linearly, keep their sides of that plane. If both sides together
// approach by more than the pair allows, 90 % of its distance beyond the least one, each side is
// limited to a half, and in the first passes a side that needs less leaves the rest to the other.
// Steps are only ever shortened; after the first passes a limited pair stays safe, so that the
// passes end.
// Unlike one global time of impact, two sheets that nearly touch do not stop the rest of the valve.
#pragma once

#include <optional>
#include <vector>

#include "collision/broad_phase.h"
#include "collision/instrument_bodies.h"
#include "collision/near_barriers.h"

namespace mvs::core {

class StepLimiter {
 public:
  // Limits the step of a whole model and of its instruments. Builds `broad_phase` for nodes that
  // move together, limits, and builds it again, as limited nodes move relative to others; the third
  // lists hold for nodes that move independently, and so for any further limit. At the end the
  // lists hold at x, at x + dx and between, within `slack`. Returns how often they were built.
  uint32_t limit(const Model &model, const std::vector<Vec3> &x, double slack,
                 BroadPhase &broad_phase, std::vector<Vec3> &dx, InstrumentBodies *tools = nullptr);

  // Limits a step for the pairs of `broad_phase`, which must hold for it, of `tools` and of
  // `bodies`. Returns the smallest factor by which the step of a node was shortened, 1 if none was.
  double limit(const Model &model, const std::vector<Vec3> &x, const BroadPhase &broad_phase,
               std::vector<Vec3> &dx, const std::vector<ToolPair> &tools = {},
               const std::vector<BodyPair> &bodies = {});

 private:
  struct Pair {
    std::array<uint32_t, 4> node, with;  // with: the node whose share of its step a node takes
    uint32_t split;                      // nodes before it are on the side of the normal
    Vec3 normal;
    double max_approach;                  // m, of both sides together
    std::optional<double> body_approach;  // m, of node 0, the frame of a convex tool
  };
  void add_pairs(const Model &model, const std::vector<Vec3> &x, const BroadPhase &broad_phase,
                 const std::vector<Vec3> &dx);
  void add_pair(const ToolPair &pair, double least_distance, const std::vector<Vec3> &dx);
  void add_pair(const BodyPair &pair, const std::vector<Vec3> &dx);
  bool limit_pair(const Pair &pair, const std::vector<Vec3> &dx, bool by_halves);

  NearBarriers near_;
  std::vector<Vec3> to_;
  std::vector<Pair> pairs_;
  std::vector<double> max_safe_step_;  // of each node, a share of its step
};

}  // namespace mvs::core
