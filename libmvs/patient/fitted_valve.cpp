// Coarse fits with several laws, then a fine one.
#include "patient/fitted_valve.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "model/law.h"
#include "patient/fit/edge_range.h"
#include "patient/fit/extend_free_edge.h"
#include "patient/fit/fit_over_levels.h"
#include "patient/fit/fitted_law.h"

namespace mvs::core {
namespace {

// A fine valve whose distance from the closed surface is this many times that of the coarse one
// lies in another fold: meshes of one fold differ by a tenth (as_good_as).
constexpr double other_fold = 1.2;

// Fits of the coarse valve with each of some laws.
std::vector<LawFit> fits_of_laws(const std::vector<LeafletLawId> &laws, const Patient &patient,
                                 const BuildSettings &settings, const Findings &findings,
                                 const TellShare &tell) {
  Findings of_coarse = findings;  // its commissures are those of the patient
  const double edge = std::max(settings.edge, edge_for(patient.mid.sheet, law_vertices));
  const PatientGeometry g = patient_geometry(patient.mid, edge, of_coarse);
  const bool edge_is_exact =
      find_edge_range(settings.edge_error, settings.edge_lost, g, of_coarse).geometry == nullptr;
  std::vector<Valve> valves;
  valves.reserve(laws.size());
  for (const LeafletLawId law : laws) {
    Findings of_law = of_coarse;
    valves.push_back(patient_valve(settings, law, g, patient.boundary, of_law));
  }
  return fit_laws(std::move(valves), g, patient.closed, edge_is_exact, tell, settings.workers);
}

// Coarse fits, the nearest first: with the given law, so that its fine fit begins at the same
// factors, or with each of three.
std::vector<LawFit> coarse_fits(const Patient &patient, const BuildSettings &settings,
                                const Findings &findings, const TellShare &tell) {
  begin_stage(settings, "tissue");
  std::vector<LeafletLawId> laws(fitted_laws.begin(), fitted_laws.end());
  if (settings.law) laws = {*settings.law};
  try {
    return in_order(fits_of_laws(laws, patient, settings, findings, tell));
  } catch (const Error &error) {
    // a sheet that has no coarse mesh, or a closed surface that the fine fit refuses
    if (error.code != MVS_E_ARGUMENT && error.code != MVS_E_OP) throw;
    return {};
  }
}

// Fits the chordae of a valve. If the free edge is not exact, it gets the tissue that the closed
// surface shows.
FittedValve fit_valve(const Patient &patient, const BuildSettings &settings, const LawFit &coarse,
                      const PatientGeometry &g, const Findings &findings, const TellShare &tell) {
  FittedValve made{coarse.law, g, {}, findings, {}, {}};
  made.valve = patient_valve(settings, coarse.law, g, patient.boundary, made.findings);
  FitSettings s;
  s.known = coarse.factor;
  s.workers = settings.workers;
  // of the progress: the search for the free edge is one beside the others
  const double edge_share = 1.0 / (s.starts + 1);
  const EdgeRange edge =
      find_edge_range(settings.edge_error, settings.edge_lost, made.g, made.findings);
  if (edge.geometry != nullptr) {
    extend_free_edge(made.valve, made.g, patient.closed, s.known, made.findings,
                     [&](double share) { tell(edge_share * share); });
  }
  made.fit = fit_over_levels(made.valve, patient.closed, s, made.findings,
                             [&](double share) { tell(edge_share + (1 - edge_share) * share); });
  return made;
}

// The fine valve with the law of the nearest coarse fit. The fine one may close in another fold,
// farther from the surface; then the other plausible laws are tried, and the nearest is taken.
FittedValve fit_with_laws(const Patient &patient, const BuildSettings &settings,
                          const std::vector<LawFit> &fits, const PatientGeometry &g,
                          const Findings &findings, const TellShare &tell) {
  std::vector<LawFit> laws = plausible_laws(fits);
  if (laws.empty()) {
    laws.emplace_back();
    laws[0].law = settings.law.value_or(fitted_laws[0]);
  }
  std::optional<FittedValve> best;
  for (size_t k = 0; k < laws.size(); ++k) {
    FittedValve made = fit_valve(patient, settings, laws[k], g, findings, [&](double share) {
      tell((static_cast<double>(k) + share) / static_cast<double>(laws.size()));
    });
    const bool same_fold = made.fit.rms <= other_fold * laws[k].rms;
    const auto loss = [](const ChordFit &fit) { return loss_of(fit.rms, fit.at_rest); };
    if (!best || loss(made.fit) < loss(best->fit)) best = std::move(made);
    if (same_fold) break;
  }
  return std::move(*best);
}

}  // namespace

Finding given_tissue(LeafletLawId law) {
  return {"tissue",
          FindingSource::given,
          1,
          format("%s, as given", find_leaflet_law(law)->word),
          {static_cast<double>(law)},
          ""};
}

FittedValve fitted_valve(const Patient &patient, const BuildSettings &settings,
                         const PatientGeometry &g, const Findings &findings,
                         const TellShare &tell) {
  const std::vector<LawFit> fits =
      coarse_fits(patient, settings, findings, [&](double share) { tell(0.4 * share); });
  begin_stage(settings, "fit");
  FittedValve made = fit_with_laws(patient, settings, fits, g, findings,
                                   [&](double share) { tell(0.4 + 0.6 * share); });
  made.findings.push_back(settings.law ? given_tissue(made.law) : tissue_found(fits, made.law));
  for (const LawFit &fit : plausible_laws(fits)) {
    if (fit.at_rest) made.leaks.push_back(fit.leak);
  }
  if (made.fit.at_rest) made.leaks.push_back(made.fit.leak);
  made.leaks.insert(made.leaks.end(), made.fit.other_leaks.begin(), made.fit.other_leaks.end());
  return made;
}

}  // namespace mvs::core
