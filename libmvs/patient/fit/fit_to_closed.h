// Rest lengths of chordae with which a valve closes to a given surface.
//
// Bounded regularised least squares (Gauss-Newton), first one factor for each group of chordae with
// a normal prior of mean 1, then one for each chord with the group's as its mean; residuals are
// distances along fixed matches of both surfaces, renewed in each round as in iterative closest
// points (Besl and McKay 1992). Chordae that hang slack change nothing, so their groups are also
// tried shorter. The search is repeated from other lengths, and every result is closed from the
// open shape, as a user closes the valve: that closure decides which one is taken, and those that
// are as good show how far the surface leaves lengths and shape open.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/tasks.h"
#include "patient/chordae/chord_groups.h"
#include "patient/fit/closure.h"
#include "patient/fit/surface_match.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Factors on the lengths of groups, by name.
using GroupFactors = std::map<std::string, double>;

struct FitSettings {
  ChordGrouping grouping = ChordGrouping::halves;
  bool one_by_one = true;  // each chord after the groups
  double pressure = systolic_pressure;
  double least = 0.8, most = 1.25;    // factors
  double prior = 0.1;                 // standard deviation of a group's factor
  double single_prior = 0.1;          // of a chord's factor around that of its group
  double noise = usual_closed_error;  // m, standard deviation of the given surface
  uint32_t rounds = 6;                // at most, of each search
  uint32_t starts = 3;                // searches, the first from `known`
  GroupFactors known;                 // of a fit on another mesh; other groups begin at 1
  Workers *workers = nullptr;         // that make searches at the same time
};

// A factor is not determined by the surface if its deviation is at least this share of the prior's.
inline constexpr double undetermined_share = 0.7;

// Derivatives of residuals of a closed valve by a factor on the present lengths of each group:
// [group][match]. The default is jacobian_by_linearisation() (linear_closure.h).
using ClosedJacobian = std::function<std::vector<std::vector<double>>(
    const ClosedValve &closed, const std::vector<ChordGroup> &groups,
    const std::vector<SurfaceMatch> &matches)>;

struct ChordFit {
  std::vector<ChordGroup> groups;
  std::vector<double> factor;           // of each group: the mean of its chordae
  std::vector<double> deviation;        // of each group's factor: standard deviation of the
                                        // posterior and of the fits that are as good
  std::vector<double> chord_factor;     // of each chord segment; 1 for sutures
  std::vector<double> chord_deviation;  // the same
  double rms_before = 0, rms = 0;       // m, distance of both surfaces, closed from open
  double spread = 0;                    // m, RMS between the nodes of fits that are as good
  double leak = 0;                      // m2, of the closed valve of the fitted lengths
  bool at_rest = false;                 // that valve
  std::vector<double> other_leaks;      // m2, of the other fits that are as good, all at rest
  uint32_t rounds = 0;                  // of all searches
};

// Another fit is as good as the best one if its distance is at most this much larger: less than two
// segmentations, or two meshes, of one valve differ by.
inline double as_good_as(double rms) {
  constexpr double share = 1.1, distance = 0.05e-3;  // m
  return share * rms + distance;
}

// Distance by which fits are compared, m: a valve that is not at rest is the last choice.
inline double loss_of(double rms, bool at_rest) {
  constexpr double not_at_rest = 1;  // m, farther than any fit
  return rms + (at_rest ? 0 : not_at_rest);
}

// The searches of a fit, so that a caller can give up a fit that falls behind another.
class FitSearches {
 public:
  // Throws if the surface is empty or lies elsewhere. Keeps a reference to `given`.
  FitSearches(Valve valve, const ClosedSurface &given, const FitSettings &settings,
              ClosedJacobian jacobian = {});
  ~FitSearches();
  // The next searches. `tell` is called before each closure.
  void search(uint32_t count, const TellShare &tell);
  // Of the best search so far: its valve, closed from open.
  const ClosedValve &closed() const;
  // The best search so far, and how far those as good as it lie from it.
  ChordFit fit() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

// All searches. Changes the rest lengths of `valve`. Throws as FitSearches does. `tell` is called
// before each closure.
ChordFit fit_to_closed(Valve &valve, const ClosedSurface &given, const FitSettings &settings,
                       Findings &findings, ClosedJacobian jacobian = {},
                       const TellShare &tell = {});

}  // namespace mvs::core
