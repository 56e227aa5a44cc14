// The steps of a build in their order.
#include "patient/build_valve.h"

#include <optional>

#include "base/error.h"
#include "model/law.h"
#include "patient/findings.h"
#include "patient/fit/edge_range.h"
#include "patient/fit/extend_free_edge.h"
#include "patient/fit/fit_over_levels.h"
#include "patient/fit/fitted_law.h"
#include "patient/fit/thickness_range.h"
#include "patient/patient_valve.h"
#include "patient/tall_leaflets.h"

namespace mvs::core {
namespace {

constexpr double default_vertices = 1000;

void find_leaflets_of(const PatientSurface &surface, const MidSheet &mid, Findings &findings) {
  const SheetCoordinates coordinates = sheet_coordinates(mid.sheet, mid.rims);
  const LeafletArcs arcs =
      find_leaflets(mid.sheet, mid.rims, coordinates,
                    {surface.commissures, surface.anterior, surface.tips}, findings);
  doubt_tall_leaflets(mid.rims, coordinates, arcs, findings);
}

// A patient's leaflets on their mid-surface, with the landmarks that the meshes of all sizes share.
struct Patient {
  const MidSheet &mid;
  const PapillaryTips &tips;
  const ClosedSurface &closed;
};

// Fits of the coarse valve with each of some laws.
std::vector<LawFit> fits_of_laws(const std::vector<LeafletLawId> &laws, const Patient &patient,
                                 const BuildSettings &settings, const Findings &findings,
                                 const std::function<void(double)> &tell) {
  Findings of_coarse = findings;  // its commissures are those of the patient
  const PatientGeometry g =
      patient_geometry(patient.mid, edge_for(patient.mid.sheet, law_vertices), of_coarse);
  const bool edge_is_exact =
      find_edge_range(settings.edge_error, settings.edge_lost, g, of_coarse).geometry == nullptr;
  std::vector<LawFit> fits;
  for (size_t k = 0; k < laws.size(); ++k) {
    Findings of_law = of_coarse;
    Valve valve = patient_valve(settings, laws[k], g, patient.tips, of_law);
    const std::optional<LawFit> fit =
        fit_law(std::move(valve), g, patient.closed, edge_is_exact, [&](uint32_t search) {
          const double of_this = static_cast<double>(search) / law_searches;
          tell((static_cast<double>(k) + of_this) / static_cast<double>(laws.size()));
        });
    if (fit) fits.push_back(*fit);
  }
  return fits;
}

// The law that is given, the default without a closed surface, or the one of the nearest fit. With
// a closed surface a law that is given is fitted as well, so that the fine fit begins alike.
LawChoice law_of(const Patient &patient, const BuildSettings &settings, Findings &findings,
                 const std::function<void(double)> &tell) {
  LawChoice choice;
  Findings of_choice;
  if (!patient.closed.points.empty()) {
    begin_stage(settings, "tissue");
    std::vector<LeafletLawId> laws(fitted_laws.begin(), fitted_laws.end());
    if (settings.law) laws = {*settings.law};
    choice = choose_law(fits_of_laws(laws, patient, settings, findings, tell), of_choice);
  }
  if (settings.law) {
    choice.law = *settings.law;
    of_choice = {{"tissue",
                  FindingSource::given,
                  1,
                  format("%s, as given", find_leaflet_law(choice.law)->word),
                  {static_cast<double>(choice.law)},
                  ""}};
  }
  findings.insert(findings.end(), of_choice.begin(), of_choice.end());
  return choice;
}

// If the free edge is not exact, `g` and the valve get the tissue that the closed surface shows.
ChordFit fit_chords(const ClosedSurface &closed, const GroupFactors &known, bool edge_is_exact,
                    const Progress &progress, PatientGeometry &g, Valve &valve,
                    Findings &findings) {
  FitSettings settings;
  settings.known = known;
  const auto tell = [&](uint32_t search) {
    tell_progress(progress, 0.4 + 0.4 * search / (settings.starts + 1));
  };
  if (!edge_is_exact) extend_free_edge(valve, g, closed, known, findings, tell);
  return fit_over_levels(valve, closed, settings, findings,
                         [&](uint32_t start) { tell(start + 1); });
}

}  // namespace

void tell_progress(const Progress &progress, double share) {
  MVS_MUST(!progress || progress(share, 0), MVS_E_CANCELLED, "progress",
           "cancelled by the progress callback: the valve is as before");
}

BuiltValve build_valve(const PatientSurface &surface, const BuildSettings &settings,
                       const Progress &progress) {
  BuiltValve built;
  Findings &findings = built.findings;
  tell_progress(progress, 0.0);
  const MidSheet mid = find_mid_sheet(surface, settings, findings);
  begin_stage(settings, "leaflets");
  find_leaflets_of(surface, mid, findings);
  begin_stage(settings, "remesh");
  PatientGeometry g = patient_geometry(
      mid, settings.edge > 0 ? settings.edge : edge_for(mid.sheet, default_vertices), findings);
  const PapillaryTips tips = find_papillary_tips(surface.tips, g, findings);
  const ClosedSurface closed{surface.closed_points, surface.closed_triangles};
  const LawChoice choice = law_of({mid, tips, closed}, settings, findings, [&](double share) {
    tell_progress(progress, 0.1 + 0.3 * share);
  });
  begin_stage(settings, "chordae");
  Valve valve = patient_valve(settings, choice.law, g, tips, findings);
  valve.name = surface.name;
  tell_progress(progress, closed.points.empty() ? 0.1 : 0.4);
  const EdgeRange edge = find_edge_range(settings.edge_error, settings.edge_lost, g, findings);
  LeakUnknowns unknowns{{}, edge, settings.thickness_error, {}};
  std::vector<double> leaks = choice.leaks;
  double done = 0.1;
  if (!closed.points.empty()) {
    begin_stage(settings, "fit");
    const ChordFit fit =
        fit_chords(closed, choice.factor, edge.geometry == nullptr, progress, g, valve, findings);
    unknowns.lengths = range_after(fit);
    unknowns.shape = {&closed, &g};
    leaks.insert(leaks.end(), fit.leaks.begin(), fit.leaks.end());
    done = 0.8;
  }
  built.model = make_model(std::move(valve));
  if (!settings.finds_leak) return built;
  begin_stage(settings, "leak");
  report_thickness_error(settings.thickness_error, findings);
  built.leak = leak_interval(built.model, unknowns, leaks, findings, [&](double share) {
    tell_progress(progress, done + (1 - done) * share);
  });
  return built;
}

}  // namespace mvs::core
