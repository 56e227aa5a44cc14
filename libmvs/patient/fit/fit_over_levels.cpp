// Search on the coarse mesh, its factors on the fine valve, an improvement there if it is needed.
#include "patient/fit/fit_over_levels.h"

#include <map>
#include <optional>

#include "anatomy/coarsen.h"
#include "base/error.h"
#include "measure/orifice/orifice.h"
#include "patient/fit/fit_report.h"
#include "patient/fit/fit_search.h"
#include "patient/fit/linear_closure.h"

namespace mvs::core {
namespace {

constexpr double finer = 1.5;         // share of the coarse vertices from which levels pay
constexpr double coarse_share = 0.8;  // of the progress of a fit: that of the search

std::optional<Coarsened> coarsened(const Model &model, size_t vertices) {
  if (static_cast<double>(sheet_vertices(model)) < finer * static_cast<double>(vertices))
    return std::nullopt;
  try {
    return coarsen(model, vertices);
  } catch (const Error &error) {
    if (error.code != MVS_E_ARGUMENT) throw;
    return std::nullopt;  // its chordae need more vertices
  }
}

// The factors of a coarse fit on the chordae of the fine model. A chord that was merged into
// another one has the factor of its group.
ChordFit on_fine_chords(const ChordFit &rough, const Model &coarse, const Model &fine,
                        const FitSettings &s) {
  std::map<Id, size_t> place;
  for (size_t c = 0; c < coarse.valve.chords.size(); ++c) place[coarse.valve.chords[c].id] = c;
  std::map<std::string, size_t> named;
  for (size_t g = 0; g < rough.groups.size(); ++g) named[rough.groups[g].name] = g;
  ChordFit fit = rough;
  fit.groups = chord_groups(fine, s.grouping);
  fit.factor.clear();
  fit.deviation.clear();
  fit.chord_factor.assign(fine.valve.chords.size(), 1);
  fit.chord_deviation.assign(fine.valve.chords.size(), 0);
  for (const ChordGroup &group : fit.groups) {
    const auto of_group = named.find(group.name);
    const bool known = of_group != named.end();
    fit.factor.push_back(known ? rough.factor[of_group->second] : 1);
    fit.deviation.push_back(known ? rough.deviation[of_group->second] : s.prior);
    for (const uint32_t c : group.chords) {
      const auto same = place.find(fine.valve.chords[c].id);
      const bool kept = same != place.end();
      fit.chord_factor[c] = kept ? rough.chord_factor[same->second] : fit.factor.back();
      fit.chord_deviation[c] = kept ? rough.chord_deviation[same->second] : fit.deviation.back();
    }
  }
  return fit;
}

// Closes the fine valve with the factors; improves the groups if it lies farther from the surface.
void finish(const Valve &valve, const SurfaceMatcher &matcher, const FitSettings &s, Solver &solver,
            ChordFit &fit, const std::function<void()> &before_closure) {
  const ClosedJacobian jacobian = jacobian_by_linearisation();
  Valve shaped =
      valve;  // each chord by its factor over that of its group, which the search changes
  for (size_t g = 0; g < fit.groups.size(); ++g) {
    for (const uint32_t c : fit.groups[g].chords)
      shaped.chords[c].rest_length *= fit.chord_factor[c] / fit.factor[g];
  }
  FitParameters groups{fit.groups, {}, s.prior};
  groups.mean.assign(groups.groups.size(), 1);
  const FitSearch search(shaped, matcher, s, solver, jacobian, before_closure);
  FitTrial taken = search.from_open(groups, fit.factor);
  if (rms_distance(taken.matches) > as_good_as(fit.rms)) {
    FitTrial improved = taken;
    std::vector<double> deviation;
    fit.rounds += search.improve(groups, improved, deviation);
    const bool closes = without_divergence([&] {
      improved = search.from_open(groups, improved.factor);
      return true;
    });
    const auto loss = [](const FitTrial &trial) {
      return loss_of(rms_distance(trial.matches), trial.closed.stats.converged);
    };
    if (closes && loss(improved) < loss(taken)) {
      for (size_t g = 0; g < fit.groups.size(); ++g) {
        for (const uint32_t c : fit.groups[g].chords)
          fit.chord_factor[c] *= improved.factor[g] / fit.factor[g];
      }
      fit.factor = improved.factor;
      taken = std::move(improved);
    }
  }
  fit.rms = rms_distance(taken.matches);
  fit.at_rest = taken.closed.stats.converged;
  fit.leak = measure_orifice(*taken.closed.model, taken.closed.state.x).area;
}

}  // namespace

ChordFit fit_over_levels(Valve &valve, const ClosedSurface &given, const FitSettings &s,
                         Findings &findings, const TellShare &tell, size_t coarse) {
  const ModelPtr model = make_model(valve);
  const std::optional<Coarsened> level = coarsened(*model, coarse);
  if (!level) return fit_to_closed(valve, given, s, findings, {}, tell);
  Valve searched = level->model->valve;
  Findings of_coarse;
  const ChordFit rough = fit_to_closed(searched, given, s, of_coarse, {}, [&](double share) {
    if (tell) tell(coarse_share * share);
  });
  ChordFit fit = on_fine_chords(rough, *level->model, *model, s);
  Solver solver(Backend::fastest);
  // the closed coarse valve decides how the given surface is wound
  const ClosedValve closed = close_open(solver, make_model(searched), s.pressure);
  const SurfaceMatcher matcher(given, *closed.model, closed.state.x);
  finish(valve, matcher, s, solver, fit, [&] {
    if (tell) tell(coarse_share);
  });
  for (size_t c = 0; c < valve.chords.size(); ++c)
    valve.chords[c].rest_length *= fit.chord_factor[c];
  report_fit(fit, s, findings);
  return fit;
}

}  // namespace mvs::core
