// A fit with one law, and the choice among laws.
#include "patient/fit/fitted_law.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/intersect.h"
#include "measure/orifice/orifice.h"
#include "model/law.h"
#include "patient/fit/extend_free_edge.h"
#include "patient/fit/shape_error.h"

namespace mvs::core {
namespace {

// Another law takes the place of the default if its misfit is at most this share: two segmentations
// of one valve, or two folds of one closure, differ by a tenth.
constexpr double clearly_nearer = 0.9;
// A law may be that of the patient if its misfit is at most this many times the least: misfits
// contain the errors of the surface, and a law whose own error is three quarters of theirs has 1.25
// times their misfit.
constexpr double plausible = 1.25;
// m, of the closed surface (that of FitSettings), and of the free edge of the open one as networks
// draw it.
constexpr double distance_error = 0.5e-3, edge_error = 1.4e-3;
// Errors are independent over some 5 mm: 26 places along 130 mm of free edge, 60 on 1,500 mm2 of
// leaflets, whose squares the distance averages.
constexpr double edge_places = 26.0 / 60.0;

const char *word_of(LeafletLawId law) {
  return find_leaflet_law(law)->word;
}

std::string words_of(const LawFit &fit) {
  std::string words = format("%s %.2f mm", word_of(fit.law), fit.distance * 1e3);
  if (fit.edge > 0) words += format(" and %.2f mm", fit.edge * 1e3);
  return words;
}

Finding report(const std::vector<LawFit> &order, const LawFit &best) {
  std::string words;
  bool clear = true;
  for (const LawFit &fit : order) {
    words += (words.empty() ? "" : ", ") + words_of(fit);
    if (fit.law != best.law && misfit_of(fit) * clearly_nearer < misfit_of(best)) clear = false;
  }
  return {"tissue",
          FindingSource::guessed,
          clear ? 0.6 : 0.4,
          format("%s: of coarse valves with fitted chordae it lies nearest to the closed surface "
                 "(RMS distance, and by how much the free edge had to be moved out: %s; %s stays "
                 "unless another tissue is a tenth nearer); give the law if it is known",
                 word_of(best.law), words.c_str(), word_of(fitted_laws[0])),
          {static_cast<double>(best.law)},
          ""};
}

}  // namespace

std::optional<LawFit> fit_law(Valve valve, PatientGeometry g, const ClosedSurface &given,
                              bool edge_is_exact, const FitProgress &tell) {
  LawFit made;
  made.law = valve.leaflets[0].law;
  FitSettings settings;
  settings.starts = 1;
  Findings unused;
  try {
    if (!edge_is_exact) made.edge = extend_free_edge(valve, g, given, {}, unused, tell);
    const ChordFit fit =
        fit_to_closed(valve, given, settings, unused, {}, [&](uint32_t) { tell(1); });
    for (size_t k = 0; k < fit.groups.size(); ++k) made.factor[fit.groups[k].name] = fit.factor[k];
    Solver solver(Backend::fastest);
    const ClosedValve closed = close_open(solver, make_model(std::move(valve)), settings.pressure);
    const std::vector<Vec3> &x = closed.state.x;
    if (!closed.stats.converged) return std::nullopt;
    if (!find_intersections(x, closed.model->valve.triangles).empty()) return std::nullopt;
    made.distance = distance_from_valve(given, *closed.model, x);
    made.leak = measure_orifice(*closed.model, x).area;
  } catch (const Error &error) {
    if (error.code != MVS_E_DIVERGED) throw;
    return std::nullopt;
  }
  return made;
}

double misfit_of(const LawFit &fit) {
  const double edge = fit.edge * distance_error / edge_error;
  return std::sqrt(fit.distance * fit.distance + edge_places * edge * edge);
}

LawChoice choose_law(const std::vector<LawFit> &fits, Findings &findings) {
  LawChoice choice;
  if (fits.empty()) {
    findings.push_back({"tissue",
                        FindingSource::assumed,
                        0.2,
                        format("%s: with none of the tissues a coarse valve with fitted chordae "
                               "came to rest; give the law if it is known",
                               word_of(choice.law)),
                        {static_cast<double>(choice.law)},
                        ""});
    return choice;
  }
  std::vector<LawFit> order = fits;
  std::stable_sort(order.begin(), order.end(),
                   [](const LawFit &a, const LawFit &b) { return misfit_of(a) < misfit_of(b); });
  const double least = misfit_of(order[0]);
  const auto fallback = std::find_if(order.begin(), order.end(),
                                     [](const LawFit &fit) { return fit.law == fitted_laws[0]; });
  const bool stays = fallback != order.end() && least > clearly_nearer * misfit_of(*fallback);
  const LawFit &best = stays ? *fallback : order[0];
  choice.law = best.law;
  choice.factor = best.factor;
  for (const LawFit &fit : order) {
    if (misfit_of(fit) <= plausible * least) choice.leaks.push_back(fit.leak);
  }
  findings.push_back(report(order, best));
  return choice;
}

}  // namespace mvs::core
