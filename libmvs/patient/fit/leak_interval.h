// How much the leak of a built valve depends on the lengths of its chordae, its free edge and its
// thickness.
//
// The valve is closed with all lengths shorter, as they are, and longer; if the free edge is known
// to some error only, also with the edge farther out and farther in by it (free_edge_shift.h), and
// if the thickness is, with thicker and thinner tissue. If one of these closures leaks, it is
// closed with random lengths from the same range as well, one factor for each group of chordae and
// one for each chord, and with a random edge and thickness; the interval is the range of all leaks,
// a quarter wider on both sides: of nine closures alone, one valve in five would lie outside
// (exchangeable samples). Both ends move out by what meshes of one valve differ by, too, but not
// below 0. If the valve was fitted to a closed surface, the distance that remains from it is an
// error that all closures share: its share of the interval (shape_error.h) is added on both sides
// of the leak of the valve as it is, in squares, as lengths and shape err independently; and the
// interval reaches to what the gaps of the surface itself may leak (shown_gaps.h). Every
// closure starts from the open shape, so that none depends on another; one that does not come to
// rest within 400 iterations is left out, and the findings say so. If fewer than half do, the valve
// as it is goes on; if it comes to rest, the others count with the shapes that they have reached,
// else the interval is not known, and no random ones are closed in either case. A valve that still
// creeps after the last iteration shows as well whether it leaks: if none does, no random ones are
// closed, which creep as well and take most of the time of a build.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "base/tasks.h"
#include "model/model.h"
#include "patient/fit/edge_range.h"
#include "patient/fit/fit_to_closed.h"
#include "patient/fit/shape_error.h"
#include "patient/fit/shown_gaps.h"

namespace mvs::core {

// How far lengths may be from those of the valve.
struct LengthRange {
  double all = 0.1;           // of all lengths together, a share of them
  std::vector<double> group;  // of each of the groups of ChordGrouping::halves; empty: `all`
  double single = 0.03;       // of a chord beside its group
};
// The range that a fit leaves open: of each group, and of the mean of all groups.
LengthRange range_after(const ChordFit &fit);

// Whether all of these leaks, m2, are below the difference between meshes of one valve; a leak of
// NaN, that of a closure that diverged, is not.
bool all_seal(const std::vector<double> &leaks);

struct LeakInterval {
  std::array<double, 3> factor = {};        // on all rest lengths
  std::array<double, 3> leak = {};          // m2, regurgitant orifice at 120 mmHg; NaN: diverged
  std::array<bool, 3> at_rest = {};         // whether the closure came to rest
  std::array<uint32_t, 3> iterations = {};  // of each closure
  std::array<double, 2> edge_leak = {};     // m2, edge farther out and in; unused if it is exact
  std::array<double, 2> tissue_leak = {};   // m2, thicker and thinner; unused if that is exact
  ShapeLeaks shape;                         // of the valve as it is, if it was fitted
  std::array<double, 2> shown = {};         // m2, through the gaps of that surface; 0: none
  double least = NAN, most = NAN;           // m2, the interval; NaN: too few closures came to rest
  std::array<double, 2> of_closures = {NAN, NAN};  // m2, by the closures alone; NaN: the interval
  std::array<double, 2> with_shape = {NAN, NAN};   // m2, by these and the shape alone; the same
  uint32_t closures = 0, rests = 0;                // of these, those that came to rest
  uint32_t draws = 0;                              // closures with random lengths
  bool creeps = false;  // fewer than half came to rest, the valve as it is did; the others count
                        // with the shapes that they reached
};

// The unknowns of a valve over which its leak is found.
struct LeakUnknowns {
  LengthRange lengths;
  EdgeRange edge;
  double thickness_error = 0;  // m, of all leaflets together
  FittedShape shape;
};

// The interval around the leak of the valve as it is, widened by the error of its shape.
void add_shape_error(LeakInterval &interval);

// Makes the interval contain the gaps of the closed surface, each narrower and wider by its error.
void reach_to(const ShownGaps &shown, LeakInterval &interval);

// `known`: leaks of other closures of the same valve that came to rest, m2, which the interval
// contains. `tell` is called before and during closures; closures share the workers.
LeakInterval leak_interval(const ModelPtr &model, const LeakUnknowns &unknowns,
                           const std::vector<double> &known, Findings &findings,
                           const TellShare &tell = {}, Workers *workers = nullptr);

}  // namespace mvs::core
