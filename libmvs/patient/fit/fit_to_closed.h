// Rest lengths of chordae with which a valve closes to a given surface.
//
// Bounded regularised least squares (Gauss-Newton): one factor for each group of chordae, with a
// normal prior of mean 1; residuals are distances along fixed matches of both surfaces, renewed in
// each round as in iterative closest points (Besl and McKay 1992). Chordae that hang slack change
// nothing, so their groups are also tried shorter.
#pragma once

#include <functional>

#include "patient/chordae/chord_groups.h"
#include "patient/fit/closure.h"
#include "patient/fit/surface_match.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

struct FitSettings {
  ChordGrouping grouping = ChordGrouping::halves;
  double pressure = systolic_pressure;
  double least = 0.8, most = 1.25;  // factors
  double prior = 0.1;               // standard deviation of a factor
  double noise = 0.5e-3;            // m, standard deviation of the given surface
  uint32_t rounds = 6;              // at most
};

// Derivatives of residuals of a closed valve by a factor on the present lengths of each group:
// [group][match]. The default takes differences of closures that start from the closed valve.
using ClosedJacobian = std::function<std::vector<std::vector<double>>(
    const ClosedValve &closed, const std::vector<ChordGroup> &groups,
    const std::vector<SurfaceMatch> &matches)>;
ClosedJacobian jacobian_by_differences(Solver &solver);

struct ChordFit {
  std::vector<ChordGroup> groups;
  std::vector<double> factor;      // of each group
  std::vector<double> deviation;   // posterior standard deviation of each factor
  double rms_before = 0, rms = 0;  // m, distance of both surfaces
  uint32_t rounds = 0;
  bool at_rest = false;  // the closed valve of the fitted lengths
};

// Changes the rest lengths of `valve`. Throws if the surface is empty or lies elsewhere.
ChordFit fit_to_closed(Valve &valve, const ClosedSurface &given, const FitSettings &settings,
                       Findings &findings, ClosedJacobian jacobian = {});

}  // namespace mvs::core
