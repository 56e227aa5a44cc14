// How much the leak of a built valve depends on the lengths of its chordae and on its free edge.
//
// The valve is closed with all lengths shorter, as they are, and longer; if the free edge is known
// to some error only, also with the edge farther out and farther in by it (free_edge_shift.h). If
// one of these closures leaks, it is closed with random lengths from the same range as well, one
// factor for each group of chordae and one for each chord, and with a random edge; the interval is
// the range of all leaks, a quarter wider on both sides and not below 0: of nine closures alone,
// one valve in five would lie outside (exchangeable samples). Every closure starts from the open
// shape, so that none depends on another.
#pragma once

#include <array>
#include <vector>

#include "model/model.h"
#include "patient/fit/edge_range.h"
#include "patient/fit/fit_to_closed.h"

namespace mvs::core {

// How far lengths may be from those of the valve.
struct LengthRange {
  double all = 0.1;           // of all lengths together, a share of them
  std::vector<double> group;  // of each of the groups of ChordGrouping::halves; empty: `all`
  double single = 0.03;       // of a chord beside its group
};
// The range that a fit leaves open.
LengthRange range_after(const ChordFit &fit);

struct LeakInterval {
  std::array<double, 3> factor = {};        // on all rest lengths
  std::array<double, 3> leak = {};          // m2, regurgitant orifice at 120 mmHg
  std::array<bool, 3> at_rest = {};         // whether the closure came to rest
  std::array<uint32_t, 3> iterations = {};  // of each closure
  std::array<double, 2> edge_leak = {};     // m2, edge farther out and in; 0: edge exact
  double least = 0, most = 0;               // m2, the interval
  uint32_t draws = 0;                       // closures with random lengths
};

// `known`: leaks of other closures of the same valve, m2, which the interval contains. `tell` is
// called before each closure with its number and their number at most; it may throw.
LeakInterval leak_interval(const ModelPtr &model, const LengthRange &range, const EdgeRange &edge,
                           const std::vector<double> &known, Findings &findings,
                           const std::function<void(uint32_t, uint32_t)> &tell = {});

}  // namespace mvs::core
