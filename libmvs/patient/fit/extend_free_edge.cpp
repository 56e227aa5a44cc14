// One search over groups, the overhang of its closed valve, the edge moved by it.
#include "patient/fit/extend_free_edge.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "patient/coordinates.h"
#include "patient/fit/closure.h"
#include "patient/fit/edge_overhang.h"
#include "patient/fit/fit_over_levels.h"
#include "patient/fit/free_edge_shift.h"

namespace mvs::core {
namespace {

constexpr double least_mean = 0.1e-3;  // m: exact surfaces of one valve differ by as much

constexpr double limit_share = 0.9;  // of most_overhang: few edges lack as much

// The valve with the lengths of a search from one start, closed from open.
ClosedValve closed_roughly(const Valve &valve, const ClosedSurface &given,
                           const GroupFactors &known, const TellShare &tell) {
  FitSettings settings;
  settings.starts = 1;
  settings.one_by_one = false;
  settings.rounds = 3;
  settings.known = known;
  Valve fitted = valve;
  Findings of_search;
  fit_over_levels(fitted, given, settings, of_search, tell);
  Solver solver(Backend::fastest);
  return close_open(solver, make_model(std::move(fitted)), settings.pressure);
}

}  // namespace

double extend_free_edge(Valve &valve, PatientGeometry &g, const ClosedSurface &given,
                        const GroupFactors &known, Findings &findings, const TellShare &tell) {
  const ClosedValve closed = closed_roughly(valve, given, known, tell);
  const SurfaceMatcher matcher(given, *closed.model, closed.state.x);
  const std::vector<double> by =
      edge_overhang(g, closed, matcher.match(*closed.model, closed.state.x));
  double sum = 0, squares = 0, most = 0;
  for (const uint32_t i : g.rims.free_edge) {
    sum += by[i];
    squares += by[i] * by[i];
    most = std::max(most, by[i]);
  }
  const double nodes = static_cast<double>(g.rims.free_edge.size());
  const double mean = sum / nodes;
  if (mean < least_mean) return 0;
  valve = with_edge_moved(valve, g, by);
  std::copy_n(valve.rest.get().begin(), g.sheet.x.size(), g.sheet.x.begin());
  g.coordinates = sheet_coordinates(g.sheet, g.rims);
  const bool at_limit = most > limit_share * most_overhang;
  findings.push_back(
      {"edge_found",
       FindingSource::guessed,
       at_limit ? 0.2 : 0.5,
       format("the closed surface goes on past the free edge of the open one: the edge was moved "
              "out by %.2f mm in the mean, at most %.2f mm%s; if the open surface has its edge "
              "where it is, the tissue is softer than the one taken: give its law, and say that "
              "the edge is exact",
              mean * 1e3, most * 1e3, at_limit ? ", the limit" : ""),
       {mean, most},
       "m"});
  return std::sqrt(squares / nodes);
}

}  // namespace mvs::core
