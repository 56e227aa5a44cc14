// How far each node may go so that no sheet passes through another.
#pragma once

#include <vector>

#include "collision/broad_phase.h"
#include "collision/instrument_bodies.h"

namespace mvs::core {

// Shortens a step dx, node by node, until no motion x .. x + dx along straight lines brings a pair
// of `broad_phase` (which must reach as far as dx) to less than a tenth of its present distance, or
// nearer than its guard can hold it.
//
// For each pair a plane across its closest points separates it; the pair stays apart for the whole
// motion if its corners, moving linearly, keep their sides of it. Pairs for which the sum of both
// approaches is too much have each node's approach cut to its half. Cutting only ever shortens, and
// a pair cut once stays safe, so this ends after at most one cut of every pair. Unlike one global
// time of impact, two sheets that nearly touch do not stop the rest of the valve.
class StepLimiter {
 public:
  // Shortens a step so that nothing passes through anything, whatever there is to meet: finds the
  // pairs that could meet while all nodes move together, cuts, and looks again, as what is cut
  // moves against what is not. What cuts again and again gets a list that holds however each node
  // is cut. `broad_phase` then hold for x, for x + dx and between, within `slack`. Returns how
  // often they were looked for. What must not cross `tools` is looked for with them.
  uint32_t limit(const Model &model, const std::vector<Vec3> &x, double slack,
                 BroadPhase &broad_phase, std::vector<Vec3> &dx, InstrumentBodies *tools = nullptr);

  // Returns the smallest factor by which a node's step was cut, 1 if none was. What an instrument
  // must not cross comes in `tools`.
  double limit(const Model &model, const std::vector<Vec3> &x, const BroadPhase &broad_phase,
               std::vector<Vec3> &dx, const std::vector<ToolPair> &tools = {});

 private:
  struct Pair {
    std::array<uint32_t, 4> node, with;  // with: whose share of its step a node goes
    uint32_t split;                      // nodes before it are on the side the normal points to
    Vec3 normal;
    double room;  // m, the share of the distance that may be used up
  };
  void take_pairs(const Model &model, const std::vector<Vec3> &x, const BroadPhase &broad_phase,
                  const std::vector<Vec3> &dx);
  void keep(const ToolPair &pair, double least, const std::vector<Vec3> &dx);
  bool cut(const Pair &pair, const std::vector<Vec3> &dx);

  std::vector<Vec3> to_;
  std::vector<Pair> pairs_;
  std::vector<double> scale_;
  bool strict_ = false;
};

}  // namespace mvs::core
