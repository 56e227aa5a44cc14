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

// A law is clearly nearer than another if its misfit is at most this share: two segmentations of
// one valve, or two folds of one closure, differ by a tenth.
constexpr double clearly_nearer = 0.9;
// A law may be that of the patient if its misfit is at most this many times the least: misfits
// contain the errors of the surface, and a law whose own error is three quarters of theirs has 1.25
// times their misfit.
constexpr double plausible = 1.25;
// m, of the free edge of the open surface as networks draw it.
constexpr double edge_error = 1.4e-3;
// Errors are independent over some 5 mm: 26 places along 130 mm of free edge, 60 on 1,500 mm2 of
// leaflets, whose squares the distance averages.
constexpr double edge_places = 26.0 / 60.0;

const char *word_of(LeafletLawId law) {
  return find_leaflet_law(law)->word;
}

std::string words_of(const LawFit &fit) {
  std::string words = format("%s %.2f mm", word_of(fit.law), fit.distance * 1e3);
  if (!fit.at_rest) words += " (not at rest)";
  if (fit.edge > 0) words += format(" and %.2f mm", fit.edge * 1e3);
  return words;
}

}  // namespace

std::optional<LawFit> fit_law(Valve valve, PatientGeometry g, const ClosedSurface &given,
                              bool edge_is_exact, const FitProgress &tell) {
  LawFit made;
  made.law = valve.leaflets[0].law;
  const FitSettings settings;
  Findings unused;
  try {
    if (!edge_is_exact) made.edge = extend_free_edge(valve, g, given, {}, unused, tell);
    const ChordFit fit =
        fit_to_closed(valve, given, settings, unused, {}, [&](uint32_t start) { tell(start + 1); });
    for (size_t k = 0; k < fit.groups.size(); ++k) made.factor[fit.groups[k].name] = fit.factor[k];
    made.rms = fit.rms;
    Solver solver(Backend::fastest);
    const ClosedValve closed = close_open(solver, make_model(std::move(valve)), settings.pressure);
    const std::vector<Vec3> &x = closed.state.x;
    if (!find_intersections(x, closed.model->valve.triangles).empty()) return std::nullopt;
    made.distance = distance_from_valve(given, *closed.model, x);
    made.at_rest = closed.stats.converged;
    made.leak = measure_orifice(*closed.model, x).area;
  } catch (const Error &error) {
    if (error.code != MVS_E_DIVERGED) throw;
    return std::nullopt;
  }
  return made;
}

double misfit_of(const LawFit &fit) {
  const double edge = fit.edge * FitSettings().noise / edge_error;
  return std::sqrt(fit.distance * fit.distance + edge_places * edge * edge);
}

std::vector<LawFit> in_order(std::vector<LawFit> fits) {
  std::stable_sort(fits.begin(), fits.end(), [](const LawFit &a, const LawFit &b) {
    return a.at_rest != b.at_rest ? a.at_rest : misfit_of(a) < misfit_of(b);
  });
  return fits;
}

std::vector<LawFit> plausible_laws(const std::vector<LawFit> &fits) {
  std::vector<LawFit> laws;
  for (const LawFit &fit : fits) {
    if (fit.at_rest == fits[0].at_rest && misfit_of(fit) <= plausible * misfit_of(fits[0]))
      laws.push_back(fit);
  }
  return laws;
}

Finding tissue_found(const std::vector<LawFit> &fits, LeafletLawId taken) {
  if (fits.empty()) {
    return {"tissue",
            FindingSource::assumed,
            0.2,
            format("%s: no coarse valve with fitted chordae could be compared with the closed "
                   "surface; give the law if it is known",
                   word_of(taken)),
            {static_cast<double>(taken)},
            ""};
  }
  std::string words;
  for (const LawFit &fit : fits) words += (words.empty() ? "" : ", ") + words_of(fit);
  const LawFit &own =
      *std::find_if(fits.begin(), fits.end(), [&](const LawFit &fit) { return fit.law == taken; });
  const bool clear = std::all_of(fits.begin(), fits.end(), [&](const LawFit &fit) {
    return fit.law == taken || misfit_of(own) <= clearly_nearer * misfit_of(fit);
  });
  return {"tissue",
          FindingSource::guessed,
          !own.at_rest ? 0.2
          : clear      ? 0.6
                       : 0.4,
          format("%s, by distances (RMS) of the closed surface from coarse valves with fitted "
                 "chordae, and by how much their free edges had to be moved out: %s; give the law "
                 "if it is known",
                 word_of(taken), words.c_str()),
          {static_cast<double>(taken)},
          ""};
}

}  // namespace mvs::core
